#include "study/environments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "look/brdf_models.hpp"
#include "look/image_similarity.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "renderer/renderer.hpp"
#include "report/contact_sheet.hpp"
#include "report/sheet_labels.hpp"
#include "table/csv.hpp"

namespace remap {
namespace {

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
    throw Error(ErrorKind::kUsage,
                "environments: at least one pair, one alpha and one environment are required");
  require_names_differ(options.environments);
  const auto renderer = make_builtin_renderer();
  for (const StudyPair& pair : options.pairs)
    for (const std::string& name : {pair.source, pair.target}) {
      const ModelDescription model = renderer->model(name);
      for (const double alpha : options.alphas)
        if (!model.alpha.contains(alpha))
          throw Error(ErrorKind::kUsage, "alpha: " + number_text(alpha) + " is out of range for " + name +
                                             " (" + number_text(model.alpha.min) + " to " +
                                             number_text(model.alpha.max) + ")");
    }
  if (!(options.specular > 0.0 && options.specular <= 1.0))
    throw Error(ErrorKind::kUsage,
                "specular: " + number_text(options.specular) + " is out of range (above 0, at most 1)");
  if (!(options.diffuse >= 0.0 && options.diffuse <= 1.0))
    throw Error(ErrorKind::kUsage, "diffuse: " + number_text(options.diffuse) + " is out of range (0 to 1)");
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
