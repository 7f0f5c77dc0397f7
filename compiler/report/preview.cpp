#include "report/preview.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "lower/interpreter.hpp"
#include "measure/parameter_roles.hpp"
#include "measure/sweep.hpp"
#include "remap/error.hpp"
#include "renderer/image_similarity.hpp"
#include "report/contact_sheet.hpp"
#include "report/lit_sphere.hpp"
#include "table/light.hpp"

namespace remap {
namespace {

constexpr float kDifferenceGain = 4.0f;

// One side of the fit, ready to be rendered.
struct End {
  ModelDescription model;
  SpecularResponse response;  // between the fit's specular and the model's own
  double exposure = 1.0;
};

std::string comment(const Fit& fit, const std::string& key) {
  const auto found = fit.table.comments.find(key);
  return found == fit.table.comments.end() ? "" : found->second;
}

End make_end(const Renderer& renderer, const Fit& fit, const std::string& role, const ModelSide& side,
             double exposure) {
  const ParameterRoles roles =
      recorded_roles(comment(fit, role + "_roughness_parameter"), comment(fit, role + "_specular"),
                     comment(fit, role + "_fixed"));
  End end{recast(renderer.model(side.model), roles), {SpecularLaw::kAffine}, exposure};
  if (end.model.parameter(ParameterRole::kSpecular).name != side.specular)
    end.response = specular_response(renderer, end.model);
  return end;
}

Material material_of(const End& end, double alpha, const std::vector<double>& speculars) {
  const ParameterDescription& specular = end.model.parameter(ParameterRole::kSpecular);
  const double clamped = std::clamp(alpha, end.model.alpha.min, end.model.alpha.max);
  Material material = grey_material(end.model, clamped, specular.range.min, 0.0);
  std::vector<double>& values = material.parameters[specular.name];
  values.clear();
  for (const double value : speculars)
    values.push_back(std::clamp(end.response.own(value), specular.range.min, specular.range.max));
  return material;
}

// RGB display values of the pixels that show the shape.
using Colors = std::vector<float>;

Colors photograph(const Renderer& renderer, const End& end, const Material& material, const Scene& scene,
                  const std::vector<std::uint32_t>& pixels) {
  const Image image = renderer.render(material, scene);
  const auto channels = static_cast<std::size_t>(image.channels);
  const double nearest = scene.light.distance - 1.0;
  const double exposure = end.exposure * std::numbers::pi * nearest * nearest;
  Colors colors;
  for (const std::uint32_t pixel : pixels)
    for (std::size_t c = 0; c < 3; ++c)
      colors.push_back(display_value(
          exposure * static_cast<double>(image.values[channels * pixel + std::min(c, channels - 1)])));
  return colors;
}

Colors difference(const Colors& a, const Colors& b) {
  Colors result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    result[i] = std::min(1.0f, kDifferenceGain * std::fabs(a[i] - b[i]));
  return result;
}

// Converts the source of this alpha by the fit.
PreviewedMaterial converted(const Fit& fit, const std::vector<double>& specular, double alpha) {
  PreviewedMaterial figure;
  figure.alpha = alpha;
  figure.target_specular.resize(specular.size());
  const double own = evaluate_texel(fit, from_alpha(fit.source.roughness, alpha), specular,
                                    figure.target_specular, &figure.in_domain);
  figure.target_alpha = to_alpha(fit.target.roughness, own);
  return figure;
}

void require_options(const PreviewOptions& options) {
  if (options.shapes.empty()) throw Error(ErrorKind::kUsage, "preview: at least one shape is required");
  if (!options.specular.empty() && options.specular.size() != 1 && options.specular.size() != 3)
    throw Error(ErrorKind::kUsage,
                "preview: specular must have 1 or 3 values, not " + std::to_string(options.specular.size()));
  for (const double alpha : options.alphas)
    if (!(alpha > 0.0))
      throw Error(ErrorKind::kUsage, "preview: alpha " + number_text(alpha) + " must be above 0");
}

// Fills missing options from the domain of a fit.
void fill(const Domain& domain, PreviewMaterials* options) {
  if (options->alphas.empty()) options->alphas = preview_alphas(domain);
  if (options->specular.empty()) options->specular = {0.5 * domain.specular.max};
}

std::string short_number(double value) { return number_text(rounded(value, 3)); }

std::string short_list(std::vector<double> values) {
  for (double& value : values) value = rounded(value, 3);
  return listed(values);
}

// The numbers of a source and of its conversion, a line each.
std::string numbers_label(const std::vector<double>& specular, const PreviewedMaterial& material) {
  return "alpha " + short_number(material.alpha) + "\n-> " + short_number(material.target_alpha) +
         "\nspecular " + short_list(specular) + "\n-> " + short_list(material.target_specular);
}

constexpr std::size_t kColumns = 3;  // source, copied, converted

// Background on each side of a picture, pixels.
int margin_of(const LitPreviewOptions& options) { return options.resolution / 20; }

int cell_of(const LitPreviewOptions& options) { return options.resolution + 2 * margin_of(options); }

// Linear radiance of one sphere and the share of each pixel that it covers, row by row.
struct CoveredPicture {
  std::vector<float> radiance;  // red, green, blue; mean over the covered part of the pixel
  std::vector<float> coverage;  // 0 to 1
};

// Averages a picture of side * n pixels down to side. Channel c comes from the material `first + c`, or from
// `first` where the specular is grey.
CoveredPicture covered_picture(const SpherePictures& pictures, std::size_t first, std::size_t material_count,
                               int side) {
  const auto width = static_cast<std::size_t>(side), fine = static_cast<std::size_t>(pictures.resolution());
  const std::size_t step = fine / width;
  CoveredPicture picture{std::vector<float>(3 * width * width, 0.0f),
                         std::vector<float>(width * width, 0.0f)};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float> radiance = pictures.radiance(first + std::min(c, material_count - 1), 0);
    for (std::size_t i = 0; i < pictures.pixels().size(); ++i) {
      const std::size_t place = pictures.pixels()[i];
      const std::size_t pixel = place / fine / step * width + place % fine / step;
      picture.radiance[3 * pixel + c] += radiance[3 * i + c];
      if (c == 0) picture.coverage[pixel] += 1.0f;
    }
  }
  for (std::size_t pixel = 0; pixel < picture.coverage.size(); ++pixel) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.radiance[3 * pixel + c] /= std::max(picture.coverage[pixel], 1.0f);
    picture.coverage[pixel] /= static_cast<float>(step * step);
  }
  return picture;
}

