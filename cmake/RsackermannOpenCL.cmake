# What OpenCV's cl2cpp.cmake does for modules inside of OpenCV, for a build against an installed OpenCV: it isn't
# installed.

# Adds the kernels NAME.cl in cl_dir to the target as cv::ocl::rsackermann::NAME_oclsrc, declared in
# opencl_kernels_rsackermann.hpp. They are used if OpenCV has been built with OpenCL.
function(rsackermann_embed_opencl target cl_dir)
  file(GLOB kernels CONFIGURE_DEPENDS "${cl_dir}/*.cl")
  set(generated_dir "${PROJECT_BINARY_DIR}/opencl")
  set(RSACKERMANN_KERNEL_DECLARATIONS "")
  set(RSACKERMANN_KERNEL_DEFINITIONS "")
  foreach(kernel IN LISTS kernels)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${kernel}")
    get_filename_component(name "${kernel}" NAME_WE)
    file(READ "${kernel}" code)
    string(MD5 hash "${code}")
    string(APPEND RSACKERMANN_KERNEL_DECLARATIONS "extern struct cv::ocl::internal::ProgramEntry ${name}_oclsrc;\n")
    string(APPEND RSACKERMANN_KERNEL_DEFINITIONS
      "struct cv::ocl::internal::ProgramEntry ${name}_oclsrc = {\"rsackermann\", \"${name}\",\n"
      "R\"kernel(${code})kernel\", \"${hash}\", NULL};\n")
  endforeach()
  foreach(extension hpp cpp)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/opencl/opencl_kernels_rsackermann.${extension}.in"
      "${generated_dir}/opencl_kernels_rsackermann.${extension}" @ONLY)
  endforeach()
  target_sources(${target} PRIVATE "${generated_dir}/opencl_kernels_rsackermann.cpp")
  target_include_directories(${target} PRIVATE "${generated_dir}")

  # opencv2/core/opencl/ocl_defs.hpp includes cvconfig.h without a folder.
  find_path(OPENCV_CVCONFIG_DIR cvconfig.h REQUIRED HINTS ${OpenCV_INCLUDE_DIRS}
    PATH_SUFFIXES opencv${OpenCV_VERSION_MAJOR}/opencv2 opencv2)
  target_include_directories(${target} SYSTEM PRIVATE "${OPENCV_CVCONFIG_DIR}")
endfunction()
