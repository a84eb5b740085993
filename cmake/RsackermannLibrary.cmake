# The library: the sources of the module that ocv_define_module() takes, too.

include(cmake/RsackermannDispatch.cmake)
include(cmake/RsackermannOpenCL.cmake)

set(RSACKERMANN_MODULE_DIR "${PROJECT_SOURCE_DIR}/modules/rsackermann")
file(GLOB_RECURSE library_sources CONFIGURE_DEPENDS "${RSACKERMANN_MODULE_DIR}/src/*.cpp")
rsackermann_keep_core(library_sources)

add_library(opencv_rsackermann ${library_sources})
add_library(rsackermann::rsackermann ALIAS opencv_rsackermann)
rsackermann_add_dispatched_files(opencv_rsackermann "${RSACKERMANN_MODULE_DIR}")
target_include_directories(opencv_rsackermann PRIVATE "${RSACKERMANN_DISPATCH_DIR}")
rsackermann_embed_opencl(opencv_rsackermann "${RSACKERMANN_MODULE_DIR}/src/opencl")

set_target_properties(opencv_rsackermann PROPERTIES
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
  EXPORT_NAME rsackermann
  DEFINE_SYMBOL "") # CVAPI_EXPORTS does it; so the objects of a static library are those of a shared one, for ccache
target_compile_features(opencv_rsackermann PUBLIC cxx_std_${CMAKE_CXX_STANDARD})
target_compile_definitions(opencv_rsackermann PRIVATE CVAPI_EXPORTS)
if(RSACKERMANN_CORE_ONLY)
  # For opencv2/rsackermann.hpp. Not for the tests, which don't include it: ccache has their objects from a build of the
  # whole.
  target_compile_definitions(opencv_rsackermann INTERFACE $<INSTALL_INTERFACE:RSACKERMANN_CORE_ONLY>)
endif()
# The library runs in threads of the caller, whose stacks may be small.
if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  target_compile_options(opencv_rsackermann PRIVATE -Wframe-larger-than=16384)
endif()
set(RSACKERMANN_INSTALL_INCLUDEDIR "${CMAKE_INSTALL_INCLUDEDIR}/opencv${OpenCV_VERSION_MAJOR}")
target_include_directories(opencv_rsackermann
  PUBLIC "$<BUILD_INTERFACE:${RSACKERMANN_MODULE_DIR}/include>"
         "$<INSTALL_INTERFACE:${RSACKERMANN_INSTALL_INCLUDEDIR}>")
target_link_libraries(opencv_rsackermann
  PUBLIC opencv_core opencv_imgproc opencv_video
  PRIVATE "$<BUILD_INTERFACE:Eigen3::Eigen>")
# What most sources include. By names that are found on the way of includes: with paths ccache would find nothing again
# from another checkout.
target_precompile_headers(opencv_rsackermann PRIVATE
  <cpu_dispatch.hpp> # for *.dispatch.cpp, in which it has to come first
  <opencv2/rsackermann/estimator.hpp> <opencv2/rsackermann/warp.hpp>
  <opencv2/imgproc.hpp> <opencv2/core/utils/logger.hpp> <Eigen/Cholesky>)
# opencv2/opencv_modules.hpp defines HAVE_OPENCV_XIMGPROC if OpenCV has this module.
if(TARGET opencv_ximgproc)
  target_link_libraries(opencv_rsackermann PRIVATE opencv_ximgproc)
endif()
