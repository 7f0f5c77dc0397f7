# remap_add_converter(TARGET FIT): TARGET may `#include <remap/ID.hpp>`, the header of the fit file FIT.
#
# FIT is a fit in JSON, as `remapc fit` writes it; a relative path starts at the folder of the calling
# CMakeLists.txt. ID is the id that the fit carries. The header is emitted at build time, into
# remap_generated/remap/ of the binary folder, and again whenever the fit or remapc changes.
function(remap_add_converter target fit)
  if(NOT TARGET ${target})
    message(FATAL_ERROR "remap_add_converter: unknown target ${target} (add it before this call)")
  endif()
  if(NOT TARGET remap::remapc)
    message(FATAL_ERROR "remap_add_converter: remapc is not here, which emits the header "
                        "(install the package remap-tools, or build remap with REMAP_BUILD_COMPILER=ON)")
  endif()
  cmake_path(ABSOLUTE_PATH fit BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE OUTPUT_VARIABLE fit_file)
  _remap_read_fit_id(${fit_file} id)
  set(folder ${CMAKE_BINARY_DIR}/remap_generated)
  _remap_emit_once(${fit_file} ${id} ${folder})

  get_target_property(type ${target} TYPE)
  set(scope PUBLIC)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${folder}>)
  target_compile_features(${target} ${scope} cxx_std_17)
  add_dependencies(${target} remap_converter_${id})
endfunction()

function(_remap_read_fit_id fit_file id)
  if(NOT EXISTS ${fit_file} OR IS_DIRECTORY ${fit_file})
    message(FATAL_ERROR "remap_add_converter: ${fit_file}: file not found "
                        "(give a fit in JSON, as `remapc fit` writes it)")
  endif()
  # Another id in the file is another header: configure again.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${fit_file})
  file(READ ${fit_file} text)
  string(JSON value ERROR_VARIABLE failure GET "${text}" id)
  if(failure)
    message(FATAL_ERROR "remap_add_converter: ${fit_file}: not a fit: ${failure}")
  endif()
  set(${id} ${value} PARENT_SCOPE)
endfunction()

# Several targets may use one converter: one rule makes its header, and all of them wait for it.
function(_remap_emit_once fit_file id folder)
  set(emitter remap_converter_${id})
  if(TARGET ${emitter})
    get_target_property(known ${emitter} REMAP_FIT)
    if(NOT known STREQUAL fit_file)
      message(FATAL_ERROR "remap_add_converter: ${fit_file}: has the same id ${id} as ${known} "
                          "(give one of them another id)")
    endif()
    return()
  endif()
  set(header ${folder}/remap/${id}.hpp)
  add_custom_command(
    OUTPUT ${header}
    COMMAND remap::remapc emit ${fit_file} -o ${folder}/remap
    DEPENDS ${fit_file} remap::remapc
    COMMENT "Emitting the converter ${id}"
    VERBATIM)
  add_custom_target(${emitter} DEPENDS ${header})
  set_target_properties(${emitter} PROPERTIES REMAP_FIT ${fit_file})
endfunction()
