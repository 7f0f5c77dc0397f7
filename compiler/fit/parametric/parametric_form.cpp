#include "fit/parametric/parametric_form.hpp"

#include <numeric>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace remap {
namespace {

const std::vector<RoughnessForm> kRoughnessForms = {
    {"quartic", "degree 4 in alpha", {4}},
    {"sextic", "degree 6 in alpha", {6}},
    {"quartic-s", "degree 4, and a cubic times specular", {4, 3}},
    {"sextic-s", "degree 6, and a cubic times specular", {6, 3}},
    {"sextic-s2", "degree 6, and cubics times powers of specular up to 2", {6, 3, 3}},
    {"sextic-s4", "like sextic-s2, with powers up to 4", {6, 3, 3, 3, 3}},
    // A rim that does not fade with specular shifts the match by about 1 / specular, which needs many powers.
    {"sextic-s6", "like sextic-s2, with powers up to 6", {6, 3, 3, 3, 3, 3, 3}},
};

// The authors' scripts add the pole to section 7. An offset models the rim that a target with Fresnel shows
// at reflectance 0; curvature models the specular of three.js. A sum of two curves removes the residual wave
// of 1e-3 that one curve leaves in k(alpha).
const std::vector<SpecularForm> kSpecularForms = {
    {"slope", "k(alpha) specular", {1}, false},
    {"slope+pole", "slope with c5 / alpha in k", {1}, true},
    {"double", "k(alpha) specular, k the sum of two curves", {1, 1}, false},
    {"affine", "offset(alpha) + k(alpha) specular", {0, 1}, false},
    {"affine+pole", "affine with c5 / alpha in k", {0, 1}, true},
    {"affine-double", "offset(alpha) + k(alpha) specular, k the sum of two curves", {0, 1, 1}, false},
    {"quadratic", "k(alpha) specular + curvature(alpha) specular^2", {1, 2}, false},
    {"quadratic+pole", "quadratic with c5 / alpha in k", {1, 2}, true},
    {"quadratic-double", "quadratic, k the sum of two curves", {1, 1, 2}, false},
    {"full", "offset + k specular + curvature specular^2", {0, 1, 2}, false},
    {"full-double", "full, k the sum of two curves", {0, 1, 1, 2}, false},
};

constexpr std::size_t kCurveCoefficients = 5;  // start, ramp, its rate, bump, its rate

template <typename Form>
const Form* find_named(const std::vector<Form>& forms, std::string_view name) {
  for (const Form& form : forms)
    if (form.name == name) return &form;
  return nullptr;
}

template <typename Form>
std::string names_of(const std::vector<Form>& forms) {
  std::string text;
  for (const Form& form : forms) text += (text.empty() ? "" : ", ") + std::string(form.name);
  return text;
}

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

std::string form_name(const ParametricForm& form) {
  if (form.roughness == &kRoughnessForms.front() && form.specular == &kSpecularForms.front()) return "paper";
  return std::string(form.roughness->name) + "/" + std::string(form.specular->name);
}

ParametricForm find_form(const std::string& name) {
  if (name == "paper") return {&kRoughnessForms.front(), &kSpecularForms.front()};
  if (name == "paper+pole") return find_form("quartic/slope+pole");
  const std::size_t slash = name.find('/');
  const ParametricForm form = {
      find_named(kRoughnessForms, name.substr(0, slash)),
      slash == std::string::npos ? nullptr : find_named(kSpecularForms, name.substr(slash + 1))};
  if (form.roughness != nullptr && form.specular != nullptr) return form;
  std::vector<std::string> known = {"paper", "paper+pole"};
  for (const RoughnessForm& roughness : kRoughnessForms)
    for (const SpecularForm& specular : kSpecularForms)
      known.push_back(std::string(roughness.name) + "/" + std::string(specular.name));
  const std::string nearest = nearest_name(name, known);
  throw usage_error("unknown form '" + name + "' (" +
                    (nearest.empty() ? "" : "did you mean " + nearest + "? ") +
                    "choose paper, paper+pole or ROUGHNESS/SPECULAR of " + names_of(kRoughnessForms) + " / " +
                    names_of(kSpecularForms) + ")");
}

std::string form_list() {
  const auto line = [](const auto& form) {
    std::string text = "  " + std::string(form.name);
    text.resize(std::max<std::size_t>(text.size() + 2, 20), ' ');
    return text + std::string(form.summary) + "\n";
  };
  std::string text = "Forms ROUGHNESS/SPECULAR (paper: quartic/slope):\n";
  for (const RoughnessForm& form : kRoughnessForms) text += line(form);
  text += "  /\n";
  for (const SpecularForm& form : kSpecularForms) text += line(form);
  return text;
}

}  // namespace remap
