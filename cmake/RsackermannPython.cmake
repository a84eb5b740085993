# The Python package rsackermann for the OpenCV that is installed: OpenCV's own generator and converters, from its
# source, make an extension of their own of the headers of core and of this module. It is in the build's folder python.

find_package(Python3 REQUIRED COMPONENTS Interpreter Development NumPy)
set(opencv_modules "${OPENCV_TS_SOURCE_DIR}/modules")
set(RSACKERMANN_PYTHON_DIR "lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/dist-packages" CACHE STRING
  "Folder of Python packages below CMAKE_INSTALL_PREFIX")
set(misc "${RSACKERMANN_MODULE_DIR}/misc/python")
set(generated "${PROJECT_BINARY_DIR}/python-sources")
set(package "${PROJECT_BINARY_DIR}/python/rsackermann")
if(NOT EXISTS "${opencv_modules}/python/src2/gen2.py")
  message(FATAL_ERROR "The Python package needs the source tree of OpenCV ${OpenCV_VERSION}; OPENCV_TS_SOURCE_DIR is "
    "\"${OPENCV_TS_SOURCE_DIR}\". scripts/get_opencv_source.sh fetches it and prints where it is; pip finds it there.")
endif()

# The extension isn't cv2, but a part of the package.
file(COPY "${opencv_modules}/python/src2" DESTINATION "${generated}")
file(READ "${opencv_modules}/python/src2/cv2.hpp" content)
string(REPLACE "#define MODULESTR \"cv2\"" "#define MODULESTR \"rsackermann.bindings\"" content "${content}")
file(WRITE "${generated}/src2/cv2.hpp" "${content}")
file(READ "${misc}/package/rsackermann/__init__.py" content)
string(REPLACE "__all__ = []\n\n" "" content "${content}")
string(REPLACE "import cv2 as cv\n" "from . import bindings as cv
from .bindings import FileNode, FileStorage, UMat, error
from .bindings.rsackermann import *
" content "${content}")
file(WRITE "${package}/__init__.py" "${content}")

# Of OpenCV the types that the module's functions take.
set(headers "${opencv_modules}/core/include/opencv2/core.hpp")
foreach(name IN ITEMS async base bindings_utils check mat ocl optim persistence types utility)
  list(APPEND headers "${opencv_modules}/core/include/opencv2/core/${name}.hpp")
endforeach()
list(APPEND headers "${opencv_modules}/core/misc/python/shadow_umat.hpp")
file(GLOB_RECURSE module_headers CONFIGURE_DEPENDS "${RSACKERMANN_MODULE_DIR}/include/*.hpp")
rsackermann_keep_core(module_headers)
list(APPEND headers ${module_headers})
string(REPLACE ";" "\n" content "${headers}")
file(WRITE "${generated}/headers.txt" "${content}\n")
file(WRITE "${generated}/pyopencv_custom_headers.h" "#include \"${opencv_modules}/core/misc/python/pyopencv_async.hpp\"
#include \"${opencv_modules}/core/misc/python/pyopencv_umat.hpp\"
#include \"pyopencv_rsackermann.hpp\"\n")
file(WRITE "${generated}/opencv2/opencv_modules.hpp" "#define HAVE_OPENCV_CORE\n#define HAVE_OPENCV_RSACKERMANN\n")

set(generator "${generated}/src2/gen2.py")
add_custom_command(OUTPUT "${generated}/pyopencv_generated_include.h"
  COMMAND "${Python3_EXECUTABLE}" "${generator}" "${generated}" "${generated}/headers.txt"
  DEPENDS "${generator}" ${headers} VERBATIM)
set(sources "${generated}/pyopencv_generated_include.h")
foreach(name IN ITEMS cv2 cv2_convert cv2_numpy cv2_util)
  list(APPEND sources "${generated}/src2/${name}.cpp")
endforeach()
Python3_add_library(rsackermann_python MODULE WITH_SOABI ${sources})
set_target_properties(rsackermann_python PROPERTIES OUTPUT_NAME bindings LIBRARY_OUTPUT_DIRECTORY "${package}")
if(BUILD_SHARED_LIBS)
  set_target_properties(rsackermann_python PROPERTIES INSTALL_RPATH "$ORIGIN/../../../../${CMAKE_INSTALL_LIBDIR}")
endif()
target_compile_features(rsackermann_python PRIVATE cxx_std_14)
target_compile_definitions(rsackermann_python PRIVATE PyInit_cv2=PyInit_bindings
  $<$<BOOL:${RSACKERMANN_CORE_ONLY}>:RSACKERMANN_CORE_ONLY>)
target_compile_options(rsackermann_python PRIVATE -w)
target_include_directories(rsackermann_python
  PRIVATE "${generated}" "${generated}/src2" "${misc}" "${PROJECT_SOURCE_DIR}/cmake/opencv_ts")
target_link_libraries(rsackermann_python PRIVATE opencv_rsackermann Python3::NumPy)
install(TARGETS rsackermann_python LIBRARY DESTINATION "${RSACKERMANN_PYTHON_DIR}/rsackermann" COMPONENT python)
install(FILES "${package}/__init__.py" DESTINATION "${RSACKERMANN_PYTHON_DIR}/rsackermann" COMPONENT python)
