# Found for `find_package(CLI11)` by toolchain.cmake.
include(${CMAKE_CURRENT_LIST_DIR}/header_folder.cmake)
remap_header_folder(CLI CLI/CLI.hpp folder)
add_library(CLI11::CLI11 INTERFACE IMPORTED)
target_include_directories(CLI11::CLI11 SYSTEM INTERFACE ${folder})
