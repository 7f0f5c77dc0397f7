// This file lists the forms of the parametric kind as data, which shows the free coefficients. Roughness and
// specular are fitted separately, so a form has two parts.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// A RoughnessForm is alpha2 = sum over j of specular1^j times a polynomial of alpha1 without constant term,
// of degree degrees[j].
struct RoughnessForm {
  std::string_view name;
  std::string_view summary;  // shown to users
  std::vector<int> degrees;
  std::size_t coefficient_count() const;
};

// A SpecularForm is specular2 = sum over `powers` p of specular1^p times a curve of alpha1
// (remap::AlphaCurve). A repeated power has the sum of two curves.
struct SpecularForm {
  std::string_view name;
  std::string_view summary;
  std::vector<int> powers;  // in increasing order, repetitions allowed; includes 1
  bool pole = false;        // true if the factor of specular1 has the term pole / alpha1
  // Returns true if this term has the same power as the previous term. Only the previous term then has a
  // constant, for both.
  bool is_repeated(std::size_t term) const;
  std::size_t coefficient_count() const;
};

// Return all forms, in order of complexity. The first is the paper's (Sztrajman et al. 2019, section 7).
std::span<const RoughnessForm> roughness_forms();
std::span<const SpecularForm> specular_forms();

struct ParametricForm {
  const RoughnessForm* roughness = nullptr;
  const SpecularForm* specular = nullptr;
};

// Finds `paper`, or `paper+pole` with the term c5 / alpha of the authors' scripts. Throws kUsage otherwise.
ParametricForm find_form(const std::string& name);

}  // namespace remap
