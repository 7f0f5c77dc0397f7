// What a warp starts from: two materials as lists of texels, and the strokes that mark corresponding regions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "model/warp.hpp"
#include "sweep/brdf.hpp"

namespace remapc {

// Texels of one material, row by row or in any other order; those with a value that is not finite take no
// part. Reflectances and alpha are within 0 and 1 (held()).
struct WarpMaterial {
  std::string name;  // for messages
  BrdfModel model;   // of the specular lobe; GGX with Schlick's Fresnel unless said otherwise
  std::vector<remap::WarpTexel> texels;
};

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

// Throws kInput for a material without a finite texel, a stroke without texels (or none that is finite), an
// index that is no texel, no stroke at all, and for a stroke that lies within another. What strokes share
// beyond that counts for each of them.
void require_valid(const WarpMaterial& source, const WarpMaterial& target,
                   const std::vector<StrokePair>& strokes);

// The texel with values within 0 and 1; NaN stays.
remap::WarpTexel held(const remap::WarpTexel& texel) noexcept;

// Whether all values are finite.
bool is_finite(const remap::WarpTexel& texel) noexcept;

}  // namespace remapc
