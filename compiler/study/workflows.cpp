#include "study/workflows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "look/image.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "report/contact_sheet.hpp"
#include "table/csv.hpp"

namespace remap {
namespace {

constexpr std::size_t kSheetRowsAGroup = 2, kFamilyKinds = 3;
constexpr double kLeastAlpha = 0.01;
constexpr const char* kHeadlight = "headlight";  // name of the light in the table
constexpr const char* kColumns[] = {"material",  "group", "alpha", "diffuse_r", "diffuse_g",
                                    "diffuse_b", "f0_r",  "f0_g",  "f0_b"};

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

// Returns the methods for plain diffuse: equation (3) with both means and with F0 0.03 and 0.04, Khronos'
// solver, the networks in `learned`, and the projection. Khronos' solver is made for the glTF convention, but
// importers apply it to plain maps. Networks for other conventions are skipped.
std::vector<WorkflowMethod> plain_methods(const std::vector<WorkflowFit>& learned) {
  const auto plain = [](WorkflowFormula formula, double f0) {
    return conversion_by(std::move(formula), f0, DiffuseConvention::kPlain);
  };
  std::vector<WorkflowMethod> methods = {
      method_of("equation (3), mean, 0.03", plain(ClosedFormula::kEquation3, kPaperDielectricF0)),
      method_of("equation (3), weighted, 0.03", plain(ClosedFormula::kEquation3ByAlbedo, kPaperDielectricF0)),
      method_of("equation (3), mean, 0.04", plain(ClosedFormula::kEquation3, kCommonDielectricF0)),
      method_of("equation (3), weighted, 0.04",
                plain(ClosedFormula::kEquation3ByAlbedo, kCommonDielectricF0))};
  WorkflowMethod khronos = method_of(
      "Khronos", conversion_by(ClosedFormula::kKhronos, kCommonDielectricF0, DiffuseConvention::kScaled));
  khronos.reflection.diffuse_of_albedo = 1.0;
  methods.push_back(khronos);
  for (const WorkflowFit& network : learned) {
    WorkflowConversion conversion = network.conversion;
    if (conversion.specular.diffuse != DiffuseConvention::kPlain) continue;
    conversion.specular.width = conversion.metallic.width = RoughnessEncoding::kAlpha;
    methods.push_back(method_of(network.id, conversion));
  }
  methods.push_back(method_of("projection", plain(Projection{kCleanPrior}, kCommonDielectricF0)));
  return methods;
}

// Returns the methods for the glTF convention, in which diffuse is scaled by 1 - max(specular). Khronos'
// solver is made for this convention.
std::vector<WorkflowMethod> gltf_methods() {
  const auto scaled = [](WorkflowFormula formula) {
    return conversion_by(std::move(formula), kCommonDielectricF0, DiffuseConvention::kScaled);
  };
  return {method_of("equation (3), mean", scaled(ClosedFormula::kEquation3)),
          method_of("equation (3), weighted", scaled(ClosedFormula::kEquation3ByAlbedo)),
          method_of("Khronos", scaled(ClosedFormula::kKhronos)),
          method_of("projection", scaled(Projection{kCleanPrior}))};
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

// Scales diffuse by 1 - max(specular), as in the glTF convention.
Reflectances scaled_surface(Reflectances surface) {
  const double left = 1.0 - std::max({surface.f0[0], surface.f0[1], surface.f0[2]});
  for (double& diffuse : surface.diffuse) diffuse *= left;
  return surface;
}

DisplayedSphere picture(const LitReflectances& lit, const StudyMaterial& material, std::size_t light,
                        const Reflectances& surface) {
  return displayed_sphere(lit.radiance(material.alpha, light, surface), lit.pixels(), lit.resolution());
}

double mean_rmse(const WorkflowPictures& pictures, std::size_t environment_count) {
  double sum = 0.0;
  for (std::size_t e = 0; e < environment_count; ++e) sum += pictures.rmse[e];
  return sum / static_cast<double>(environment_count);
}

// Compares one material with the results of `methods`. The last method is the one with the smallest error.
std::vector<WorkflowPictures> compared(const LitReflectances& lit, const std::vector<WorkflowMethod>& methods,
                                       const StudyMaterial& material, const Reflectances& shown,
                                       double alpha) {
  std::vector<WorkflowPictures> all;
  std::vector<Reflectances> results;
  const MetallicReflection& least_error = methods.back().reflection;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const bool is_searched = m + 1 == methods.size();
    all.push_back({is_searched ? best_metallic(lit, material.alpha, shown, least_error)
                               : converted(methods[m], material.surface, alpha),
                   {},
                   {}});
    results.push_back(reflectances_of(all.back().surface, methods[m].reflection));
  }
  for (std::size_t light = 0; light <= lit.headlight(); ++light) {
    const DisplayedSphere source = picture(lit, material, light, shown);
    for (std::size_t m = 0; m < all.size(); ++m) {
      const DisplayedSphere target = picture(lit, material, light, results[m]);
      all[m].rmse.push_back(100.0 * rms_difference(source.colors, target.colors));
      all[m].ssim.push_back(sphere_similarity(source, target, lit.pixels(), lit.resolution()));
    }
  }
  const std::size_t environments = lit.environment_count();
  for (std::size_t m = 0; m + 1 < all.size(); ++m)
    if (methods[m].reflection.dielectric_f0 == least_error.dielectric_f0 &&
        mean_rmse(all[m], environments) < mean_rmse(all.back(), environments))
      all.back() = all[m];
  return all;
}

WorkflowComparison comparison_of(const WorkflowsOptions& options, const LitReflectances& lit,
                                 DiffuseConvention diffuse) {
  const bool is_scaled = diffuse == DiffuseConvention::kScaled;
  WorkflowComparison comparison{
      is_scaled ? "gltf" : "plain", is_scaled ? gltf_methods() : plain_methods(options.learned), {}};
  comparison.methods.push_back(
      method_of(kLeastErrorMethod, conversion_by(Projection{kCleanPrior}, kCommonDielectricF0, diffuse)));
  const std::vector<StudyMaterial>& materials = options.materials;
  comparison.pictures.assign(comparison.methods.size(), std::vector<WorkflowPictures>(materials.size()));
  run_parallel(materials.size(), options.jobs, [&](std::size_t i) {
    if (options.cancelled != nullptr && *options.cancelled)
      throw Error(ErrorKind::kInterrupted, "study: interrupted; nothing was written");
    // The maps have the same values in both conventions.
    const Reflectances shown = is_scaled ? scaled_surface(materials[i].surface) : materials[i].surface;
    std::vector<WorkflowPictures> all =
        compared(lit, comparison.methods, materials[i], shown, options.alphas[materials[i].alpha]);
    for (std::size_t m = 0; m < all.size(); ++m) comparison.pictures[m][i] = std::move(all[m]);
    if (options.progress) options.progress();
  });
  return comparison;
}

// Returns indices of the first materials of each group, which sheets show.
std::vector<std::size_t> sheet_rows(const std::vector<StudyMaterial>& materials) {
  std::vector<std::size_t> rows;
  std::map<std::string, std::size_t> counts;
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (counts[materials[i].group]++ < kSheetRowsAGroup) rows.push_back(i);
  return rows;
}

std::vector<Image> sheets_of(const WorkflowsOptions& options, const LitReflectances& lit,
                             const WorkflowComparison& comparison) {
  const std::vector<StudyMaterial>& materials = options.materials;
  const std::vector<std::size_t> rows = sheet_rows(materials);
  SheetLabels labels{{"source"}, {}};
  for (const WorkflowMethod& method : comparison.methods) labels.columns.push_back(method.name);
  for (const std::size_t row : rows) labels.rows.push_back(materials[row].name);
  const int side = lit.resolution();
  std::vector<Image> sheets;
  for (std::size_t light = 0; light < lit.environment_count(); ++light) {
    Image sheet = contact_sheet(rows.size(), labels.columns.size(), side);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const auto place = [&](std::size_t column, const Reflectances& surface) {
        place_picture(&sheet, side, r, column, lit.pixels(),
                      picture(lit, materials[rows[r]], light, surface).colors);
      };
      place(0, materials[rows[r]].surface);
      for (std::size_t m = 0; m < comparison.methods.size(); ++m)
        place(1 + m,
              reflectances_of(comparison.pictures[m][rows[r]].surface, comparison.methods[m].reflection));
    }
    sheets.push_back(labelled(sheet, labels));
  }
  return sheets;
}

void require_options(const WorkflowsOptions& options) {
  if (options.materials.empty() || options.alphas.empty() || options.environments.empty())
    throw usage_error("workflows: at least one material, one alpha and one environment are required");
  require_names_differ(options.environments);
  for (const Environment& environment : options.environments)
    if (environment.name == kHeadlight)
      throw usage_error("environment: the name headlight means the light at the camera (rename the file)");
  for (const double alpha : options.alphas)
    if (!(alpha >= kLeastAlpha && alpha <= 1.0))
      throw usage_error("alpha: " + number_text(alpha) + " is out of range (0.01 to 1)");
  for (const StudyMaterial& material : options.materials)
    if (material.alpha >= options.alphas.size())
      throw usage_error(material.name + ": alpha index " + std::to_string(material.alpha) +
                        " is out of range (" + std::to_string(options.alphas.size()) + " alphas)");
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

// Converts to the specular workflow by `there`, and from there to the metallic workflow by `method`.
RoundTripErrors round_trip(const WorkflowMethod& method, const WorkflowConversion& there, FamilyKind kind,
                           std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  double metallic = 0.0, color = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const MetallicMaterial truth = drawn(kind, generator);
    SpecularMaterial material = to_specular(there, truth);
    if (kind != FamilyKind::kExact)
      for (auto* channels : {&material.diffuse, &material.specular})
        for (float& channel : *channels) channel = stored(channel);
    const MetallicMaterial result = to_metallic(method.conversion, material);
    metallic += std::pow(static_cast<double>(result.metallic - truth.metallic), 2);
    for (std::size_t c = 0; c < 3; ++c)
      color += std::pow(static_cast<double>(display_value(static_cast<double>(result.base_color[c])) -
                                            display_value(static_cast<double>(truth.base_color[c]))),
                        2) /
               3.0;
  }
  const auto all = static_cast<double>(count);
  return {method.name, kind, std::sqrt(metallic / all), std::sqrt(color / all)};
}

}  // namespace

