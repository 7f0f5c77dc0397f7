// This file declares passes of headers that are built once for each set of flags that a user might choose.
// CMake lists the builds in builds.inc.
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

// This is the evaluate_batch of a header of whole materials. It returns texels out of domain.
using MaterialPass = std::size_t (*)(std::size_t count, const float* const* in, float* const* out);

template <typename Function>
struct Build {
  std::string code;   // the header
  std::string flags;  // o2, o3, avx2, avx512
  Function function;
};

// Return the builds that this processor can run.
std::vector<Build<Pass>> pass_builds();
std::vector<Build<MaterialPass>> material_builds();

// Returns the flags in words.
std::string flags_text(const std::string& flags);

}  // namespace remap_bench
