#include "look/brdf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace brdf_text {

using real = double;
using std::exp, std::max, std::pow, std::sqrt;
#include "look/brdf.glsl"

}  // namespace brdf_text

LocalGeometry local_geometry(double cos_light, double cos_view, double cos_between) {
  const double half_length_2 = 2.0 + 2.0 * cos_between;
  const double half_length = std::sqrt(half_length_2);
  return {cos_light,
          cos_view,
          std::min(1.0, (cos_light + cos_view) / half_length),
          std::min(1.0, 0.5 * half_length),
          half_length_2,
          std::min(1.0, 2.0 * cos_light * cos_view - cos_between)};
}

double microfacet_distribution(Brdf brdf, double alpha, double cos_half) {
  if (brdf == Brdf::kGgx) return brdf_text::ggx_distribution(alpha, cos_half);
  if (brdf == Brdf::kBeckmann) return brdf_text::beckmann_distribution(alpha, cos_half);
  return brdf_text::phong_distribution(alpha, cos_half);
}

double smith_shadowing(Brdf brdf, double alpha, double cos_direction) {
  if (brdf == Brdf::kGgx) return brdf_text::ggx_shadowing(alpha, cos_direction);
  return brdf_text::beckmann_shadowing(alpha, cos_direction);
}

namespace {

// A NamedLobe is a function of brdf.glsl with its name.
struct NamedLobe {
  const char* name;
  double (*shape)(double alpha, LocalGeometry g);
};

NamedLobe lobe_of(Brdf brdf) {
  switch (brdf) {
    case Brdf::kWard:
      return {"ward", brdf_text::ward};
    case Brdf::kWardDuer:
      return {"ward_duer", brdf_text::ward_duer};
    case Brdf::kWardBalanced:
      return {"ward_balanced", brdf_text::ward_balanced};
    case Brdf::kPhong:
      return {"phong", brdf_text::phong};
    case Brdf::kBlinn:
      return {"blinn", brdf_text::blinn};
    case Brdf::kPlainPhong:
      return {"plain_phong", brdf_text::plain_phong};
    case Brdf::kPlainBlinn:
      return {"plain_blinn", brdf_text::plain_blinn};
    case Brdf::kBeckmann:
      return {"beckmann", brdf_text::beckmann};
    case Brdf::kGgx:
      return {"ggx", brdf_text::ggx};
    case Brdf::kAs:
      return {"ashikhmin_shirley", brdf_text::ashikhmin_shirley};
  }
  return {"ggx", brdf_text::ggx};
}

}  // namespace

double evaluate_shape(Brdf brdf, double alpha, const LocalGeometry& g) {
  return lobe_of(brdf).shape(alpha, g);
}

const char* glsl_name(Brdf brdf) { return lobe_of(brdf).name; }

double schlick_weight(double cosine) { return brdf_text::schlick_weight(cosine); }

Lobe evaluate_lobe(Brdf brdf, Fresnel fresnel, double alpha, const LocalGeometry& g) {
  const double value = evaluate_shape(brdf, alpha, g);
  if (fresnel == Fresnel::kNone) return {0.0, value};
  const double schlick = schlick_weight(g.cos_light_half);
  return {value * schlick, value * (1.0 - schlick)};
}

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
                    ": F0 does not determine the index of a conductor (choose a model with a scale, F0 or "
                    "the index of a dielectric)");
}

}  // namespace remap
