// This file finds the numbers of a compact form from rows of a table, or from any error function of the
// form's results for these rows.
#pragma once

#include <functional>
#include <vector>

#include "converter/compact_form.hpp"
#include "lower/fit.hpp"

namespace remap {

// A FormSample is the target of a source texel. It states whether the target is at a limit there.
struct FormSample {
  MappedTexel source, target;
  bool alpha_at_limit = false, specular_at_limit = false;
};

// A FormShape has the terms t^j alpha^i of both factors with j < powers and i < terms - j. Without powers
// above 1, t is not used.
struct FormShape {
  std::size_t powers = 1, terms = 1;
  bool operator==(const FormShape&) const = default;
};

// Returns the shapes, beginning with few numbers. Factors of only alpha serve lobes without Fresnel, whose
// scale is a power of alpha.
std::vector<FormShape> form_shapes();
std::size_t term_count(const FormShape& shape);  // number of terms of each factor
std::string shape_name(const FormShape& shape);
bool is_within(const CompactForm& form, const FormShape& shape);
CompactForm padded(CompactForm form, const FormShape& shape);  // adds terms that are 0

// Returns the numbers of a form in a row, as a search changes them: the pole as its logarithm, P, Q, and the
// hinge if there are limits.
std::vector<double> numbers_of(const CompactForm& form);
CompactForm with_numbers(CompactForm form, const std::vector<double>& numbers);

// Returns the form with the least squares of relative errors (error_weight of table/regression.hpp) on the
// samples. Throws kNumeric if the samples do not determine it. Limits are part of the form if samples reach
// one. If the first start is not sound, or limits make the result depend on the start, the best of the
// `sound` forms within the shape is another start.
CompactForm fit_form(const std::vector<FormSample>& samples, const Limits& limits, const Domain& domain,
                     const FormShape& shape, const std::vector<CompactForm>& sound = {});

// A TexelError is the error of one texel, which a search minimises, with its gradient by target alpha and
// target specular. The curvature is approximated so that it has no negative eigenvalue.
struct TexelError {
  double value = 0.0;
  double by_alpha = 0.0, by_specular = 0.0;
  double by_alpha_2 = 0.0, by_both = 0.0, by_specular_2 = 0.0;
};
// Returns `weight` times the squared relative errors of `found` against the target of a row.
TexelError row_error(const MappedTexel& found, const MappedTexel& wanted, double weight);
using TexelErrors = std::function<std::vector<TexelError>(const std::vector<MappedTexel>& targets)>;

// Runs Gauss and Newton's method over all numbers at once, damped (Levenberg 1944), from each start. The sum
// of the errors never rises. Returns the best result, a sound one if there is one.
CompactForm refined_form(const std::vector<CompactForm>& starts, const Domain& domain,
                         const std::vector<MappedTexel>& sources, const TexelErrors& errors, int iterations);

// Returns true if the form is sound, by a dense grid. P and Q are positive and finite over the domain, and
// the hinge leaves a width. Below the limits, target alpha never falls if source alpha rises, and target
// specular never falls if source specular rises.
bool is_sound(const CompactForm& form, const Domain& domain);

// Returns the form, clamped at the limits that it exceeds somewhere in the domain.
CompactForm within_limits(CompactForm form, const Domain& domain, const Limits& limits);

}  // namespace remap
