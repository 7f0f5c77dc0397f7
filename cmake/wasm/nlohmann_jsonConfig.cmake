# Found for `find_package(nlohmann_json)` by toolchain.cmake.
include(${CMAKE_CURRENT_LIST_DIR}/header_folder.cmake)
remap_header_folder(nlohmann nlohmann/json.hpp folder)
add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
target_include_directories(nlohmann_json::nlohmann_json SYSTEM INTERFACE ${folder})
