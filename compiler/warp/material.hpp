// This file holds the input of a warp: two materials as lists of texels, and strokes that mark corresponding
// regions. A texel has parameters of a BRDF model, or is an entry of a table of reflectances or profiles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "look/brdf.hpp"
#include "remap/warp.hpp"

namespace remap {

// A WarpMaterial holds the texels of one material in any order. Texels with a value that is not finite are
// skipped. Reflectances and alpha are in 0 to 1 (clamped()).
struct WarpMaterial {
  std::string name;  // name for messages
  BrdfModel model;   // model of the specular lobe; GGX with Schlick's Fresnel by default
  std::vector<WarpTexel> texels;
  bool is_dielectric = false;         // true if reflectance is not linear in specular, as in MapModel
  std::size_t width = 0, height = 0;  // size of the map that the texels form, row-major; 0 if they form none
  bool is_albedo = false;             // true if it was read from only a diffuse map
};

// A TabulatedMaterial has texels that are entries of a table. These are measured BRDFs, or radially symmetric
// scattering profiles P(r) of the diffuse component of a BSSRDF (Song et al. 2009).
struct TabulatedMaterial {
  std::string name;  // name for messages
  // These are the radii of profiles in rising order, above 0. They are empty for BRDFs, whose samples are at
  // the directions of half_vector_quadrature().
  std::vector<double> radii;
  Eigen::MatrixXf samples;             // red, then green, then blue; one column per entry; finite, at least 0
  std::vector<std::uint32_t> entries;  // entry of each texel, row-major; a texel without an entry is skipped
  std::size_t width = 0, height = 0;   // size of the map of entries
  std::filesystem::path table;         // profiles.exr, profiles.csv or brdfs.txt
};

// A MaterialRef refers to a material of either kind, which must outlive it.
class MaterialRef {
 public:
  MaterialRef(const WarpMaterial& material) noexcept : parametric_(&material) {}      // NOLINT: both are one
  MaterialRef(const TabulatedMaterial& material) noexcept : tabulated_(&material) {}  // NOLINT

  const std::string& name() const noexcept { return parametric_ ? parametric_->name : tabulated_->name; }
  std::size_t texel_count() const noexcept {
    return parametric_ ? parametric_->texels.size() : tabulated_->entries.size();
  }
  // Return the size of the map that the texels form, row-major from the top.
  std::size_t width() const noexcept { return parametric_ ? parametric_->width : tabulated_->width; }
  std::size_t height() const noexcept { return parametric_ ? parametric_->height : tabulated_->height; }
  // Returns true if a texel is used: all of its values are finite, or it is an entry of the table.
  bool takes_part(std::size_t texel) const noexcept;
  // Returns true if reflectance is linear in all parameters except alpha.
  bool is_separable() const noexcept { return parametric_ != nullptr && !parametric_->is_dielectric; }
  bool is_profiles() const noexcept { return tabulated_ != nullptr && !tabulated_->radii.empty(); }
  // Each function returns null if the material is of the other kind.
  const WarpMaterial* parametric() const noexcept { return parametric_; }
  const TabulatedMaterial* tabulated() const noexcept { return tabulated_; }

 private:
  const WarpMaterial* parametric_ = nullptr;
  const TabulatedMaterial* tabulated_ = nullptr;
};

// Returns at most `limit` used texels. They are evenly spread over the list, with random offsets, so that
// they do not form columns of a map.
std::vector<std::uint32_t> sample_texels(const MaterialRef& material, std::size_t limit);

// A StrokePair is a region that is marked in both materials: indices of texels.
struct StrokePair {
  std::vector<std::uint32_t> source, target;  // `target` is in the template
  std::string color = {};  // `#rrggbb` if the strokes were painted in colors; messages show it
};
// Returns `stroke 2`, or `stroke #ff0000`.
std::string stroke_name(const std::vector<StrokePair>& strokes, std::size_t stroke);

// An Overlap is the fraction of a stroke that another stroke covers.
struct Overlap {
  std::size_t stroke = 0, other = 0;  // indices of the strokes
  double share = 0.0;                 // fraction of the texels, 0 to 1
  bool in_template = false;
};
// Finds the stroke that covers most of `stroke` on one side. Indices are below `texel_count`.
Overlap largest_overlap(const std::vector<StrokePair>& strokes, std::vector<std::uint32_t> StrokePair::*side,
                        std::size_t stroke, std::size_t texel_count);

// Throws kInput for a material without used texels, a stroke without used texels, an index out of range, and
// a stroke that lies inside another stroke. Throws kUsage if there are no strokes. Strokes may overlap
// partly.
void require_valid(const MaterialRef& source, const MaterialRef& target,
                   const std::vector<StrokePair>& strokes);

// Clamps the values of a texel to 0 to 1; NaN is kept.
WarpTexel clamped(const WarpTexel& texel) noexcept;

}  // namespace remap
