# Library, headers, a package for find_package(rsackermann) and one for pkg-config.
#
# Components, which are packages of their own (RsackermannPackages.cmake): library, development, programs.

include(CMakePackageConfigHelpers)

set(RSACKERMANN_INSTALL_CMAKEDIR "${CMAKE_INSTALL_LIBDIR}/cmake/rsackermann")
set(RSACKERMANN_INSTALL_PKGCONFIGDIR "${CMAKE_INSTALL_LIBDIR}/pkgconfig")

install(TARGETS opencv_rsackermann EXPORT rsackermannTargets
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT library
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
foreach(folder IN ITEMS opencv2 opencv2/rsackermann)
  file(GLOB headers CONFIGURE_DEPENDS "${RSACKERMANN_MODULE_DIR}/include/${folder}/*.hpp")
  rsackermann_keep_core(headers)
  install(FILES ${headers} DESTINATION "${RSACKERMANN_INSTALL_INCLUDEDIR}/${folder}" COMPONENT development)
endforeach()
install(EXPORT rsackermannTargets NAMESPACE rsackermann:: DESTINATION "${RSACKERMANN_INSTALL_CMAKEDIR}"
  COMPONENT development)

configure_package_config_file(cmake/rsackermannConfig.cmake.in "${PROJECT_BINARY_DIR}/rsackermannConfig.cmake"
  INSTALL_DESTINATION "${RSACKERMANN_INSTALL_CMAKEDIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rsackermannConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/rsackermannConfig.cmake" "${PROJECT_BINARY_DIR}/rsackermannConfigVersion.cmake"
  DESTINATION "${RSACKERMANN_INSTALL_CMAKEDIR}" COMPONENT development)

# rsackermann.pc finds the files from its own place, so that the installed tree may be moved.
file(RELATIVE_PATH RSACKERMANN_PKGCONFIG_TO_PREFIX
  "/prefix/${RSACKERMANN_INSTALL_PKGCONFIGDIR}" "/prefix")
set(RSACKERMANN_PKGCONFIG_OPENCV_INCLUDES ${OpenCV_INCLUDE_DIRS})
list(TRANSFORM RSACKERMANN_PKGCONFIG_OPENCV_INCLUDES PREPEND "-I")
list(JOIN RSACKERMANN_PKGCONFIG_OPENCV_INCLUDES " " RSACKERMANN_PKGCONFIG_OPENCV_INCLUDES)
set(RSACKERMANN_PKGCONFIG_DEFINITIONS "$<$<BOOL:${RSACKERMANN_CORE_ONLY}>:-DRSACKERMANN_CORE_ONLY>")
configure_file(cmake/rsackermann.pc.in "${PROJECT_BINARY_DIR}/rsackermann.pc.configured" @ONLY)
file(GENERATE OUTPUT "${PROJECT_BINARY_DIR}/rsackermann.pc" INPUT "${PROJECT_BINARY_DIR}/rsackermann.pc.configured")
install(FILES "${PROJECT_BINARY_DIR}/rsackermann.pc" DESTINATION "${RSACKERMANN_INSTALL_PKGCONFIGDIR}"
  COMPONENT development)
