# opencv_ts, OpenCV's test framework, and the module's test programs. OpenCV doesn't install opencv_ts, so it is built
# from the source of the same version.

set(ts_dir "${OPENCV_TS_SOURCE_DIR}/modules/ts")
if(NOT OPENCV_TS_SOURCE_DIR OR NOT EXISTS "${ts_dir}/include/opencv2/ts.hpp")
  message(FATAL_ERROR "The tests need OPENCV_TS_SOURCE_DIR, the source tree of OpenCV ${OpenCV_VERSION}: "
    "-DOPENCV_TS_SOURCE_DIR=\"$(scripts/get_opencv_source.sh)\"")
endif()

find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs videoio highgui)
find_package(Threads REQUIRED)
find_path(OPENCV_CVCONFIG_DIR cvconfig.h REQUIRED HINTS ${OpenCV_INCLUDE_DIRS}
  PATH_SUFFIXES opencv${OpenCV_VERSION_MAJOR}/opencv2 opencv2)

file(GLOB ts_sources "${ts_dir}/src/*.cpp")
add_library(opencv_ts STATIC ${ts_sources})
target_compile_options(opencv_ts PRIVATE -w)
if(OpenCV_VERSION_MAJOR GREATER_EQUAL 5 AND EXISTS "${ts_dir}/src/ts_arrtest.cpp")
  # That of OpenCV 4, where that of 5 can't be had: without what needs the old C interface or other matrices.
  list(FILTER ts_sources EXCLUDE REGEX "/ts_(arrtest|func)\\.cpp$")
  set_property(TARGET opencv_ts PROPERTY SOURCES
    ${ts_sources} "${PROJECT_SOURCE_DIR}/cmake/opencv_ts_without_c/ts_func.cpp")
  target_include_directories(opencv_ts SYSTEM PUBLIC "${PROJECT_SOURCE_DIR}/cmake/opencv_ts_without_c")
endif()
target_include_directories(opencv_ts SYSTEM
  PUBLIC "${ts_dir}/include" "${OPENCV_CVCONFIG_DIR}"
  PRIVATE "${PROJECT_SOURCE_DIR}/cmake/opencv_ts")
target_link_libraries(opencv_ts
  PUBLIC opencv_core opencv_imgproc opencv_imgcodecs opencv_videoio opencv_highgui Threads::Threads)
if(SANITIZERS MATCHES thread)
  target_sources(opencv_ts INTERFACE "${PROJECT_SOURCE_DIR}/test/sanitize/std_threads.cpp")
endif()

# The programs write their results there; they don't make directories.
set(RSACKERMANN_TEST_RESULTS_DIR "${PROJECT_BINARY_DIR}/test-results")
file(MAKE_DIRECTORY "${RSACKERMANN_TEST_RESULTS_DIR}")

include(cmake/RsackermannAddTests.cmake)

# Of tests a build takes longer than a run.
function(rsackermann_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()
rsackermann_compile_quickly(opencv_ts)

# Adds the program NAME from the sources in the module's folder.
function(rsackermann_add_ts_program name folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${RSACKERMANN_MODULE_DIR}/${folder}/*.cpp")
  rsackermann_keep_core(sources)
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE "${RSACKERMANN_MODULE_DIR}/${folder}")
  target_link_libraries(${name} PRIVATE opencv_rsackermann opencv_ts Eigen3::Eigen ${RSACKERMANN_LENS_MODELS})
  target_precompile_headers(${name} PRIVATE
    <opencv2/ts.hpp> <opencv2/rsackermann/estimator.hpp> <opencv2/rsackermann/warp.hpp>)
endfunction()

if(BUILD_TESTING)
  rsackermann_add_ts_program(opencv_test_rsackermann test)
  rsackermann_compile_quickly(opencv_test_rsackermann)
  # Tests of internals, which the library doesn't export.
  target_sources(opencv_test_rsackermann PRIVATE $<TARGET_OBJECTS:opencv_rsackermann>)
  if(TARGET opencv_ximgproc)
    target_link_libraries(opencv_test_rsackermann PRIVATE opencv_ximgproc)
  endif()
  rsackermann_add_sharded_test(opencv_test_rsackermann opencv_test_rsackermann 4 --test_tag_skip=long)
  # For ctest -C Long: all cases in one process.
  add_test(NAME opencv_test_rsackermann_long CONFIGURATIONS Long
    COMMAND opencv_test_rsackermann "--gtest_output=xml:${RSACKERMANN_TEST_RESULTS_DIR}/opencv_test_rsackermann_long.xml")
  # OpenCV takes a CPU as an OpenCL device, which is what PoCL makes of it, only if it is told to.
  rsackermann_add_gtest(opencv_test_rsackermann_opencl opencv_test_rsackermann "--gtest_filter=*OpenCL*")
  set_tests_properties(opencv_test_rsackermann_opencl PROPERTIES ENVIRONMENT "OPENCV_OPENCL_DEVICE=:CPU:")
  # What a processor with the widest vectors would not run: the kernels for others.
  foreach(kernels IN ITEMS avx2 baseline)
    rsackermann_add_gtest(opencv_test_rsackermann_${kernels} opencv_test_rsackermann
      "--gtest_filter=*Warp*:*Passage*-*OpenCL*" --test_tag_skip=long)
  endforeach()
  set_tests_properties(opencv_test_rsackermann_avx2 PROPERTIES ENVIRONMENT "OPENCV_CPU_DISABLE=AVX512-SKX")
  set_tests_properties(opencv_test_rsackermann_baseline PROPERTIES ENVIRONMENT "OPENCV_CPU_DISABLE=AVX512-SKX,AVX2")
endif()
if(BUILD_PERF_TESTS)
  rsackermann_add_ts_program(opencv_perf_rsackermann perf)
  rsackermann_add_gtest(opencv_perf_rsackermann opencv_perf_rsackermann
    --perf_min_samples=1 --perf_force_samples=1 --perf_verify_sanity)
endif()
