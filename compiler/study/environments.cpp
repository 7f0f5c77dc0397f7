#include "study/environments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "remap/error.hpp"
#include "renderer/image_similarity.hpp"
#include "renderer/renderer.hpp"
#include "report/contact_sheet.hpp"

namespace remap {
namespace {

constexpr std::size_t kMethodCount = 5;  // methods without kBest

double mean_radiance(const std::vector<float>& radiance) {
  double sum = 0.0;
  for (std::size_t i = 0; i < radiance.size(); i += 3) sum += luminance(&radiance[i]);
  return sum / (static_cast<double>(radiance.size()) / 3.0);
}

// A picture of one material under one environment.
struct LitPicture {
  DisplayedSphere display;
  double mean = 0.0;                           // linear luminance
  std::array<std::vector<float>, 2> halves{};  // display colors from each half of the light directions
};

LitPicture picture_of(const SpherePictures& pictures, std::size_t material, std::size_t environment) {
  const std::vector<float> radiance = pictures.radiance(material, environment);
  LitPicture picture{
      displayed_sphere(radiance, pictures.pixels(), pictures.resolution()), mean_radiance(radiance), {}};
  for (std::size_t half = 0; half < picture.halves.size(); ++half)
    picture.halves[half] = display_values(pictures.half_radiance(material, environment, half));
  return picture;
}

// The distinct source and target materials at one alpha.
struct RenderedMaterials {
  std::vector<SphereMaterial> materials;
  std::size_t place(const SphereMaterial& material) {
    const auto found = std::find(materials.begin(), materials.end(), material);
    if (found != materials.end()) return static_cast<std::size_t>(found - materials.begin());
    materials.push_back(material);
    return materials.size() - 1;
  }
};

struct ComparedPair {
  Conversion conversion;
  std::size_t source, target;  // indices into RenderedMaterials::materials
};

// The mean square sampling error of the difference of two pictures. It is estimated from the differences that
// each half of the light directions gives: the error of their mean is half of their difference.
double squared_noise(const LitPicture& source, const LitPicture& target) {
  double sum = 0.0;
  for (std::size_t i = 0; i < source.halves[0].size(); ++i) {
    const double first = static_cast<double>(source.halves[0][i]) - static_cast<double>(target.halves[0][i]);
    const double second = static_cast<double>(source.halves[1][i]) - static_cast<double>(target.halves[1][i]);
    sum += 0.25 * (first - second) * (first - second);
  }
  return sum / static_cast<double>(source.halves[0].size());
}

// Places the pictures of one environment on its sheet.
void fill_sheet(const std::vector<ComparedPair>& pairs, const std::vector<LitPicture>& shots,
                const SpherePictures& pictures, Image* sheet) {
  for (const ComparedPair& pair : pairs) {
    const std::size_t row = pair.conversion.pair;
    const std::size_t column = 1 + static_cast<std::size_t>(pair.conversion.method);
    const auto place = [&](std::size_t material, std::size_t at) {
      place_picture(sheet, pictures.resolution(), row, at, pictures.pixels(), shots[material].display.colors);
    };
    place(pair.source, 0);
    place(pair.target, column);
  }
}

// Renders all materials of one alpha together and compares them.
void compare_alpha(const EnvironmentsOptions& options, const RadiancePyramid& pyramid,
                   std::span<const Conversion> conversions, EnvironmentsResult* result) {
  RenderedMaterials rendered;
  std::vector<ComparedPair> pairs;
  for (const Conversion& c : conversions) {
    const StudyPair& pair = options.pairs[c.pair];
    pairs.push_back(
        {c, rendered.place({builtin_brdf(pair.source), c.alpha, options.specular, options.diffuse}),
         rendered.place({builtin_brdf(pair.target), c.target_alpha, c.target_specular, options.diffuse})});
  }
  const SpherePictures pictures = render_spheres(pyramid, rendered.materials, options);
  const std::size_t environment_count = options.environments.size();
  std::vector<EnvironmentComparison> comparisons(pairs.size() * environment_count);
  const bool on_sheet = options.sheet_alpha == conversions.front().alpha;
  if (on_sheet)
    result->sheets.assign(environment_count, contact_sheet(options.pairs.size(),
                                                           1 + kMethodCount + (options.least_error ? 1 : 0),
                                                           options.resolution));
  run_parallel(environment_count, options.jobs, [&](std::size_t e) {
    std::vector<LitPicture> shots;
    for (std::size_t m = 0; m < rendered.materials.size(); ++m) shots.push_back(picture_of(pictures, m, e));
    if (on_sheet) fill_sheet(pairs, shots, pictures, &result->sheets[e]);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const LitPicture &source = shots[pairs[i].source], &target = shots[pairs[i].target];
      comparisons[i * environment_count + e] = {
          pairs[i].conversion,
          e,
          {100.0 * rms_difference(source.display.colors, target.display.colors),
           sphere_similarity(source.display, target.display, pictures.pixels(), pictures.resolution()),
           target.mean / source.mean - 1.0},
          squared_noise(source, target)};
    }
  });
  result->comparisons.insert(result->comparisons.end(), comparisons.begin(), comparisons.end());
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

EnvironmentsResult study_environments(const EnvironmentsOptions& options) {
  require_options(options);
  EnvironmentsResult result;
  const std::vector<Conversion> conversions = conversions_of(options, &result.remarks);
  const RadiancePyramid pyramid(options.environments);
  for (auto begin = conversions.begin(); begin != conversions.end();) {
    const auto end =
        std::find_if(begin, conversions.end(), [&](const Conversion& c) { return c.alpha != begin->alpha; });
    std::vector<Conversion> at_alpha(begin, end);
    if (options.least_error) add_best(options, pyramid, &at_alpha);
    compare_alpha(options, pyramid, at_alpha, &result);
    begin = end;
  }
  double sum = 0.0;
  for (const EnvironmentComparison& comparison : result.comparisons) sum += comparison.squared_noise;
  result.noise = 100.0 * std::sqrt(sum / static_cast<double>(result.comparisons.size()));
  return result;
}

std::vector<const EnvironmentComparison*> comparisons_of(const EnvironmentsResult& result, Method method,
                                                         std::size_t pair) {
  std::vector<const EnvironmentComparison*> chosen;
  for (const EnvironmentComparison& comparison : result.comparisons)
    if (comparison.conversion.method == method && (pair == kAllPairs || comparison.conversion.pair == pair))
      chosen.push_back(&comparison);
  return chosen;
}

PictureSimilarity mean_similarity(const std::vector<const EnvironmentComparison*>& comparisons) {
  PictureSimilarity mean;
  const auto count = static_cast<double>(comparisons.size());
  for (const EnvironmentComparison* comparison : comparisons) {
    mean.rmse += comparison->image_similarity.rmse / count;
    mean.ssim += comparison->image_similarity.ssim / count;
    mean.energy += std::fabs(comparison->image_similarity.energy) / count;
  }
  return mean;
}

}  // namespace remap
