// One build of the kernel of a network; names and flags come from CMake, as in pass.cpp.
#include <cstdint>
#include <cstring>

#include "bench/builds.hpp"

#define BENCH_TEXT(name) #name
#define BENCH_FILE(name) BENCH_TEXT(name.hpp)
#define remap BENCH_NAMESPACE
#include BENCH_FILE(BENCH_HEADER)
#undef remap

namespace remap_bench {

void BENCH_NAME(std::size_t texels, const float* in, float* out) {
  namespace network = BENCH_NAMESPACE::BENCH_HEADER;
  for (std::size_t start = 0; start < texels; start += network::kBlock) {
    const float* from[6];
    float* to[4];
    for (std::size_t k = 0; k < 6; ++k) from[k] = in + k * texels + start;
    for (std::size_t m = 0; m < 4; ++m) to[m] = out + m * texels + start;
    network::rows(network::kBlock, from, to);
  }
}

}  // namespace remap_bench
