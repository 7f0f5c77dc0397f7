#include "converter/compact_form.hpp"

#include <limits>

namespace remap {
namespace {

std::size_t terms_of(const FactorTerms& factor) {
  std::size_t count = 0;
  for (const std::vector<float>& row : factor)
    for (const float term : row) count += term != 0.0f;
  return count;
}

// At this alpha, the exponent 2 / alpha^2 - 2 is two million. A mirror would have an infinite exponent.
constexpr float kSharpestExponent = 1e-3f;

}  // namespace

bool is_copy(const CompactForm& form) { return form == CompactForm{}; }

std::size_t number_count(const CompactForm& form) {
  if (is_copy(form)) return 0;
  const std::size_t factors = terms_of(form.alpha) + terms_of(form.specular);
  std::size_t count = factors + (form.alpha.size() > 1 || form.specular.size() > 1 ? 1 : 0);
  for (const float number : {form.hinge.turn, form.hinge.turn_by_alpha, form.hinge.bend, form.hinge.spread})
    count += number != 0.0f;
  return count;
}

FormEnds ends_of(RoughnessEncoding source, RoughnessEncoding target, const Range& width) {
  const auto min = static_cast<float>(width.min), max = static_cast<float>(width.max);
  FormEnds ends{min, max, 0.0f, max, 0.0f, 0.0f};
  const bool is_exponent = source == RoughnessEncoding::kExponent;
  const bool falls = is_exponent || source == RoughnessEncoding::kGlossiness;  // falls as alpha rises
  if (falls) {
    ends.width_from = min;
    ends.width_to = is_exponent ? std::numeric_limits<float>::max() : 1.0f;
  }
  ends.alpha_min = static_cast<float>(to_alpha(source, falls ? width.max : width.min));
  if (target == RoughnessEncoding::kExponent) ends.least_alpha = kSharpestExponent;
  return ends;
}

}  // namespace remap