std::size_t progress_steps(const WorkflowsOptions& options) {
  return options.alphas.size() * static_cast<std::size_t>(std::max(0, options.resolution)) +
         2 * options.materials.size();
}

void read_materials(const std::string& text, const std::string& name, WorkflowsOptions* options) {
  const Csv csv = parse_csv(text, name);
  for (std::size_t c = 0; c < std::size(kColumns); ++c)
    if (c >= csv.header.cells.size() || csv.header.cells[c].text != kColumns[c])
      csv.fail(csv.header.number, 1,
               std::string("the column ") + kColumns[c] +
                   " is missing (scripts/studies/materials writes such files)");
  for (const CsvLine& line : csv.lines) {
    const auto number = [&](std::size_t c, double least) {
      const double value = csv.number(line, line.cells[c], kColumns[c]);
      if (!(value >= least && value <= 1.0))
        csv.fail(line.number, line.cells[c].column,
                 std::string(kColumns[c]) + ": " + number_text(value) + " is out of range (" +
                     number_text(least) + " to 1)");
      return value;
    };
    StudyMaterial material{std::string(line.cells[0].text), std::string(line.cells[1].text), {}, 0};
    const double alpha = number(2, kLeastAlpha);
    for (std::size_t c = 0; c < 3; ++c) {
      material.surface.diffuse[c] = number(3 + c, 0.0);
      material.surface.f0[c] = number(6 + c, 0.0);
    }
    const auto found = std::ranges::find(options->alphas, alpha);
    material.alpha = static_cast<std::size_t>(found - options->alphas.begin());
    if (found == options->alphas.end()) options->alphas.push_back(alpha);
    options->materials.push_back(std::move(material));
  }
}

