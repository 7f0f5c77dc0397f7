# The text of --version: the version of project() in CMakeLists.txt, and what the build is made of. The version stands
# there alone: headers, packages and manual pages take it from it.

# remap_library_list(VARIABLE NAME=VERSION...): "Name 1.2, Name 3" in VARIABLE, without those that have no version: they
# take no part in this build.
function(remap_library_list variable)
  list(FILTER ARGN EXCLUDE REGEX "=$")
  list(TRANSFORM ARGN REPLACE "=" " ")
  list(JOIN ARGN ", " text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# remap_macro_value(VARIABLE HEADER MACRO): the number that a header defines.
function(remap_macro_value variable header macro)
  file(STRINGS ${header} line REGEX "^# *define +${macro} +[0-9]+" LIMIT_COUNT 1)
  string(REGEX REPLACE "^# *define +${macro} +([0-9]+).*" "\\1" value "${line}")
  set(${variable} "${value}" PARENT_SCOPE)
endfunction()

# remap_version_text(TARGET): TARGET gets version_text() of command_line/run_app.hpp. To be called after the libraries of the runtime
# are found.
function(remap_version_text target)
  set(sets "")
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(sets " with kernels for SSE2, AVX2 and AVX-512")
  endif()
  set(REMAP_BUILD "${CMAKE_BUILD_TYPE} by ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} for ${CMAKE_SYSTEM_PROCESSOR}${sets}")

  set(data ${PROJECT_SOURCE_DIR}/generated/converters.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${data})
  file(READ ${data} text)
  string(JSON count LENGTH "${text}" converters)
  file(SHA256 ${data} hash)
  string(SUBSTRING ${hash} 0 12 hash)
  set(REMAP_DATA "${count} converters, SHA-256 ${hash}...")

  foreach(package IN ITEMS OpenImageIO libwebp CLI11 nlohmann_json)
    get_directory_property(${package} DIRECTORY ${PROJECT_SOURCE_DIR}/runtime DEFINITION ${package}_VERSION)
  endforeach()
  foreach(part IN ITEMS MAJOR MINOR RELEASE)
    remap_macro_value(${part} ${XXHASH_INCLUDE_DIR}/xxhash.h XXH_VERSION_${part})
  endforeach()
  remap_library_list(REMAP_LIBRARIES OpenImageIO=${OpenImageIO} libwebp=${libwebp} CLI11=${CLI11}
                     "JSON for Modern C++=${nlohmann_json}" xxHash=${MAJOR}.${MINOR}.${RELEASE})
  set(written ${PROJECT_BINARY_DIR}/runtime/version_text.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/runtime/command_line/version_text.cpp.in ${written} @ONLY)
  target_sources(${target} PRIVATE ${written})
endfunction()
