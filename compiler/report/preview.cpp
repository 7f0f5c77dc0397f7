#include "report/preview.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "look/brdf.hpp"
#include "look/image.hpp"
#include "look/lit_sphere.hpp"
#include "lower/interpreter.hpp"
#include "measure/picture_taker.hpp"
#include "measure/sweep.hpp"
#include "measure/sweep_options.hpp"
#include "report/contact_sheet.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

constexpr std::size_t kColumns = 3;  // source, copied, converted

// Returns one side of the fit, ready to be rendered. Its response converts between the fit's specular and the
// model's own parameter.
ProbedModel make_end(const Renderer& renderer, const Fit& fit, const std::string& role, const ModelSide& side,
                     double exposure, double diffuse) {
  const ParameterRoles roles =
      recorded_roles(fit.table.comment(role + "_roughness_parameter"), fit.table.comment(role + "_specular"),
                     fit.table.comment(role + "_fixed"));
  ProbedModel end{recast(renderer.model(side.model), roles), {SpecularLaw::kAffine}, exposure};
  if (diffuse > 0.0 && !end.model.has(ParameterRole::kDiffuse))
    throw usage_error("--diffuse: " + side.model + " has no diffuse reflectance (remove this option)");
  if (end.model.parameter(ParameterRole::kSpecular).name != side.specular)
    end.response = specular_response(renderer, end.model);
  return end;
}

Material material_of(const ProbedModel& end, double alpha, const std::vector<double>& speculars,
                     double diffuse) {
  const ParameterDescription& specular = end.model.parameter(ParameterRole::kSpecular);
  const double clamped = std::clamp(alpha, end.model.alpha.min, end.model.alpha.max);
  Material material = grey_material(end.model, clamped, specular.range.min, diffuse);
  std::vector<double>& values = material.parameters[specular.name];
  values.clear();
  for (const double value : speculars)
    values.push_back(std::clamp(end.response.native(value), specular.range.min, specular.range.max));
  return material;
}

// A CoveredPicture holds a shape's linear radiance and the covered fraction of each pixel, row by row.
struct CoveredPicture {
  std::vector<float> radiance;  // red, green, blue; mean over the covered part of the pixel
  std::vector<float> coverage;  // 0 to 1
};

// Returns the fraction of each pixel that the sphere covers, from samples x samples points.
std::vector<float> sphere_coverage(int side, int samples) {
  const auto width = static_cast<std::size_t>(side), step = static_cast<std::size_t>(samples);
  std::vector<float> coverage(width * width, 0.0f);
  for (const std::uint32_t place : shape_pixels(Shape::kSphere, side * samples))
    coverage[place / (width * step) / step * width + place % (width * step) / step] +=
        1.0f / static_cast<float>(step * step);
  return coverage;
}

// Returns the pixel beside `pixel` in the direction of the picture's center.
std::size_t inner_pixel(std::size_t pixel, std::size_t width) {
  const auto inner = [&](std::size_t place) { return place < width / 2 ? place + 1 : place - 1; };
  return inner(pixel / width) * width + inner(pixel % width);
}

// Returns a picture whose channel c comes from material `first + c`, or from `first` if the specular is grey.
// If the center of a pixel at the rim misses the sphere, the pixel gets the color of its inner neighbour.
CoveredPicture covered_picture(const SpherePictures& pictures, std::size_t first, std::size_t material_count,
                               int samples) {
  const auto width = static_cast<std::size_t>(pictures.resolution());
  CoveredPicture picture{std::vector<float>(3 * width * width, 0.0f),
                         sphere_coverage(pictures.resolution(), samples)};
  std::vector<bool> is_known(width * width, false);
  for (const std::uint32_t pixel : pictures.pixels()) is_known[pixel] = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float> radiance = pictures.radiance(first + std::min(c, material_count - 1), 0);
    for (std::size_t i = 0; i < pictures.pixels().size(); ++i)
      picture.radiance[3 * pictures.pixels()[i] + c] = radiance[3 * i + c];
    for (std::size_t pixel = 0; pixel < is_known.size(); ++pixel)
      if (!is_known[pixel] && picture.coverage[pixel] > 0.0f)
        picture.radiance[3 * pixel + c] = picture.radiance[3 * inner_pixel(pixel, width) + c];
  }
  return picture;
}

