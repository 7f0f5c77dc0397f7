// This file evaluates the formulas of lower/evaluate.hpp in long double, eleven bits more than the code under
// test.
#pragma once

#include <cmath>
#include <vector>

#include "lower/mapping.hpp"

namespace remap {

struct Exact {
  long double value = 0.0L;
};

inline Exact operator+(Exact a, Exact b) { return {a.value + b.value}; }
inline Exact operator-(Exact a, Exact b) { return {a.value - b.value}; }
inline Exact operator*(Exact a, Exact b) { return {a.value * b.value}; }
inline Exact operator+(Exact a, double b) { return {a.value + static_cast<long double>(b)}; }
inline Exact operator-(Exact a, double b) { return {a.value - static_cast<long double>(b)}; }
inline Exact operator*(Exact a, double b) { return {a.value * static_cast<long double>(b)}; }

inline Exact rise(double rate, Exact x) {
  if (rate == 0.0) return x;
  const auto wide = static_cast<long double>(rate);
  return {-std::expm1(-wide * x.value) / wide};
}
inline Exact reciprocal(Exact x) { return {1.0L / x.value}; }
inline Exact hyperbolic_tangent(Exact x) { return {std::tanh(x.value)}; }
inline Exact rectified(Exact x) { return {x.value > 0.0L ? x.value : 0.0L}; }

inline Exact gaussian_sum(const KernelExpansion& expansion, const std::vector<Exact>& inputs) {
  long double sum = 0.0L;
  const double* vector = expansion.vectors.data();
  for (const double weight : expansion.weights) {
    long double square = 0.0L;
    for (const Exact input : inputs) {
      const long double difference = input.value - static_cast<long double>(*vector++);
      square += difference * difference;
    }
    sum += static_cast<long double>(weight) * std::exp(-static_cast<long double>(expansion.gamma) * square);
  }
  return {sum};
}

}  // namespace remap
