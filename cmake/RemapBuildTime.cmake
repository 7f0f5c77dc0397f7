# What keeps builds short: headers that many sources read are compiled once, and what has no long loops is not optimised.

# gcc, which otherwise collects garbage every few megabytes, takes a seventh less time, and up to 1.7 GB for sixteen files.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-expand=400" "SHELL:--param ggc-min-heapsize=1000000")
endif()

# remap_compile_together(TARGET): its files are compiled some at a time, sixteen in half the processor time of six (decision 071).
option(REMAP_UNITY "Compile the files of a folder together" ON)
set(REMAP_UNITY_FILES 16 CACHE STRING "How many files of a folder are compiled together")
function(remap_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${REMAP_UNITY} UNITY_BUILD_BATCH_SIZE ${REMAP_UNITY_FILES})
endfunction()

# remap_precompile_tests(OWNER), remap_use_precompiled_tests(TARGET OWNER): Catch2 compiled once, for all test programs.
# They must have the same flags as OWNER; definitions may differ.
function(remap_precompile_tests owner)
  # CMake compiles the header only for a target with a source that reads it, which Catch2's main must not.
  file(CONFIGURE OUTPUT precompiled_tests.cpp CONTENT "// Reads the precompiled header of the tests.\n")
  target_sources(${owner} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/precompiled_tests.cpp)
  # The owner is a library, whose code would be of another kind than that of the programs that read its header.
  target_compile_options(${owner} PRIVATE $<$<PLATFORM_ID:Linux>:-fPIE>)
  target_precompile_headers(${owner} PRIVATE
    <algorithm> <cmath> <filesystem> <functional> <iostream> <optional> <string> <variant> <vector> <catch2/catch.hpp>)
endfunction()

function(remap_use_precompiled_tests target owner)
  target_precompile_headers(${target} REUSE_FROM ${owner})
endfunction()

# remap_unoptimised(TARGET): TARGET checks what others compute, and is itself not worth the time of an optimiser.
function(remap_unoptimised target)
  target_compile_options(${target} PRIVATE -O0 -U_FORTIFY_SOURCE)
endfunction()

# remap_small(TARGET...): what plans, edits texts and reports has no loop over texels, rows or pictures. Half the code, and a third of the
# compile time; under sanitizers, whose checks an optimiser takes long to move, half of it.
function(remap_small)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Os> $<$<CONFIG:Debug>:-O0>)
  endforeach()
endfunction()