// Pixels that show the sphere at least in part.
std::vector<std::uint32_t> covered_pixels(const CoveredPicture& picture) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < picture.coverage.size(); ++i)
    if (picture.coverage[i] > 0.0f) pixels.push_back(static_cast<std::uint32_t>(i));
  return pixels;
}

// The same pixels in a cell of the sheet.
std::vector<std::uint32_t> in_cell(const LitPreviewOptions& options, std::vector<std::uint32_t> pixels) {
  const auto side = static_cast<std::uint32_t>(options.resolution);
  const auto margin = static_cast<std::uint32_t>(margin_of(options));
  const auto cell = static_cast<std::uint32_t>(cell_of(options));
  for (std::uint32_t& pixel : pixels) pixel = (pixel / side + margin) * cell + pixel % side + margin;
  return pixels;
}

std::vector<float> chosen(const CoveredPicture& picture, const std::vector<std::uint32_t>& pixels) {
  std::vector<float> radiance;
  for (const std::uint32_t pixel : pixels)
    for (std::size_t c = 0; c < 3; ++c) radiance.push_back(picture.radiance[3 * pixel + c]);
  return radiance;
}

// Display values over the background of the sheet, so that the rim of the sphere is smooth.
std::vector<float> over_background(const CoveredPicture& picture, const std::vector<std::uint32_t>& pixels,
                                   std::vector<float> colors) {
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float share = picture.coverage[pixels[i]];
      colors[3 * i + c] = share * colors[3 * i + c] + (1.0f - share) * kSheetBackground;
    }
  return colors;
}

