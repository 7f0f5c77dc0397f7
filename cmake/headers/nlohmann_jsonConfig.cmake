# Found for `find_package(nlohmann_json)` by header_folders.cmake.
remap_header_folder(nlohmann nlohmann/json.hpp folder)
add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
target_include_directories(nlohmann_json::nlohmann_json SYSTEM INTERFACE ${folder})
file(STRINGS ${folder}/nlohmann/detail/abi_macros.hpp lines REGEX "define NLOHMANN_JSON_VERSION_(MAJOR|MINOR|PATCH) ")
list(TRANSFORM lines REPLACE ".*_(MAJOR|MINOR|PATCH) +([0-9]+).*" "\\2")
list(JOIN lines "." nlohmann_json_VERSION)
