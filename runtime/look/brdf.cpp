#include "look/brdf.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace remap
