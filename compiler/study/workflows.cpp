#include "study/workflows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "remap/error.hpp"
#include "renderer/image_similarity.hpp"
#include "report/contact_sheet.hpp"

namespace remap {
namespace {

constexpr double kWorstShare = 0.05;
constexpr std::size_t kSheetRowsAGroup = 2;

WorkflowConversion conversion_by(WorkflowFormula formula, double f0, DiffuseConvention diffuse) {
  WorkflowConversion conversion;
  conversion.specular.diffuse = conversion.metallic.diffuse = diffuse;
  conversion.specular.width = conversion.metallic.width = RoughnessEncoding::kAlpha;
  conversion.metallic.dielectric_f0 = f0;
  conversion.formula = std::move(formula);
  return conversion;
}

MetallicReflection reflection_of(const MetallicWorkflow& workflow) {
  const bool scaled = workflow.diffuse == DiffuseConvention::kScaled;
  return {workflow.dielectric_f0, scaled ? 1.0 - workflow.dielectric_f0 : 1.0};
}

WorkflowMethod method_of(const std::string& name, const WorkflowConversion& conversion) {
  return {name, conversion, reflection_of(conversion.metallic)};
}

// Converts reflectances to the parameters of a conversion.
SpecularMaterial parameters_of(const Reflectances& surface, double alpha) {
  SpecularMaterial material;
  for (std::size_t c = 0; c < 3; ++c) {
    material.diffuse[c] = static_cast<float>(surface.diffuse[c]);
    material.specular[c] = static_cast<float>(surface.f0[c]);
  }
  material.width = static_cast<float>(alpha);
  return material;
}

MetallicSurface converted(const WorkflowMethod& method, const Reflectances& surface, double alpha) {
  const MetallicMaterial result = to_metallic(method.conversion, parameters_of(surface, alpha));
  MetallicSurface metallic{{}, static_cast<double>(result.metallic)};
  for (std::size_t c = 0; c < 3; ++c) metallic.base_color[c] = static_cast<double>(result.base_color[c]);
  return metallic;
}

// The maps have the same values in both conventions. In the glTF convention, diffuse is scaled by
// 1 - max(specular).
Reflectances scaled_surface(Reflectances surface) {
  const double left = 1.0 - std::max({surface.f0[0], surface.f0[1], surface.f0[2]});
  for (double& diffuse : surface.diffuse) diffuse *= left;
  return surface;
}

// One convention and its methods.
struct WorkflowRun {
  std::string convention;
  bool scaled = false;
  std::vector<WorkflowMethod> methods;
  MetallicReflection least_error;
};

// The rendering that all materials of a run share.
struct Studio {
  const WorkflowsOptions& options;
  const LitReflectances& lit;

