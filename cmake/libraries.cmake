# What a program that uses libtessera.a links: read by the build, and by find_package(tessera) once installed.
set(TESSERA_PACKAGES PkgConfig Threads TBB fmt glm Vulkan OpenMesh)
# Through pkg-config: toml++ has no CMake package here.
set(TESSERA_MODULES tomlplusplus libcrypto)
set(TESSERA_LIBRARIES
  Threads::Threads TBB::tbb fmt::fmt Vulkan::Vulkan OpenMeshCore PkgConfig::tomlplusplus PkgConfig::libcrypto ${CMAKE_DL_LIBS})
