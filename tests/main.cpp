// Catch2's own main, once for every test program.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