  DisplayedSphere picture(const StudyMaterial& material, std::size_t light,
                          const Reflectances& surface) const {
    return displayed_sphere(lit.radiance(material.alpha, light, surface), lit.pixels(), lit.resolution());
  }
  std::size_t light_count() const { return lit.environment_count() + 1; }
};

double mean_rmse(const WorkflowPictures& pictures, std::size_t environment_count) {
  double sum = 0.0;
  for (std::size_t e = 0; e < environment_count; ++e) sum += pictures.rmse[e];
  return sum / static_cast<double>(environment_count);
}

// Compares one material with the results of every method and with the least-error surface.
std::vector<WorkflowPictures> compared(const Studio& studio, const WorkflowRun& run,
                                       const StudyMaterial& material) {
  const Reflectances& maps = material.surface;
  const Reflectances shown = run.scaled ? scaled_surface(maps) : maps;
  const double alpha = studio.options.alphas[material.alpha];
  std::vector<WorkflowPictures> all;
  std::vector<Reflectances> results;
  for (const WorkflowMethod& method : run.methods) {
    all.push_back({converted(method, maps, alpha), {}, {}});
    results.push_back(reflectances_of(all.back().surface, method.reflection));
  }
  all.push_back({best_metallic(studio.lit, material.alpha, shown, run.least_error), {}, {}});
  results.push_back(reflectances_of(all.back().surface, run.least_error));
  for (std::size_t light = 0; light < studio.light_count(); ++light) {
    const DisplayedSphere source = studio.picture(material, light, shown);
    for (std::size_t m = 0; m < all.size(); ++m) {
      const DisplayedSphere target = studio.picture(material, light, results[m]);
      all[m].rmse.push_back(100.0 * rms_difference(source.colors, target.colors));
      all[m].ssim.push_back(sphere_similarity(source, target, studio.lit.pixels(), studio.lit.resolution()));
    }
  }
  const std::size_t environments = studio.lit.environment_count();
  for (std::size_t m = 0; m + 1 < all.size(); ++m)
    if (run.methods[m].reflection.dielectric_f0 == run.least_error.dielectric_f0 &&
        mean_rmse(all[m], environments) < mean_rmse(all.back(), environments))
      all.back() = all[m];
  return all;
}

WorkflowComparison comparison_of(const Studio& studio, const WorkflowRun& run) {
  WorkflowComparison comparison{run.convention, {}, {}};
  for (const WorkflowMethod& method : run.methods) comparison.methods.push_back(method.name);
  comparison.methods.push_back(kLeastErrorMethod);
  const std::vector<StudyMaterial>& materials = studio.options.materials;
  comparison.pictures.assign(comparison.methods.size(), std::vector<WorkflowPictures>(materials.size()));
  run_parallel(materials.size(), studio.options.jobs, [&](std::size_t i) {
    if (studio.options.cancelled != nullptr && *studio.options.cancelled)
      throw Error(ErrorKind::kInterrupted, "study: interrupted; nothing was written");
    std::vector<WorkflowPictures> all = compared(studio, run, materials[i]);
    for (std::size_t m = 0; m < all.size(); ++m) comparison.pictures[m][i] = std::move(all[m]);
    if (studio.options.progress) studio.options.progress();
  });
  return comparison;
}

// Indices of the first materials of each group.
std::vector<std::size_t> sheet_rows(const std::vector<StudyMaterial>& materials) {
  std::vector<std::size_t> rows, counts(kMaterialGroups);
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (counts[static_cast<std::size_t>(materials[i].group)]++ < kSheetRowsAGroup) rows.push_back(i);
  return rows;
}

void add_sheets(const Studio& studio, const WorkflowRun& run, const WorkflowComparison& comparison,
                WorkflowsResult* result) {
  const std::vector<StudyMaterial>& materials = studio.options.materials;
  const std::vector<std::size_t> rows = sheet_rows(materials);
  for (const std::size_t row : rows) result->sheet_materials.push_back(materials[row].name);
  const int side = studio.lit.resolution();
  for (std::size_t light = 0; light < studio.lit.environment_count(); ++light) {
    Image sheet = contact_sheet(rows.size(), 1 + comparison.methods.size(), side);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto place = [&](std::size_t column, const Reflectances& surface) {
        place_picture(&sheet, side, r, column, studio.lit.pixels(),
                      studio.picture(materials[rows[r]], light, surface).colors);
      };
      place(0, materials[rows[r]].surface);
      for (std::size_t m = 0; m < comparison.methods.size(); ++m)
        place(1 + m, reflectances_of(comparison.pictures[m][rows[r]].surface,
                                     m < run.methods.size() ? run.methods[m].reflection : run.least_error));
    }
    result->sheets.push_back(std::move(sheet));
  }
}

void require_options(const WorkflowsOptions& options) {
  if (options.materials.empty() || options.alphas.empty() || options.environments.empty())
    throw Error(ErrorKind::kUsage,
                "workflows: at least one material, one alpha and one environment are required");
  require_names_differ(options.environments);
  for (const double alpha : options.alphas)
    if (!(alpha >= 0.01 && alpha <= 1.0))
      throw Error(ErrorKind::kUsage, "alpha: " + number_text(alpha) + " is out of range (0.01 to 1)");
  for (const StudyMaterial& material : options.materials)
    if (material.alpha >= options.alphas.size())
      throw Error(ErrorKind::kUsage, material.name + ": alpha index " + std::to_string(material.alpha) +
                                         " is out of range (" + std::to_string(options.alphas.size()) +
                                         " alphas)");
}

float stored(float linear) {
  const double steps = std::round(255.0 * static_cast<double>(display_value(static_cast<double>(linear))));
  return static_cast<float>(linear_of_display(steps / 255.0));
}

MetallicMaterial drawn(FamilyKind kind, std::mt19937_64& generator) {
  const auto share = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  const bool authored = kind == FamilyKind::kAuthored;
  MetallicMaterial material;
  for (float& channel : material.base_color)
    channel = static_cast<float>(authored ? linear_of_display(share()) : share());
  const double metallic = share(), pure = share();
  material.metallic = static_cast<float>(authored && pure < 0.8 ? std::round(metallic) : metallic);
  material.width = static_cast<float>(share());
  return material;
}

// One tested method: `there` is equation (2); `back` is the conversion under test.
struct FamilyTrip {
  std::string name;
  WorkflowConversion there, back;
};

FamilyTrip trip_of(const WorkflowMethod& method, const std::string& addition = "") {
  FamilyTrip trip{method.name + addition, method.conversion, method.conversion};
  trip.there.formula = Equation2{};
  return trip;
}

FamilyErrors errors_of(const FamilyTrip& trip, FamilyKind kind, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  double metallic = 0.0, color = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const MetallicMaterial truth = drawn(kind, generator);
    SpecularMaterial material = to_specular(trip.there, truth);
    if (kind != FamilyKind::kExact)
      for (auto* channels : {&material.diffuse, &material.specular})
        for (float& channel : *channels) channel = stored(channel);
    const MetallicMaterial result = to_metallic(trip.back, material);
    metallic += std::pow(static_cast<double>(result.metallic - truth.metallic), 2);
    for (std::size_t c = 0; c < 3; ++c)
      color += std::pow(static_cast<double>(display_value(static_cast<double>(result.base_color[c])) -
                                            display_value(static_cast<double>(truth.base_color[c]))),
                        2) /
               3.0;
  }
  const auto all = static_cast<double>(count);
  return {std::sqrt(metallic / all), std::sqrt(color / all)};
}

}  // namespace

