// The converter pass, built once for each set of flags that a user might take.
#pragma once

#include <array>
#include <cstddef>

namespace remap_bench {

// evaluate_batch<3> of the committed header: planar width and RGB. Returns texels out of domain.
using Pass = std::size_t (*)(std::size_t count, const float* width,
                             const std::array<const float*, 3>& specular, float* width_out,
                             const std::array<float*, 3>& specular_out);

std::size_t pass_o2(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                    const std::array<float*, 3>&);
std::size_t pass_o3(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                    const std::array<float*, 3>&);
std::size_t pass_avx2(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                      const std::array<float*, 3>&);

}  // namespace remap_bench
