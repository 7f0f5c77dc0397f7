#include "fit/baselines.hpp"

#include <algorithm>
#include <cmath>

namespace remap {
namespace {

using Convention = RoughnessEncoding;

double clamp01(double value) { return std::clamp(value, 0.0, 1.0); }

std::string width_text(const ModelSide& side) {
  return (side.model.empty() ? "the table's model" : side.model) + " has " +
         std::string(encoding_name(side.roughness));
}

// pbrt-v3 has this formula by Pharr, Jakob and Humphreys, in TrowbridgeReitzDistribution::RoughnessToAlpha().
double pbrt_alpha(double roughness) {
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

// Returns why the number of a parameter is not copied from one model to the other, or an empty text.
std::string why_number_is_not_copied(const ModelSide& source, const ModelSide& target) {
  const auto is_width = [](const ModelSide& side) {
    return side.roughness == Convention::kAlpha || side.roughness == Convention::kRoughness;
  };
  if (!is_width(source) || !is_width(target)) return width_text(is_width(source) ? target : source);
  if (source.roughness != target.roughness) return "";
  return "both models have " + std::string(encoding_name(source.roughness));
}

}  // namespace

std::vector<Baseline> baselines(const ModelSide& source, const ModelSide& target) {
  std::vector<Baseline> all;
  const auto add = [&all](const std::string& name, const std::string& formula, const std::string& why_not,
                          const std::function<MappedTexel(double, double)>& map) {
    all.push_back({name, formula, why_not.empty() ? map : nullptr, why_not});
  };
  const auto copied = [](double alpha, double specular) { return MappedTexel{alpha, specular}; };
  const bool from_exponent = source.roughness == Convention::kExponent,
             to_exponent = target.roughness == Convention::kExponent;
  add("copy", "alpha and specular unchanged (MDL distiller, MaterialX)", "", copied);
  // Mitsuba and Cycles use this formula of Walter et al. (2007), section 5.2. remap converts exponents to
  // alpha by the same formula, so this baseline copies alpha.
  add("exponent", "n = 2 / alpha^2 - 2 (Walter et al. 2007)",
      from_exponent != to_exponent ? ""
      : from_exponent              ? "both models have an exponent"
                                   : "neither model has an exponent",
      copied);
  // This baseline copies the value of the parameter although the models have different conventions. It
  // confuses alpha and sqrt(alpha).
  add("copy number", "the parameter value unchanged, although one is alpha and one sqrt(alpha)",
      why_number_is_not_copied(source, target),
      [from = source.roughness, to = target.roughness](double alpha, double specular) {
        return MappedTexel{to_alpha(to, from_alpha(from, alpha)), specular};
      });
  add("pbrt-v3", "alpha = quartic of ln(roughness)",
      source.roughness == Convention::kRoughness ? "" : width_text(source) + ", not roughness",
      [](double alpha, double specular) {
        return MappedTexel{pbrt_alpha(from_alpha(Convention::kRoughness, alpha)), specular};
      });
  // The following formulas convert a Phong exponent n and a grey specular to roughness, which is sqrt(alpha).
  const auto add_exponent = [&](const char* name, const char* formula,
                                double (*roughness)(double exponent, double specular)) {
    add(name, formula, from_exponent ? "" : width_text(source) + ", not an exponent",
        [roughness](double alpha, double specular) {
          const double r = roughness(from_alpha(Convention::kExponent, alpha), specular);
          return MappedTexel{r * r, specular};
        });
  };
  // The formula comes from facebookincubator/FBX2glTF, getRoughness() for Phong and Blinn materials.
  add_exponent("FBX2glTF", "roughness = sqrt(2 / (2 + n))",
               [](double n, double) { return std::sqrt(2.0 / (2.0 + n)); });
  // The formula comes from xelatihy/yocto-gl, exponent_to_roughness().
  add_exponent("Yocto", "roughness = (2 / (n + 2))^(1/4)",
               [](double n, double) { return std::pow(2.0 / (n + 2.0), 0.25); });
  // Blender's OBJ importer clamps Ns to 0 to 1000.
  add_exponent("Blender OBJ", "roughness = 1 - sqrt(min(n, 1000) / 1000)",
               [](double n, double) { return 1.0 - std::sqrt(std::clamp(n, 0.0, 1000.0) / 1000.0); });
  // The formula comes from assimp's glTF2 exporter. Its specular intensity is the luma of Ks.
  add_exponent("assimp", "roughness = 1 - sqrt(n / 1000) luma(Ks)",
               [](double n, double specular) { return 1.0 - clamp01(std::sqrt(n / 1000.0)) * specular; });
  // The formula comes from CesiumGS/obj2gltf, materials from Ns.
  add_exponent("obj2gltf", "roughness = 1 - n / 1000",
               [](double n, double) { return clamp01(1.0 - n / 1000.0); });
  return all;
}

}  // namespace remap