// Returns pixels of which the shape covers at least a part.
std::vector<std::uint32_t> covered_pixels(const CoveredPicture& picture) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < picture.coverage.size(); ++i)
    if (picture.coverage[i] > 0.0f) pixels.push_back(static_cast<std::uint32_t>(i));
  return pixels;
}

std::vector<float> chosen(const CoveredPicture& picture, const std::vector<std::uint32_t>& pixels) {
  std::vector<float> radiance;
  for (const std::uint32_t pixel : pixels)
    for (std::size_t c = 0; c < 3; ++c) radiance.push_back(picture.radiance[3 * pixel + c]);
  return radiance;
}

// Returns display values over the background of the sheet, so that a rim is smooth.
std::vector<float> over_background(const CoveredPicture& picture, const std::vector<std::uint32_t>& pixels,
                                   std::vector<float> colors) {
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float share = picture.coverage[pixels[i]];
      colors[3 * i + c] = share * colors[3 * i + c] + (1.0f - share) * kSheetBackground;
    }
  return colors;
}

using RowPictures = std::array<CoveredPicture, kColumns>;

// A RowProgress receives the finished fraction of a row's work, 0 to 1.
using RowProgress = std::function<void(double)>;

// A LampStudio renders rows under a point light.
class LampStudio {
 public:
  LampStudio(const Renderer& renderer, const Fit& fit, const PreviewOptions& options, const Light& light)
      : renderer_(renderer),
        options_(options),
        light_(light),
        source_(make_end(renderer, fit, "source", fit.source,
                         parse_number(fit.table.comment(kLightScaleComment)).value_or(1.0), options.diffuse)),
        target_(make_end(renderer, fit, "target", fit.target, 1.0, options.diffuse)) {}

  RowPictures operator()(const PreviewFigure& figure, const RowProgress& progress) const {
    RowPictures row;
    row[0] = photograph(source_, figure.alpha, options_.specular, figure.shape);
    progress(1.0 / kColumns);
    row[1] = photograph(target_, figure.alpha, options_.specular, figure.shape);
    progress(2.0 / kColumns);
    row[2] = photograph(target_, figure.target_alpha, figure.target_specular, figure.shape);
    return row;
  }

 private:
  CoveredPicture photograph(const ProbedModel& end, double alpha, const std::vector<double>& specular,
                            Shape shape) const {
    const Image image = renderer_.render(material_of(end, alpha, specular, options_.diffuse),
                                         {options_.resolution, options_.samples_per_axis, light_, 0, shape});
    const auto channels = static_cast<std::size_t>(image.channels);
    const double nearest = light_.distance - 1.0;
    const double exposure = end.exposure * std::numbers::pi * nearest * nearest;
    const std::size_t count = image.values.size() / channels;
    CoveredPicture picture{std::vector<float>(3 * count), std::vector<float>(count, 0.0f)};
    for (const std::uint32_t pixel : shape_pixels(shape, options_.resolution)) {
      picture.coverage[pixel] = 1.0f;
      for (std::size_t c = 0; c < 3; ++c)
        picture.radiance[3 * pixel + c] = static_cast<float>(
            exposure * static_cast<double>(image.values[channels * pixel + std::min(c, channels - 1)]));
    }
    return picture;
  }

  const Renderer& renderer_;
  const PreviewOptions& options_;
  Light light_;
  ProbedModel source_, target_;
};

// An EnvironmentStudio renders rows under an environment.
class EnvironmentStudio {
 public:
  EnvironmentStudio(const Fit& fit, const PreviewOptions& options, const Environment& environment)
      : options_(options),
        source_(lobe_of(fit.source, environment)),
        target_(lobe_of(fit.target, environment)),
        pyramid_(std::span(&environment, 1), kMapRows) {
    sampling_.resolution = options.resolution;
    sampling_.samples = options.directions;
    sampling_.shares_directions = true;
  }

