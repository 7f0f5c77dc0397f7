#include "report/preview.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/interpreter.hpp"
#include "probe/parameter_roles.hpp"
#include "remap/error.hpp"
#include "renderer/image_similarity.hpp"
#include "report/color.hpp"
#include "report/contact_sheet.hpp"
#include "sweep/sweep.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

constexpr float kDifferenceGain = 4.0f;

// One side of the fit, ready to be rendered.
struct End {
  ModelDescription model;
  SpecularResponse response;  // between the fit's specular and the model's own
  double exposure = 1.0;
};

std::string comment(const remap::Fit& fit, const std::string& key) {
  const auto found = fit.table.comments.find(key);
  return found == fit.table.comments.end() ? "" : found->second;
}

End make_end(const Renderer& renderer, const remap::Fit& fit, const std::string& role,
             const remap::ModelSide& side, double exposure) {
  const ParameterRoles roles =
      recorded_roles(comment(fit, role + "_roughness_parameter"), comment(fit, role + "_specular"),
                     comment(fit, role + "_fixed"));
  End end{recast(find_model(renderer, side.model), roles), {SpecularLaw::kAffine}, exposure};
  if (end.model.parameter(ParameterRole::kSpecular).name != side.specular)
    end.response = specular_response(renderer, end.model);
  return end;
}

Material material_of(const End& end, double alpha, const std::vector<double>& speculars) {
  const ParameterDescription& specular = end.model.parameter(ParameterRole::kSpecular);
  const double held = std::clamp(alpha, end.model.alpha.min, end.model.alpha.max);
  Material material = grey_material(end.model, held, specular.range.min, 0.0);
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

double similarity(const Colors& a, const Colors& b, const std::vector<std::uint32_t>& pixels, int side) {
  const auto luma = [&](const Colors& colors) {
    std::vector<float> square(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      square[pixels[i]] = static_cast<float>(luminance(&colors[3 * i]));
    return square;
  };
  const std::vector<float> map = similarity_map(luma(a), luma(b), side, side);
  double sum = 0.0;
  for (const std::uint32_t pixel : pixels) sum += static_cast<double>(map[pixel]);
  return sum / static_cast<double>(pixels.size());
}

Colors difference(const Colors& a, const Colors& b) {
  Colors result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    result[i] = std::min(1.0f, kDifferenceGain * std::fabs(a[i] - b[i]));
  return result;
}

// Converts the source by the fit. `figure` has the source's alpha.
void convert(const remap::Fit& fit, const std::vector<double>& specular, PreviewFigure* figure) {
  figure->target_specular.resize(specular.size());
  const double own = remap::evaluate_texel(fit, remap::from_alpha(fit.source.roughness, figure->alpha),
                                           specular, figure->target_specular, &figure->in_domain);
  figure->target_alpha = remap::to_alpha(fit.target.roughness, own);
}

void require_options(const PreviewOptions& options) {
  if (options.shapes.empty()) throw Error(ErrorKind::kUsage, "preview: at least one shape is required");
  if (!options.specular.empty() && options.specular.size() != 1 && options.specular.size() != 3)
    throw Error(ErrorKind::kUsage,
                "preview: specular must have 1 or 3 values, not " + std::to_string(options.specular.size()));
  for (const double alpha : options.alphas)
    if (!(alpha > 0.0))
      throw Error(ErrorKind::kUsage, "preview: alpha " + remap::number_text(alpha) + " must be above 0");
}

// Fills missing options from the domain of `fit`.
PreviewOptions filled(PreviewOptions options, const remap::Fit& fit) {
  if (options.alphas.empty()) options.alphas = preview_alphas(fit.domain);
  if (options.specular.empty()) options.specular = {0.5 * fit.domain.specular.max};
  return options;
}

}  // namespace

std::vector<double> preview_alphas(const remap::Domain& domain) {
  constexpr int kCount = 4;
  constexpr remap::Range kShown{0.1, 0.7};
  remap::Range shown{std::max(kShown.min, domain.alpha.min), std::min(kShown.max, domain.alpha.max)};
  if (!(shown.min < shown.max)) shown = domain.alpha;
  std::vector<double> alphas;
  for (int i = 0; i < kCount; ++i)
    alphas.push_back(shown.min * std::pow(shown.max / shown.min, i / (kCount - 1.0)));
  return alphas;
}

Preview make_preview(const Renderer& renderer, const remap::Fit& fit, const PreviewOptions& wanted) {
  require_options(wanted);
  const PreviewOptions options = filled(wanted, fit);
  const auto scale = remap::parse_number(comment(fit, "irradiance_scale"));
  const End source = make_end(renderer, fit, "source", fit.source, scale.value_or(1.0));
  const End target = make_end(renderer, fit, "target", fit.target, 1.0);
  constexpr std::size_t kRowsAShape = 3;
  const int side = options.resolution;
  Preview preview;
  preview.specular = options.specular;
  preview.sheet = contact_sheet(kRowsAShape * options.shapes.size(), options.alphas.size(), side);
  for (std::size_t s = 0; s < options.shapes.size(); ++s) {
    const Scene scene{side, options.samples_per_axis, options.light, 0, options.shapes[s]};
    const std::vector<std::uint32_t> pixels = shape_pixels(scene.shape, side);
    for (std::size_t a = 0; a < options.alphas.size(); ++a) {
      PreviewFigure figure;
      figure.shape = scene.shape;
      figure.alpha = options.alphas[a];
      convert(fit, options.specular, &figure);
      const Colors before =
          photograph(renderer, source, material_of(source, figure.alpha, options.specular), scene, pixels);
      const Colors after = photograph(
          renderer, target, material_of(target, figure.target_alpha, figure.target_specular), scene, pixels);
      figure.ssim = similarity(before, after, pixels, side);
      figure.rms = rms_difference(before, after);
      place_picture(&preview.sheet, side, kRowsAShape * s, a, pixels, before);
      place_picture(&preview.sheet, side, kRowsAShape * s + 1, a, pixels, after);
      place_picture(&preview.sheet, side, kRowsAShape * s + 2, a, pixels, difference(before, after));
      preview.figures.push_back(std::move(figure));
    }
  }
  return preview;
}

}  // namespace remapc
