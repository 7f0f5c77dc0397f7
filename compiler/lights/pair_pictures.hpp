// Pictures of two models of the built-in renderer under lights that the project makes: some choose the
// numbers of a converter, the others judge it. Materials are highlights without diffuse light.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "lower/form_fit.hpp"

namespace remap {

// Maps a source texel to a target texel, both in canonical parameters.
using TexelMap = std::function<MappedTexel(double alpha, double specular)>;

class PairPictures {
 public:
  virtual ~PairPictures() = default;
  // The materials whose pictures choose.
  virtual const std::vector<MappedTexel>& sources() const = 0;
  // Of what their target texels show: the RMSE of display values under environments and the error relative to
  // the source under point lights, each divided by `unit`, so that a per cent of one counts as a per cent of
  // the other.
  virtual TexelErrors choosing_errors(const PictureErrors& unit) const = 0;
  // Means by the lights and materials that choose.
  virtual PictureErrors chosen(const TexelMap& map) const = 0;
  // By other materials and lights: means over both.
  virtual PictureErrors judged(const TexelMap& map) const = 0;
};

// None where the built-in renderer lacks one of the models. Takes seconds; pictures of a model are kept for
// the next pair. Thread-safe.
std::unique_ptr<PairPictures> pair_pictures(const std::string& source, const std::string& target,
                                            const Domain& domain, unsigned jobs);

}  // namespace remap
