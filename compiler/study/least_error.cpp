#include "study/least_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/image_similarity.hpp"
#include "renderer/renderer.hpp"
#include "report/lit_sphere.hpp"
#include "study/golden_section.hpp"
#include "system/parallel.hpp"

namespace remapc {
namespace {

constexpr int kWidths = 11;
constexpr double kWidthRatio = 1.085;  // between neighboring alphas
constexpr int kLeastErrorSamples = 256;
constexpr double kWidestAlpha = 1.0;  // limit of the built-in models

// Pictures of the target at one alpha, as functions of specular: dark + specular * (bright - dark).
struct Width {
  double alpha = 0.0;
  std::vector<std::vector<float>> dark, bright;  // for each environment
};

struct Search {
  std::vector<std::vector<float>> source;  // display values, for each environment
  std::array<Width, kWidths> widths;
};

double mean_rmse(const Search& search, const Width& width, double specular) {
  double sum = 0.0;
  std::vector<float> shown;
  for (std::size_t e = 0; e < search.source.size(); ++e) {
    shown.clear();
    for (std::size_t i = 0; i < width.dark[e].size(); ++i) {
      const double dark = static_cast<double>(width.dark[e][i]);
      shown.push_back(display_value(dark + specular * (static_cast<double>(width.bright[e][i]) - dark)));
    }
    sum += rms_difference(search.source[e], shown);
  }
  return sum / static_cast<double>(search.source.size());
}

struct Optimum {
  double specular = 0.0, rmse = 0.0;
};

// The error has one minimum over specular, because brightness increases with specular.
Optimum best_specular(const Search& search, const Width& width) {
  constexpr int kSteps = 16;  // to 5e-4
  const auto [specular, rmse] =
      golden_section(0.0, 1.0, kSteps, [&](double value) { return mean_rmse(search, width, value); });
  return {specular, rmse};
}

// The position of the minimum of the parabola through three values at -1, 0 and 1, clamped to [-1, 1].
double vertex(double before, double middle, double after) {
  const double bend = before - 2.0 * middle + after;
  return bend > 0.0 ? std::clamp(0.5 * (before - after) / bend, -1.0, 1.0) : 0.0;
}

Conversion best_of(const Search& search, const Conversion& start) {
  std::array<Optimum, kWidths> optima;
  for (std::size_t i = 0; i < optima.size(); ++i) optima[i] = best_specular(search, search.widths[i]);
  const auto least = std::min_element(optima.begin(), optima.end(),
                                      [](const Optimum& a, const Optimum& b) { return a.rmse < b.rmse; });
  const auto i = static_cast<std::size_t>(least - optima.begin());
  Conversion best{start.pair, Method::kBest, start.alpha, search.widths[i].alpha, least->specular};
  if (i == 0 || i + 1 == optima.size()) return best;
  const double offset = vertex(optima[i - 1].rmse, optima[i].rmse, optima[i + 1].rmse);
  best.target_alpha = std::min(kWidestAlpha, best.target_alpha * std::pow(kWidthRatio, offset));
  const Optimum& towards = offset < 0.0 ? optima[i - 1] : optima[i + 1];
  best.target_specular += std::fabs(offset) * (towards.specular - best.target_specular);
  return best;
}

// Appends the materials of one search: the source, then specular 0 and 1 at each alpha.
void add_materials(const EnvironmentsOptions& options, const Conversion& start,
                   std::vector<SphereMaterial>* materials) {
  const ModelPair& pair = options.pairs[start.pair];
  materials->push_back({builtin_brdf(pair.source), start.alpha, options.specular});
  for (int i = 0; i < kWidths; ++i) {
    const double ratio = std::pow(kWidthRatio, i - kWidths / 2);
    for (const double specular : {0.0, 1.0})
      materials->push_back(
          {builtin_brdf(pair.target), std::min(kWidestAlpha, start.target_alpha * ratio), specular});
  }
}

Search search_of(const SpherePictures& pictures, std::span<const SphereMaterial> materials, std::size_t first,
                 std::size_t environment_count) {
  Search search;
  for (std::size_t e = 0; e < environment_count; ++e) {
    std::vector<float> source = pictures.radiance(first, e);
    for (float& value : source) value = display_value(static_cast<double>(value));
    search.source.push_back(std::move(source));
    for (std::size_t i = 0; i < search.widths.size(); ++i) {
      search.widths[i].alpha = materials[first + 1 + 2 * i].alpha;
      search.widths[i].dark.push_back(pictures.radiance(first + 1 + 2 * i, e));
      search.widths[i].bright.push_back(pictures.radiance(first + 2 + 2 * i, e));
    }
  }
  return search;
}

}  // namespace

std::vector<Conversion> best_conversions(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
                                         std::span<const Conversion> starts) {
  std::vector<SphereMaterial> materials;
  for (const Conversion& start : starts) add_materials(options, start, &materials);
  SphereSampling sampling{kLeastErrorResolution, kLeastErrorSamples, options.jobs, options.progress,
                          options.cancelled};
  const SpherePictures pictures = render_spheres(pyramid, materials, sampling);
  std::vector<Conversion> best(starts.size());
  remap::run_parallel(starts.size(), options.jobs, [&](std::size_t i) {
    const Search search = search_of(pictures, materials, i * (1 + 2 * kWidths), options.environments.size());
    best[i] = best_of(search, starts[i]);
  });
  return best;
}

}  // namespace remapc
