# cmake --install: headers as in the source tree under include/tessera, libtessera.a, the kernels' Slang sources, the command, what it
# makes reports with, and a package for find_package(tessera), which gives tessera::tessera.
include(CMakePackageConfigHelpers)
set(packageFolder ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
set(slangFolder ${CMAKE_INSTALL_DATADIR}/tessera/slang)

target_sources(tessera PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES
  host/counters.h host/cpu/cpu-device.h host/device.h host/error.h host/framebuffer.h host/image.h host/kernel-cache.h host/kernel.h host/plan.h
  host/probe.h host/rasterizer.h host/reference.h host/scene.h host/variant.h host/vulkan/vulkan-device.h datasets/input.h)

install(TARGETS tessera EXPORT tessera FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tessera)
install(TARGETS tessera-cli)
install(DIRECTORY slang/ DESTINATION ${slangFolder})
install(DIRECTORY experiments/report/ DESTINATION ${CMAKE_INSTALL_DATADIR}/tessera/report PATTERN __pycache__ EXCLUDE)
install(EXPORT tessera NAMESPACE tessera:: FILE tesseraTargets.cmake DESTINATION ${packageFolder})

configure_package_config_file(cmake/tesseraConfig.cmake.in ${PROJECT_BINARY_DIR}/tesseraConfig.cmake
  INSTALL_DESTINATION ${packageFolder} PATH_VARS slangFolder)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tesseraConfig.cmake ${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake cmake/libraries.cmake
  DESTINATION ${packageFolder})
