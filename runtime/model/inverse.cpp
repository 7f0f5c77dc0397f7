#include "model/inverse.hpp"

#include <cmath>
#include <functional>

#include "model/interpreter.hpp"

namespace remap {
namespace {

constexpr double kSameEnd = 1e-12;  // of a range, relative to its value there
constexpr int kHalvings = 60;

// Where a rising function takes `value` within `range`; none where it does not.
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

}  // namespace

std::optional<MappedTexel> inverse(const MappingKind& mapping, const Domain& domain,
                                   const MappedTexel& target) {
  // The specular that is needed at a width; beyond the domain its nearest edge, whose excess is judged at the
  // end.
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

}  // namespace remap
