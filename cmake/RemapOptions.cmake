# Compiler flags of every target of the project, as one interface target.
find_package(Threads REQUIRED)

add_library(remap_options INTERFACE)
target_link_libraries(remap_options INTERFACE Threads::Threads)
target_compile_options(remap_options INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wpedantic)
# gcc 12 warns of an impossible overlap inside std::string's operator+ (gcc bug 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(remap_options INTERFACE -Wno-restrict)
endif()
# Where memory has 32 bits, sizes of files have 64, and clang warns of every read.
if(CMAKE_SIZEOF_VOID_P EQUAL 4 AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(remap_options INTERFACE -Wno-shorten-64-to-32)
endif()
# Results must not depend on whether the compiler fuses a product and a sum.
target_compile_options(remap_options INTERFACE -ffp-contract=off)
if(REMAP_WARNINGS_AS_ERRORS)
  target_compile_options(remap_options INTERFACE -Werror)
endif()
