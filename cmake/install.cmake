# cmake --install: the public headers as <tessera/NAME.h>, libtessera.a, the kernels' Slang sources, the command, the pinned
# slangc, what makes reports, and a package for find_package(tessera), which gives tessera::tessera. Nothing that is installed needs the
# clone, and the prefix can be moved: host/support/home.cpp finds the files from the program.
include(CMakePackageConfigHelpers)
set(packageFolder ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
set(slangFolder ${TESSERA_INSTALLED_DATA}/slang)

file(GLOB publicHeaders CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/host/include/tessera/*.h)
target_sources(tessera PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/host/include FILES ${publicHeaders})

install(TARGETS tessera EXPORT tessera FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS tessera-cli)
# What reads and writes images is loaded when it is needed, from beside the libraries, by the command and by programs that link the
# library.
set(moduleFolder ${CMAKE_INSTALL_LIBDIR}/tessera)
install(TARGETS tessera_image_io LIBRARY DESTINATION ${moduleFolder})
file(RELATIVE_PATH moduleFromCommand /${CMAKE_INSTALL_BINDIR} /${moduleFolder})
set_target_properties(tessera-cli PROPERTIES INSTALL_RPATH $ORIGIN/${moduleFromCommand})
target_link_options(tessera INTERFACE $<INSTALL_INTERFACE:LINKER:-rpath,$<INSTALL_PREFIX>/${moduleFolder}>)
install(DIRECTORY slang/ DESTINATION ${slangFolder})
install(DIRECTORY experiments/report/ DESTINATION ${TESSERA_INSTALLED_DATA}/report
  PATTERN __pycache__ EXCLUDE PATTERN build EXCLUDE PATTERN *.egg-info EXCLUDE)
install(FILES tools/report.txt DESTINATION ${TESSERA_INSTALLED_DATA})
include(${CMAKE_CURRENT_LIST_DIR}/install-tools.cmake)
install(EXPORT tessera NAMESPACE tessera:: FILE tesseraTargets.cmake DESTINATION ${packageFolder})

configure_package_config_file(cmake/tesseraConfig.cmake.in ${PROJECT_BINARY_DIR}/tesseraConfig.cmake
  INSTALL_DESTINATION ${packageFolder} PATH_VARS slangFolder)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tesseraConfig.cmake ${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake cmake/libraries.cmake
  DESTINATION ${packageFolder})
