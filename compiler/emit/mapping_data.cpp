// How headers compute a mapping: the data of their code, and a bound of its rounding errors.
#include <algorithm>
#include <cmath>

#include "emit/header_data.hpp"
#include "remap/error.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Domain;
using remap::Layer;
using remap::Network;

// Slightly more than the unit roundoff of a float and of a double.
constexpr double kFloatUnit = 6e-8, kDoubleUnit = 2.3e-16;

std::string shape_text(const remap::LoweredFunction& function) {
  const remap::PiecewisePolynomial& polynomial = function.polynomial;
  int degree = 0;
  for (const int d : polynomial.degrees) degree = std::max(degree, d);
  std::string text = "degree " + std::to_string(degree);
  if (polynomial.cell_count > 1) text += " on " + std::to_string(polynomial.cell_count) + " pieces";
  if (polynomial.pole != 0.0f)
    text += " in alpha / (alpha + " + remap::number_text(remap::decimal_value(polynomial.pole)) + ")";
  if (polynomial.degrees.size() > 2)
    text += ", " + std::to_string(polynomial.degrees.size() - 1) + " in specular";
  text += ", proven within " + two_digits(function.bound) + " (sampled " + two_digits(function.sampled) + ")";
  if (function.rises_with_alpha) text += ", rising with alpha";
  if (function.rises_with_specular) text += ", rising with specular";
  return text;
}

// The rounding error of Horner's rule in floats (Higham 2002, section 5.1), including that of the literals.
double alpha_error(const remap::Parametric& form, const Domain& domain) {
  double error = 0.0;
  for (std::size_t j = 0; j < form.alpha.size(); ++j)
    for (std::size_t i = 0; i < form.alpha[j].size(); ++i) {
      const auto alpha_power = static_cast<double>(i + 1), specular_power = static_cast<double>(j);
      error += kFloatUnit * (2.0 * alpha_power + 2.0 * specular_power + 4.0) * std::fabs(form.alpha[j][i]) *
               std::pow(domain.alpha.max, alpha_power) * std::pow(domain.specular.max, specular_power);
    }
  return error;
}

// The same for curves. A rise is a series of eight terms, or 1 minus an exponential with an error of 2e-7;
// both are within ten roundings of its largest value. The sum of a curve adds four roundings, every power of
// specular four more.
double specular_error(const remap::Parametric& form, const Domain& domain) {
  const auto risen = [](double factor, double rate, double largest) {
    return std::fabs(factor) * (rate * largest <= kSeriesLimit ? 2.0 * largest : 1.0 / rate);
  };
  double error = 0.0;
  for (const remap::SpecularTerm& term : form.specular) {
    const remap::AlphaCurve& curve = term.factor;
    const double magnitude = std::fabs(curve.start) + risen(curve.ramp, curve.ramp_rate, domain.alpha.max) +
                             risen(curve.bump, curve.bump_rate, domain.alpha.max * domain.alpha.max) +
                             (curve.pole == 0.0 ? 0.0 : std::fabs(curve.pole) / domain.alpha.min);
    error += kFloatUnit * (14.0 + 4.0 * term.power) * magnitude * std::pow(domain.specular.max, term.power);
  }
  return error;
}

// The largest exponent gamma |x - v|^2 over the domain.
double largest_exponent(const remap::KernelExpansion& expansion, const Domain& domain) {
  const auto normalized = [](const remap::Scaling& scaling, double value) {
    const double t = scaling.pole == 0.0 ? value : value / (value + scaling.pole);
    return (t - scaling.offset) * scaling.scale;
  };
  double largest = 0.0;
  const std::size_t width = expansion.inputs.size();
  for (std::size_t v = 0; v < expansion.count(); ++v) {
    double square = 0.0;
    for (std::size_t k = 0; k < width; ++k) {
      const remap::Range& range = k == 0 ? domain.alpha : domain.specular;
      double far = 0.0;
      for (const double end : {range.min, range.max})
        far =
            std::max(far, std::fabs(normalized(expansion.inputs[k], end) - expansion.vectors[v * width + k]));
      square += far * far;
    }
    largest = std::max(largest, expansion.gamma * square);
  }
  return largest;
}

int squarings_of(const remap::KernelExpansion& expansion, const Domain& domain) {
  constexpr double kLargestExponent = 690.0;  // exp(-x) of doubles holds down to 2^-1000
  int squarings = 0;
  for (double largest = largest_exponent(expansion, domain); largest > kLargestExponent; largest *= 0.5)
    ++squarings;
  return squarings;
}

// The rounding error in double precision: 4e-13 of the weights for the exponential and the sum, and the error
// of the normalized inputs, which grows where a domain is narrow, times the steepest slope of a Gaussian,
// sqrt(2 gamma / e).
double error_of(const remap::KernelExpansion& expansion, const Domain& domain) {
  double weights = 0.0, moved = 0.0;
  for (const double weight : expansion.weights) weights += std::fabs(weight);
  for (std::size_t k = 0; k < expansion.inputs.size(); ++k) {
    const remap::Scaling& scaling = expansion.inputs[k];
    const double largest = scaling.pole > 0.0 ? 1.0 : (k == 0 ? domain.alpha.max : domain.specular.max);
    moved += 6.0 * kDoubleUnit * (largest + std::fabs(scaling.offset)) * std::fabs(scaling.scale);
  }
  const double of_sum = weights * (4e-13 + 0.86 * std::sqrt(expansion.gamma) * moved);
  return (of_sum + 8.0 * kDoubleUnit * std::fabs(expansion.bias)) / std::fabs(expansion.output.scale) +
         8.0 * kDoubleUnit * std::fabs(expansion.output.offset);
}

