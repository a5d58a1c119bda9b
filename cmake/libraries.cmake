# What a program that uses libtessera.a links: read by the build, and by find_package(tessera) once installed.
set(TESSERA_PACKAGES PkgConfig Threads TBB fmt glm Vulkan OpenMesh)
# Through pkg-config: toml++ has no CMake package here, and Debian 12's of OpenImageIO names OpenCV's include folder, which is not
# installed with it.
set(TESSERA_MODULES tomlplusplus OpenImageIO libcrypto)
set(TESSERA_LIBRARIES
  Threads::Threads TBB::tbb fmt::fmt Vulkan::Vulkan OpenMeshCore PkgConfig::tomlplusplus PkgConfig::OpenImageIO PkgConfig::libcrypto ${CMAKE_DL_LIBS})
