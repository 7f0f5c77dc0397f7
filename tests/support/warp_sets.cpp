#include "support/warp_sets.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>

namespace remap {
namespace {

using Color = std::array<double, 3>;
using Region = std::function<bool(const std::array<double, 3>&)>;

double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

double smooth_step(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Color mix(const Color& a, const Color& b, double share) {
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = a[c] + (b[c] - a[c]) * share;
  return color;
}

WarpTexel texel_of(const Color& diffuse, const Color& specular, double alpha) {
  WarpTexel texel{};
  for (std::size_t c = 0; c < 3; ++c) {
    texel[c] = static_cast<float>(diffuse[c]);
    texel[3 + c] = static_cast<float>(specular[c]);
  }
  texel[6] = static_cast<float>(alpha);
  return texel;
}

using Law = WarpTexel (*)(const std::array<double, 3>&);

WarpTexel leaf_source(const std::array<double, 3>& l) {
  const double v = l[1], u = 0.5 + (l[0] - 0.5) * (1.0 - 0.45 * v);
  const Color body = mix({0.22, 0.10, 0.035}, {0.07, 0.025, 0.012}, std::pow(u, 0.6));
  return texel_of(mix(body, {0.36, 0.27, 0.16}, std::pow(v, 1.5)),
                  mix({0.03, 0.03, 0.03}, {0.05, 0.05, 0.05}, u), 0.62 - 0.22 * std::pow(u, 1.5) - 0.15 * v);
}

WarpTexel leaf_template(const std::array<double, 3>& l) {
  const double v = l[1], u = 0.5 + (l[0] - 0.5) * (1.0 - 0.6 * v);
  const Color body = mix({0.02, 0.09, 0.015}, {0.16, 0.26, 0.03}, std::pow(u, 1.2));
  return texel_of(mix(body, {0.34, 0.40, 0.20}, v), mix({0.06, 0.06, 0.06}, {0.035, 0.035, 0.035}, u),
                  0.16 + 0.22 * u + 0.2 * v * (1.0 - 0.3 * u));
}

Color scaled(const Color& color, double factor) { return mix({0.0, 0.0, 0.0}, color, factor); }

WarpTexel rust_source(const std::array<double, 3>& l) {
  const Color diffuse = mix({0.015, 0.015, 0.015}, {0.33, 0.12, 0.035}, std::pow(l[0], 1.4));
  const Color specular = mix({0.50, 0.49, 0.47}, {0.04, 0.04, 0.04}, std::pow(l[0], 0.6));
  return texel_of(scaled(diffuse, 0.55 + 0.8 * std::pow(l[1], 0.7)),
                  scaled(specular, 0.8 + 0.2 * l[2] * (1.0 - l[0])),
                  0.22 + 0.4 * std::pow(l[0], 1.2) + 0.25 * std::pow(l[2], 1.3) * (1.0 - 0.4 * l[0]));
}

WarpTexel rust_template(const std::array<double, 3>& l) {
  const Color diffuse = mix({0.02, 0.012, 0.01}, {0.10, 0.30, 0.24}, l[0]);
  const Color specular = mix({0.75, 0.42, 0.28}, {0.04, 0.04, 0.04}, std::pow(l[0], 0.8));
  return texel_of(scaled(diffuse, 0.65 + 0.7 * l[1]), scaled(specular, 0.75 + 0.25 * l[2] * (1.0 - l[0])),
                  0.15 + 0.35 * l[0] + 0.22 * l[2] * (1.0 - 0.5 * l[0]) + 0.05 * l[1]);
}

// Evaluates the material at `latents` and adds texel noise of 1 %.
std::vector<WarpTexel> material_of(Law law, const Latents& latents, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<WarpTexel> texels;
  for (const auto& latent : latents) {
    WarpTexel texel = law(latent);
    for (float& value : texel) {
      const double noise = uniform(random) + uniform(random) + uniform(random) + uniform(random) - 2.0;
      value = static_cast<float>(std::clamp(static_cast<double>(value) * (1.0 + 0.0173 * noise), 0.002, 1.0));
    }
    texels.push_back(texel);
  }
  return texels;
}

WarpSet set_of(const std::string& name, std::size_t size, Law source, Law target, Latents from, Latents to) {
  WarpSet set;
  set.name = name;
  set.size = size;
  set.source = {name + " source", {}, material_of(source, from, 5)};
  set.target = {name + " template", {}, material_of(target, to, 6)};
  for (const auto& latent : from) set.truth.push_back(target(latent));
  set.source_latents = std::move(from);
  set.target_latents = std::move(to);
  return set;
}

// Returns smooth noise, uniformly distributed in 0 to 1.
std::vector<double> ranked_noise(std::size_t size, double roughness, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<double> values(size * size, 0.0);
  for (std::size_t cells = 2; cells <= size / 2; cells *= 2) {
    std::vector<double> knots((cells + 1) * (cells + 1));
    for (double& knot : knots) knot = uniform(random) - 0.5;
    const double amplitude = std::pow(static_cast<double>(cells), 1.0 - roughness);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double x = static_cast<double>(i % size * cells) / static_cast<double>(size);
      const double y = static_cast<double>(i / size * cells) / static_cast<double>(size);
      const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
      const double s = smooth_step(x - static_cast<double>(column), 0.0, 1.0);
      const double t = smooth_step(y - static_cast<double>(row), 0.0, 1.0);
      const double* knot = knots.data() + row * (cells + 1) + column;
      const double above = knot[0] + s * (knot[1] - knot[0]);
      const double below = knot[cells + 1] + s * (knot[cells + 2] - knot[cells + 1]);
      values[i] += amplitude * (above + t * (below - above));
    }
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    values[order[rank]] = static_cast<double>(rank) / static_cast<double>(order.size() - 1);
  return values;
}

Latents leaf_latents(std::size_t size, std::uint32_t seed, double power) {
  const auto age = ranked_noise(size, 1.4, seed), vein = ranked_noise(size, 2.0, seed + 1);
  Latents latents(age.size());
  for (std::size_t i = 0; i < age.size(); ++i) {
    const double distance = std::abs(vein[i] - 0.5);  // stems follow an isoline of smooth noise
    latents[i] = {std::pow(age[i], power), 1.0 - smooth_step(distance, 0.02, 0.09), 0.0};
  }
  return latents;
}

Latents rust_latents(std::size_t size, std::uint32_t seed, double power) {
  const auto a = ranked_noise(size, 1.5, seed), b = ranked_noise(size, 1.1, seed + 1),
             c = ranked_noise(size, 1.6, seed + 2);
  Latents latents(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    latents[i] = {std::pow(smooth_step(a[i], 0.35, 0.75), power), std::pow(b[i], 1.0 / power), c[i]};
  return latents;
}

std::vector<Region> regions_of(const WarpSet& set) {
  using L = const std::array<double, 3>&;
  if (set.name == "leaf")
    return {[](L l) { return l[1] < 0.1; }, [](L l) { return l[1] > 0.8; },
            [](L l) { return l[1] < 0.2 && l[0] < 0.2; }, [](L l) { return l[1] < 0.2 && l[0] > 0.8; }};
  return {[](L l) { return l[0] < 0.05; },
          [](L l) { return l[0] > 0.95; },
          [](L l) { return l[1] < 0.2 && l[0] < 0.5; },
          [](L l) { return l[1] > 0.8 && l[0] > 0.5; },
          [](L l) { return l[2] > 0.8 && l[0] < 0.3; },
          [](L l) { return l[2] < 0.2 && l[0] < 0.3; }};
}

std::vector<std::uint32_t> scribbles(const Latents& latents, std::size_t size, const Region& region,
                                     std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < latents.size(); ++i)
    if (region(latents[i])) inside.push_back(i);
  std::vector<char> marked(latents.size(), 0);
  const auto edge = static_cast<double>(size);
  for (int line = 0; line < 12; ++line) {
    const std::uint32_t start = inside[random() % inside.size()];
    const double angle = uniform(random) * std::numbers::pi;
    for (double t = -0.1; t <= 0.1; t += 0.5 / edge)
      for (int side = -1; side <= 1; ++side) {
        const double x =
            static_cast<double>(start % size) + t * edge * std::cos(angle) - side * std::sin(angle);
        const double y =
            static_cast<double>(start / size) + t * edge * std::sin(angle) + side * std::cos(angle);
        if (x < 0.0 || y < 0.0 || x >= edge || y >= edge) continue;
        const std::size_t texel = static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x);
        if (region(latents[texel])) marked[texel] = 1;
      }
    if (line >= 2 && std::count(marked.begin(), marked.end(), 1) > 80) break;
  }
  std::vector<std::uint32_t> texels;
  for (std::uint32_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0) texels.push_back(i);
  return texels;
}

}  // namespace

WarpSet leaf_set(std::size_t size) {
  return set_of("leaf", size, leaf_source, leaf_template, leaf_latents(size, 11, 1.5),
                leaf_latents(size, 77, 0.7));
}

WarpSet rust_set(std::size_t size) {
  return set_of("rust", size, rust_source, rust_template, rust_latents(size, 11, 0.7),
                rust_latents(size, 77, 1.5));
}

std::vector<StrokePair> strokes_of(const WarpSet& set, std::uint32_t seed) {
  std::vector<StrokePair> strokes;
  for (const Region& region : regions_of(set)) {
    const auto index = static_cast<std::uint32_t>(strokes.size()) + 10 * seed;
    strokes.push_back({scribbles(set.source_latents, set.size, region, 100 + index),
                       scribbles(set.target_latents, set.size, region, 200 + index)});
  }
  return strokes;
}

}  // namespace remap
