// The forms that the parametric kind can take, as data: which coefficients are free. Roughness and specular
// are regressed apart, so a form is one of each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remapc {

// alpha2 = sum over j of specular1^j times a polynomial of alpha1 without constant term, of degree
// degrees[j].
struct RoughnessForm {
  std::string_view name;
  std::string_view summary;  // for people
  std::vector<int> degrees;
  std::size_t coefficient_count() const;
};

// specular2 = sum over `powers` p of specular1^p times a curve of alpha1 (remap::AlphaCurve). A power that
// stands twice has the sum of two curves.
struct SpecularForm {
  std::string_view name;
  std::string_view summary;
  std::vector<int> powers;  // never falling, with 1 among them
  bool pole = false;        // whether the factor of specular1 has the term pole / alpha1
  // Whether the term adds to the one before it, which then holds the constant of both.
  bool is_repeated(std::size_t term) const;
  std::size_t coefficient_count() const;
};

// From the paper's (Sztrajman et al. 2019, section 7), which is the first, to the richest.
std::span<const RoughnessForm> roughness_forms();
std::span<const SpecularForm> specular_forms();

struct ParametricForm {
  const RoughnessForm* roughness = nullptr;
  const SpecularForm* specular = nullptr;
};

// `paper` for the paper's, else `<roughness>/<specular>`.
std::string form_name(const ParametricForm& form);

// The form of that name; `paper+pole` is `quartic/slope+pole`. Throws kUsage with the names there are.
ParametricForm find_form(const std::string& name);

// All of them, a line each, for the help of a command.
std::string form_list();

}  // namespace remapc
