// The built-in renderer: the hub's models on the sweep scene, in double precision, without any approximation
// but the sampling of the pixel.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

#include "error.hpp"
#include "nearest_name.hpp"
#include "number_text.hpp"
#include "sweep/brdf.hpp"
#include "sweep/renderer.hpp"
#include "version.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;
using remap::Range;
using remap::RoughnessConvention;

struct BuiltinModel {
  const char* name;
  Brdf brdf;
  Fresnel fresnel;
  RoughnessConvention roughness;
};

// Names as in the hub; `-plain` scales the microfacet lobe by a constant reflectance instead of Schlick's F0.
constexpr std::array kModels = {
    BuiltinModel{"mitsuba/ward", Brdf::kWard, Fresnel::kNone, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/ward-duer", Brdf::kWardDuer, Fresnel::kNone, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/ward-balanced", Brdf::kWardBalanced, Fresnel::kNone, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/phong", Brdf::kPhong, Fresnel::kNone, RoughnessConvention::kExponent},
    BuiltinModel{"mitsuba/beckmann", Brdf::kBeckmann, Fresnel::kSchlick, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/ggx", Brdf::kGgx, Fresnel::kSchlick, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/as", Brdf::kAs, Fresnel::kSchlick, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/beckmann-plain", Brdf::kBeckmann, Fresnel::kNone, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/ggx-plain", Brdf::kGgx, Fresnel::kNone, RoughnessConvention::kAlpha},
    BuiltinModel{"mitsuba/as-plain", Brdf::kAs, Fresnel::kNone, RoughnessConvention::kAlpha},
};

// Widths below 1e-4 are mirrors that no picture of the sweep resolves.
constexpr Range kAlphaRange{1e-4, 1.0};

ModelDescription describe(const BuiltinModel& model) {
  const double bound_a = remap::from_alpha(model.roughness, kAlphaRange.min);
  const double bound_b = remap::from_alpha(model.roughness, kAlphaRange.max);
  return {model.name,
          model.roughness,
          kAlphaRange,
          {{std::string(remap::convention_name(model.roughness)),
            ParameterRole::kRoughness,
            {std::min(bound_a, bound_b), std::max(bound_a, bound_b)}},
           {model.fresnel == Fresnel::kSchlick ? "f0" : "specular", ParameterRole::kSpecular, {0.0, 1.0}},
           {"diffuse", ParameterRole::kDiffuse, {0.0, 1.0}}}};
}

// None where the name is unknown.
const BuiltinModel* find_builtin(const std::string& name) {
  const auto model = std::find_if(kModels.begin(), kModels.end(),
                                  [&](const BuiltinModel& candidate) { return name == candidate.name; });
  return model == kModels.end() ? nullptr : &*model;
}

// One lit sample of the picture: its pixel, its directions, and cos_light / distance^2 over the samples a
// pixel.
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
      SurfacePoint n;
      if (!sphere_point(scene.resolution, (column + 0.5) * step, (row + 0.5) * step, &n)) continue;
      double lx = light_x - n.x, ly = -n.y, lz = light_z - n.z;
      const double light_distance = std::sqrt(lx * lx + ly * ly + lz * lz);
      lx /= light_distance, ly /= light_distance, lz /= light_distance;
      double vx = -n.x, vy = -n.y, vz = kCameraDistance - n.z;
      const double view_distance = std::sqrt(vx * vx + vy * vy + vz * vz);
      vx /= view_distance, vy /= view_distance, vz /= view_distance;
      const double cos_light = lx * n.x + ly * n.y + lz * n.z;
      const double cos_view = vx * n.x + vy * n.y + vz * n.z;
      if (cos_light <= 0.0 || cos_view <= 0.0) continue;
      const double cos_between = lx * vx + ly * vy + lz * vz;
      const double half_length_2 = 2.0 + 2.0 * cos_between;
      const double half_length = std::sqrt(half_length_2);
      const int pixel = row / scene.samples_per_axis * scene.resolution + column / scene.samples_per_axis;
      samples.push_back({static_cast<std::uint32_t>(pixel),
                         {cos_light, cos_view, std::min(1.0, (cos_light + cos_view) / half_length),
                          std::min(1.0, 0.5 * half_length), half_length_2,
                          std::min(1.0, 2.0 * cos_light * cos_view - cos_between)},
                         cos_light / (light_distance * light_distance) * step * step});
    }
  }
  return samples;
}

class BuiltinRenderer final : public Renderer {
 public:
  std::string version() const override { return std::string("remapc ") + remap::kVersion; }

  std::vector<ModelDescription> models() const override {
    std::vector<ModelDescription> descriptions;
    for (const BuiltinModel& model : kModels) descriptions.push_back(describe(model));
    return descriptions;
  }

  Image render(const Material& material, const Scene& scene) const override;

