#include "model/round_trip.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/interpreter.hpp"

namespace remap {
namespace {

constexpr int kReturnedAlphas = 60, kReturnedSpeculars = 20;
constexpr double kMedianGoal = 0.005, kP99Goal = 0.02;

// Nearest rank.
double quantile(std::vector<double>* values, double share) {
  if (values->empty()) return 0.0;
  const double last = static_cast<double>(values->size());
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * last)));
  std::sort(values->begin(), values->end());
  return (*values)[rank - 1];
}

}  // namespace

RoundTrip round_trip(const Fit& there, const Fit& back) {
  std::vector<double> alphas, speculars;
  for (int i = 0; i < kReturnedAlphas; ++i)
    for (int j = 1; j <= kReturnedSpeculars; ++j) {
      const Range& range = there.domain.alpha;
      const double alpha = range.min + (range.max - range.min) * i / (kReturnedAlphas - 1);
      const double specular = there.domain.specular.max * j / kReturnedSpeculars;
      const MappedTexel far = evaluate_mapping(there.mapping, alpha, specular);
      if (!back.domain.alpha.contains(far.alpha) || !back.domain.specular.contains(far.specular)) continue;
      const MappedTexel home = evaluate_mapping(back.mapping, far.alpha, far.specular);
      alphas.push_back(std::fabs(home.alpha - alpha) / alpha);
      speculars.push_back(std::fabs(home.specular - specular) / specular);
    }
  RoundTrip trip;
  trip.share = static_cast<double>(alphas.size()) / (kReturnedAlphas * kReturnedSpeculars);
  trip.alpha_median = quantile(&alphas, 0.5);
  trip.alpha_p99 = quantile(&alphas, 0.99);
  trip.specular_median = quantile(&speculars, 0.5);
  trip.specular_p99 = quantile(&speculars, 0.99);
  return trip;
}

bool returns(const RoundTrip& trip) {
  return trip.share > 0.0 && trip.alpha_median <= kMedianGoal && trip.specular_median <= kMedianGoal &&
         trip.alpha_p99 <= kP99Goal && trip.specular_p99 <= kP99Goal;
}

}  // namespace remap
