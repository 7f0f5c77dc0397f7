// This file renders two built-in models under lights that remap makes itself. Pictures under some of the
// lights choose the numbers of a converter, and pictures under the others judge it. Materials are highlights
// without diffuse light.
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
  // Both models are built-in ones whose lobes are linear (is_linear_lobe()). Takes seconds. The pictures of a
  // model are kept for other pairs. Thread-safe.
  PairPictures(const std::string& source, const std::string& target, const Domain& domain, unsigned jobs);
  ~PairPictures();

  // Returns the materials whose pictures choose the numbers of a converter.
  const std::vector<MappedTexel>& sources() const { return sources_; }
  // Returns the errors of pictures of target texels. These are the RMSE of display values under environments,
  // and the error relative to the source under point lights. Each error is divided by its value in `unit`, so
  // that one per cent has the same weight in both.
  TexelErrors choosing_errors(const PictureErrors& unit) const;
  // Returns mean errors for the lights and materials that choose.
  PictureErrors chosen(const TexelMap& map) const;
  // Returns mean errors for the lights and materials that judge.
  PictureErrors judged(const TexelMap& map) const;

 private:
  class Judge;
  std::unique_ptr<Judge> choosing_, judging_;
  std::vector<MappedTexel> sources_;
};

// Returns null if the built-in renderer lacks one of the models.
std::unique_ptr<PairPictures> pair_pictures(const std::string& source, const std::string& target,
                                            const Domain& domain, unsigned jobs);

}  // namespace remap
