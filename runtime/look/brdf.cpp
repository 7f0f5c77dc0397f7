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

double evaluate_shape(Brdf brdf, double alpha, const LocalGeometry& g) {
  switch (brdf) {
    case Brdf::kWard:
      return brdf_text::ward(alpha, g);
    case Brdf::kWardDuer:
      return brdf_text::ward_duer(alpha, g);
    case Brdf::kWardBalanced:
      return brdf_text::ward_balanced(alpha, g);
    case Brdf::kPhong:
      return brdf_text::phong(alpha, g);
    case Brdf::kBlinn:
      return brdf_text::blinn(alpha, g);
    case Brdf::kPlainPhong:
      return brdf_text::plain_phong(alpha, g);
    case Brdf::kPlainBlinn:
      return brdf_text::plain_blinn(alpha, g);
    case Brdf::kBeckmann:
      return brdf_text::beckmann(alpha, g);
    case Brdf::kGgx:
      return brdf_text::ggx(alpha, g);
    case Brdf::kAs:
      return brdf_text::ashikhmin_shirley(alpha, g);
  }
  return 0.0;
}

const char* glsl_name(Brdf brdf) {
  switch (brdf) {
    case Brdf::kWard:
      return "ward";
    case Brdf::kWardDuer:
      return "ward_duer";
    case Brdf::kWardBalanced:
      return "ward_balanced";
    case Brdf::kPhong:
      return "phong";
    case Brdf::kBlinn:
      return "blinn";
    case Brdf::kPlainPhong:
      return "plain_phong";
    case Brdf::kPlainBlinn:
      return "plain_blinn";
    case Brdf::kBeckmann:
      return "beckmann";
    case Brdf::kGgx:
      return "ggx";
    case Brdf::kAs:
      return "ashikhmin_shirley";
  }
  return "ggx";
}

double schlick_weight(double cosine) { return brdf_text::schlick_weight(cosine); }

Lobe evaluate_lobe(Brdf brdf, Fresnel fresnel, double alpha, const LocalGeometry& g) {
  const double value = evaluate_shape(brdf, alpha, g);
  if (fresnel == Fresnel::kNone) return {0.0, value};
  const double schlick = schlick_weight(g.cos_light_half);
  return {value * schlick, value * (1.0 - schlick)};
}

}  // namespace remap
