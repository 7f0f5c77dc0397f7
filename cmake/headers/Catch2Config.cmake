# Found for `find_package(Catch2)` by header_folders.cmake.
remap_header_folder(catch2 catch2/catch.hpp folder)
add_library(Catch2::Catch2 INTERFACE IMPORTED)
target_include_directories(Catch2::Catch2 SYSTEM INTERFACE ${folder})
