// This file describes appearance warps: as tables, with their provenance, and as converters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

// A compiled appearance warp (An et al. 2011) gives texels of one material the reflectances of another. A
// closed formula maps a texel to coordinates. A table has the template's parameters at these coordinates.

// A WarpTexel has a diffuse lobe and a specular lobe: diffuse reflectance (R, G, B), specular reflectance at
// normal incidence or scale (R, G, B), and alpha, the microfacet width. Both reflectances are linear.
using WarpTexel = std::array<float, 7>;
inline constexpr std::size_t kWarpParameters = std::tuple_size_v<WarpTexel>;

inline constexpr std::size_t kLargestWarpDimension = 3;

// A SeparableTerms describes a lobe that is linear in its specular parameter, rho = d / pi + s slope(alpha) +
// base(alpha). It has these principal coordinates (An et al. 2011, section 3, for distances quadratic in
// rho):
//   x_k = sum_c d_c diffuse[k][c] + s_c specular[k][c](alpha) + offset[k](alpha)
// The functions of alpha are linear between nodes that are evenly spaced in log(alpha).
struct SeparableTerms {
  std::vector<float> diffuse;   // dimension x 3
  std::vector<float> specular;  // nodes x dimension x 3, at least two nodes
  std::vector<float> offset;    // nodes x dimension

  bool operator==(const SeparableTerms&) const = default;
};

// A QuadraticTerms is a fit for other distances, quadratic in u. The seven values of u are the cube roots of
// diffuse and specular reflectance, and log(alpha / least) / log(largest / least). The 36 terms are 1, u_0 to
// u_6, and u_i u_j for i <= j, ordered by i, then j.
struct QuadraticTerms {
  std::vector<float> weights;  // dimension x 36

  bool operator==(const QuadraticTerms&) const = default;
};
inline constexpr std::size_t kQuadraticTerms = 36;

// An AppearanceCoordinates gives the position of a reflectance in the appearance space of its material.
// Reflectances are clamped to [0, 1], and alpha to its range. The unit is the RMS distance of texels from the
// mean.
struct AppearanceCoordinates {
  std::size_t dimension = 0;   // 1 to 3
  float least_alpha = 0.0f;    // above 0
  float largest_alpha = 0.0f;  // at most 1
  std::variant<SeparableTerms, QuadraticTerms> terms;

  bool operator==(const AppearanceCoordinates&) const = default;
};

// Returns the number of nodes of alpha.
std::size_t width_node_count(const AppearanceCoordinates& space, const SeparableTerms& terms) noexcept;

// Returns the 36 terms of a texel whose values are in range.
std::array<double, kQuadraticTerms> quadratic_terms(const AppearanceCoordinates& space,
                                                    const WarpTexel& texel) noexcept;

// A BlendedNodes interpolates multilinearly between nodes. Positions are clamped to the box of the table.
struct BlendedNodes {
  std::array<float, kWarpParameters> least{}, largest{};  // range of each parameter
  // There are nodes^dimension x 7 codes, and the first dimension is the fastest. A parameter is least +
  // (largest - least) (code / 255)^2, so that dark values have finer steps.
  std::vector<std::uint8_t> codes;

  bool operator==(const BlendedNodes&) const = default;
};

// A CopiedNodes copies the closest node, so results are template reflectances (An et al. 2011, principle 5).
struct CopiedNodes {
  std::vector<WarpTexel> palette;      // texels of the template, 1 to 65536
  std::vector<std::uint16_t> indices;  // index into the palette; nodes^dimension, first dimension fastest

  bool operator==(const CopiedNodes&) const = default;
};
inline constexpr std::size_t kLargestPalette = 65536;

// A ParameterTable holds the template's parameters over a box of the source's coordinates.
struct ParameterTable {
  std::size_t nodes = 0;         // along each dimension, 2 to 4096; at most kMostNodes in all
  std::vector<float> low, high;  // corners of the box, low < high in each dimension
  std::variant<BlendedNodes, CopiedNodes> entries;

  bool operator==(const ParameterTable&) const = default;
};
inline constexpr std::size_t kMostNodes = std::size_t{1} << 24;

struct CompiledWarp {
  AppearanceCoordinates coordinates;  // coordinates of the source
  ParameterTable table;

  bool operator==(const CompiledWarp&) const = default;
};

// Returns the position of a texel: `dimension` values, then zeros. NaN in the texel gives NaN.
std::array<double, kLargestWarpDimension> coordinates_of(const AppearanceCoordinates& space,
                                                         const WarpTexel& texel) noexcept;

float decoded(const BlendedNodes& nodes, std::size_t parameter, std::uint8_t code) noexcept;

// Returns the position in units of nodes along each dimension, from 0 to nodes - 1.
std::array<double, kLargestWarpDimension> node_position_of(const CompiledWarp& warp,
                                                           const WarpTexel& texel) noexcept;

// Returns the template's parameters for a texel of the source, in double precision. Tests compare faster
// implementations with it. NaN in the texel gives NaN in all parameters. `warp` must be valid.
WarpTexel evaluate_warp(const CompiledWarp& warp, const WarpTexel& texel) noexcept;

// Returns the size of the converter's numbers in bytes.
std::size_t byte_count(const CompiledWarp& warp) noexcept;

// Throws kInput, beginning with `context`, for inconsistent counts, an empty box, or numbers that are not
// finite.
void require_valid(const CompiledWarp& warp, const std::string& context);

// A WarpMapFit is a fit of kind `warp`: a compiled appearance warp and its provenance.

struct WarpMapFit {
  std::string id;
  std::string source_model, template_model;  // models of the texels before and after: `mitsuba/ggx`
  CompiledWarp warp;
  // This is the RMS distance in appearance from the exact copy of template texels. It is a fraction of the
  // template's spread. It is -1 if unknown.
  double copy_rms_error = -1.0;
  std::map<std::string, std::string> method;  // how the fit was made
  std::vector<std::string> remarks;           // warnings of the fit, one line each
  std::string tool_version;
  bool operator==(const WarpMapFit&) const = default;
};

inline constexpr const char* kWarpKind = "warp";

// This entry of `method` marks a warp whose source was only a diffuse map, with specular 0 and alpha 1.
inline constexpr const char* kWarpSourceMaps = "source_maps";
inline constexpr const char* kDiffuseAlone = "diffuse";
inline bool is_of_diffuse_alone(const WarpMapFit& fit) {
  const auto maps = fit.method.find(kWarpSourceMaps);
  return maps != fit.method.end() && maps->second == kDiffuseAlone;
}

// The following functions make converters of whole materials from a compiled warp.

// Converts diffuse, specular and width of a warp's source to the parameters of its template. All target rows
// must be present. Equation (2) first converts a metallic source to a specular one. A color in one row is
// grey. Throws kInput like require_valid().
std::unique_ptr<Converter> make_warp_converter(const WarpMapFit& fit, const WorkflowEnd& source,
                                               InstructionSet set = best_instruction_set());

// Reads the warp of a fit file. Throws kInput if the file cannot be read or holds a fit of another kind.
WarpMapFit load_warp_fit(const std::filesystem::path& path);

}  // namespace remap
