#include "study/conversions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "look/brdf_models.hpp"
#include "look/image_similarity.hpp"
#include "lower/interpreter.hpp"
#include "measure/sweep.hpp"
#include "study/golden_section.hpp"

namespace remap {
namespace {

// Parameters holds the target's parameters at each alpha of the options.
using Parameters = std::vector<MappedTexel>;

Parameters copied(const EnvironmentsOptions& options) {
  Parameters parameters;
  for (const double alpha : options.alphas) parameters.push_back({alpha, options.specular});
  return parameters;
}

Parameters matched(const EnvironmentsOptions& options, const Renderer& renderer, const StudyPair& pair,
                   const std::string& objective) {
  SweepOptions sweep;
  sweep.source = pair.source;
  sweep.target = pair.target;
  sweep.objective = objective_preset(objective);
  sweep.resolution = options.match_resolution;
  sweep.samples = copied(options);
  SweepExecution execution;
  execution.jobs = options.jobs;
  execution.cancelled = options.cancelled;
  Parameters parameters;
  for (const TableRow& row : run_sweep(renderer, sweep, execution).rows)
    parameters.push_back({row.alpha2, row.specular2});
  return parameters;
}

Parameters shipped(const EnvironmentsOptions& options, const Fit& fit) {
  Parameters parameters;
  for (const double alpha : options.alphas) {
    double specular = 0.0;
    const double roughness = evaluate_texel(fit, from_alpha(fit.source.roughness, alpha),
                                            std::span(&options.specular, 1), std::span(&specular, 1));
    parameters.push_back({to_alpha(fit.target.roughness, roughness), specular});
  }
  return parameters;
}

const Fit* find_pair(const std::vector<Fit>& fits, const StudyPair& pair) {
  const auto fit = std::find_if(fits.begin(), fits.end(), [&](const Fit& candidate) {
    return candidate.source.model == pair.source && candidate.target.model == pair.target;
  });
  return fit == fits.end() ? nullptr : &*fit;
}

constexpr int kWidths = 11;
constexpr double kWidthRatio = 1.085;  // ratio of neighboring alphas
constexpr int kLeastErrorSamples = 256;
constexpr double kWidestAlpha = 1.0;  // limit of the built-in models

// Pictures holds pictures of one material under each environment.
using Pictures = std::vector<std::vector<float>>;

// Returns the mean RMSE between `source` (display values) and a target with the pictures dark + specular *
// (bright - dark).
double mean_rmse(const Pictures& source, const Pictures& dark, const Pictures& bright, double specular) {
  double sum = 0.0;
  std::vector<float> shown;
  for (std::size_t e = 0; e < source.size(); ++e) {
    shown.clear();
    for (std::size_t i = 0; i < dark[e].size(); ++i) {
      const double base = static_cast<double>(dark[e][i]);
      shown.push_back(display_value(base + specular * (static_cast<double>(bright[e][i]) - base)));
    }
    sum += rms_difference(source[e], shown);
  }
  return sum / static_cast<double>(source.size());
}

// Returns where the parabola through values at -1, 0 and 1 has its minimum, clamped to [-1, 1].
double vertex(double before, double middle, double after) {
  const double bend = before - 2.0 * middle + after;
  return bend > 0.0 ? std::clamp(0.5 * (before - after) / bend, -1.0, 1.0) : 0.0;
}

// Compares the source, which is material `first`, with the target's materials, which follow it in several
// widths.
Conversion best_of(const SpherePictures& pictures, std::span<const SphereMaterial> materials,
                   std::size_t first, std::size_t environment_count, const Conversion& start) {
  const auto pictures_of = [&](std::size_t material) {
    Pictures all;
    for (std::size_t e = 0; e < environment_count; ++e) all.push_back(pictures.radiance(material, e));
    return all;
  };
  Pictures source = pictures_of(first);
  for (std::vector<float>& picture : source) picture = display_values(picture);
  std::array<std::pair<double, double>, kWidths> optima;  // the best specular of each width, and its RMSE
  for (std::size_t i = 0; i < optima.size(); ++i) {
    const Pictures dark = pictures_of(first + 1 + 2 * i), bright = pictures_of(first + 2 + 2 * i);
    // The error has only one minimum over specular, because brightness rises with specular.
    constexpr int kSteps = 16;  // reach a precision of 5e-4
    optima[i] = golden_section(0.0, 1.0, kSteps,
                               [&](double specular) { return mean_rmse(source, dark, bright, specular); });
  }
  const auto least = std::ranges::min_element(optima, {}, &std::pair<double, double>::second);
  const auto i = static_cast<std::size_t>(least - optima.begin());
  Conversion best{start.pair, Method::kBest, start.alpha, materials[first + 1 + 2 * i].alpha, least->first};
  if (i == 0 || i + 1 == optima.size()) return best;
  const double offset = vertex(optima[i - 1].second, optima[i].second, optima[i + 1].second);
  best.target_alpha = std::min(kWidestAlpha, best.target_alpha * std::pow(kWidthRatio, offset));
  const double towards = optima[offset < 0.0 ? i - 1 : i + 1].first;
  best.target_specular += std::fabs(offset) * (towards - best.target_specular);
  return best;
}

// Adds the materials of one search: the source, then specular 0 and 1 at each alpha.
void add_materials(const EnvironmentsOptions& options, const Conversion& start,
                   std::vector<SphereMaterial>* materials) {
  const StudyPair& pair = options.pairs[start.pair];
  materials->push_back({builtin_brdf(pair.source), start.alpha, options.specular, options.diffuse});
  for (int i = 0; i < kWidths; ++i) {
    const double ratio = std::pow(kWidthRatio, i - kWidths / 2);
    for (const double specular : {0.0, 1.0})
      materials->push_back({builtin_brdf(pair.target), std::min(kWidestAlpha, start.target_alpha * ratio),
                            specular, options.diffuse});
  }
}

}  // namespace

std::string method_name(Method method) {
  constexpr std::array<const char*, 6> kNames = {"copy",      "paper",   "natural-1",
                                                 "natural-2", "shipped", "best"};
  return kNames[static_cast<std::size_t>(method)];
}

std::vector<Conversion> conversions_of(const EnvironmentsOptions& options) {
  const auto renderer = make_builtin_renderer();
  std::vector<Conversion> conversions;
  const auto add = [&](std::size_t pair, Method method, const Parameters& parameters) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
      conversions.push_back({pair, method, options.alphas[i], parameters[i].alpha, parameters[i].specular});
    if (options.progress) options.progress();
  };
  for (std::size_t p = 0; p < options.pairs.size(); ++p) {
    const StudyPair& pair = options.pairs[p];
    add(p, Method::kCopy, copied(options));
    add(p, Method::kPaper, matched(options, *renderer, pair, "paper"));
    add(p, Method::kNatural1, matched(options, *renderer, pair, "natural-1"));
    add(p, Method::kNatural2, matched(options, *renderer, pair, "natural-2"));
    const Fit* fit = find_pair(options.fits, pair);
    add(p, Method::kShipped, fit == nullptr ? Parameters{} : shipped(options, *fit));
  }
  std::ranges::stable_sort(conversions, {}, &Conversion::alpha);
  return conversions;
}

std::vector<Conversion> best_conversions(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
                                         std::span<const Conversion> starts) {
  std::vector<SphereMaterial> materials;
  for (const Conversion& start : starts) add_materials(options, start, &materials);
  SphereSampling sampling{kLeastErrorResolution, kLeastErrorSamples, options.jobs, options.progress,
                          options.cancelled};
  const SpherePictures pictures = render_spheres(pyramid, materials, sampling);
  std::vector<Conversion> best(starts.size());
  run_parallel(starts.size(), options.jobs, [&](std::size_t i) {
    best[i] = best_of(pictures, materials, i * (1 + 2 * kWidths), options.environments.size(), starts[i]);
  });
  return best;
}

}  // namespace remap
