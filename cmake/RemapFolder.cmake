# remap_folder(TARGET FOLDER [PUBLIC LIBRARY...] [PRIVATE LIBRARY...]): the library TARGET of every .cpp file in FOLDER, without its
# subfolders. A folder is one library; the order of folders in HACKING.md is the order of what they link.
function(remap_folder target folder)
  cmake_parse_arguments(PARSE_ARGV 2 LINK "" "" "PUBLIC;PRIVATE")
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC ${LINK_PUBLIC} PRIVATE ${LINK_PRIVATE})
endfunction()
