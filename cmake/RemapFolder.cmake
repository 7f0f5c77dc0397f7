# remap_folder(TARGET FOLDER [PUBLIC LIBRARY...] [PRIVATE LIBRARY...]): the library TARGET of every .cpp file in FOLDER but main.cpp, without
# its subfolders; with `FOLDER/*` of those. The order of folders in HACKING.md is the order of what they link.
# New files are found without configuring again, but for a project that has remap as a subfolder.
set(REMAP_GLOB "")
if(PROJECT_IS_TOP_LEVEL)
  set(REMAP_GLOB CONFIGURE_DEPENDS)
endif()
function(remap_folder target folder)
  cmake_parse_arguments(PARSE_ARGV 2 LINK "" "" "PUBLIC;PRIVATE")
  file(GLOB sources ${REMAP_GLOB} ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main[.]cpp$")
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC ${LINK_PUBLIC} PRIVATE ${LINK_PRIVATE})
  remap_compile_together(${target})
endfunction()

# remap_find(PACKAGE DEBIAN_PACKAGE): find_package(), which says what to install where it finds nothing.
macro(remap_find package debian_package)
  find_package(${package} QUIET)
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "remap: ${package} is not installed (on Debian: apt-get install ${debian_package}, or scripts/install-packages for all)")
  endif()
endmacro()

# remap_find_header(VARIABLE HEADER DEBIAN_PACKAGE): the folder of a library that is one header, and brings no CMake package.
macro(remap_find_header variable header debian_package)
  find_path(${variable} ${header})
  if(NOT ${variable})
    message(FATAL_ERROR "remap: ${header} is not installed (on Debian: apt-get install ${debian_package}, or scripts/install-packages for all)")
  endif()
endmacro()
