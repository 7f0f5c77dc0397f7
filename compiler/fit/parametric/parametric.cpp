#include "fit/parametric/parametric.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "fit/parametric/specular_terms.hpp"
#include "lower/evaluate.hpp"

namespace remap {
namespace {

using Eigen::Index;

constexpr int kAlphaSteps = 1000;  // steps of the grid on which a curve is checked
constexpr int kSpecularSteps = 16;

double grid_value(const Range& range, int i, int steps) {
  return i == steps ? range.max : range.min + (range.max - range.min) * i / steps;
}

// Returns where `quantity` is smallest on a grid of the domain, or where it is NaN. If `flat`, it is the same
// at every specular.
MappedTexel least_place(const Domain& domain, bool flat, const auto& quantity) {
  MappedTexel place;
  double least = 1e300;
  for (int i = 0; i <= kAlphaSteps; ++i) {
    const double alpha = grid_value(domain.alpha, i, kAlphaSteps);
    for (int j = flat ? kSpecularSteps : 0; j <= kSpecularSteps; ++j) {
      const double specular = grid_value(domain.specular, j, kSpecularSteps);
      const double value = quantity(alpha, specular);
      if (!(value < least || std::isnan(value))) continue;
      least = value;
      place = {alpha, specular};
    }
  }
  return place;
}

double alpha_derivative(const Parametric& form, double alpha, double specular) {
  double sum = 0.0, specular_power = 1.0;
  for (const std::vector<double>& row : form.alpha) {
    double polynomial = 0.0;
    for (std::size_t i = row.size(); i-- > 0;)
      polynomial = polynomial * alpha + static_cast<double>(i + 1) * row[i];
    sum += specular_power * polynomial;
    specular_power *= specular;
  }
  return sum;
}

double specular_derivative(const Parametric& form, double alpha, double specular) {
  double sum = 0.0;
  for (const SpecularTerm& term : form.specular)
    if (term.power > 0)
      sum += term.power * std::pow(specular, term.power - 1) * curve_value(term.factor, alpha);
  return sum;
}

std::string context(double value, const MappedTexel& place, bool with_specular) {
  std::string text = number_text(value) + " at alpha1 " + number_text(place.alpha);
  if (with_specular) text += ", specular1 " + number_text(place.specular);
  return text;
}

}  // namespace

void require_rising_alpha(const Parametric& form, const Domain& domain) {
  const bool flat = form.alpha.size() == 1;
  const auto slope = [&](double alpha, double specular) { return alpha_derivative(form, alpha, specular); };
  const MappedTexel place = least_place(domain, flat, slope);
  const double least = slope(place.alpha, place.specular);
  if (least > 0.0) return;
  throw numeric_error("fit: the roughness curve does not increase from " + number_text(domain.alpha.min) +
                      " to " + number_text(domain.alpha.max) + ": its slope is " +
                      context(least, place, !flat));
}

void require_rising_specular(const Parametric& form, const Domain& domain, double least_specular) {
  const bool proportional = is_proportional(form);
  const auto slope = [&](double alpha, double specular) {
    return specular_derivative(form, alpha, specular);
  };
  const auto value = [&](double alpha, double specular) { return target_specular(form, alpha, specular); };
  const MappedTexel flattest = least_place(domain, proportional, slope),
                    darkest = least_place({domain.alpha, {least_specular, least_specular}}, true, value);
  const double least_slope = slope(flattest.alpha, flattest.specular),
               least_value = value(darkest.alpha, darkest.specular);
  if (!(least_slope > 0.0))
    throw numeric_error(proportional
                            ? "fit: k(alpha) is not positive: it is " + context(least_slope, flattest, false)
                            : "fit: specular2 does not increase with specular1: its slope is " +
                                  context(least_slope, flattest, true));
  if (!(least_value >= 0.0))
    throw numeric_error("fit: specular2 is negative: it is " + context(least_value, darkest, true));
}

double least_positive_specular(const std::vector<TableRow>& rows) {
  double least = 1e300;
  for (const TableRow& row : rows)
    if (row.specular1 > 0.0) least = std::min(least, row.specular1);
  return least;
}

std::vector<std::vector<double>> fit_roughness(const std::vector<TableRow>& rows,
                                               const ParametricForm& form) {
  Eigen::MatrixXd basis(static_cast<Index>(rows.size()),
                        std::accumulate(form.degrees.begin(), form.degrees.end(), Index{0}));
  Eigen::VectorXd target(basis.rows());
  for (Index r = 0; r < basis.rows(); ++r) {
    const TableRow& row = rows[static_cast<std::size_t>(r)];
    Index column = 0;
    double specular_power = 1.0;
    for (const int degree : form.degrees) {
      double power = specular_power;
      for (int i = 0; i < degree; ++i) basis(r, column++) = power *= row.alpha1;
      specular_power *= row.specular1;
    }
    target(r) = row.alpha2;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(basis);
  if (qr.rank() < basis.cols())
    throw input_error("fit: the training rows have too few distinct samples for the form " +
                      std::string(form.roughness) + " (at least " + std::to_string(basis.cols()) +
                      " that differ in alpha1 and specular1 are required)");
  const Eigen::VectorXd solution = qr.solve(target);
  std::vector<std::vector<double>> coefficients;
  const double* next = solution.data();
  for (const int degree : form.degrees) {
    coefficients.emplace_back(next, next + degree);
    next += degree;
  }
  return coefficients;
}

Parametric fit_parametric(const std::vector<TableRow>& rows, const Domain& domain,
                          const ParametricForm& form) {
  Parametric fit;
  fit.specular = fit_specular_terms(rows, form);
  fit.alpha = fit_roughness(rows, form);
  require_rising_alpha(fit, domain);
  require_rising_specular(fit, domain, least_positive_specular(rows));
  return fit;
}

Regression fit_parametric_kind(const std::vector<TableRow>& rows, const Domain& domain,
                               const std::string& form) {
  const std::string name = form.empty() ? "paper" : form;
  return {fit_parametric(rows, domain, find_form(name)), {{"form", name}}};
}

}  // namespace remap
