# To be included by toolchains: packages of this machine that are headers alone, each by a folder of its own, since
# /usr/include has headers of another C library.

# remap_header_folder(NAME HEADER FOLDER): sets the variable FOLDER to one that shows the folder or the file NAME of the include folder of
# this machine that has HEADER, and nothing else.
function(remap_header_folder name header folder)
  find_path(REMAP_HOST_${name} ${header} PATHS /usr/include /usr/local/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  set(shown ${CMAKE_BINARY_DIR}/host_headers/${name})
  file(MAKE_DIRECTORY ${shown})
  file(CREATE_LINK ${REMAP_HOST_${name}}/${name} ${shown}/${name} SYMBOLIC)
  set(${folder} ${shown} PARENT_SCOPE)
endfunction()

set(nlohmann_json_DIR ${CMAKE_CURRENT_LIST_DIR})
set(CLI11_DIR ${CMAKE_CURRENT_LIST_DIR})
set(Catch2_DIR ${CMAKE_CURRENT_LIST_DIR})
if(NOT XXHASH_INCLUDE_DIR)
  remap_header_folder(xxhash.h xxhash.h XXHASH_INCLUDE_DIR)
  remap_header_folder(tiny_obj_loader.h tiny_obj_loader.h TINYOBJLOADER_INCLUDE_DIR)
  set(XXHASH_INCLUDE_DIR ${XXHASH_INCLUDE_DIR} CACHE PATH "")
  set(TINYOBJLOADER_INCLUDE_DIR ${TINYOBJLOADER_INCLUDE_DIR} CACHE PATH "")
endif()
