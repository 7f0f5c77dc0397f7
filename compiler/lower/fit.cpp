#include "lower/fit.hpp"

namespace remap {

std::optional<double> mean_ssim(const Fit& fit) {
  if (!fit.image_similarity || fit.image_similarity->ssim.empty()) return std::nullopt;
  double sum = 0.0;
  for (const SphereSimilarity& sphere : fit.image_similarity->ssim) sum += sphere.ssim;
  return sum / static_cast<double>(fit.image_similarity->ssim.size());
}

}  // namespace remap
