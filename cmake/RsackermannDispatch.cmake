# What ocv_add_dispatched_file(FILE AVX2) does inside of OpenCV, for a build against an installed OpenCV.
#
# warp/maps.simd.hpp would hold the code; warp/maps.dispatch.cpp includes "maps.simd.hpp" and the generated
# "warp/maps.simd_declarations.hpp", and chooses with CV_CPU_DISPATCH. The code is compiled a second time with AVX2 where
# the compiler can do that.

include(CheckCXXCompilerFlag)

set(RSACKERMANN_DISPATCH_HEADER "${CMAKE_CURRENT_LIST_DIR}/dispatch/cpu_dispatch.hpp")

# Adds to the target what each *.simd.hpp below source_dir needs.
function(rsackermann_add_dispatched_files target source_dir)
  file(GLOB_RECURSE simd_files CONFIGURE_DEPENDS RELATIVE "${source_dir}" "${source_dir}/*.simd.hpp")
  if(NOT simd_files)
    return()
  endif()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|i.86")
    check_cxx_compiler_flag("-mavx2 -mfma -mf16c" RSACKERMANN_COMPILER_HAS_AVX2)
  endif()

  set(generated_dir "${PROJECT_BINARY_DIR}/dispatch")
  target_include_directories(${target} PRIVATE "${generated_dir}")
  foreach(simd_file IN LISTS simd_files)
    string(REGEX REPLACE "\\.simd\\.hpp$" "" name "${simd_file}")
    set(RSACKERMANN_SIMD_FILE "${source_dir}/${simd_file}")
    set(RSACKERMANN_PRECOMP_FILE "${source_dir}/precomp.hpp")
    set_property(SOURCE "${source_dir}/${name}.dispatch.cpp" APPEND PROPERTY
      COMPILE_OPTIONS -include "${RSACKERMANN_DISPATCH_HEADER}")
    if(RSACKERMANN_COMPILER_HAS_AVX2)
      configure_file("${PROJECT_SOURCE_DIR}/cmake/dispatch/simd_declarations_avx2.hpp.in"
        "${generated_dir}/${name}.simd_declarations.hpp" @ONLY)
      configure_file("${PROJECT_SOURCE_DIR}/cmake/dispatch/simd_avx2.cpp.in" "${generated_dir}/${name}.avx2.cpp" @ONLY)
      set_property(SOURCE "${generated_dir}/${name}.avx2.cpp" PROPERTY COMPILE_OPTIONS -mavx2 -mfma -mf16c)
      target_sources(${target} PRIVATE "${generated_dir}/${name}.avx2.cpp")
    else()
      configure_file("${PROJECT_SOURCE_DIR}/cmake/dispatch/simd_declarations.hpp.in"
        "${generated_dir}/${name}.simd_declarations.hpp" @ONLY)
    endif()
  endforeach()
endfunction()
