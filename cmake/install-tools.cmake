# What ./dev fetched into .tools: slangc with its libraries, and the Python environment of reports. Where one is not there, the install
# says so and goes on; the command then says what to install.
set(fetched ${PROJECT_SOURCE_DIR}/.tools)
set(tools ${TESSERA_INSTALLED_TOOLS})
install(DIRECTORY ${fetched}/slang/bin/ DESTINATION ${tools}/slang/bin USE_SOURCE_PERMISSIONS OPTIONAL)

# An environment can be moved but for its scripts, whose first lines name its folder: the packages come along, and of bin/ the interpreter,
# which is a link to the machine's own. What makes the environment, and what tests and papers use alone, stays.
set(environment ${fetched}/report)
file(GLOB python RELATIVE ${environment} CONFIGURE_DEPENDS ${environment}/lib/python3.*)
install(DIRECTORY ${environment}/${python}/site-packages/ DESTINATION ${tools}/python/${python}/site-packages OPTIONAL
  PATTERN __pycache__ EXCLUDE
  REGEX "/site-packages/(pip|setuptools|pkg_resources|_distutils_hack|distutils-precedence|selenium|trio|typst)[^/]*" EXCLUDE)
install(CODE "
  set(prefix \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${tools}\")
  if(EXISTS ${environment}/pyvenv.cfg)
    file(STRINGS ${environment}/pyvenv.cfg settings)
    list(FILTER settings EXCLUDE REGEX ^command)  # it names the clone
    list(JOIN settings \"\\n\" settings)
    file(WRITE \${prefix}/python/pyvenv.cfg \${settings}\\n)
    file(REAL_PATH ${environment}/bin/python interpreter)
    file(MAKE_DIRECTORY \${prefix}/python/bin)
    file(CREATE_LINK \${interpreter} \${prefix}/python/bin/python SYMBOLIC)
  else()
    message(WARNING \"${environment} is not there: reports are installed without their Python; ./dev build fetches it\")
  endif()
  if(NOT EXISTS ${fetched}/slang/bin/slangc)
    message(WARNING \"${fetched}/slang is not there: installed without slangc; ./dev build fetches it, or SLANGC names one at run time\")
  endif()")