void require_options(const LitPreviewOptions& options) {
  if (options.specular.size() != 1 && options.specular.size() != 3)
    throw Error(ErrorKind::kUsage, "--specular: " + std::to_string(options.specular.size()) +
                                       " values given (use one value, or R,G,B)");
  for (const double alpha : options.alphas)
    if (!(alpha > 0.0 && alpha <= 1.0))
      throw Error(ErrorKind::kUsage, "--alpha: " + number_text(alpha) + " is outside 0 to 1");
  if (!(options.diffuse >= 0.0 && options.diffuse <= 1.0))
    throw Error(ErrorKind::kUsage, "--diffuse: " + number_text(options.diffuse) + " is outside 0 to 1");
}

// The materials of one figure: source, copied and converted, each with one material for each specular value.
std::vector<SphereMaterial> materials_of(const Fit& fit, const LitPreviewOptions& options,
                                         const LitFigure& figure) {
  const BrdfModel source = builtin_brdf(fit.source.model), target = builtin_brdf(fit.target.model);
  std::vector<SphereMaterial> materials;
  for (const double value : options.specular)
    materials.push_back({source, figure.alpha, value, options.diffuse});
  for (const double value : options.specular)
    materials.push_back({target, figure.alpha, value, options.diffuse});
  for (const double value : figure.target_specular)
    materials.push_back({target, std::clamp(figure.target_alpha, 1e-4, 1.0), value, options.diffuse});
  return materials;
}

// Draws the three spheres of one alpha into a row of the sheet and compares them.
void show_row(const SpherePictures& pictures, const LitPreviewOptions& options, std::size_t row,
              LitPreview* preview) {
  const std::size_t count = options.specular.size();
  std::array<DisplayedSphere, kColumns> shown;
  std::vector<std::uint32_t> pixels;
  for (std::size_t column = 0; column < kColumns; ++column) {
    const CoveredPicture picture = covered_picture(pictures, column * count, count, options.resolution);
    pixels = covered_pixels(picture);
    shown[column] = displayed_sphere(chosen(picture, pixels), pixels, options.resolution);
    place_picture(&preview->sheet, cell_of(options), row, column, in_cell(options, pixels),
                  over_background(picture, pixels, shown[column].colors));
  }
  const auto similarity = [&](const DisplayedSphere& other) {
    return LitSimilarity{sphere_similarity(shown[0], other, pixels, options.resolution),
                         rms_difference(shown[0].colors, other.colors)};
  };
  preview->figures[row].copied = similarity(shown[1]);
  preview->figures[row].converted = similarity(shown[2]);
}

}  // namespace

std::vector<double> preview_alphas(const Domain& domain) {
  constexpr int kCount = 4;
  constexpr Range kShown{0.1, 0.7};
  Range shown{std::max(kShown.min, domain.alpha.min), std::min(kShown.max, domain.alpha.max)};
  if (!(shown.min < shown.max)) shown = domain.alpha;
  std::vector<double> alphas;
  for (int i = 0; i < kCount; ++i)
    alphas.push_back(shown.min * std::pow(shown.max / shown.min, i / (kCount - 1.0)));
  return alphas;
}

