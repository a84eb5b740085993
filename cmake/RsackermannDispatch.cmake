# The counterpart of ocv_add_dispatched_file(FILE MODES...) inside of OpenCV, for a build against an installed OpenCV.
#
# warp/maps.simd.hpp would hold the code; warp/maps.dispatch.cpp includes "maps.simd.hpp" and the generated
# "warp/maps.simd_declarations.hpp", and chooses with CV_CPU_DISPATCH. The code is compiled again for each of the modes
# (AVX2, AVX512_SKX) that the compiler knows.

include(CheckCXXCompilerFlag)

set(RSACKERMANN_DISPATCH_DIR "${CMAKE_CURRENT_LIST_DIR}/dispatch")
set(RSACKERMANN_FLAGS_AVX2 -mavx2 -mfma -mf16c)
set(RSACKERMANN_FLAGS_AVX512_SKX ${RSACKERMANN_FLAGS_AVX2} -mavx512f -mavx512cd -mavx512bw -mavx512dq -mavx512vl)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # https://gcc.gnu.org/bugzilla/show_bug.cgi?id=105593: the compiler's own header.
  list(APPEND RSACKERMANN_FLAGS_AVX512_SKX -Wno-maybe-uninitialized -Wno-uninitialized)
endif()

# Adds to the target the files below module_dir/src for which the CMakeLists.txt of the module has
# ocv_add_dispatched_file().
function(rsackermann_add_dispatched_files target module_dir)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${module_dir}/CMakeLists.txt")
  file(STRINGS "${module_dir}/CMakeLists.txt" calls REGEX "^ocv_add_dispatched_file\\(")
  foreach(call IN LISTS calls)
    string(REGEX REPLACE "^ocv_add_dispatched_file\\((.*)\\)" "\\1" arguments "${call}")
    string(REPLACE " " ";" arguments "${arguments}")
    rsackermann_add_dispatched_file(${target} "${module_dir}/src" ${arguments})
  endforeach()
endfunction()

# Adds source_dir/NAME.simd.hpp in the modes that follow, the least first.
function(rsackermann_add_dispatched_file target source_dir name)
  set(generated_dir "${PROJECT_BINARY_DIR}/dispatch")
  # Relative paths, with which ccache finds the objects again from another checkout.
  get_filename_component(folder "${generated_dir}/${name}" DIRECTORY)
  file(RELATIVE_PATH RSACKERMANN_DISPATCH_HEADER "${folder}" "${RSACKERMANN_DISPATCH_DIR}/cpu_dispatch.hpp")
  file(RELATIVE_PATH RSACKERMANN_SIMD_FILE "${folder}" "${source_dir}/${name}.simd.hpp")
  file(RELATIVE_PATH RSACKERMANN_PRECOMP_FILE "${folder}" "${source_dir}/precomp.hpp")
  set(declarations "")
  set(modes BASELINE)
  foreach(RSACKERMANN_MODE IN LISTS ARGN)
    rsackermann_check_mode(${RSACKERMANN_MODE})
    if(RSACKERMANN_COMPILER_HAS_${RSACKERMANN_MODE})
      string(TOLOWER "${name}.${RSACKERMANN_MODE}.cpp" source)
      string(PREPEND source "${generated_dir}/")
      configure_file("${RSACKERMANN_DISPATCH_DIR}/simd_mode.cpp.in" "${source}" @ONLY)
      set_property(SOURCE "${source}" PROPERTY COMPILE_OPTIONS ${RSACKERMANN_FLAGS_${RSACKERMANN_MODE}})
      set_property(SOURCE "${source}" PROPERTY SKIP_PRECOMPILE_HEADERS ON)
      target_sources(${target} PRIVATE "${source}")
      file(READ "${RSACKERMANN_DISPATCH_DIR}/simd_declarations.hpp.in" declaration)
      string(CONFIGURE "${declaration}" declaration @ONLY)
      string(APPEND declarations "${declaration}")
      string(PREPEND modes "${RSACKERMANN_MODE}, ")
    endif()
  endforeach()
  file(GENERATE OUTPUT "${generated_dir}/${name}.simd_declarations.hpp"
    CONTENT "${declarations}#define CV_CPU_DISPATCH_MODES_ALL ${modes}\n")
  target_include_directories(${target} PRIVATE "${generated_dir}")
  set_property(SOURCE "${source_dir}/${name}.dispatch.cpp" PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
  # That header has to come first, as it does in the precompiled header.
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
    set_property(SOURCE "${source_dir}/${name}.dispatch.cpp" APPEND PROPERTY
      COMPILE_OPTIONS -include "${RSACKERMANN_DISPATCH_DIR}/cpu_dispatch.hpp")
  endif()
endfunction()

# Sets RSACKERMANN_COMPILER_HAS_mode.
function(rsackermann_check_mode mode)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|i.86")
    string(REPLACE ";" " " flags "${RSACKERMANN_FLAGS_${mode}}")
    check_cxx_compiler_flag("${flags}" RSACKERMANN_COMPILER_HAS_${mode})
  endif()
endfunction()
