#include "fit/parametric/parametric_form.hpp"

#include <numeric>

#include "core/errors.hpp"

namespace remap {
namespace {

const std::vector<RoughnessForm> kRoughnessForms = {
    {"quartic", "degree 4 in alpha", {4}},
};

// The pole is not in section 7. The authors' scripts have it.
const std::vector<SpecularForm> kSpecularForms = {
    {"slope", "k(alpha) specular", {1}, false},
    {"slope+pole", "slope with c5 / alpha in k", {1}, true},
};

constexpr std::size_t kCurveCoefficients = 5;  // start, ramp, its rate, bump, its rate

}  // namespace

std::size_t RoughnessForm::coefficient_count() const {
  return static_cast<std::size_t>(std::accumulate(degrees.begin(), degrees.end(), 0));
}

std::size_t SpecularForm::coefficient_count() const {
  std::size_t count = pole ? 1 : 0;
  for (std::size_t t = 0; t < powers.size(); ++t) count += kCurveCoefficients - (is_repeated(t) ? 1 : 0);
  return count;
}

bool SpecularForm::is_repeated(std::size_t term) const {
  return term > 0 && powers[term] == powers[term - 1];
}

std::span<const RoughnessForm> roughness_forms() { return kRoughnessForms; }
std::span<const SpecularForm> specular_forms() { return kSpecularForms; }

ParametricForm find_form(const std::string& name) {
  if (name == "paper") return {&kRoughnessForms.front(), &kSpecularForms.front()};
  if (name == "paper+pole") return {&kRoughnessForms.front(), &kSpecularForms.back()};
  throw usage_error("--form: unknown form '" + name + "' (choose paper or paper+pole)");
}

}  // namespace remap
