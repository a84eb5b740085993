# Packages for Debian and its like: `cpack -G DEB` makes one each of library, headers and programs.
#
# Configure with -DCMAKE_INSTALL_PREFIX=/usr, so that the files are where Debian's own packages have them.

set(CPACK_PACKAGE_NAME rsackermann)
set(CPACK_PACKAGE_VENDOR "rsackermann")
set(CPACK_PACKAGE_CONTACT "The maintainers of rsackermann <rsackermann@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_COMPONENTS_ALL library development)
if(BUILD_SAMPLES)
  list(APPEND CPACK_COMPONENTS_ALL programs)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The programs' dependency on the library is in the build directory, not in an installed package.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}")
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

get_target_property(soversion opencv_rsackermann SOVERSION)
set(library libopencv-rsackermann${soversion})

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "Shared library.")
# Runs ldconfig after it is installed and removed.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libopencv-rsackermann-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libopencv-dev (>= ${OpenCV_VERSION})")
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, and what CMake and pkg-config need.")

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME rsackermann)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_PROGRAMS_DEPENDS library)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Programs that correct, render and evaluate images.")

include(CPack)
