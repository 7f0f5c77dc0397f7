// This file declares code that is built once for each set of flags that a user might choose: passes of
// headers, kernels of networks, and Eigen's products. CMake lists the builds in builds.inc.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace remap_bench {

// This is the evaluate_batch<3> of a header, for planar width and RGB. It returns texels out of domain.
using Pass = std::size_t (*)(std::size_t count, const float* width,
                             const std::array<const float*, 3>& specular, float* width_out,
                             const std::array<float*, 3>& specular_out);

// These passes convert interleaved texels: RGBA with the width in alpha, RGB with a separate map of the
// width, and RGBA texel by texel.
enum class TexelUse { kRgba, kRgb, kSingle };
using TexelPass = void (*)(TexelUse use, std::size_t count, const float* width, const float* in,
                           float* width_out, float* out);

// This header is also measured over large maps and interleaved texels.
inline constexpr const char* kLargeHeader = "mitsuba_ward_to_mitsuba_as";

// This is the header of the shipped network for whole materials.
inline constexpr const char* kNetworkHeader = "specular_to_metallic_network_sztrajman_2019";

// This is the evaluate_batch of a header of whole materials. It returns texels out of domain.
using MaterialPass = std::size_t (*)(std::size_t count, const float* const* in, float* const* out);

// A NetworkProducts does the multiplications of a network of 6 x 300 x 4 as Eigen's products of matrices,
// `batch` texels at a time.
struct NetworkProducts {
  std::size_t batch;
  bool texels_innermost;                         // true if a column of the matrices is a row of texels
  const float *hidden_weights, *output_weights;  // 1800 and 1200 arbitrary numbers
};
using ProductsPass = void (*)(const NetworkProducts& products, std::size_t texels, const float* in,
                              float* out);

template <typename Function>
struct Build {
  std::string code;   // the header or rival
  std::string flags;  // o2, o3, avx2, avx512
  Function function;
};

// Return the builds that this processor can run.
std::vector<Build<Pass>> pass_builds();
std::vector<Build<TexelPass>> texel_builds();
std::vector<Build<MaterialPass>> material_builds();
std::vector<Build<ProductsPass>> products_builds();

// Returns the flags in words.
std::string flags_text(const std::string& flags);

}  // namespace remap_bench
