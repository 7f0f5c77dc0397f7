#include "lower/fit.hpp"

namespace remap {

std::optional<double> mean_ssim(const Fit& fit) {
  if (fit.ssim.empty()) return std::nullopt;
  double sum = 0.0;
  for (const auto& [alpha, ssim] : fit.ssim) sum += ssim;
  return sum / static_cast<double>(fit.ssim.size());
}

}  // namespace remap
