# Two interface targets hold every flag: tessera_common for code, tessera_exact for code whose float32 bits are the contract.
set(TESSERA_SANITIZE "" CACHE STRING "sanitizers for the host code and the CPU kernels: address,undefined or thread")
option(TESSERA_VALIDATION "Vulkan devices of the command line load the validation layer" OFF)

add_library(tessera_common INTERFACE)
target_include_directories(tessera_common INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/host/include)
target_compile_options(tessera_common INTERFACE -Wall -Wextra -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(tessera_common INTERFACE -Wno-restrict)  # GCC bug 105651: false positives inside std::string
endif()
if(TESSERA_VALIDATION)
  target_compile_definitions(tessera_common INTERFACE TESSERA_VALIDATION)
endif()

# The kernels are compiled at run time, by the same compiler and under the same sanitizers as the host code.
set(TESSERA_KERNEL_CXX_FLAGS "" CACHE STRING "further flags for kernels compiled to C++")
if(TESSERA_SANITIZE)
  set(sanitize -fsanitize=${TESSERA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # GCC's own manual: with sanitizers these warnings have false positives (here inside <regex>).
  target_compile_options(tessera_common INTERFACE ${sanitize} -Wno-maybe-uninitialized)
  target_link_options(tessera_common INTERFACE ${sanitize})
  list(JOIN sanitize " " sanitize)
  string(PREPEND TESSERA_KERNEL_CXX_FLAGS "-g ${sanitize} ")
  string(STRIP "${TESSERA_KERNEL_CXX_FLAGS}" TESSERA_KERNEL_CXX_FLAGS)
endif()
if(TESSERA_SANITIZE MATCHES thread)
  # The thread sanitizer cannot see into Debian's oneTBB, so the CPU device takes std::thread.
  target_compile_definitions(tessera_common INTERFACE TESSERA_PLAIN_THREADS)
endif()

add_library(tessera_exact INTERFACE)
target_compile_options(tessera_exact INTERFACE -ffp-contract=off -fno-fast-math)
