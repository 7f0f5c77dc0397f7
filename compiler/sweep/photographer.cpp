#include "sweep/photographer.hpp"

#include <algorithm>
#include <cmath>

#include "error.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

// Pictures are floats: three of them combined are good to a few 2^-24 of the brightest pixel.
constexpr double kAffineTolerance = 2e-6;

float brightest(const std::vector<float>& picture) {
  return *std::max_element(picture.begin(), picture.end());
}

// One value a pixel of a grey picture.
float grey_value(const Image& image, std::size_t pixel, const std::string& model) {
  if (image.channels == 1) return image.values[pixel];
  const float* rgb = &image.values[3 * pixel];
  const float tolerance = 1e-4f * std::max({rgb[0], rgb[1], rgb[2], 1e-6f});
  if (std::fabs(rgb[0] - rgb[1]) > tolerance || std::fabs(rgb[0] - rgb[2]) > tolerance)
    throw Error(ErrorKind::kInput,
                model + ": the picture of a grey material has colour; expected equal channels");
  return rgb[1];
}

}  // namespace

Photographer::Photographer(const Renderer& renderer, const Objective& objective, int resolution,
                           int samples_per_axis)
    : renderer_(renderer),
      objective_(objective),
      resolution_(resolution),
      samples_per_axis_(samples_per_axis) {
  const std::vector<float> cosines = remapc::view_cosines(resolution, samples_per_axis);
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    if (cosines[i] <= 0.0f) continue;
    pixels_.push_back(i);
    cosines_.push_back(cosines[i]);
  }
  if (pixels_.empty())
    throw Error(ErrorKind::kUsage, "resolution: no pixel shows the sphere; expected more pixels");
}

std::vector<float> Photographer::take(const ModelDescription& model, const Sitting& sitting) const {
  const Material material = grey_material(model, sitting.alpha, sitting.specular, sitting.diffuse);
  std::vector<float> row;
  row.reserve(pixels_.size() * objective_.lights.size());
  for (const Light& light : objective_.lights) {
    const Image image = renderer_.render(material, Scene{resolution_, samples_per_axis_, light});
    const auto side = static_cast<std::size_t>(resolution_);
    const bool complete = image.width == resolution_ && image.height == resolution_ &&
                          (image.channels == 1 || image.channels == 3) &&
                          image.values.size() == side * side * static_cast<std::size_t>(image.channels);
    if (!complete)
      throw Error(ErrorKind::kInput, model.name + ": the picture is " + std::to_string(image.width) + " x " +
                                         std::to_string(image.height) + " with " +
                                         std::to_string(image.channels) + " channels; expected " +
                                         std::to_string(resolution_) + " squared, 1 or 3");
    for (const std::size_t pixel : pixels_) {
      const float value = grey_value(image, pixel, model.name);
      if (!std::isfinite(value))
        throw Error(ErrorKind::kInput, model.name + ": the picture has a pixel that is not finite");
      row.push_back(value);
    }
  }
  return row;
}

SpecularResponse probe_specular(const Photographer& photographer, const ModelDescription& model,
                                const remap::Range& alphas, double max_specular) {
  SpecularResponse response{true, true, 0.0};
  for (const double alpha : {alphas.min, std::sqrt(alphas.min * alphas.max), alphas.max}) {
    const auto black = photographer.take(model, {alpha, 0.0, 0.0});
    const auto half = photographer.take(model, {alpha, 0.5 * max_specular, 0.0});
    const auto full = photographer.take(model, {alpha, max_specular, 0.0});
    const double scale = brightest(full);
    if (!(scale > 0.0))
      throw Error(ErrorKind::kInput,
                  model.name + ": the picture at full specular is black; expected a highlight");
    for (std::size_t i = 0; i < full.size(); ++i) {
      const double deviation = std::fabs(0.5 * (static_cast<double>(black[i]) + full[i]) - half[i]) / scale;
      response.residual = std::max(response.residual, deviation);
      if (black[i] != 0.0f) response.proportional = false;
    }
  }
  response.affine = response.residual <= kAffineTolerance;
  response.proportional = response.proportional && response.affine;
  return response;
}

DiffuseMatch match_diffuse(const Photographer& photographer, const ModelDescription& source,
                           const ModelDescription& target) {
  const auto diffuse_picture = [&](const ModelDescription& model) {
    const double alpha = std::sqrt(model.alpha.min * model.alpha.max);
    std::vector<float> picture = photographer.take(model, {alpha, 0.0, 1.0});
    const std::vector<float> without = photographer.take(model, {alpha, 0.0, 0.0});
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] -= without[i];
    return picture;
  };
  const std::vector<float> wanted = diffuse_picture(source), given = diffuse_picture(target);
  double wanted_2 = 0.0, cross = 0.0, given_2 = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const double a = wanted[i], b = given[i];
    wanted_2 += a * a, cross += a * b, given_2 += b * b;
  }
  if (!(wanted_2 > 0.0) || !(given_2 > 0.0))
    throw Error(ErrorKind::kInput, source.name + " to " + target.name + ": a diffuse picture is black");
  const double left = std::max(0.0, wanted_2 - cross * cross / given_2);
  return {cross / given_2, std::sqrt(left / wanted_2)};
}

}  // namespace remapc
