// This file renders the built-in models in the sweep scene, in double precision. The only approximation is
// the average over a pixel.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "look/brdf.hpp"
#include "remap/version.hpp"
#include "renderer/fresnel.hpp"
#include "renderer/renderer.hpp"

namespace remap {
namespace {

// Dielectrics range from no boundary to germanium in the infrared. Conductors have the measured indices of
// visible light. These include 0, which some measurements have after their conversion to a color space.
constexpr Range kIorRange{1.0, 4.0};
constexpr Range kEtaRange{0.0, 12.0};
constexpr Range kExtinctionRange{0.0, 20.0};
// This is the F0 of a dielectric whose `specular` is 1 (Burley 2012). At 0.5, F0 is 4 % (index 1.5), and at
// 0.375 it is 3 %, as in the paper.
constexpr double kDielectricF0 = 0.08;

std::vector<ParameterDescription> specular_parameters(Reflectance reflectance) {
  switch (reflectance) {
    case Reflectance::kScale:
      return {{"specular", ParameterRole::kSpecular, {0.0, 1.0}}};
    case Reflectance::kTrimmedScale:
      return {{"specular", ParameterRole::kSpecular, {0.0, 2.0}}};
    case Reflectance::kSchlick:
      return {{"f0", ParameterRole::kSpecular, {0.0, 1.0}}};
    case Reflectance::kSchlickIor:
    case Reflectance::kDielectric:
      return {{"ior", ParameterRole::kSpecular, kIorRange}};
    case Reflectance::kConductor:
      return {{"eta", ParameterRole::kIndex, kEtaRange}, {"k", ParameterRole::kExtinction, kExtinctionRange}};
    case Reflectance::kMetallic:
      return {{"base_color", ParameterRole::kSpecular, {0.0, 1.0}},
              {"metallic", ParameterRole::kOther, {0.0, 1.0}, 1.0, true},
              {"specular", ParameterRole::kOther, {0.0, 1.0}, 0.5, true}};
  }
  return {};
}

ModelDescription describe(const BuiltinModel& model) {
  const double bound_a = from_alpha(model.roughness, model.alpha.min);
  const double bound_b = from_alpha(model.roughness, model.alpha.max);
  ModelDescription description{model.name,
                               model.roughness,
                               model.alpha,
                               {{std::string(encoding_name(model.roughness)),
                                 ParameterRole::kRoughness,
                                 {std::min(bound_a, bound_b), std::max(bound_a, bound_b)}}}};
  for (ParameterDescription& parameter : specular_parameters(model.reflectance))
    description.parameters.push_back(std::move(parameter));
  if (model.reflectance != Reflectance::kMetallic)
    description.parameters.push_back({"diffuse", ParameterRole::kDiffuse, {0.0, 1.0}});
  return description;
}

// A LitSample is one lit sample of the picture: its pixel, its directions, and cos_light / distance^2 divided
// by the number of samples in the pixel.
struct LitSample {
  std::uint32_t pixel;
  LocalGeometry geometry;
  double irradiance;
};

std::vector<LitSample> lit_samples(const Scene& scene) {
  const double angle = scene.light.angle * std::numbers::pi / 180.0;
  const double light_x = scene.light.distance * std::sin(angle),
               light_z = scene.light.distance * std::cos(angle);
  const double step = 1.0 / scene.samples_per_axis;
  std::vector<LitSample> samples;
  for (int row = 0; row < scene.resolution * scene.samples_per_axis; ++row) {
    for (int column = 0; column < scene.resolution * scene.samples_per_axis; ++column) {
      SurfaceHit hit;
      if (!shape_point(scene.shape, scene.resolution, (column + 0.5) * step, (row + 0.5) * step, &hit))
        continue;
      const Vector3 &p = hit.position, &n = hit.normal;
      double lx = light_x - p.x, ly = -p.y, lz = light_z - p.z;
      const double light_distance = std::sqrt(lx * lx + ly * ly + lz * lz);
      lx /= light_distance, ly /= light_distance, lz /= light_distance;
      double vx = -p.x, vy = -p.y, vz = kCameraDistance - p.z;
      const double view_distance = std::sqrt(vx * vx + vy * vy + vz * vz);
      vx /= view_distance, vy /= view_distance, vz /= view_distance;
      const double cos_light = lx * n.x + ly * n.y + lz * n.z;
      const double cos_view = vx * n.x + vy * n.y + vz * n.z;
      if (cos_light <= 0.0 || cos_view <= 0.0) continue;
      if (is_shadowed(scene.shape, hit, {light_x, 0.0, light_z})) continue;
      const double cos_between = lx * vx + ly * vy + lz * vz;
      const int pixel = row / scene.samples_per_axis * scene.resolution + column / scene.samples_per_axis;
      samples.push_back({static_cast<std::uint32_t>(pixel), local_geometry(cos_light, cos_view, cos_between),
                         cos_light / (light_distance * light_distance) * step * step});
    }
  }
  return samples;
}

class BuiltinRenderer final : public Renderer {
 public:
  std::string version() const override { return std::string("remapc ") + kVersion; }

