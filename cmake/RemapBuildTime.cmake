# What keeps builds short: headers that many sources read are compiled once, and what has no long loops is not optimised.

# remap_precompile_tests(OWNER), remap_use_precompiled_tests(TARGET OWNER): Catch2 compiled once, for all test programs.
# They must have the same flags as OWNER; definitions may differ.
function(remap_precompile_tests owner)
  # CMake compiles the header only for a target with a source that reads it, which Catch2's main must not.
  file(CONFIGURE OUTPUT precompiled_tests.cpp CONTENT "// Reads the precompiled header of the tests.\n")
  target_sources(${owner} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/precompiled_tests.cpp)
  target_precompile_headers(${owner} PRIVATE
    <algorithm> <cmath> <filesystem> <functional> <iostream> <optional> <string> <variant> <vector> <catch2/catch.hpp>)
endfunction()

function(remap_use_precompiled_tests target owner)
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

# remap_unoptimised(TARGET): TARGET checks what others compute, and is itself not worth the time of an optimiser.
function(remap_unoptimised target)
  target_compile_options(${target} PRIVATE -O0)
endfunction()

# remap_small(TARGET...): what plans, edits texts and reports has no loop over texels, rows or pictures. Half the code, and a third of the
# compile time; under sanitizers, whose checks an optimiser takes long to move, half of it.
function(remap_small)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Os> $<$<CONFIG:Debug>:-O0>)
  endforeach()
endfunction()
