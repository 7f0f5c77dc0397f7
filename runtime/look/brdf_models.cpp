#include "look/brdf_models.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/errors.hpp"
#include "core/nearest_name.hpp"

namespace remap {
namespace {

// Below 1e-4 a lobe is a mirror that no picture of the sweep resolves.
constexpr Range kAlphaRange{1e-4, 1.0};

// This range is for exponents of 0.1 to 10,000: alpha is the square root of 2 / (n + 2).
constexpr Range kExponentAlphas{0.014140721622265262, 0.9759000729485333};

// Names are the hub's. `-plain` multiplies the microfacet lobe by a constant instead of Schlick's Fresnel.
constexpr std::array kModels = {
    BuiltinModel{"mitsuba/ward", Brdf::kWard, Reflectance::kScale, RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/ward-duer", Brdf::kWardDuer, Reflectance::kScale, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/ward-balanced", Brdf::kWardBalanced, Reflectance::kScale, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/ward-conserving", Brdf::kWard, Reflectance::kTrimmedScale,
                 RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/phong", Brdf::kPhong, Reflectance::kScale, RoughnessEncoding::kExponent,
                 kAlphaRange},
    BuiltinModel{"mitsuba/beckmann", Brdf::kBeckmann, Reflectance::kSchlick, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/ggx", Brdf::kGgx, Reflectance::kSchlick, RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/as", Brdf::kAs, Reflectance::kSchlick, RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/beckmann-plain", Brdf::kBeckmann, Reflectance::kScale, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/ggx-plain", Brdf::kGgx, Reflectance::kScale, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/as-plain", Brdf::kAs, Reflectance::kScale, RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/beckmann-ior", Brdf::kBeckmann, Reflectance::kSchlickIor, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/ggx-ior", Brdf::kGgx, Reflectance::kSchlickIor, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/as-ior", Brdf::kAs, Reflectance::kSchlickIor, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/beckmann-dielectric", Brdf::kBeckmann, Reflectance::kDielectric,
                 RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/ggx-dielectric", Brdf::kGgx, Reflectance::kDielectric, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/as-dielectric", Brdf::kAs, Reflectance::kDielectric, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/beckmann-conductor", Brdf::kBeckmann, Reflectance::kConductor,
                 RoughnessEncoding::kAlpha, kAlphaRange},
    BuiltinModel{"mitsuba/ggx-conductor", Brdf::kGgx, Reflectance::kConductor, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/as-conductor", Brdf::kAs, Reflectance::kConductor, RoughnessEncoding::kAlpha,
                 kAlphaRange},
    BuiltinModel{"mitsuba/beckmann-metallic", Brdf::kBeckmann, Reflectance::kMetallic,
                 RoughnessEncoding::kRoughness, kAlphaRange},
    BuiltinModel{"mitsuba/ggx-metallic", Brdf::kGgx, Reflectance::kMetallic, RoughnessEncoding::kRoughness,
                 kAlphaRange},
    BuiltinModel{"mitsuba/as-metallic", Brdf::kAs, Reflectance::kMetallic, RoughnessEncoding::kRoughness,
                 kAlphaRange},
    BuiltinModel{"legacy/phong", Brdf::kPlainPhong, Reflectance::kScale, RoughnessEncoding::kExponent,
                 kExponentAlphas},
    BuiltinModel{"legacy/blinn-phong", Brdf::kPlainBlinn, Reflectance::kScale, RoughnessEncoding::kExponent,
                 kExponentAlphas},
    BuiltinModel{"legacy/phong-normalised", Brdf::kPhong, Reflectance::kScale, RoughnessEncoding::kExponent,
                 kExponentAlphas},
    BuiltinModel{"legacy/blinn-phong-normalised", Brdf::kBlinn, Reflectance::kScale,
                 RoughnessEncoding::kExponent, kExponentAlphas},
};

const BuiltinModel& known_model(const std::string& name) {
  if (const BuiltinModel* model = find_builtin_model(name)) return *model;
  std::vector<std::string> names;
  for (const BuiltinModel& model : kModels) names.emplace_back(model.name);
  throw usage_error(name + ": unknown model of the built-in renderer" + suggestion(name, names));
}

}  // namespace

std::span<const BuiltinModel> builtin_models() { return kModels; }

const BuiltinModel* find_builtin_model(const std::string& name) {
  const auto model = std::ranges::find(kModels, name, &BuiltinModel::name);
  return model == kModels.end() ? nullptr : &*model;
}

bool is_linear_lobe(const std::string& name) {
  const BuiltinModel* model = find_builtin_model(name);
  return model != nullptr &&
         (model->reflectance == Reflectance::kScale || model->reflectance == Reflectance::kSchlick);
}

BrdfModel builtin_brdf(const std::string& name) {
  const BuiltinModel& model = known_model(name);
  if (model.reflectance == Reflectance::kScale) return {model.brdf, Fresnel::kNone};
  if (model.reflectance == Reflectance::kSchlick) return {model.brdf, Fresnel::kSchlick};
  throw usage_error(
      name + ": its specular is neither a scale nor F0 (choose a model with `specular` from 0 to 1 or `f0`)");
}

MapModel builtin_map_model(const std::string& name) {
  const BuiltinModel& model = known_model(name);
  switch (model.reflectance) {
    case Reflectance::kScale:
    case Reflectance::kTrimmedScale:
      return {{model.brdf, Fresnel::kNone}, false};
    case Reflectance::kSchlick:
    case Reflectance::kSchlickIor:
    case Reflectance::kMetallic:
      return {{model.brdf, Fresnel::kSchlick}, false};
    case Reflectance::kDielectric:
      return {{model.brdf, Fresnel::kNone}, true};
    case Reflectance::kConductor:
      break;
  }
  throw usage_error(name +
                    ": F0 does not determine the index of a conductor (choose a model with a "
                    "scale, F0 or the index of a dielectric)");
}

}  // namespace remap
