#include "build/trust.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/report_text.hpp"

namespace remap {

bool is_measured(const Fit& fit) { return mean_ssim(fit).has_value(); }

double image_error(const Fit& fit) {
  return fit.image_error ? fit.image_error->rms : std::numeric_limits<double>::infinity();
}

std::string trust_warning(const Fit& fit) {
  if (!fit.image_error) return "pictures never compared";
  return image_error(fit) > kLargestTrustedError ? "image error above " + fixed(kLargestTrustedError, 2) : "";
}

std::vector<const Fit*> by_trust(const std::vector<Fit>& fits) {
  std::vector<const Fit*> sorted;
  for (const Fit& fit : fits) sorted.push_back(&fit);
  std::sort(sorted.begin(), sorted.end(), [](const Fit* a, const Fit* b) {
    return std::pair(image_error(*a), a->id) < std::pair(image_error(*b), b->id);
  });
  return sorted;
}

}  // namespace remap
