# Headers, library and a package for find_package(rsackermann).

include(CMakePackageConfigHelpers)

set(RSACKERMANN_INSTALL_CMAKEDIR "${CMAKE_INSTALL_LIBDIR}/cmake/rsackermann")

install(DIRECTORY "${RSACKERMANN_MODULE_DIR}/include/opencv2" DESTINATION "${RSACKERMANN_INSTALL_INCLUDEDIR}")
install(TARGETS opencv_rsackermann EXPORT rsackermannTargets
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT rsackermannTargets NAMESPACE rsackermann:: DESTINATION "${RSACKERMANN_INSTALL_CMAKEDIR}")

configure_package_config_file(cmake/rsackermannConfig.cmake.in "${PROJECT_BINARY_DIR}/rsackermannConfig.cmake"
  INSTALL_DESTINATION "${RSACKERMANN_INSTALL_CMAKEDIR}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/rsackermannConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/rsackermannConfig.cmake" "${PROJECT_BINARY_DIR}/rsackermannConfigVersion.cmake"
  DESTINATION "${RSACKERMANN_INSTALL_CMAKEDIR}")