std::vector<WorkflowComparison> study_workflows(const WorkflowsOptions& options, std::vector<Image>* sheets) {
  require_options(options);
  const LitReflectances lit(options.environments, options.alphas, options);
  std::vector<WorkflowComparison> comparisons;
  for (const DiffuseConvention diffuse : {DiffuseConvention::kPlain, DiffuseConvention::kScaled})
    comparisons.push_back(comparison_of(options, lit, diffuse));
  if (sheets != nullptr) *sheets = sheets_of(options, lit, comparisons.front());
  return comparisons;
}

std::string workflows_csv(const WorkflowsOptions& options,
                          const std::vector<WorkflowComparison>& comparisons) {
  CsvText csv(
      "convention,material,group,alpha,diffuse_r,diffuse_g,diffuse_b,f0_r,f0_g,f0_b,method,base_color_r,"
      "base_color_g,base_color_b,metallic,light,rmse_percent,ssim",
      {{"tool", std::string("remap-study ") + kVersion},
       {"resolution", std::to_string(options.resolution)},
       {"samples", std::to_string(options.samples)},
       {"environments", environment_names(options.environments)},
       {"alphas", listed(options.alphas)}});
  for (const WorkflowComparison& comparison : comparisons)
    for (std::size_t i = 0; i < options.materials.size(); ++i)
      for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
        const StudyMaterial& material = options.materials[i];
        const WorkflowPictures& pictures = comparison.pictures[m][i];
        for (std::size_t light = 0; light < pictures.rmse.size(); ++light)
          csv.add_row(
              comparison.convention, material.name, material.group, options.alphas[material.alpha],
              material.surface.diffuse, material.surface.f0, comparison.methods[m].name,
              pictures.surface.base_color, pictures.surface.metallic,
              light < options.environments.size() ? options.environments[light].name.c_str() : kHeadlight,
              pictures.rmse[light], pictures.ssim[light]);
      }
  return csv.text();
}

