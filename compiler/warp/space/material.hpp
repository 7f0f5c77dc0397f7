// What a warp starts from: two materials as lists of texels, and the strokes that mark corresponding regions.
// A texel is told by parameters of a BRDF model, or is one entry of a table of reflectances or profiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "renderer/brdf.hpp"
#include "warp/compiled_warp.hpp"

namespace remapc {

// Texels of one material, row by row or in any other order; those with a value that is not finite take no
// part. Reflectances and alpha are within 0 and 1 (held()).
struct WarpMaterial {
  std::string name;  // for messages
  BrdfModel model;   // of the specular lobe; GGX with Schlick's Fresnel unless said otherwise
  std::vector<remap::WarpTexel> texels;
  bool is_dielectric = false;  // as MapModel has it: reflectance is not linear in specular
};

// Texels that are entries of a table: measured BRDFs, or scattering profiles P(r) of the diffuse component of
// a BSSRDF (Song et al. 2009), radially symmetric.
struct TabulatedMaterial {
  std::string name;  // for messages
  // Of profiles, in the order of samples, above 0 and growing; empty for BRDFs, whose samples are at the
  // directions of half_vector_quadrature().
  std::vector<double> radii;
  Eigen::MatrixXf samples;  // samples of red, then green, then blue; a column an entry; finite, from 0
  std::vector<std::uint32_t> entries;  // of each texel, row by row; one that is no column takes no part
};

// Either kind, by reference: what it stands for must outlive it.
class MaterialRef {
 public:
  MaterialRef(const WarpMaterial& material) noexcept : parametric_(&material) {}      // NOLINT: both are one
  MaterialRef(const TabulatedMaterial& material) noexcept : tabulated_(&material) {}  // NOLINT

  const std::string& name() const noexcept { return parametric_ ? parametric_->name : tabulated_->name; }
  std::size_t texel_count() const noexcept {
    return parametric_ ? parametric_->texels.size() : tabulated_->entries.size();
  }
  // Whether all values of a texel are finite, or it is an entry of the table.
  bool takes_part(std::size_t texel) const noexcept;
  // Parameters in which reflectance is linear, but for alpha.
  bool is_separable() const noexcept { return parametric_ != nullptr && !parametric_->is_dielectric; }
  bool is_profiles() const noexcept { return tabulated_ != nullptr && !tabulated_->radii.empty(); }
  // Empty where it is of the other kind.
  const WarpMaterial* parametric() const noexcept { return parametric_; }
  const TabulatedMaterial* tabulated() const noexcept { return tabulated_; }

 private:
  const WarpMaterial* parametric_ = nullptr;
  const TabulatedMaterial* tabulated_ = nullptr;
};

// The map that the texels of a material make, row by row from the top.
struct MapFrame {
  std::string name;  // of the material, for messages
  std::size_t width = 0, height = 0;
};

// Texels that take part, at most `limit`, evenly spread over the list and scattered, so that they stand in no
// columns of a map.
std::vector<std::uint32_t> sample_texels(const MaterialRef& material, std::size_t limit);

// One region, marked in both materials: indices of texels.
struct StrokePair {
  std::vector<std::uint32_t> source, target;  // `target`: of the template
  std::string color = {};  // `#rrggbb` of both, where they were painted in one; for messages
};
// `stroke 2`, or `stroke #ff0000`.
std::string stroke_name(const std::vector<StrokePair>& strokes, std::size_t stroke);

// How much of a stroke another one covers as well.
struct Overlap {
  std::size_t other = 0;  // index of that stroke
  double share = 0.0;     // of the texels, 0 to 1
};
// The one that covers most of `stroke`, on one side; all texels are below `texel_count`.
Overlap largest_overlap(const std::vector<StrokePair>& strokes, std::vector<std::uint32_t> StrokePair::*side,
                        std::size_t stroke, std::size_t texel_count);

// Throws kInput for a material without a texel that takes part, a stroke without texels (or none that is
// finite), an index that is no texel, no stroke at all, and for a stroke that lies within another. What
// strokes share beyond that counts for each of them.
void require_valid(const MaterialRef& source, const MaterialRef& target,
                   const std::vector<StrokePair>& strokes);

// The texel with values within 0 and 1; NaN stays.
remap::WarpTexel held(const remap::WarpTexel& texel) noexcept;

// Whether all values are finite.
bool is_finite(const remap::WarpTexel& texel) noexcept;

}  // namespace remapc