  RowPictures operator()(const PreviewFigure& figure, const RowProgress& progress) const {
    std::vector<SphereMaterial> materials;
    const auto add = [&](const BrdfModel& model, double alpha, const std::vector<double>& specular) {
      for (const double value : specular)
        materials.push_back({model, std::clamp(alpha, 1e-4, 1.0), value, options_.diffuse});
    };
    add(source_, figure.alpha, options_.specular);
    add(target_, figure.alpha, options_.specular);
    add(target_, figure.target_alpha, figure.target_specular);
    SphereSampling sampling = sampling_;
    std::atomic<int> lines = 0;
    sampling.progress = [&] { progress(static_cast<double>(++lines) / sampling_.resolution); };
    const SpherePictures pictures = render_spheres(pyramid_, materials, sampling);
    RowPictures row;
    const std::size_t count = options_.specular.size();
    for (std::size_t column = 0; column < kColumns; ++column)
      row[column] = covered_picture(pictures, column * count, count, options_.samples_per_axis);
    return row;
  }

 private:
  // The map is coarse, because each spot of light costs as much as a sample, and a finer map has more
  // spots.
  static constexpr int kMapRows = 64;

  static BrdfModel lobe_of(const ModelSide& side, const Environment& environment) {
    if (!is_linear_lobe(side.model))
      throw usage_error("--light " + environment.name + ": cannot light " + side.model +
                        ", which is not a built-in model with a scale or F0 (use --light 45)");
    return builtin_brdf(side.model);
  }

  const PreviewOptions& options_;
  BrdfModel source_, target_;
  RadiancePyramid pyramid_;
  SphereSampling sampling_;
};

PreviewFigure converted(const Fit& fit, const std::vector<double>& specular, const std::string& light,
                        Shape shape, double alpha) {
  PreviewFigure figure{light, shape, alpha, {}, std::vector<double>(specular.size()), true, {}, {}};
  const double own = evaluate_texel(fit, from_alpha(fit.source.roughness, alpha), specular,
                                    figure.target_specular, &figure.in_domain);
  figure.target_alpha = to_alpha(fit.target.roughness, own);
  return figure;
}

void require_options(const PreviewOptions& options) {
  if (options.lights.empty() || options.shapes.empty())
    throw usage_error("preview: at least one light and one shape are required");
  if (options.specular.size() != 1 && options.specular.size() != 3)
    throw usage_error("--specular: " + std::to_string(options.specular.size()) +
                      " values given (use one value, or R,G,B)");
  for (const double alpha : options.alphas)
    if (!(alpha > 0.0 && alpha <= 1.0))
      throw usage_error("--alpha: " + number_text(alpha) + " is outside 0 to 1");
  if (!(options.diffuse >= 0.0 && options.diffuse <= 1.0))
    throw usage_error("--diffuse: " + number_text(options.diffuse) + " is outside 0 to 1");
}

std::string short_number(double value) { return number_text(rounded(value, 3)); }

std::string short_list(std::vector<double> values) {
  for (double& value : values) value = rounded(value, 3);
  return listed(values);
}

// Returns a label with the scene, the numbers of the source, and the converted numbers.
std::string row_label(const std::vector<double>& specular, const PreviewFigure& figure) {
  return figure.light + ", " + shape_name(figure.shape) + "\nalpha " + short_number(figure.alpha) + "\n-> " +
         short_number(figure.target_alpha) + "\nspecular " + short_list(specular) + "\n-> " +
         short_list(figure.target_specular);
}

// Returns the shapes that `light` shows.
std::vector<Shape> lit_shapes(const PreviewLight& light, const std::vector<Shape>& shapes) {
  if (std::holds_alternative<Light>(light.light)) return shapes;
  if (std::ranges::find(shapes, Shape::kSphere) == shapes.end())
    throw usage_error("--light " + light.name + ": lights spheres only (add --shape sphere)");
  return {Shape::kSphere};
}

// A SheetFiller fills a preview row by row.
class SheetFiller {
 public:
  SheetFiller(const Fit& fit, const PreviewOptions& options, std::size_t rows)
      : fit_(fit), options_(options), rows_(rows) {
    preview_.specular = options.specular;
    preview_.labels.columns = {"source\n" + fit.source.model, "copied\n" + fit.target.model,
                               "converted\n" + fit.target.model};
    preview_.sheet = contact_sheet(rows, kColumns, cell_side(options.resolution));
  }

