# Found for `find_package(CLI11)` by header_folders.cmake.
remap_header_folder(CLI CLI/CLI.hpp folder)
add_library(CLI11::CLI11 INTERFACE IMPORTED)
target_include_directories(CLI11::CLI11 SYSTEM INTERFACE ${folder})
file(STRINGS ${folder}/CLI/Version.hpp line REGEX "define CLI11_VERSION ")
string(REGEX REPLACE ".*\"(.+)\".*" "\\1" CLI11_VERSION "${line}")