std::vector<WorkflowMethod> plain_methods(const std::vector<NamedConversion>& learned) {
  using namespace remap;
  const auto plain = [](WorkflowFormula formula, double f0) {
    return conversion_by(std::move(formula), f0, DiffuseConvention::kPlain);
  };
  std::vector<WorkflowMethod> methods = {
      method_of("equation (3), mean, 0.03", plain(Equation3{MetallicMean::kPlain}, kPaperDielectricF0)),
      method_of("equation (3), weighted, 0.03", plain(Equation3{MetallicMean::kAlbedo}, kPaperDielectricF0)),
      method_of("equation (3), mean, 0.04", plain(Equation3{MetallicMean::kPlain}, kCommonDielectricF0)),
      method_of("equation (3), weighted, 0.04",
                plain(Equation3{MetallicMean::kAlbedo}, kCommonDielectricF0))};
  WorkflowMethod khronos =
      method_of("Khronos", conversion_by(KhronosSolver{}, kCommonDielectricF0, DiffuseConvention::kScaled));
  khronos.reflection.diffuse_of_albedo = 1.0;
  methods.push_back(khronos);
  for (const NamedConversion& network : learned) {
    WorkflowConversion conversion = network.conversion;
    if (conversion.specular.diffuse != DiffuseConvention::kPlain) continue;
    conversion.specular.width = conversion.metallic.width = RoughnessEncoding::kAlpha;
    methods.push_back(method_of(network.name, conversion));
  }
  methods.push_back(method_of("projection", plain(Projection{kCleanPrior}, kCommonDielectricF0)));
  return methods;
}

std::vector<WorkflowMethod> gltf_methods() {
  using namespace remap;
  const auto scaled = [](WorkflowFormula formula) {
    return conversion_by(std::move(formula), kCommonDielectricF0, DiffuseConvention::kScaled);
  };
  return {method_of("equation (3), mean", scaled(Equation3{MetallicMean::kPlain})),
          method_of("equation (3), weighted", scaled(Equation3{MetallicMean::kAlbedo})),
          method_of("Khronos", scaled(KhronosSolver{})),
          method_of("projection", scaled(Projection{kCleanPrior}))};
}