  void add_rows(const std::string& light, Shape shape, const auto& studio) {
    for (const double alpha : options_.alphas) {
      PreviewFigure figure = converted(fit_, options_.specular, light, shape, alpha);
      add_pictures(studio(figure, [&](double share) { tell(share); }), figure);
      preview_.labels.rows.push_back(row_label(options_.specular, figure));
      preview_.figures.push_back(std::move(figure));
      tell(0.0);
    }
  }

  Preview result() { return std::move(preview_); }

 private:
  // Reports progress. `share` is the finished fraction of the current row.
  void tell(double share) const {
    const double finished = static_cast<double>(preview_.figures.size()) + share;
    if (options_.progress) options_.progress(finished / static_cast<double>(rows_));
  }

  // Compares the pictures, and places them in the next row of the sheet.
  void add_pictures(const RowPictures& pictures, PreviewFigure& figure) {
    const std::vector<std::uint32_t> pixels = covered_pixels(pictures[0]);
    const std::vector<std::uint32_t> places = pixels_of_cell(pixels, options_.resolution);
    std::array<DisplayedSphere, kColumns> shown;
    for (std::size_t column = 0; column < kColumns; ++column) {
      shown[column] = displayed_sphere(chosen(pictures[column], pixels), pixels, options_.resolution);
      place_picture(&preview_.sheet, cell_side(options_.resolution), preview_.figures.size(), column, places,
                    over_background(pictures[column], pixels, shown[column].colors));
    }
    const auto similarity = [&](const DisplayedSphere& other) {
      return picture_error(shown[0], other, pixels, options_.resolution);
    };
    figure.copied = similarity(shown[1]);
    figure.converted = similarity(shown[2]);
  }

  const Fit& fit_;
  const PreviewOptions& options_;
  const std::size_t rows_;
  Preview preview_;
};

Environment environment_of(const std::string& name_or_file, double exposure) {
  std::vector<Environment> known = builtin_environments();
  const auto found = std::ranges::find(known, name_or_file, &Environment::name);
  if (found == known.end() && !std::filesystem::exists(name_or_file))
    throw usage_error("--light: unknown light '" + name_or_file +
                      "' (choose headlight, degrees from -180 to 180, " + environment_names(known) +
                      ", or give an EXR or HDR file)");
  Environment environment = found == known.end() ? load_environment(name_or_file) : *found;
  const double scale = exposure / mean_luminance(environment);
  return exposed(std::move(environment), scale);
}

}  // namespace

PreviewLight preview_light(const std::string& word, double distance, double exposure) {
  const auto angle = word == "headlight" ? 0.0 : parse_number(word);
  if (!angle) return {word, environment_of(word, exposure)};
  if (!(*angle > -180.0 && *angle <= 180.0))
    throw usage_error("--light: " + word + " is outside -180 to 180 degrees");
  return {word == "headlight" ? word : word + " degrees", Light{*angle, distance}};
}

std::string default_light(const Fit& fit, const std::vector<Shape>& shapes) {
  const bool has_sphere = std::ranges::find(shapes, Shape::kSphere) != shapes.end();
  return has_sphere && is_linear_lobe(fit.source.model) && is_linear_lobe(fit.target.model) ? "studio" : "45";
}

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
  PreviewOptions options = wanted;
  if (options.alphas.empty()) options.alphas = preview_alphas(fit.domain);
  if (options.specular.empty()) options.specular = {0.5 * fit.domain.specular.max};
  require_options(options);
  std::vector<std::vector<Shape>> shapes;  // shapes under each light
  std::size_t rows = 0;
  for (const PreviewLight& light : options.lights) {
    shapes.push_back(lit_shapes(light, options.shapes));
    rows += shapes.back().size() * options.alphas.size();
  }
  SheetFiller sheet(fit, options, rows);
  for (std::size_t i = 0; i < options.lights.size(); ++i) {
    const PreviewLight& light = options.lights[i];
    const auto show = [&](const auto& studio) {
      for (const Shape shape : shapes[i]) sheet.add_rows(light.name, shape, studio);
    };
    if (const auto* environment = std::get_if<Environment>(&light.light))
      show(EnvironmentStudio(fit, options, *environment));
    else
      show(LampStudio(renderer, fit, options, std::get<Light>(light.light)));
  }
  return sheet.result();
}

}  // namespace remap
