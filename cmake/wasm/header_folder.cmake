# remap_header_folder(NAME HEADER FOLDER): sets the variable FOLDER to one that shows the folder or the file NAME of the include folder of
# this machine that has HEADER, and nothing else.
function(remap_header_folder name header folder)
  find_path(REMAP_HOST_${name} ${header} PATHS /usr/include /usr/local/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  set(shown ${CMAKE_BINARY_DIR}/host_headers/${name})
  file(MAKE_DIRECTORY ${shown})
  file(CREATE_LINK ${REMAP_HOST_${name}}/${name} ${shown}/${name} SYMBOLIC)
  set(${folder} ${shown} PARENT_SCOPE)
endfunction()