Preview make_preview(const Renderer& renderer, const Fit& fit, const PreviewOptions& wanted) {
  require_options(wanted);
  PreviewOptions options = wanted;
  fill(fit.domain, &options);
  const auto scale = parse_number(comment(fit, kLightScaleComment));
  const End source = make_end(renderer, fit, "source", fit.source, scale.value_or(1.0));
  const End target = make_end(renderer, fit, "target", fit.target, 1.0);
  constexpr std::size_t kRowsAShape = 3;
  const int side = options.resolution;
  Preview preview;
  preview.specular = options.specular;
  preview.sheet = contact_sheet(kRowsAShape * options.shapes.size(), options.alphas.size(), side);
  for (std::size_t s = 0; s < options.shapes.size(); ++s) {
    const Scene scene{side, options.samples_per_axis, options.light, 0, options.shapes[s]};
    for (const std::string& row : {"source\n" + fit.source.model, "conversion\n" + fit.target.model,
                                   "difference x " + short_number(kDifferenceGain)})
      preview.labels.rows.push_back(shape_name(scene.shape) + "\n" + row);
    const std::vector<std::uint32_t> pixels = shape_pixels(scene.shape, side);
    for (std::size_t a = 0; a < options.alphas.size(); ++a) {
      PreviewFigure figure{converted(fit, options.specular, options.alphas[a]), scene.shape};
      if (s == 0) preview.labels.columns.push_back(numbers_label(options.specular, figure));
      const Colors before =
          photograph(renderer, source, material_of(source, figure.alpha, options.specular), scene, pixels);
      const Colors after = photograph(
          renderer, target, material_of(target, figure.target_alpha, figure.target_specular), scene, pixels);
      figure.ssim = sphere_similarity(displayed_colors(before, pixels, side),
                                      displayed_colors(after, pixels, side), pixels, side);
      figure.rms = rms_difference(before, after);
      place_picture(&preview.sheet, side, kRowsAShape * s, a, pixels, before);
      place_picture(&preview.sheet, side, kRowsAShape * s + 1, a, pixels, after);
      place_picture(&preview.sheet, side, kRowsAShape * s + 2, a, pixels, difference(before, after));
      preview.figures.push_back(std::move(figure));
    }
  }
  return preview;
}

Environment environment_for_preview(const std::string& name_or_file, double exposure) {
  if (!(exposure > 0.0))
    throw Error(ErrorKind::kUsage, "--exposure: " + number_text(exposure) + " is not above 0");
  std::vector<Environment> known = builtin_environments();
  const auto found = std::ranges::find(known, name_or_file, &Environment::name);
  if (found == known.end() && !std::filesystem::exists(name_or_file))
    throw Error(ErrorKind::kUsage, "--environment: unknown environment '" + name_or_file + "' (choose " +
                                       environment_names(known) + ", or name an EXR or HDR file)");
  Environment environment = found == known.end() ? load_environment(name_or_file) : *found;
  const double scale = exposure / mean_luminance(environment);
  return exposed(std::move(environment), scale);
}

LitPreview make_lit_preview(const Fit& fit, const Environment& environment, const LitPreviewOptions& wanted) {
  for (const ModelSide* side : {&fit.source, &fit.target})
    if (const std::vector<ModelDescription> known = make_builtin_renderer()->models();
        std::ranges::none_of(known, [&](const ModelDescription& own) { return own.name == side->model; }))
      throw Error(ErrorKind::kUsage, "--environment: shows models of the built-in renderer only, and " +
                                         side->model +
                                         " is none (leave it out: a light shows models of workers, too)");
  LitPreviewOptions options = wanted;
  fill(fit.domain, &options);
  require_options(options);
  LitPreview preview{
      options.specular,
      {},
      contact_sheet(options.alphas.size(), kColumns, cell_of(options)),
      {{"source\n" + fit.source.model, "copied\n" + fit.target.model, "converted\n" + fit.target.model}, {}}};
  const RadiancePyramid pyramid(std::span(&environment, 1));
  SphereSampling sampling;
  sampling.resolution = options.resolution * options.samples_per_axis;
  sampling.samples = options.directions;
  for (const double alpha : options.alphas) {
    preview.figures.push_back({converted(fit, options.specular, alpha), {}, {}});
    preview.labels.rows.push_back(numbers_label(options.specular, preview.figures.back()));
    const SpherePictures pictures =
        render_spheres(pyramid, materials_of(fit, options, preview.figures.back()), sampling);
    show_row(pictures, options, preview.figures.size() - 1, &preview);
  }
  return preview;
}

}  // namespace remap
