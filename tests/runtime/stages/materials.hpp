// This file makes materials for tests of workflow conversions, and an oracle for the projection that shares
// no code with it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "reference/workflow_conversion.hpp"
#include "support/srgb.hpp"

namespace workflow_test {

using Rgb = std::array<double, 3>;

inline const remap::WorkflowFormula kClean = remap::Projection{remap::kCleanPrior};

// Returns the value as a map of 8 bits in sRGB stores it.
inline double in_8_bits(double linear) {
  return remap::srgb_to_linear(std::round(255.0 * remap::linear_to_srgb(linear)) / 255.0);
}

inline remap::WorkflowConversion plain(remap::WorkflowFormula formula, double f0 = 0.04) {
  remap::WorkflowConversion conversion;
  conversion.metallic.dielectric_f0 = f0;
  conversion.formula = formula;
  return conversion;
}

inline remap::WorkflowConversion gltf(remap::WorkflowFormula formula) {
  remap::WorkflowConversion conversion;
  conversion.specular = {"gltf-specgloss", remap::DiffuseConvention::kScaled,
                         remap::RoughnessEncoding::kGlossiness};
  conversion.metallic = {"gltf", 0.04, remap::DiffuseConvention::kScaled,
                         remap::RoughnessEncoding::kRoughness};
  conversion.formula = formula;
  return conversion;
}

// Returns a network with two hidden layers.
inline remap::Network random_network() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> weight(-0.7, 0.7);
  remap::Network network{remap::Activation::kTanh,
                         std::vector<remap::Scaling>(6, {0.5, 2.0, 0.0}),
                         std::vector<remap::Scaling>(4, {0.4, 1.5, 0.0}),
                         {}};
  const std::size_t sizes[] = {6, 13, 9, 4};
  for (std::size_t l = 0; l < 3; ++l) {
    remap::Layer layer{sizes[l], {}, {}};
    for (std::size_t i = 0; i < sizes[l] * sizes[l + 1]; ++i) layer.weights.push_back(weight(random));
    for (std::size_t i = 0; i < sizes[l + 1]; ++i) layer.biases.push_back(weight(random));
    network.layers.push_back(layer);
  }
  return network;
}

inline remap::MetallicMaterial random_metallic(std::mt19937& random) {
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  return {{share(random), share(random), share(random)}, share(random), share(random)};
}

inline remap::SpecularMaterial random_specular(std::mt19937& random) {
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  return {{share(random), share(random), share(random)},
          {share(random), share(random), share(random)},
          share(random)};
}

// Works like the function above, but diffuse and specular together reflect at most the light that arrives.
inline remap::SpecularMaterial random_reflecting(std::mt19937& random, bool is_plain) {
  remap::SpecularMaterial material = random_specular(random);
  const auto& s = material.specular;
  if (is_plain)
    for (float& diffuse : material.diffuse) diffuse *= 1.0f - std::max({s[0], s[1], s[2]});
  return material;
}

// An Oracle computes the weighted squared error of metallic and base color for a specular material by the
// definition of the method. It sums the squares of both differences and their product, in double precision.
struct Oracle {
  Rgb diffuse, f0, weight;
  double mixed, specular, dielectric_f0, diffuse_of_albedo;

  Oracle(const remap::SpecularMaterial& material, double alpha, double f, bool scaled)
      : dielectric_f0(f), diffuse_of_albedo(scaled ? 1.0 - f : 1.0) {
    const auto& s = material.specular;
    const double left = scaled ? 1.0 - std::max({s[0], s[1], s[2]}) : 1.0;
    for (std::size_t c = 0; c < 3; ++c) {
      diffuse[c] = left * material.diffuse[c];
      f0[c] = s[c];
      weight[c] = 1.0 / (diffuse[c] + f0[c] + 0.02);
    }
    const double seen = (0.03 + alpha) / (0.1 + alpha);
    specular = seen * seen * 0.514 / (1.0 - 0.986 * alpha + 2.82 * alpha * alpha);
    mixed = std::min((0.058 + alpha) / (0.074 + alpha), 0.985) * std::sqrt(specular);
  }

  double error(double metallic, const Rgb& base_color) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = diffuse_of_albedo * (1.0 - metallic) * base_color[c] - diffuse[c];
      const double s = dielectric_f0 * (1.0 - metallic) + base_color[c] * metallic - f0[c];
      sum += weight[c] * (d * d + 2.0 * mixed * d * s + specular * s * s);
    }
    return sum;
  }

  // Returns the error of the best base color for one metallic. Each channel is found by golden sections over
  // [0, 1], because the error is convex in it.
  double best_error(double metallic) const {
    Rgb color{};
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto of = [&](double albedo) {
        const double d = diffuse_of_albedo * (1.0 - metallic) * albedo - diffuse[c];
        const double s = dielectric_f0 * (1.0 - metallic) + albedo * metallic - f0[c];
        return weight[c] * (d * d + 2.0 * mixed * d * s + specular * s * s);
      };
      double low = 0.0, high = 1.0;
      for (int i = 0; i < 40; ++i) {
        const double a = high - 0.618 * (high - low), b = low + 0.618 * (high - low);
        if (of(a) < of(b))
          high = b;
        else
          low = a;
      }
      color[c] = 0.5 * (low + high);
      sum += of(color[c]);
    }
    return sum;
  }

  // Returns the least error over a dense grid of metallic.
  double least_error(int steps) const {
    double least = best_error(0.0);
    for (int i = 1; i <= steps; ++i) least = std::min(least, best_error(static_cast<double>(i) / steps));
    return least;
  }
};

}  // namespace workflow_test
