# The target `docs` writes the pages of the C++ interface; the test docs/api holds the public headers to it.
set(docsFolder ${PROJECT_BINARY_DIR}/docs)
configure_file(cmake/Doxyfile.in ${docsFolder}/Doxyfile @ONLY)
find_program(TESSERA_DOXYGEN doxygen)
if(NOT TESSERA_DOXYGEN)
  set(TESSERA_DOXYGEN doxygen)  # its absence is an error of what needs it, not of the build
endif()
add_custom_target(docs
  COMMAND ${TESSERA_DOXYGEN} ${docsFolder}/Doxyfile
  COMMAND ${CMAKE_COMMAND} -E echo "${docsFolder}/html/index.html"
  VERBATIM)
