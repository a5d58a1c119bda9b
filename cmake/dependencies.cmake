# Every library comes from Debian 12; ./dev installs them from packages.txt.
include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
foreach(package IN LISTS TESSERA_PACKAGES)
  find_package(${package} REQUIRED)
endforeach()
foreach(module IN LISTS TESSERA_MODULES)
  pkg_check_modules(${module} REQUIRED IMPORTED_TARGET ${module})
endforeach()

# Headers alone: no user of the installed library needs these.
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(SPIRV-Headers REQUIRED)
if(TESSERA_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()
if(TESSERA_BENCH)
  find_package(benchmark REQUIRED)
endif()

# Of libtessera-image-io.so alone. Through pkg-config: Debian 12's CMake package names OpenCV's include folder, which is not installed
# with it.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
