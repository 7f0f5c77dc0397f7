// This file holds the formula of each kind of mapping, for any type of scalar. The interpreter uses doubles,
// and proofs use Taylor models (lower/taylor.hpp). So a proof holds for the formula that is interpreted. A
// scalar needs +, -, * with itself and with double, and the functions that are declared for double below.
#pragma once

#include <cmath>
#include <vector>

#include "lower/mapping.hpp"
#include "reference/network.hpp"

namespace remap {

// Returns phi of AlphaCurve: (1 - exp(-rate x)) / rate, or x if the rate is 0.
inline double rise(double rate, double x) { return rate == 0.0 ? x : -std::expm1(-rate * x) / rate; }

// Returns the sum of weights[i] exp(-gamma |x - vector i|^2) for normalised inputs x.
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

// Returns the inputs of a regression with `count` inputs: alpha, or alpha and specular.
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

// Returns the variable t of the form.
template <typename Scalar>
Scalar share_of_pole(double pole, const Scalar& specular) {
  return reciprocal(specular + pole) * -pole + 1.0;
}

template <typename Scalar>
Scalar target_alpha(const CompactForm& form, const Scalar& alpha, const Scalar& specular) {
  return factor_value(form.alpha, alpha, share_of_pole(static_cast<double>(form.pole), specular)) * alpha;
}
template <typename Scalar>
Scalar target_specular(const CompactForm& form, const Scalar& alpha, const Scalar& specular) {
  return factor_value(form.specular, alpha, share_of_pole(static_cast<double>(form.pole), specular)) *
         specular;
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

// Evaluates a network with one output for one texel.
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

}  // namespace remap
