// This file compiles the pass of one header of whole materials for one set of flags. Names and flags come
// from CMake, as in pass.cpp.
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
  using converter = BENCH_NAMESPACE::BENCH_HEADER;
  converter::InputTexels<const float> from{};  // pointers first, then strides of 1
  converter::OutputTexels<> to{};
  std::memcpy(static_cast<void*>(&from), in, sizeof(converter::Input) / sizeof(float) * sizeof(float*));
  std::memcpy(static_cast<void*>(&to), out, sizeof(converter::Output) / sizeof(float) * sizeof(float*));
  return converter::evaluate_batch(count, from, to);
}

}  // namespace remap_bench
