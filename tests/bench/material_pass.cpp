// One build of the pass of one header of whole materials; names and flags come from CMake, as in pass.cpp.
#include <cmath>
#include <cstdint>
#include <cstring>

#include "bench/builds.hpp"

#define BENCH_TEXT(name) #name
#define BENCH_FILE(name) BENCH_TEXT(name.hpp)
#define remap BENCH_NAMESPACE
#include BENCH_FILE(BENCH_HEADER)
#undef remap

namespace remap_bench {

std::size_t BENCH_NAME(std::size_t count, const float* const* in, float* const* out) {
  namespace converter = BENCH_NAMESPACE::BENCH_HEADER;
  std::array<const float*, converter::kInputRows> from{};
  std::array<float*, converter::kOutputRows> to{};
  for (std::size_t r = 0; r < from.size(); ++r) from[r] = in[r];
  for (std::size_t r = 0; r < to.size(); ++r) to[r] = out[r];
  return converter::evaluate_rows(count, from, to);
}

}  // namespace remap_bench
