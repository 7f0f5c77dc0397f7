// The formula of each kind of mapping over any scalar: doubles for the interpreter, Taylor models for proofs
// (lower/taylor.hpp), so that proofs hold for the interpreted formula. A scalar needs +, -, * with itself and
// with double, and the functions that are declared for double below.
#pragma once

#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "lower/regimes.hpp"
#include "stages/network_outputs.hpp"

namespace remap {

// phi of AlphaCurve: (1 - exp(-rate x)) / rate, x where the rate is 0.
inline double rise(double rate, double x) { return rate == 0.0 ? x : -std::expm1(-rate * x) / rate; }

// Sum of weights[i] exp(-gamma |x - vector i|^2) for normalised inputs x.
inline double gaussian_sum(const KernelExpansion& expansion, const std::vector<double>& inputs) {
  double sum = 0.0;
  const double* vector = expansion.vectors.data();
  for (const double weight : expansion.weights) {
    double square = 0.0;
    for (const double input : inputs) {
      const double difference = input - *vector++;
      square += difference * difference;
    }
    sum += weight * std::exp(-expansion.gamma * square);
  }
  return sum;
}

template <typename Scalar>
Scalar curve_value(const AlphaCurve& curve, const Scalar& alpha) {
  Scalar value = rise(curve.ramp_rate, alpha) * curve.ramp + curve.start;
  if (curve.bump != 0.0) value = value + rise(curve.bump_rate, alpha * alpha) * curve.bump;
  if (curve.pole != 0.0) value = value + reciprocal(alpha) * curve.pole;
  return value;
}

// The inputs of a regressor with `count` inputs: alpha alone, or both.
template <typename Scalar>
std::vector<Scalar> inputs_of(std::size_t count, const Scalar& alpha, const Scalar& specular) {
  if (count == 1) return {alpha};
  return {alpha, specular};
}

template <typename Scalar>
Scalar expansion_value(const KernelExpansion& expansion, const Scalar& alpha, const Scalar& specular) {
  std::vector<Scalar> inputs = inputs_of(expansion.inputs.size(), alpha, specular);
  for (std::size_t i = 0; i < inputs.size(); ++i) inputs[i] = normalised(expansion.inputs[i], inputs[i]);
  return scaled_back(expansion.output, gaussian_sum(expansion, inputs) + expansion.bias);
}

// By Clenshaw's recurrence; 2 x - 1 is the parameter in its range. `at(i)`: the coefficient of T_i.
template <typename Scalar, typename Coefficient>
Scalar chebyshev_sum(const Range& range, const Scalar& parameter, std::size_t count, const Coefficient& at) {
  const double width = range.max - range.min;
  const Scalar x = (parameter - range.min) * (2.0 / width) - 1.0;
  Scalar next = parameter * 0.0, after = next;
  for (std::size_t i = count; i-- > 1;) {
    const Scalar sum = x * next * 2.0 - after + at(i);
    after = next;
    next = sum;
  }
  return x * next - after + at(0);
}

// Beyond the ranges of the series, its polynomial goes on.
template <typename Scalar>
Scalar series_value(const TexelSeries& series, const Scalar& alpha, const Scalar& specular) {
  return chebyshev_sum(series.specular, specular, series.coefficients.size(), [&](std::size_t j) {
    const std::vector<double>& row = series.coefficients[j];
    return chebyshev_sum(series.alpha, alpha, row.size(), [&](std::size_t i) { return row[i]; });
  });
}

template <typename Scalar>
Scalar target_alpha(const Parametric& form, const Scalar& alpha, const Scalar& specular) {
  Scalar sum = alpha * 0.0;
  for (std::size_t j = form.alpha.size(); j-- > 0;) {
    const std::vector<double>& row = form.alpha[j];
    Scalar polynomial = alpha * 0.0;
    for (std::size_t i = row.size(); i-- > 0;) polynomial = (polynomial + row[i]) * alpha;
    sum = j + 1 == form.alpha.size() ? polynomial : sum * specular + polynomial;
  }
  return sum;
}
template <typename Scalar>
Scalar target_alpha(const Svr& svr, const Scalar& alpha, const Scalar& specular) {
  return expansion_value(svr.alpha, alpha, specular);
}
template <typename Scalar>
Scalar target_alpha(const Mlp& mlp, const Scalar& alpha, const Scalar& specular) {
  return network_value(mlp.alpha, alpha, specular);
}

template <typename Scalar>
Scalar target_alpha(const Series& series, const Scalar& alpha, const Scalar& specular) {
  return series_value(series.alpha, alpha, specular);
}

// A network of one output over one texel.
template <typename Scalar>
Scalar network_value(const Network& network, const Scalar& alpha, const Scalar& specular) {
  return network_outputs(network, inputs_of(network.inputs.size(), alpha, specular))[0];
}

template <typename Scalar>
Scalar target_specular(const Parametric& form, const Scalar& alpha, const Scalar& specular) {
  Scalar sum = alpha * 0.0;
  Scalar power = alpha * 0.0 + 1.0;
  int reached = 0;
  for (const SpecularTerm& term : form.specular) {
    for (; reached < term.power; ++reached) power = power * specular;
    sum = sum + curve_value(term.factor, alpha) * power;
  }
  return sum;
}
template <typename Scalar>
Scalar target_specular(const Svr& svr, const Scalar& alpha, const Scalar& specular) {
  return expansion_value(svr.specular, alpha, specular);
}
template <typename Scalar>
Scalar target_specular(const Mlp& mlp, const Scalar& alpha, const Scalar& specular) {
  return network_value(mlp.specular, alpha, specular);
}

template <typename Scalar>
Scalar target_specular(const Series& series, const Scalar& alpha, const Scalar& specular) {
  return series_value(series.specular, alpha, specular);
}

// Applies all steps but the last.
template <typename Scalar>
void follow_chain(const Chain& chain, Scalar* alpha, Scalar* specular) {
  for (std::size_t i = 0; i + 1 < chain.steps.size(); ++i) {
    const auto [next_alpha, next_specular] = std::visit(
        [&](const auto& kind) {
          return std::pair(target_alpha(kind, *alpha, *specular), target_specular(kind, *alpha, *specular));
        },
        chain.steps[i].mapping);
    *alpha = next_alpha;
    *specular = next_specular;
  }
}
template <typename Scalar>
Scalar target_alpha(const Chain& chain, Scalar alpha, Scalar specular) {
  follow_chain(chain, &alpha, &specular);
  return std::visit([&](const auto& kind) { return target_alpha(kind, alpha, specular); },
                    chain.steps.back().mapping);
}
template <typename Scalar>
Scalar target_specular(const Chain& chain, Scalar alpha, Scalar specular) {
  follow_chain(chain, &alpha, &specular);
  return std::visit([&](const auto& kind) { return target_specular(kind, alpha, specular); },
                    chain.steps.back().mapping);
}

}  // namespace remap
