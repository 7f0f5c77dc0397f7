// This file finds the numbers of a compact form, either from the rows of a table, or from any function of the
// errors for these rows.
#pragma once

#include <functional>
#include <vector>

#include "converter/compact_form.hpp"
#include "lower/fit.hpp"

namespace remap {

// A FormSample is a source texel with its target. It states whether the target is at a limit.
struct FormSample {
  MappedTexel source, target;
  bool alpha_at_limit = false, specular_at_limit = false;
  double weight = 1.0;  // weight of its errors
};

// A FormShape has the terms t^j alpha^i of both factors, with j < powers and i < terms - j. If powers is 1,
// the form does not use t.
struct FormShape {
  std::size_t powers = 1, terms = 1;
  bool operator==(const FormShape&) const = default;
};

// Returns the shapes, the smallest first. Some shapes have factors of alpha only. They are for lobes without
// Fresnel, whose scale is a power of alpha.
std::vector<FormShape> form_shapes();
std::size_t term_count(const FormShape& shape);  // number of terms of each factor
std::string shape_name(const FormShape& shape);
bool is_within(const CompactForm& form, const FormShape& shape);
CompactForm padded(CompactForm form, const FormShape& shape);  // adds terms with the coefficient 0

// Returns the numbers of a form in one row, as a search varies them: the logarithm of the pole, P, Q, and the
// hinge if there are limits.
std::vector<double> numbers_of(const CompactForm& form);
CompactForm with_numbers(CompactForm form, const std::vector<double>& numbers);

// Returns the form with the least squares of relative errors (error_weight()) on the
// samples. If samples reach a limit, the form has the limits. Throws kNumeric if the samples do not determine
// the form. If the first start is not sound, or if the result depends on the start, the best of the `sound`
// forms within the shape is another start.
CompactForm fit_form(const std::vector<FormSample>& samples, const Limits& limits, const Domain& domain,
                     const FormShape& shape, const std::vector<CompactForm>& sound = {});

// A TexelError is the error of one texel, which a search minimises. It has the gradient by target alpha and
// target specular. The curvature is approximated without negative eigenvalues.
struct TexelError {
  double value = 0.0;
  double by_alpha = 0.0, by_specular = 0.0;
  double by_alpha_2 = 0.0, by_both = 0.0, by_specular_2 = 0.0;
};
// Returns the weight of an output's error when fits are compared: 1 / value, but at most 1 / `least`.
// Pictures show errors relative to the value, but no errors of values below a fiftieth.
double error_weight(double value, double least = 0.02);

// Returns `weight` times the squared relative errors of `found` against the target of a row.
TexelError row_error(const MappedTexel& found, const MappedTexel& wanted, double weight);
using TexelErrors = std::function<std::vector<TexelError>(const std::vector<MappedTexel>& targets)>;

// Runs the Gauss-Newton method with damping (Levenberg 1944) over all numbers at once, from each start. The
// sum of the errors never rises. Returns the best result, and a sound result if there is one.
CompactForm refined_form(const std::vector<CompactForm>& starts, const Domain& domain,
                         const std::vector<MappedTexel>& sources, const TexelErrors& errors, int iterations);

// Returns true if the form is sound on a dense grid. P and Q are positive and finite over the domain, and
// with the hinge, the width stays positive. Below the limits, target alpha never falls if source alpha rises,
// and target specular never falls if source specular rises.
bool is_sound(const CompactForm& form, const Domain& domain);

// Returns the form with clamps at the limits that it exceeds somewhere in the domain.
CompactForm within_limits(CompactForm form, const Domain& domain, const Limits& limits);

}  // namespace remap
