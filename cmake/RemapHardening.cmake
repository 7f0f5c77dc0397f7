# Every program, library and module of the project, those of packages too, is built against faults of memory: canaries on the
# stack, checked calls of the C library, tables of addresses that are read-only once the program runs, and addresses that no
# attacker knows. WebAssembly has a memory of its own, and mingw-w64 has none of these.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  add_compile_options(-fstack-protector-strong)
  # Only with optimisation, without which the C library refuses it; remap_unoptimised() takes it back.
  add_compile_options("$<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  add_link_options(-Wl,-z,relro,-z,now,-z,noexecstack)
endif()
