# Every library comes from Debian 12; ./dev installs them from packages.txt.
option(TESSERA_TESTS "build the tests" ON)
option(TESSERA_BENCH "build the benchmarks" ON)

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(glm REQUIRED)
find_package(Vulkan REQUIRED)
find_package(OpenMesh REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
# Debian 12's OpenImageIO CMake package names OpenCV's include folder, which is not installed with it: pkg-config instead.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
