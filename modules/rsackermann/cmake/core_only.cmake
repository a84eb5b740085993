# RSACKERMANN_CORE_ONLY, for the module inside of OpenCV and for the standalone build: the single image alone, that is
# camera, motion, scene, solvers, features, factors, optim, single, warp and draw, with their tests.

option(RSACKERMANN_CORE_ONLY "Build rsackermann without sequences of frames, calibration and the corrector" OFF)

# What is left out then.
set(module_dir "${CMAKE_CURRENT_LIST_DIR}")
get_filename_component(module_dir "${module_dir}" DIRECTORY)
file(GLOB RSACKERMANN_BEYOND_CORE
  "${module_dir}/include/opencv2/rsackermann/calibration.hpp"
  "${module_dir}/include/opencv2/rsackermann/corrector.hpp"
  "${module_dir}/src/calibration/*"
  "${module_dir}/src/sequence/*"
  "${module_dir}/src/corrector.cpp"
  "${module_dir}/test/test_calibration*"
  "${module_dir}/test/test_corrector*"
  "${module_dir}/test/test_sequence*"
  "${module_dir}/perf/perf_corrector*")

# Removes it from a list of files.
macro(rsackermann_keep_core files)
  if(RSACKERMANN_CORE_ONLY)
    list(REMOVE_ITEM ${files} ${RSACKERMANN_BEYOND_CORE})
  endif()
endmacro()
