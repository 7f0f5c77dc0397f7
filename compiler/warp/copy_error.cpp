#include "warp/copy_error.hpp"

#include <cmath>

namespace remapc {
namespace {

constexpr std::size_t kMostSampledSources = std::size_t{1} << 14, kMostCopies = std::size_t{1} << 18;

// The material with at most `limit` texels, all of them finite.
WarpMaterial thinned(const WarpMaterial& material, std::size_t limit) {
  WarpMaterial result{material.name, material.model, {}, material.is_dielectric};
  for (const std::uint32_t texel : sample_texels(material, limit))
    result.texels.push_back(held(material.texels[texel]));
  return result;
}

}  // namespace

double copy_rms_error(const WarpFit& fit, const WarpMaterial& source, const WarpMaterial& target) {
  const WarpMaterial from = thinned(source, kMostSampledSources), to = thinned(target, kMostCopies);
  std::vector<remap::WarpTexel> copied, compiled;
  for (const std::uint32_t texel : copy_exactly(fit, from, to)) copied.push_back(to.texels[texel]);
  for (const remap::WarpTexel& texel : from.texels)
    compiled.push_back(remap::evaluate_warp(fit.compiled, texel));
  // The unit of the coordinates is the template's spread.
  const Points difference =
      positions_of(fit.target_coordinates(), compiled) - positions_of(fit.target_coordinates(), copied);
  return std::sqrt(difference.rowwise().squaredNorm().mean());
}

}  // namespace remapc