// A first-order bound of the rounding error of a folded network in floats: each unit adds the roundings of
// its terms to the errors of its inputs times its weights. Activations have slopes of at most 1.1.
double error_of(const Network& network, const Domain& domain) {
  std::vector<double> magnitude = {1.0, domain.specular.max}, error = {0.0, 0.0};
  magnitude[0] = network.inputs[0].pole == 0.0 ? domain.alpha.max : 1.0;
  if (network.inputs[0].pole != 0.0) error[0] = 2.0 * kFloatUnit;
  for (const Layer& layer : network.layers) {
    std::vector<double> next_magnitude, next_error;
    const bool last = &layer == &network.layers.back();
    for (std::size_t j = 0; j < layer.output_count(); ++j) {
      double sum = std::fabs(layer.biases[j]), inherited = 0.0;
      for (std::size_t k = 0; k < layer.input_count; ++k) {
        const double weight = std::fabs(layer.weights[j * layer.input_count + k]);
        sum += weight * magnitude[k];
        inherited += weight * error[k];
      }
      const bool bounded = !last && network.activation == remap::Activation::kTanh;
      next_magnitude.push_back(bounded ? 1.0 : sum);
      next_error.push_back(1.1 * (inherited + kFloatUnit * static_cast<double>(layer.input_count + 1) * sum) +
                           (last ? 0.0 : 5e-7 * next_magnitude.back()));
    }
    magnitude = next_magnitude;
    error = next_error;
  }
  return *std::max_element(error.begin(), error.end()) + 1e-6;
}

MappingData fitted(const remap::Parametric& form, const Domain& domain) {
  return {FittedCurves{form, domain.alpha.max},
          "As fitted: polynomials and exponentials, by an exponential of its own (2e-7).",
          alpha_error(form, domain), specular_error(form, domain)};
}

MappingData fitted(const remap::Svr& svr, const Domain& domain) {
  return {FittedGaussians{svr, squarings_of(svr.alpha, domain), squarings_of(svr.specular, domain)},
          "As fitted: sums over " + std::to_string(svr.alpha.count()) + " and " +
              std::to_string(svr.specular.count()) +
              " support vectors, in double precision, by an exponential of its own (1e-13).",
          error_of(svr.alpha, domain), error_of(svr.specular, domain)};
}

MappingData fitted(const remap::Mlp& mlp, const Domain& domain) {
  const auto sizes = [](const Network& network) {
    std::string text = std::to_string(network.inputs.size());
    for (const Layer& layer : network.layers) text += " x " + std::to_string(layer.output_count());
    return text;
  };
  const remap::Mlp networks = {folded(mlp.alpha), folded(mlp.specular)};
  return {networks,
          "As fitted: networks of " + sizes(mlp.alpha) + " and " + sizes(mlp.specular) + " (" +
              std::string(activation_name(mlp.specular.activation)) + "), in single precision.",
          error_of(networks.alpha, domain), error_of(networks.specular, domain)};
}

MappingData fitted(const remap::Series&, const Domain&) {
  throw remap::Error(remap::ErrorKind::kUsage, "emit: a series has no exact form (remove --exact)");
}

MappingData fitted(const remap::Chain& chain, const Domain&) {
  throw remap::Error(remap::ErrorKind::kUsage, "emit: a chain of " + std::to_string(chain.steps.size()) +
                                                   " steps has no exact form (remove --exact)");
}

}  // namespace

std::string two_digits(double error) { return remap::number_text(remap::rounded_up(error, 2)); }

MappingData lowered_mapping(const remap::Lowered& lowered) {
  std::string text = "Lowered from the fit. Target alpha: " + shape_text(lowered.alpha) +
                     ".\nTarget specular: " + shape_text(lowered.specular) + ".";
  if (lowered.wide)
    text += "\nWhere alpha is at its limit, target specular: " + shape_text(lowered.wide->specular.function) +
            ".";
  if (lowered.bright)
    text += "\nWhere specular is at its limit, target alpha: " + shape_text(lowered.bright->function) + ".";
  if (lowered.wide || lowered.bright)
    text += "\nAll together within " + two_digits(lowered.alpha_bound()) + " in alpha, " +
            two_digits(lowered.specular_bound()) + " in specular.";
  return {lowered, text, lowered.alpha_bound(), lowered.specular_bound()};
}

MappingData exact_mapping(const remap::MappingKind& mapping, const Domain& domain) {
  return std::visit([&](const auto& kind) { return fitted(kind, domain); }, mapping);
}

Network folded(const Network& network) {
  Network result = network;
  Layer& first = result.layers.front();
  for (std::size_t j = 0; j < first.output_count(); ++j)
    for (std::size_t k = 0; k < first.input_count; ++k) {
      double& weight = first.weights[j * first.input_count + k];
      first.biases[j] -= weight * network.inputs[k].scale * network.inputs[k].offset;
      weight *= network.inputs[k].scale;
    }
  Layer& last = result.layers.back();
  for (std::size_t j = 0; j < last.output_count(); ++j) {
    const double range = 1.0 / network.outputs[j].scale;
    for (std::size_t k = 0; k < last.input_count; ++k) last.weights[j * last.input_count + k] *= range;
    last.biases[j] = last.biases[j] * range + network.outputs[j].offset;
  }
  for (remap::Scaling& input : result.inputs) input = {0.0, 1.0, input.pole};
  for (remap::Scaling& output : result.outputs) output = {};
  return result;
}

}  // namespace remapc
