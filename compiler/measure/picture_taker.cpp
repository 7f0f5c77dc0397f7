#include "measure/picture_taker.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"

namespace remap {
namespace {

// Throws kInput if the picture's size or channel count differs from the scene.
void require_form(const Image& image, int resolution, const std::string& model) {
  const auto side = static_cast<std::size_t>(resolution);
  const bool complete = image.width == resolution && image.height == resolution &&
                        (image.channels == 1 || image.channels == 3) &&
                        image.values.size() == side * side * static_cast<std::size_t>(image.channels);
  if (!complete)
    throw input_error(model + ": the picture is " + std::to_string(image.width) + " x " +
                      std::to_string(image.height) + " with " + std::to_string(image.channels) +
                      " channels (must be " + std::to_string(resolution) + " x " +
                      std::to_string(resolution) + " with 1 or 3)");
}

// Returns true if the picture at specular 0 is known to be black. It then need not be rendered.
bool has_no_base(const ProbedModel& probed_model) {
  return probed_model.response.proportional() && probed_model.linear_range().min == 0.0;
}

}  // namespace

PictureTaker::PictureTaker(const Renderer& renderer, const Objective& objective, int resolution,
                           int samples_per_axis)
    : renderer_(renderer),
      objective_(objective),
      resolution_(resolution),
      samples_per_axis_(samples_per_axis) {
  const std::vector<float> cosines = remap::view_cosines(resolution, samples_per_axis);
  for (std::size_t i = 0; i < cosines.size(); ++i) {
    if (cosines[i] <= 0.0f) continue;
    pixels_.push_back(i);
    cosines_.push_back(cosines[i]);
  }
  if (pixels_.empty()) throw usage_error("resolution: no pixel shows the sphere (use a higher resolution)");
}

std::vector<std::vector<float>> PictureTaker::take_channels(const Material& material) const {
  std::vector<std::vector<float>> rows;
  for (const Light& light : objective_.lights) {
    const Image image = renderer_.render(material, Scene{resolution_, samples_per_axis_, light});
    require_form(image, resolution_, material.model);
    const auto channels = static_cast<std::size_t>(image.channels);
    rows.resize(channels);
    for (std::size_t c = 0; c < channels; ++c) {
      double sum = 0.0;
      for (const std::size_t pixel : pixels_) {
        const float value = image.values[channels * pixel + c];
        if (!std::isfinite(value))
          throw input_error(material.model + ": a pixel of the picture is infinite or NaN");
        rows[c].push_back(value);
        sum += static_cast<double>(value);
      }
      if (objective_.compares_means())
        rows[c].push_back(static_cast<float>(sum / (static_cast<double>(resolution_) * resolution_)));
    }
  }
  return rows;
}

std::vector<float> PictureTaker::take(const Material& material) const {
  std::vector<std::vector<float>> rows = take_channels(material);
  if (rows.size() == 1) return std::move(rows[0]);
  for (std::size_t i = 0; i < rows[1].size(); ++i) {
    const float red = rows[0][i], green = rows[1][i], blue = rows[2][i];
    const float tolerance = 1e-4f * std::max({red, green, blue, 1e-6f});
    if (std::fabs(red - green) > tolerance || std::fabs(red - blue) > tolerance)
      throw input_error(material.model +
                        ": the picture of a grey material is colored; its channels must be equal");
  }
  return std::move(rows[1]);
}

PictureWeights PictureTaker::weights(const std::vector<float>& source) const {
  return squared_weights(objective_, source, cosines_);
}

std::vector<float> PictureTaker::square_picture(const std::vector<float>& row) const {
  const auto side = static_cast<std::size_t>(resolution_);
  std::vector<float> square(side * side, 0.0f);
  for (std::size_t i = 0; i < pixels_.size(); ++i) square[pixels_[i]] = row[i];
  return square;
}

std::vector<float> PictureTaker::take(const ModelDescription& model, const RoleValues& role_values) const {
  Material material = grey_material(model, role_values.alpha, role_values.specular, role_values.diffuse);
  for (const auto& [name, value] : role_values.others) material.parameters[name] = {value};
  return take(material);
}

std::vector<float> PictureTaker::take(const ProbedModel& probed_model, const RoleValues& role_values) const {
  const Range own = probed_model.model.parameter(ParameterRole::kSpecular).range;
  const double specular = std::clamp(probed_model.response.native(role_values.specular), own.min, own.max);
  std::vector<float> picture = take(
      probed_model.model, RoleValues{role_values.alpha, specular, role_values.diffuse, role_values.others});
  if (probed_model.exposure != 1.0)
    for (float& value : picture) value = static_cast<float>(value * probed_model.exposure);
  return picture;
}

Range ProbedModel::specular_range() const {
  const Range own = model.parameter(ParameterRole::kSpecular).range;
  return {response.canonical(own.min), response.canonical(own.max)};
}

Range ProbedModel::linear_range() const {
  const Range whole = specular_range();
  return {whole.min, response.law == SpecularLaw::kClamped ? response.knee : whole.max};
}

Range ProbedModel::diffuse_range() const {
  if (!model.has(ParameterRole::kDiffuse)) return {0.0, 0.0};
  return model.parameter(ParameterRole::kDiffuse).range;
}

std::optional<SpecularFamily> ProbedModel::family() const {
  if (!response.affine()) return curve;
  const Range range = linear_range();
  return affine_family(range, has_no_base(*this));
}

AffinePictures take_affine(const PictureTaker& picture_taker, const ProbedModel& probed_model, double alpha) {
  const Range range = probed_model.linear_range();
  AffinePictures pictures;
  pictures.full = picture_taker.take(probed_model, {alpha, range.max, 0.0});
  if (has_no_base(probed_model))
    pictures.base.resize(pictures.full.size());
  else
    pictures.base = picture_taker.take(probed_model, {alpha, range.min, 0.0});
  pictures.slope.resize(pictures.base.size());
  const double scale = 1.0 / (range.max - range.min);
  for (std::size_t i = 0; i < pictures.base.size(); ++i) {
    pictures.slope[i] =
        static_cast<float>((static_cast<double>(pictures.full[i]) - pictures.base[i]) * scale);
    if (range.min != 0.0)
      pictures.base[i] = static_cast<float>(pictures.base[i] - range.min * pictures.slope[i]);
  }
  return pictures;
}

std::vector<std::vector<float>> take_family(const PictureTaker& picture_taker,
                                            const ProbedModel& probed_model, double alpha) {
  std::vector<std::vector<float>> pictures;
  if (probed_model.response.affine()) {
    AffinePictures affine = take_affine(picture_taker, probed_model, alpha);
    if (!has_no_base(probed_model)) pictures.push_back(std::move(affine.base));
    pictures.push_back(std::move(affine.slope));
    return pictures;
  }
  for (const double specular : probed_model.curve.value().speculars)
    pictures.push_back(picture_taker.take(probed_model, {alpha, specular, 0.0}));
  return pictures;
}

}  // namespace remap
