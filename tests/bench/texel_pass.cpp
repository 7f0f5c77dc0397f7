// This file compiles a header for interleaved texels, for one set of flags. Names and flags come from CMake,
// as in pass.cpp.
#include "bench/builds.hpp"

#define BENCH_TEXT(name) #name
#define BENCH_FILE(name) BENCH_TEXT(name.hpp)
#define remap BENCH_NAMESPACE
#include BENCH_FILE(BENCH_HEADER)
#undef remap

namespace remap_bench {

void BENCH_NAME(TexelUse use, std::size_t count, const float* width, const float* in, float* width_out,
                float* out) {
  using converter = BENCH_NAMESPACE::BENCH_HEADER;
  if (use == TexelUse::kRgba)
    converter::evaluate_batch(count, {in + 3, {in, in + 1, in + 2}, 4, 4},
                              {out + 3, {out, out + 1, out + 2}, 4, 4});
  else if (use == TexelUse::kRgb)
    converter::evaluate_batch(count, {width, {in, in + 1, in + 2}, 1, 3},
                              {width_out, {out, out + 1, out + 2}, 1, 3});
  else
    for (std::size_t i = 0; i < count; ++i, in += 4, out += 4) {
      const auto texel = converter::evaluate<3>({in[3], {in[0], in[1], in[2]}});
      for (std::size_t c = 0; c < 3; ++c) out[c] = texel.specular[c];
      out[3] = texel.width;
    }
}

}  // namespace remap_bench
