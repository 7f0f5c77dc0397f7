// This file lists the forms of the parametric kind as data, which shows the free coefficients. Roughness and
// specular are fitted separately.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"

namespace remap {

// A ParametricForm has a part for roughness and a part for specular:
//   alpha2 = sum over j of specular1^j times a polynomial of alpha1 without constant term, of degree
//   degrees[j];
//   specular2 = sum over `powers` p of specular1^p times a curve of alpha1 (remap::AlphaCurve). A repeated
//   power has the sum of two curves.
struct ParametricForm {
  std::string_view roughness, specular;  // names of the parts, for messages
  std::vector<int> degrees;
  std::vector<int> powers;  // in increasing order, repetitions allowed; includes 1
  bool pole = false;        // true if the factor of specular1 has the term pole / alpha1
  // Returns true if this term has the same power as the previous term. Only the previous term then has a
  // constant, for both.
  bool is_repeated(std::size_t term) const { return term > 0 && powers[term] == powers[term - 1]; }
};

// Finds `paper` (Sztrajman et al. 2019, section 7), or `paper+pole` with the term c5 / alpha of the authors'
// scripts. Throws kUsage otherwise.
inline ParametricForm find_form(const std::string& name) {
  if (name == "paper") return {"quartic", "slope", {4}, {1}, false};
  if (name == "paper+pole") return {"quartic", "slope+pole", {4}, {1}, true};
  throw usage_error("--form: unknown form '" + name + "' (choose paper or paper+pole)");
}

}  // namespace remap