  std::vector<ModelDescription> models() const override {
    std::vector<ModelDescription> descriptions;
    for (const BuiltinModel& model : builtin_models()) descriptions.push_back(describe(model));
    return descriptions;
  }

  Image render(const Material& material, const Scene& scene) const override;

 private:
  // Returns the samples of a scene. They are kept, because they depend only on the scene, and a sweep uses
  // few scenes.
  std::shared_ptr<const std::vector<LitSample>> samples_of(const Scene& scene) const;

  mutable std::mutex mutex_;
  mutable std::map<std::string, std::shared_ptr<const std::vector<LitSample>>> samples_;
};

void require_scene(const Scene& scene) {
  if (scene.resolution < 1 || scene.resolution > 16384)
    throw usage_error("resolution: " + std::to_string(scene.resolution) + " is out of range (1 to 16384)");
  if (scene.samples_per_axis < 1 || scene.samples_per_axis > 64)
    throw usage_error("pixel samples: " + std::to_string(scene.samples_per_axis) +
                      " is out of range (1 to 64)");
  if (!(scene.light.distance > 1.0))
    throw usage_error("light distance: " + number_text(scene.light.distance) +
                      " is inside the sphere (use more than 1, its radius)");
}

std::shared_ptr<const std::vector<LitSample>> BuiltinRenderer::samples_of(const Scene& scene) const {
  const std::string key = std::to_string(scene.resolution) + "/" + std::to_string(scene.samples_per_axis) +
                          "/" + light_name(scene.light) + "/" + shape_name(scene.shape);
  const std::lock_guard lock(mutex_);
  auto& samples = samples_[key];
  if (!samples) samples = std::make_shared<const std::vector<LitSample>>(lit_samples(scene));
  return samples;
}

// A LobeChannel holds the parameters of one color channel.
struct LobeChannel {
  double specular = 0.0;  // scale, F0, or the index of a dielectric
  double eta = 0.0, k = 0.0;
  double diffuse = 0.0;
  double metallic = 0.0, level = 0.0;  // for kMetallic, whose base color is in `specular`
};

// Converts base color, metallic and specular level to diffuse and F0 (Sztrajman et al. 2019, equation 2).
LobeChannel layered(const LobeChannel& metal) {
  LobeChannel channel = metal;
  channel.diffuse = metal.specular * (1.0 - metal.metallic);
  channel.specular = kDielectricF0 * metal.level * (1.0 - metal.metallic) + metal.specular * metal.metallic;
  return channel;
}

double channel_value(const std::vector<double>& values, std::size_t channel) {
  return values[values.size() == 1 ? 0 : channel];
}

// Returns the parameter values of each channel, or one channel if all parameters are grey.
std::vector<LobeChannel> channels_of(const Material& material, const ModelDescription& description,
                                     Reflectance reflectance) {
  std::vector<LobeChannel> channels(1);
  const auto fill = [&](const ParameterDescription& parameter, double LobeChannel::*value) {
    const std::vector<double>& values = material.parameters.at(parameter.name);
    if (values.size() > channels.size()) channels.resize(values.size(), channels.front());
    for (std::size_t c = 0; c < channels.size(); ++c) channels[c].*value = channel_value(values, c);
  };
  for (const ParameterDescription& parameter : description.parameters) {
    if (parameter.role == ParameterRole::kSpecular) fill(parameter, &LobeChannel::specular);
    if (parameter.role == ParameterRole::kIndex) fill(parameter, &LobeChannel::eta);
    if (parameter.role == ParameterRole::kExtinction) fill(parameter, &LobeChannel::k);
    if (parameter.role == ParameterRole::kDiffuse) fill(parameter, &LobeChannel::diffuse);
    if (parameter.name == "metallic") fill(parameter, &LobeChannel::metallic);
    if (parameter.name == "specular" && parameter.role == ParameterRole::kOther)
      fill(parameter, &LobeChannel::level);
  }
  for (LobeChannel& channel : channels) {
    if (reflectance == Reflectance::kTrimmedScale) channel.specular = std::min(channel.specular, 1.0);
    if (reflectance == Reflectance::kSchlickIor) channel.specular = normal_reflectance(channel.specular);
    if (reflectance == Reflectance::kMetallic) channel = layered(channel);
  }
  return channels;
}

// Returns the reflectance of one channel. `shape` is the lobe of a perfect mirror, and `schlick` is Schlick's
// weight at this geometry.
double specular_reflectance(Reflectance reflectance, double shape, double schlick, const LobeChannel& channel,
                            double cos_light_half) {
  switch (reflectance) {
    case Reflectance::kScale:
    case Reflectance::kTrimmedScale:
      return channel.specular * shape;
    case Reflectance::kSchlick:
    case Reflectance::kSchlickIor:
    case Reflectance::kMetallic:
      return shape * schlick + channel.specular * (shape * (1.0 - schlick));
    case Reflectance::kDielectric:
      return shape * fresnel_dielectric(cos_light_half, channel.specular).mean();
    case Reflectance::kConductor:
      return shape * fresnel_conductor(cos_light_half, channel.eta, channel.k).mean();
  }
  return 0.0;
}

Image BuiltinRenderer::render(const Material& material, const Scene& scene) const {
  require_scene(scene);
  const ModelDescription description = model(material.model);
  require_material(material, description);
  const BuiltinModel* model = find_builtin_model(material.model);
  const std::string& roughness = description.parameter(ParameterRole::kRoughness).name;
  const double alpha = to_alpha(model->roughness, material.parameters.at(roughness).front());

  const std::vector<LobeChannel> channels = channels_of(material, description, model->reflectance);
  const auto side = static_cast<std::size_t>(scene.resolution);
  std::vector<double> radiance(side * side * channels.size(), 0.0);
  const auto samples = samples_of(scene);
  for (const LitSample& sample : *samples) {
    const double shape = evaluate_shape(model->brdf, alpha, sample.geometry);
    const double cosine = sample.geometry.cos_light_half, schlick = schlick_weight(cosine);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const double reflectance =
          specular_reflectance(model->reflectance, shape, schlick, channels[c], cosine) +
          channels[c].diffuse * std::numbers::inv_pi;
      radiance[sample.pixel * channels.size() + c] += reflectance * sample.irradiance;
    }
  }
  Image image{scene.resolution, scene.resolution, static_cast<int>(channels.size()), {}};
  image.values.assign(radiance.begin(), radiance.end());
  return image;
}

}  // namespace

std::unique_ptr<Renderer> make_builtin_renderer() { return std::make_unique<BuiltinRenderer>(); }

}  // namespace remap
