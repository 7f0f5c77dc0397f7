// Polynomials in words, and networks as headers compute them.
#include <algorithm>

#include "core/number_text.hpp"
#include "emit/header_data.hpp"

namespace remap {
namespace {

std::string shape_text(const LoweredFunction& function) {
  const PiecewisePolynomial& polynomial = function.polynomial;
  int degree = 0;
  for (const int d : polynomial.degrees) degree = std::max(degree, d);
  std::string text = "degree " + std::to_string(degree);
  if (polynomial.cell_count > 1) text += " on " + std::to_string(polynomial.cell_count) + " pieces";
  if (polynomial.pole != 0.0f)
    text += " in alpha / (alpha + " + number_text(decimal_value(polynomial.pole)) + ")";
  if (polynomial.degrees.size() > 2)
    text += ", " + std::to_string(polynomial.degrees.size() - 1) + " in specular";
  text += ", proven within " + two_digits(function.bound) + " (sampled " + two_digits(function.sampled) + ")";
  if (function.rises_with_alpha) text += ", rising with alpha";
  if (function.rises_with_specular) text += ", rising with specular";
  return text;
}

}  // namespace

std::string two_digits(double error) { return number_text(rounded_up(error, 2)); }

std::string mapping_text(const Lowered& lowered) {
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
  return text;
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
  for (Scaling& input : result.inputs) input = {0.0, 1.0, input.pole};
  for (Scaling& output : result.outputs) output = {};
  return result;
}

}  // namespace remap
