#include "lower/inverse.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "lower/interpreter.hpp"

namespace remap {
namespace {

constexpr double kSameEnd = 1e-12;  // tolerance for a range's end, relative to its value
constexpr int kHalvings = 60;

// Returns the argument within `range` at which a rising function takes `value`, if there is one.
std::optional<double> root(const std::function<double(double)>& rising, const Range& range, double value) {
  const double room = kSameEnd * std::fabs(value);
  double low = range.min, high = range.max;
  if (!(rising(low) <= value + room) || !(rising(high) >= value - room)) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

constexpr int kReturnedAlphas = 60, kReturnedSpeculars = 20;
constexpr double kMedianGoal = 0.005, kP99Goal = 0.02;

// Returns the quantile, by the closest rank.
double quantile(std::vector<double>* values, double share) {
  if (values->empty()) return 0.0;
  const double last = static_cast<double>(values->size());
  const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(share * last)));
  std::sort(values->begin(), values->end());
  return (*values)[rank - 1];
}

}  // namespace

std::optional<MappedTexel> inverse(const Fit& fit, const MappedTexel& target) {
  const MappingKind& mapping = fit.mapping;
  const Domain& domain = fit.domain;
  // Returns the specular that is needed at an alpha, clamped to the domain. The last test below rejects
  // clamped values.
  const auto specular_at = [&](double alpha) {
    const auto rising = [&](double specular) { return evaluate_mapping(mapping, alpha, specular).specular; };
    if (rising(domain.specular.min) >= target.specular) return domain.specular.min;
    return root(rising, domain.specular, target.specular).value_or(domain.specular.max);
  };
  const auto rising = [&](double alpha) {
    return evaluate_mapping(mapping, alpha, specular_at(alpha)).alpha;
  };
  const std::optional<double> alpha = root(rising, domain.alpha, target.alpha);
  if (!alpha) return std::nullopt;
  const double specular = specular_at(*alpha);
  const double reached = evaluate_mapping(mapping, *alpha, specular).specular;
  if (!(std::fabs(reached - target.specular) <= 1e-9 * domain.specular.max)) return std::nullopt;
  return MappedTexel{*alpha, specular};
}

RoundTrip round_trip(const Fit& there, const Fit& back) {
  std::vector<double> alphas, speculars;
  for (int i = 0; i < kReturnedAlphas; ++i)
    for (int j = 1; j <= kReturnedSpeculars; ++j) {
      const Range& range = there.domain.alpha;
      const double alpha = range.min + (range.max - range.min) * i / (kReturnedAlphas - 1);
      const double specular = there.domain.specular.max * j / kReturnedSpeculars;
      const MappedTexel far = evaluate_fit(there, alpha, specular);
      if (!is_inside(there, alpha, specular) || !back.domain.alpha.contains(far.alpha) ||
          !back.domain.specular.contains(far.specular) || !is_inside(back, far.alpha, far.specular))
        continue;
      const MappedTexel home = evaluate_fit(back, far.alpha, far.specular);
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
