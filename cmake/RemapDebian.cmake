# The Debian packages remap-tools, libremap-dev and remap-doc, which `cpack -G DEB` makes of the components of
# RemapPackage.cmake: their control files, and the files that policy asks for. scripts/package deb calls it.
set(REMAP_MAINTAINER "The remap developers <maintainers@remap.example>" CACHE STRING "Who stands in the packages")
set(REMAP_DEBIAN_REVISION 1 CACHE STRING "Revision of the packages of one version")
set(debian ${PROJECT_SOURCE_DIR}/packages/debian)
set(written ${PROJECT_BINARY_DIR}/debian)
file(MAKE_DIRECTORY ${written})

# compressed(FILE NAME): as policy wants it, without name and time inside.
function(compressed file name)
  execute_process(COMMAND gzip -9nc INPUT_FILE ${file} OUTPUT_FILE ${written}/${name} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# SOURCE_DATE_EPOCH says of when the packages are.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${debian}/changelog.in ${written}/changelog @ONLY)
compressed(${written}/changelog changelog.Debian.gz)
compressed(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog.gz)

# The licenses of libraries that are compiled in ask to be named.
set(notices ${written}/copyright.libraries)
file(WRITE ${notices} "Copyright of the libraries that are compiled into the programs.\n")
file(STRINGS ${debian}/compiled_in.txt lines REGEX "^[^#]")
foreach(line IN LISTS lines)
  string(REGEX REPLACE " .*" "" package ${line})
  file(READ /usr/share/doc/${package}/copyright text)
  file(APPEND ${notices} "\n=== ${package}\n\n${text}")
endforeach()
compressed(${notices} copyright.libraries.gz)

set(packages remap_tools remap-tools remap_dev libremap-dev remap_doc remap-doc)
while(packages)
  list(POP_FRONT packages component package)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${debian}/copyright ${written}/changelog.Debian.gz ${written}/changelog.gz DESTINATION ${folder}
          COMPONENT ${component})
  if(EXISTS ${debian}/${package}.lintian-overrides)
    install(FILES ${debian}/${package}.lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
            RENAME ${package} COMPONENT ${component})
  endif()
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${name}_PACKAGE_SOURCE remap)
endwhile()
install(FILES ${written}/copyright.libraries.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/remap-tools COMPONENT remap_tools)
# remap-study is for those who work on remap; it has no page.
install(FILES ${debian}/remap-study.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT remap_tools)
install(CODE "
  file(GLOB pages \"\$ENV{DESTDIR}${CMAKE_INSTALL_FULL_MANDIR}/man1/*.1\")
  execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT remap_tools)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL remap_tools remap_dev remap_doc)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_PACKAGE_NAME remap)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE ${REMAP_DEBIAN_REVISION})
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_PACKAGE_CONTACT ${REMAP_MAINTAINER})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Each package has its own, below.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(same "(= ${PROJECT_VERSION}-${REMAP_DEBIAN_REVISION})")

set(CPACK_DEBIAN_REMAP_TOOLS_DESCRIPTION "convert BRDF parameters between renderers
The same roughness and specular value give another picture in every renderer.
texremap converts texture sets, glTF, OBJ and MTL files from the models of one
renderer to those of another, by converters that were measured from pictures.
remapc measures, fits and compiles converters of one's own.")
set(CPACK_DEBIAN_REMAP_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_REMAP_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_REMAP_TOOLS_PACKAGE_SUGGESTS "python3, gnuplot-nox, remap-doc, libremap-dev ${same}")

set(CPACK_DEBIAN_REMAP_DEV_DESCRIPTION "convert BRDF parameters between renderers - development files
A static library with converters between the material models of renderers,
which takes and gives arrays, and a header without dependencies for each.
There are files for CMake and pkg-config.")
set(CPACK_DEBIAN_REMAP_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_REMAP_DEV_PACKAGE_SUGGESTS "remap-doc, remap-tools ${same}")

set(CPACK_DEBIAN_REMAP_DOC_DESCRIPTION "convert BRDF parameters between renderers - documentation
Tutorial, tasks, file formats, accuracy, decisions and reference, with
pictures, and examples.")
set(CPACK_DEBIAN_REMAP_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_REMAP_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_REMAP_DOC_PACKAGE_SUGGESTS "remap-tools, libremap-dev")
include(CPack)
