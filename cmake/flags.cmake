# Two interface targets hold every flag: tessera_common for code, tessera_exact for code whose float32 bits are the contract.
add_library(tessera_common INTERFACE)
target_include_directories(tessera_common INTERFACE $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>)
target_compile_options(tessera_common INTERFACE $<BUILD_INTERFACE:-Wall -Wextra -Werror>)

add_library(tessera_exact INTERFACE)
target_compile_options(tessera_exact INTERFACE -ffp-contract=off -fno-fast-math)
