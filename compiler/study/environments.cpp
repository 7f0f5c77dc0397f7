#include "study/environments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "look/brdf.hpp"
#include "look/image.hpp"
#include "lower/interpreter.hpp"
#include "measure/sweep.hpp"
#include "remap/version.hpp"
#include "renderer/renderer.hpp"
#include "report/contact_sheet.hpp"
#include "study/golden_section.hpp"
#include "table/csv.hpp"

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
  const auto fit = std::ranges::find_if(fits, [&](const Fit& candidate) {
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

std::string method_name(Method method) {
  constexpr std::array<const char*, 6> kNames = {"copy",      "paper",   "natural-1",
                                                 "natural-2", "shipped", "best"};
  return kNames[static_cast<std::size_t>(method)];
}

// Returns every pair and alpha converted by every method that applies to the pair, sorted by alpha, pair and
// method. kShipped applies to pairs with a fit in `options.fits`.
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

// This is the height of the pictures in the search, and also the number of calls of `progress` for each
// alpha.
constexpr int kLeastErrorResolution = 48;

// Returns, for each of `starts`, the target parameters with the smallest mean RMSE over the environments. All
// starts have the same source alpha. Searches the best specular at each of eleven alphas around the start,
// and interpolates by a parabola through the best three. If the best alpha is within a factor of 1.5 of the
// start, the RMSE is accurate to about 1 %.
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

constexpr std::size_t kMethodCount = 5;  // methods without kBest

double mean_radiance(const std::vector<float>& radiance) {
  double sum = 0.0;
  for (std::size_t i = 0; i < radiance.size(); i += 3) sum += luminance(&radiance[i]);
  return sum / (static_cast<double>(radiance.size()) / 3.0);
}

// A LitPicture is a picture of one material under one environment.
struct LitPicture {
  DisplayedSphere display;
  double mean = 0.0;                           // mean linear luminance
  std::array<std::vector<float>, 2> halves{};  // display colors from each half of the directions of light
};

LitPicture picture_of(const SpherePictures& pictures, std::size_t material, std::size_t environment) {
  const std::vector<float> radiance = pictures.radiance(material, environment);
  LitPicture picture{
      displayed_sphere(radiance, pictures.pixels(), pictures.resolution()), mean_radiance(radiance), {}};
  for (std::size_t half = 0; half < picture.halves.size(); ++half)
    picture.halves[half] = display_values(pictures.half_radiance(material, environment, half));
  return picture;
}

// Returns the mean square of the sampling error of the difference of two pictures. Each half of the
// directions of light gives one such difference. The error of their mean is half of the difference between
// both.
double squared_noise(const LitPicture& source, const LitPicture& target) {
  double sum = 0.0;
  for (std::size_t i = 0; i < source.halves[0].size(); ++i) {
    const double first = static_cast<double>(source.halves[0][i]) - static_cast<double>(target.halves[0][i]);
    const double second = static_cast<double>(source.halves[1][i]) - static_cast<double>(target.halves[1][i]);
    sum += 0.25 * (first - second) * (first - second);
  }
  return sum / static_cast<double>(source.halves[0].size());
}

// Renders all materials of one alpha together and compares them.
std::vector<EnvironmentComparison> compare_alpha(const EnvironmentsOptions& options,
                                                 const RadiancePyramid& pyramid,
                                                 std::span<const Conversion> conversions,
                                                 std::vector<Image>* sheets) {
  std::vector<SphereMaterial> materials;  // holds each material once
  const auto place_of = [&](const SphereMaterial& material) {
    const auto found = std::ranges::find(materials, material);
    const auto place = static_cast<std::size_t>(found - materials.begin());
    if (found == materials.end()) materials.push_back(material);
    return place;
  };
  std::vector<std::pair<std::size_t, std::size_t>> places;  // indices of source and target of each conversion
  for (const Conversion& c : conversions) {
    const StudyPair& pair = options.pairs[c.pair];
    const std::size_t source =
        place_of({builtin_brdf(pair.source), c.alpha, options.specular, options.diffuse});
    places.emplace_back(
        source, place_of({builtin_brdf(pair.target), c.target_alpha, c.target_specular, options.diffuse}));
  }
  const SpherePictures pictures = render_spheres(pyramid, materials, options);
  const std::size_t environment_count = options.environments.size();
  std::vector<EnvironmentComparison> comparisons(places.size() * environment_count);
  const bool on_sheet = sheets != nullptr && options.sheet_alpha == conversions.front().alpha;
  if (on_sheet)
    sheets->assign(environment_count,
                   contact_sheet(options.pairs.size(), 1 + kMethodCount + (options.least_error ? 1 : 0),
                                 options.resolution));
  run_parallel(environment_count, options.jobs, [&](std::size_t e) {
    std::vector<LitPicture> shots;
    for (std::size_t m = 0; m < materials.size(); ++m) shots.push_back(picture_of(pictures, m, e));
    for (std::size_t i = 0; i < places.size(); ++i) {
      const LitPicture &source = shots[places[i].first], &target = shots[places[i].second];
      comparisons[i * environment_count + e] = {
          conversions[i],
          e,
          100.0 * rms_difference(source.display.colors, target.display.colors),
          sphere_similarity(source.display, target.display, pictures.pixels(), pictures.resolution()),
          target.mean / source.mean - 1.0,
          squared_noise(source, target)};
      if (!on_sheet) continue;
      const auto place = [&](std::size_t column, const LitPicture& picture) {
        place_picture(&(*sheets)[e], pictures.resolution(), conversions[i].pair, column, pictures.pixels(),
                      picture.display.colors);
      };
      place(0, source);
      place(1 + static_cast<std::size_t>(conversions[i].method), target);
    }
  });
  return comparisons;
}

// Adds the best conversions. The search starts from the matches by `natural-2`.
void add_best(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
              std::vector<Conversion>* conversions) {
  std::vector<Conversion> starts;
  for (const Conversion& conversion : *conversions)
    if (conversion.method == Method::kNatural2) starts.push_back(conversion);
  const std::vector<Conversion> best = best_conversions(options, pyramid, starts);
  conversions->insert(conversions->end(), best.begin(), best.end());
}

SheetLabels sheet_labels(const EnvironmentsOptions& options) {
  SheetLabels labels{{"source"}, {}};
  for (std::size_t method = 0; method < kMethodCount + (options.least_error ? 1 : 0); ++method)
    labels.columns.push_back(method_name(static_cast<Method>(method)));
  for (const StudyPair& pair : options.pairs) labels.rows.push_back(pair.source + "\n-> " + pair.target);
  return labels;
}

void require_options(const EnvironmentsOptions& options) {
  if (options.pairs.empty() || options.alphas.empty() || options.environments.empty())
    throw usage_error("environments: at least one pair, one alpha and one environment are required");
  require_names_differ(options.environments);
  const auto renderer = make_builtin_renderer();
  for (const StudyPair& pair : options.pairs)
    for (const std::string& name : {pair.source, pair.target}) {
      const ModelDescription model = renderer->model(name);
      for (const double alpha : options.alphas)
        if (!model.alpha.contains(alpha))
          throw usage_error("alpha: " + number_text(alpha) + " is out of range for " + name + " (" +
                            number_text(model.alpha.min) + " to " + number_text(model.alpha.max) + ")");
    }
  if (!(options.specular > 0.0 && options.specular <= 1.0))
    throw usage_error("specular: " + number_text(options.specular) + " is out of range (above 0, at most 1)");
  if (!(options.diffuse >= 0.0 && options.diffuse <= 1.0))
    throw usage_error("diffuse: " + number_text(options.diffuse) + " is out of range (0 to 1)");
}

}  // namespace

std::vector<StudyPair> default_pairs() {
  return {{"mitsuba/ward", "mitsuba/ggx"},     {"mitsuba/beckmann", "mitsuba/ggx"},
          {"mitsuba/ggx", "mitsuba/beckmann"}, {"mitsuba/ward", "mitsuba/as"},
          {"mitsuba/as", "mitsuba/ggx"},       {"mitsuba/ward-balanced", "mitsuba/beckmann"}};
}

std::vector<double> default_alphas() { return {0.08, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.75}; }

std::size_t progress_steps(const EnvironmentsOptions& options) {
  return options.pairs.size() * kMethodCount +
         options.alphas.size() * static_cast<std::size_t>(std::max(0, options.resolution) +
                                                          (options.least_error ? kLeastErrorResolution : 0));
}

std::vector<EnvironmentComparison> study_environments(const EnvironmentsOptions& options,
                                                      std::vector<Image>* sheets) {
  require_options(options);
  std::vector<EnvironmentComparison> all;
  const std::vector<Conversion> conversions = conversions_of(options);
  const RadiancePyramid pyramid(options.environments);
  for (auto begin = conversions.begin(); begin != conversions.end();) {
    const auto end =
        std::find_if(begin, conversions.end(), [&](const Conversion& c) { return c.alpha != begin->alpha; });
    std::vector<Conversion> at_alpha(begin, end);
    if (options.least_error) add_best(options, pyramid, &at_alpha);
    const std::vector<EnvironmentComparison> compared = compare_alpha(options, pyramid, at_alpha, sheets);
    all.insert(all.end(), compared.begin(), compared.end());
    begin = end;
  }
  if (sheets != nullptr)
    for (Image& sheet : *sheets) sheet = labelled(sheet, sheet_labels(options));
  return all;
}

std::string environments_csv(const EnvironmentsOptions& options,
                             const std::vector<EnvironmentComparison>& comparisons) {
  double sum = 0.0;
  for (const EnvironmentComparison& comparison : comparisons) sum += comparison.squared_noise;
  const double noise = 100.0 * std::sqrt(sum / static_cast<double>(comparisons.size()));
  // All environments have the same mean luminance, apart from the rounding of floats.
  const double luminance = std::round(1e6 * mean_luminance(options.environments.front())) / 1e6;
  CsvText csv(
      "source,target,alpha,specular,environment,method,target_alpha,target_specular,rmse_percent,ssim,"
      "energy_error",
      {{"tool", std::string("remap-study ") + kVersion},
       {"resolution", std::to_string(options.resolution)},
       {"samples", std::to_string(options.samples)},
       {"diffuse", number_text(options.diffuse)},
       {"mean_luminance", number_text(luminance)},
       {"noise_percent", number_text(rounded_up(noise, 2))}});
  for (const EnvironmentComparison& comparison : comparisons) {
    const Conversion& c = comparison.conversion;
    csv.add_row(options.pairs[c.pair].source, options.pairs[c.pair].target, c.alpha, options.specular,
                options.environments[comparison.environment].name, method_name(c.method), c.target_alpha,
                c.target_specular, comparison.rmse, comparison.ssim, comparison.energy);
  }
  return csv.text();
}

}  // namespace remap
