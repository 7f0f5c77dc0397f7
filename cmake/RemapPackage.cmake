# What is installed, and what another CMake project gets from this one, installed or as a subfolder: remap::remap (the
# library), remap::headers (the generated headers), remap::remapc, remap::texremap and remap_add_converter().
include(RemapAddConverter)

# Users write `#include <remap/ID.hpp>`; in this tree the folder has another name.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/generated ${PROJECT_BINARY_DIR}/include/remap SYMBOLIC)

add_library(remap_headers INTERFACE)
add_library(remap::headers ALIAS remap_headers)
set_target_properties(remap_headers PROPERTIES EXPORT_NAME headers)
target_compile_features(remap_headers INTERFACE cxx_std_17)
target_include_directories(remap_headers INTERFACE
  $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

set(tools "")
foreach(tool texremap remapc)
  if(TARGET ${tool})
    list(APPEND tools ${tool})
  endif()
endforeach()
foreach(tool IN LISTS tools)
  add_executable(remap::${tool} ALIAS ${tool})
endforeach()

if(NOT REMAP_INSTALL)
  return()
endif()

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/remap)
set(data_folder ${CMAKE_INSTALL_DATADIR}/remap)

# Programs. Whoever has the library alone finds a package without them.
if(tools)
  install(TARGETS ${tools} EXPORT remapToolsTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(EXPORT remapToolsTargets NAMESPACE remap:: DESTINATION ${package_folder})
  install(FILES ${PROJECT_SOURCE_DIR}/runtime/sets/naming.json DESTINATION ${data_folder})
endif()
foreach(tool IN LISTS tools)
  remap_install_manuals(${tool} ${CMAKE_INSTALL_MANDIR} ${CMAKE_INSTALL_DATADIR} ${PROJECT_SOURCE_DIR}/docs/completions)
endforeach()

# The library, headers, and what finds them.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME remap_dev)
install(TARGETS remap remap_headers EXPORT remapTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT remapTargets NAMESPACE remap:: DESTINATION ${package_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/generated/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/remap
        FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h" PATTERN "LICENSE")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/generated/languages ${PROJECT_SOURCE_DIR}/generated/materialx DESTINATION ${data_folder})
install(FILES ${PROJECT_SOURCE_DIR}/generated/materials/materials.py DESTINATION ${data_folder}/materials)
install(FILES ${PROJECT_SOURCE_DIR}/generated/converters.json DESTINATION ${data_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/runtime/include/remap ${PROJECT_BINARY_DIR}/runtime/include/remap
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/remapConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/remapConfig.cmake INSTALL_DESTINATION ${package_folder})
# Until version 1.0 a minor version may change names.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/remapConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/remapConfig.cmake ${PROJECT_BINARY_DIR}/remapConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/RemapAddConverter.cmake
        DESTINATION ${package_folder})
# The prefix is found from the file itself, so that the tree can be moved.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE libdir)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE includedir)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE prefix)
configure_file(${CMAKE_CURRENT_LIST_DIR}/remap.pc.in ${PROJECT_BINARY_DIR}/remap.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/remap.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Pages as they lie in the tree, with what they link to beside them.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME remap_doc)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/HACKING.md
              ${PROJECT_SOURCE_DIR}/SECURITY.md ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
        PATTERN man EXCLUDE PATTERN completions EXCLUDE)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/scripts/studies/materials ${PROJECT_SOURCE_DIR}/scripts/studies/summarize
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/scripts/studies)
set(data ${CMAKE_INSTALL_FULL_DATADIR}/remap)
set(headers ${CMAKE_INSTALL_FULL_INCLUDEDIR}/remap)
set(links fits ${data}/fits examples ${data}/examples generated ${headers} compiler/adapters ${data}/workers
          runtime/include/remap ${headers} runtime/sets/naming.json ${data}/naming.json)
while(links)
  list(POP_FRONT links link target)
  set(written ${PROJECT_BINARY_DIR}/documentation/${link})
  cmake_path(GET link PARENT_PATH folder)
  cmake_path(GET written PARENT_PATH written_folder)
  cmake_path(RELATIVE_PATH target BASE_DIRECTORY ${CMAKE_INSTALL_FULL_DOCDIR}/${folder})
  file(MAKE_DIRECTORY ${written_folder})
  file(CREATE_LINK ${target} ${written} SYMBOLIC)
  install(FILES ${written} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endwhile()

if(REMAP_DEBIAN)
  include(RemapDebian)
endif()
