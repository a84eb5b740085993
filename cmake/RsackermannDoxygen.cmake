# The target doc: pages of the classes and the tutorials in doxygen/html. Every warning is an error, so that it is a
# test, too.

find_program(DOXYGEN_PROGRAM doxygen)
find_program(BIBTEX_PROGRAM bibtex) # doxygen calls it
if(DOXYGEN_PROGRAM AND BIBTEX_PROGRAM)
  set(RSACKERMANN_DOXYGEN_DIR "${PROJECT_BINARY_DIR}/doxygen")
  file(MAKE_DIRECTORY "${RSACKERMANN_DOXYGEN_DIR}")
  configure_file(cmake/Doxyfile.in "${RSACKERMANN_DOXYGEN_DIR}/Doxyfile" @ONLY)
  # bibtex finds what doxygen hands it in the current directory, without the settings of a whole TeX, too.
  add_custom_target(doc
    COMMAND "${CMAKE_COMMAND}" -E env BSTINPUTS=. BIBINPUTS=. "${DOXYGEN_PROGRAM}" "${RSACKERMANN_DOXYGEN_DIR}/Doxyfile"
    VERBATIM)
endif()
