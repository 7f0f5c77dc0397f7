# Builds for WebAssembly by Debian's emscripten: cmake --preset wasm. What needs it needs node, nlohmann-json3-dev and
# emscripten, and none of what the programs for this machine link.
execute_process(COMMAND em-config EMSCRIPTEN_ROOT OUTPUT_VARIABLE emscripten_root OUTPUT_STRIP_TRAILING_WHITESPACE
                RESULT_VARIABLE failure)
if(failure)
  message(FATAL_ERROR "em-config was not found (install it with: apt-get install --no-install-recommends emscripten)")
endif()
include(${emscripten_root}/cmake/Modules/Platform/Emscripten.cmake)

# Vectors of 16 bytes, exceptions of WebAssembly itself, and what its standard library lacks.
set(CMAKE_CXX_FLAGS_INIT
  "-msimd128 -fwasm-exceptions -isystem ${CMAKE_CURRENT_LIST_DIR}/../libcxx/include")

include(${CMAKE_CURRENT_LIST_DIR}/../headers/header_folders.cmake)