std::vector<RoundTripErrors> study_round_trips(const std::vector<WorkflowFit>& learned, std::size_t count,
                                               std::uint64_t seed, unsigned jobs) {
  if (count == 0) throw usage_error("--family-count must be at least 1");
  std::vector<WorkflowMethod> methods = plain_methods(learned);
  std::vector<WorkflowConversion> there;  // conversions to specular by equation (2), one for each method
  for (WorkflowMethod& method : methods) {
    WorkflowConversion& conversion = there.emplace_back(method.conversion);
    if (!is_formula(method.conversion.formula, ClosedFormula::kKhronos)) continue;
    // Khronos' solver is not made for plain maps, but importers apply it to them, so this is tested, too.
    method.name += ", plain";
    conversion.specular.diffuse = conversion.metallic.diffuse = DiffuseConvention::kPlain;
  }
  for (WorkflowMethod& method : gltf_methods()) {
    there.push_back(method.conversion);
    method.name += ", glTF";
    methods.push_back(std::move(method));
  }
  for (WorkflowConversion& conversion : there) conversion.formula = ClosedFormula::kEquation2;
  std::vector<RoundTripErrors> trips(methods.size() * kFamilyKinds);
  run_parallel(trips.size(), jobs, [&](std::size_t i) {
    const std::size_t method = i / kFamilyKinds;
    trips[i] =
        round_trip(methods[method], there[method], static_cast<FamilyKind>(i % kFamilyKinds), count, seed);
  });
  return trips;
}

std::string round_trips_csv(const std::vector<RoundTripErrors>& trips, std::size_t count,
                            std::uint64_t seed) {
  constexpr std::array<const char*, kFamilyKinds> kNames = {"uniform, exact", "uniform, 8-bit",
                                                            "authored, 8-bit"};
  CsvText csv("method,family,metallic_rms,base_color_rms", {{"tool", std::string("remap-study ") + kVersion},
                                                            {"materials", std::to_string(count)},
                                                            {"seed", std::to_string(seed)}});
  for (const RoundTripErrors& trip : trips)
    csv.add_row(trip.method, kNames[static_cast<std::size_t>(trip.family)], trip.metallic, trip.base_color);
  return csv.text();
}

}  // namespace remap
