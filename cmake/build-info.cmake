# <build>/generated/host/build-info.h: what a result row says about this build. The commit is read anew by every build, and the
# file is written only when it changed, so that nothing is rebuilt for it but what includes it.
if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND git describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE TESSERA_GIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT TESSERA_GIT)
    set(TESSERA_GIT "unknown")  # a source archive, or no git
  endif()
  configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
  return()
endif()

string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
get_target_property(commonFlags tessera_common INTERFACE_COMPILE_OPTIONS)
get_target_property(exactFlags tessera_exact INTERFACE_COMPILE_OPTIONS)
list(JOIN commonFlags " " commonFlags)
list(JOIN exactFlags " " exactFlags)
string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}} ${commonFlags} ${exactFlags}" flagsText)

set(generated ${PROJECT_BINARY_DIR}/generated)
add_custom_target(tessera_build_info
  COMMAND ${CMAKE_COMMAND}
    -DSOURCE=${PROJECT_SOURCE_DIR}
    -DTEMPLATE=${CMAKE_CURRENT_LIST_DIR}/build-info.h.in
    -DOUTPUT=${generated}/host/build-info.h
    -DPROJECT_VERSION=${PROJECT_VERSION}
    -DTESSERA_BUILD_TYPE=${CMAKE_BUILD_TYPE}
    "-DTESSERA_COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    "-DTESSERA_CXX_FLAGS_TEXT=${flagsText}"
    -P ${CMAKE_CURRENT_LIST_FILE}
  BYPRODUCTS ${generated}/host/build-info.h
  COMMENT "Reading the commit" VERBATIM)
# Link this to include "host/build-info.h".
add_library(tessera_build_info_header INTERFACE)
target_include_directories(tessera_build_info_header INTERFACE ${generated})
add_dependencies(tessera_build_info_header tessera_build_info)