 private:
  // Directions depend on the scene alone; a sweep takes hundreds of pictures of a few scenes.
  std::shared_ptr<const std::vector<LitSample>> samples_of(const Scene& scene) const;

  mutable std::mutex mutex_;
  mutable std::map<std::string, std::shared_ptr<const std::vector<LitSample>>> samples_;
};

void require_scene(const Scene& scene) {
  if (scene.resolution < 1 || scene.resolution > 16384)
    throw Error(ErrorKind::kUsage,
                "resolution: " + std::to_string(scene.resolution) + "; expected 1 to 16384");
  if (scene.samples_per_axis < 1 || scene.samples_per_axis > 64)
    throw Error(ErrorKind::kUsage,
                "samples in a pixel: " + std::to_string(scene.samples_per_axis) + "; expected 1 to 64");
  if (!(scene.light.distance > 1.0))
    throw Error(ErrorKind::kUsage, "light distance: " + remap::number_text(scene.light.distance) +
                                       "; expected more than 1, the radius of the sphere");
}

std::shared_ptr<const std::vector<LitSample>> BuiltinRenderer::samples_of(const Scene& scene) const {
  const std::string key = std::to_string(scene.resolution) + "/" + std::to_string(scene.samples_per_axis) +
                          "/" + light_name(scene.light);
  const std::lock_guard lock(mutex_);
  auto& samples = samples_[key];
  if (!samples) samples = std::make_shared<const std::vector<LitSample>>(lit_samples(scene));
  return samples;
}

// Value of a parameter for `channel`; checks name, count and range.
std::vector<double> parameter_values(const Material& material, const ParameterDescription& description) {
  const auto found = material.parameters.find(description.name);
  if (found == material.parameters.end())
    throw Error(ErrorKind::kUsage, material.model + ": parameter " + description.name + " is missing");
  const std::vector<double>& values = found->second;
  if (values.size() != 1 && values.size() != 3)
    throw Error(ErrorKind::kUsage, material.model + ": parameter " + description.name + " has " +
                                       std::to_string(values.size()) + " values; expected 1 or 3");
  for (const double value : values) {
    if (description.range.contains(value)) continue;
    throw Error(ErrorKind::kUsage, material.model + ": " + description.name + " = " +
                                       remap::number_text(value) + "; expected " +
                                       remap::number_text(description.range.min) + " to " +
                                       remap::number_text(description.range.max));
  }
  return values;
}

void require_known_parameters(const Material& material, const ModelDescription& description) {
  std::vector<std::string> names;
  for (const ParameterDescription& parameter : description.parameters) names.push_back(parameter.name);
  for (const auto& [name, values] : material.parameters) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw Error(ErrorKind::kUsage,
                material.model + ": has no parameter " + name + remap::suggestion(name, names));
  }
}

Image BuiltinRenderer::render(const Material& material, const Scene& scene) const {
  require_scene(scene);
  const ModelDescription description = find_model(*this, material.model);
  require_known_parameters(material, description);
  const BuiltinModel* model = find_builtin(material.model);
  const auto roughness = parameter_values(material, description.parameter(ParameterRole::kRoughness));
  const auto specular = parameter_values(material, description.parameter(ParameterRole::kSpecular));
  const auto diffuse = parameter_values(material, description.parameter(ParameterRole::kDiffuse));
  if (roughness.size() != 1)
    throw Error(ErrorKind::kUsage, material.model + ": roughness has 3 values; expected 1");
  const double alpha = remap::to_alpha(model->roughness, roughness[0]);

  const std::size_t channels = std::max(specular.size(), diffuse.size());
  const auto side = static_cast<std::size_t>(scene.resolution);
  std::vector<double> radiance(side * side * channels, 0.0);
  const auto samples = samples_of(scene);
  for (const LitSample& sample : *samples) {
    const Lobe lobe = evaluate_lobe(model->brdf, model->fresnel, alpha, sample.geometry);
    for (std::size_t c = 0; c < channels; ++c) {
      const double s = specular[specular.size() == 1 ? 0 : c], d = diffuse[diffuse.size() == 1 ? 0 : c];
      const double reflectance = lobe.base + s * lobe.slope + d * std::numbers::inv_pi;
      radiance[sample.pixel * channels + c] += reflectance * sample.irradiance;
    }
  }
  Image image{scene.resolution, scene.resolution, static_cast<int>(channels), {}};
  image.values.assign(radiance.begin(), radiance.end());
  return image;
}

}  // namespace

BrdfModel builtin_brdf(const std::string& name) {
  find_model(BuiltinRenderer(), name);
  const BuiltinModel* model = find_builtin(name);
  return {model->brdf, model->fresnel};
}

std::unique_ptr<Renderer> make_builtin_renderer() { return std::make_unique<BuiltinRenderer>(); }

}  // namespace remapc