std::size_t progress_steps(const WorkflowsOptions& options) {
  return options.alphas.size() * static_cast<std::size_t>(std::max(0, options.resolution)) +
         2 * options.materials.size();
}

WorkflowsResult study_workflows(const WorkflowsOptions& options) {
  require_options(options);
  const LitReflectances lit(options.environments, options.alphas, options);
  const Studio studio{options, lit};
  WorkflowsResult result;
  const WorkflowRun plain{"plain", false, plain_methods(options.learned), {kCommonDielectricF0, 1.0}};
  const WorkflowRun gltf{"gltf", true, gltf_methods(), {kCommonDielectricF0, 1.0 - kCommonDielectricF0}};
  result.comparisons.push_back(comparison_of(studio, plain));
  result.comparisons.push_back(comparison_of(studio, gltf));
  if (options.sheets) add_sheets(studio, plain, result.comparisons.front(), &result);
  return result;
}

WorkflowFigures figures_of(const WorkflowsOptions& options, const WorkflowComparison& comparison,
                           std::size_t method, std::optional<MaterialGroup> group) {
  WorkflowFigures figures;
  std::vector<double> similarities;
  double materials = 0.0;
  for (std::size_t i = 0; i < options.materials.size(); ++i) {
    if (group && options.materials[i].group != *group) continue;
    const WorkflowPictures& pictures = comparison.pictures[method][i];
    const std::size_t environments = pictures.rmse.size() - 1;
    figures.rmse += mean_rmse(pictures, environments);
    similarities.insert(similarities.end(), pictures.ssim.begin(), pictures.ssim.end() - 1);
    figures.headlight_rmse += pictures.rmse.back();
    figures.headlight_ssim += pictures.ssim.back();
    materials += 1.0;
  }
  if (materials == 0.0) return figures;
  figures.rmse /= materials;
  figures.headlight_rmse /= materials;
  figures.headlight_ssim /= materials;
  std::sort(similarities.begin(), similarities.end());
  const auto worst = std::max<std::size_t>(
      1, static_cast<std::size_t>(kWorstShare * static_cast<double>(similarities.size())));
  for (std::size_t i = 0; i < similarities.size(); ++i) {
    figures.ssim += similarities[i] / static_cast<double>(similarities.size());
    if (i < worst) figures.worst_ssim += similarities[i] / static_cast<double>(worst);
  }
  return figures;
}

std::string family_name(FamilyKind kind) {
  constexpr std::array<const char*, kFamilyKinds> kNames = {"uniform, exact", "uniform, 8-bit",
                                                            "authored, 8-bit"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<FamilyLine> study_family(const std::vector<NamedConversion>& learned, std::size_t count,
                                     std::uint64_t seed, unsigned jobs) {
  if (count == 0) throw Error(ErrorKind::kUsage, "--family-count must be at least 1");
  std::vector<FamilyTrip> trips;
  for (const WorkflowMethod& method : plain_methods(learned)) {
    const bool is_khronos = std::holds_alternative<KhronosSolver>(method.conversion.formula);
    FamilyTrip& trip = trips.emplace_back(trip_of(method, is_khronos ? ", plain" : ""));
    // The solver is also tested on maps of the other convention.
    if (is_khronos) trip.there.specular.diffuse = trip.there.metallic.diffuse = DiffuseConvention::kPlain;
  }
  for (const WorkflowMethod& method : gltf_methods()) trips.push_back(trip_of(method, ", glTF"));
  std::vector<FamilyLine> lines;
  for (const FamilyTrip& trip : trips) lines.push_back({trip.name, {}});
  run_parallel(lines.size() * kFamilyKinds, jobs, [&](std::size_t i) {
    const std::size_t line = i / kFamilyKinds, kind = i % kFamilyKinds;
    lines[line].errors[kind] = errors_of(trips[line], static_cast<FamilyKind>(kind), count, seed);
  });
  return lines;
}

}  // namespace remap
