// A compiled appearance warp (An et al. 2011): texels of one material become reflectances found in another.
// Plain data that a fit holds: coordinates in closed form, and a table of the template's parameters over
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

namespace remap {

// One texel of a diffuse lobe and a specular one: diffuse reflectance (R, G, B), specular reflectance at
// normal incidence or scale (R, G, B), both linear, and alpha, the microfacet width.
using WarpTexel = std::array<float, 7>;
inline constexpr std::size_t kWarpParameters = std::tuple_size_v<WarpTexel>;

inline constexpr std::size_t kLargestWarpDimension = 3;

// Closed form. A lobe whose specular parameter enters linearly, rho = d / pi + s slope(alpha) + base(alpha),
// has principal coordinates (An et al. 2011, section 3, by distances that are quadratic in rho)
//   x_k = sum_c d_c diffuse[k][c] + s_c specular[k][c](alpha) + offset[k](alpha)
// where the functions of alpha are straight lines between nodes even in log(alpha).
struct SeparableTerms {
  std::vector<float> diffuse;   // dimension x 3
  std::vector<float> specular;  // nodes x dimension x 3, at least two nodes
  std::vector<float> offset;    // nodes x dimension

  bool operator==(const SeparableTerms&) const = default;
};

// Fitted, for any other distance: quadratic in u = (cube roots of diffuse and of specular reflectance, and
// log(alpha / least) / log(largest / least)). The 36 terms are 1, u_0 to u_6, and u_i u_j for i <= j, in the
// order of i, then j.
struct QuadraticTerms {
  std::vector<float> weights;  // dimension x 36

  bool operator==(const QuadraticTerms&) const = default;
};
inline constexpr std::size_t kQuadraticTerms = 36;

// Where a reflectance lies in the appearance space of its material; reflectances are held within 0 and 1,
// alpha within its range. Unit: the RMS distance of the material's texels from their mean.
struct AppearanceCoordinates {
  std::size_t dimension = 0;   // 1 to 3
  float least_alpha = 0.0f;    // above 0
  float largest_alpha = 0.0f;  // at most 1
  std::variant<SeparableTerms, QuadraticTerms> terms;

  bool operator==(const AppearanceCoordinates&) const = default;
};

// Nodes of alpha.
std::size_t width_node_count(const AppearanceCoordinates& space, const SeparableTerms& terms) noexcept;

// The 36 terms of a texel whose values are in range.
std::array<double, kQuadraticTerms> quadratic_terms(const AppearanceCoordinates& space,
                                                    const WarpTexel& texel) noexcept;

// Multilinear between nodes, held at the faces of the box beyond.
struct BlendedNodes {
  std::array<float, kWarpParameters> least{}, largest{};  // of each parameter
  // nodes^dimension x 7, the first dimension runs fastest. A parameter is least + (largest - least) (code /
  // 255)^2: steps are finer where values are dark.
  std::vector<std::uint8_t> codes;

  bool operator==(const BlendedNodes&) const = default;
};

// The nearest node as it is: results are reflectances that the template has (An et al. 2011, principle 5).
struct CopiedNodes {
  std::vector<WarpTexel> palette;      // texels of the template, 1 to 65536
  std::vector<std::uint16_t> indices;  // of the palette; nodes^dimension, the first dimension runs fastest

  bool operator==(const CopiedNodes&) const = default;
};
inline constexpr std::size_t kLargestPalette = 65536;

// Parameters of the template over a box of the source's coordinates.
struct ParameterTable {
  std::size_t nodes = 0;         // along each dimension, 2 to 4096; at most kMostNodes in all
  std::vector<float> low, high;  // of the box, one each a dimension, low < high
  std::variant<BlendedNodes, CopiedNodes> entries;

  bool operator==(const ParameterTable&) const = default;
};
inline constexpr std::size_t kMostNodes = std::size_t{1} << 24;

struct CompiledWarp {
  AppearanceCoordinates coordinates;  // of the source
  ParameterTable table;

  bool operator==(const CompiledWarp&) const = default;
};

// The position of a texel, `dimension` values; the others are 0. NaN in the texel gives NaN.
std::array<double, kLargestWarpDimension> coordinates_of(const AppearanceCoordinates& space,
                                                         const WarpTexel& texel) noexcept;

// The value that a code stands for.
float decoded(const BlendedNodes& nodes, std::size_t parameter, std::uint8_t code) noexcept;

// The position in units of nodes along each dimension, from 0 to nodes - 1.
std::array<double, kLargestWarpDimension> node_position_of(const CompiledWarp& warp,
                                                           const WarpTexel& texel) noexcept;

// The template's parameters for a texel of the source, in double precision: the oracle of faster ways. NaN in
// the texel gives NaN in all parameters. `warp` must be valid.
WarpTexel evaluate_warp(const CompiledWarp& warp, const WarpTexel& texel) noexcept;

// Bytes of the numbers that the converter consists of.
std::size_t byte_count(const CompiledWarp& warp) noexcept;

// Throws kInput, opened by `place`, for counts that do not fit each other, an empty box, numbers that are not
// finite.
void require_valid(const CompiledWarp& warp, const std::string& place);

}  // namespace remap
