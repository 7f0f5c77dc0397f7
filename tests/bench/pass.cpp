// This file compiles the pass of one header for one set of flags. BENCH_NAME, BENCH_HEADER and the flags come
// from CMake. The functions of the header are inline, so each build needs its own namespace. Otherwise the
// linker would merge the builds.
#include <cstdint>
#include <cstring>

#include "bench/builds.hpp"

#define BENCH_TEXT(name) #name
#define BENCH_FILE(name) BENCH_TEXT(name.hpp)
#define remap BENCH_NAMESPACE
#include BENCH_FILE(BENCH_HEADER)
#undef remap

namespace remap_bench {

std::size_t BENCH_NAME(std::size_t count, const float* width, const std::array<const float*, 3>& specular,
                       float* width_out, const std::array<float*, 3>& specular_out) {
  return BENCH_NAMESPACE::BENCH_HEADER::evaluate_batch<3>(count, {width, specular},
                                                          {width_out, specular_out});
}

}  // namespace remap_bench
