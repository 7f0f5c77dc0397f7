#include "fit/baselines.hpp"

#include <algorithm>
#include <cmath>

namespace remapc {
namespace {

using remap::MappedTexel;
using remap::ModelSide;
using Convention = remap::RoughnessConvention;

double clamp01(double value) { return std::clamp(value, 0.0, 1.0); }

std::string width_text(const ModelSide& side) {
  return side.model + " has " + std::string(remap::convention_name(side.roughness));
}

// A formula from a Phong exponent and a grey specular to perceptual roughness, which is sqrt(alpha).
struct ExponentFormula {
  const char* name;
  const char* formula;
  double (*roughness)(double exponent, double specular);
};

const ExponentFormula kExponentFormulas[] = {
    // facebookincubator/FBX2glTF, getRoughness() for Phong and Blinn materials.
    {"FBX2glTF", "roughness = sqrt(2 / (2 + n))",
     [](double n, double) { return std::sqrt(2.0 / (2.0 + n)); }},
    // xelatihy/yocto-gl, exponent_to_roughness().
    {"Yocto", "roughness = (2 / (n + 2))^(1/4)",
     [](double n, double) { return std::pow(2.0 / (n + 2.0), 0.25); }},
    // Blender, OBJ importer: Ns is clamped to 0 to 1000.
    {"Blender OBJ", "roughness = 1 - sqrt(min(n, 1000) / 1000)",
     [](double n, double) { return 1.0 - std::sqrt(std::clamp(n, 0.0, 1000.0) / 1000.0); }},
    // assimp, glTF2 exporter: the luma of Ks is its specular intensity, which for a grey is its value.
    {"assimp", "roughness = 1 - sqrt(n / 1000) luma(Ks)",
     [](double n, double specular) { return 1.0 - clamp01(std::sqrt(n / 1000.0)) * specular; }},
    // CesiumGS/obj2gltf, materials from Ns.
    {"obj2gltf", "roughness = 1 - n / 1000", [](double n, double) { return clamp01(1.0 - n / 1000.0); }},
};

// Pharr, Jakob and Humphreys: pbrt-v3, TrowbridgeReitzDistribution::RoughnessToAlpha().
double pbrt_alpha(double roughness) {
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + x * (0.819955 + x * (0.1734 + x * (0.0171201 + x * 0.000640711)));
}

Baseline copied_alpha() {
  return {"copy", "alpha and specular unchanged (MDL distiller, MaterialX)",
          [](double alpha, double specular) {
            return MappedTexel{alpha, specular};
          },
          ""};
}

// The formula of Walter et al. (2007), section 5.2, which Mitsuba and Cycles use. Canonical coordinates use
// the same formula, so it copies alpha.
Baseline walter(const ModelSide& source, const ModelSide& target) {
  Baseline baseline{"exponent", "n = 2 / alpha^2 - 2 (Walter et al. 2007)", {}, ""};
  if ((source.roughness == Convention::kExponent) != (target.roughness == Convention::kExponent))
    baseline.map = [](double alpha, double specular) { return MappedTexel{alpha, specular}; };
  else
    baseline.why_not = source.roughness == Convention::kExponent ? "both models have an exponent"
                                                                 : "neither model has an exponent";
  return baseline;
}

// Confuses alpha and sqrt(alpha): the parameter value is copied although the conventions differ.
Baseline copied_number(const ModelSide& source, const ModelSide& target) {
  Baseline baseline{
      "copy number", "the parameter value unchanged, although one is alpha and one sqrt(alpha)", {}, ""};
  const auto is_width = [](const ModelSide& side) {
    return side.roughness == Convention::kAlpha || side.roughness == Convention::kRoughness;
  };
  if (!is_width(source) || !is_width(target))
    baseline.why_not = width_text(is_width(source) ? target : source);
  else if (source.roughness == target.roughness)
    baseline.why_not = "both models have " + std::string(remap::convention_name(source.roughness));
  else
    baseline.map = [from = source.roughness, to = target.roughness](double alpha, double specular) {
      return MappedTexel{remap::to_alpha(to, remap::from_alpha(from, alpha)), specular};
    };
  return baseline;
}

Baseline pbrt(const ModelSide& source) {
  Baseline baseline{"pbrt-v3", "alpha = quartic of ln(roughness)", {}, ""};
  if (source.roughness == Convention::kRoughness)
    baseline.map = [](double alpha, double specular) {
      return MappedTexel{pbrt_alpha(remap::from_alpha(Convention::kRoughness, alpha)), specular};
    };
  else
    baseline.why_not = width_text(source) + ", not roughness";
  return baseline;
}

Baseline of_exponent(const ExponentFormula& formula, const ModelSide& source) {
  Baseline baseline{formula.name, formula.formula, {}, ""};
  if (source.roughness == Convention::kExponent)
    baseline.map = [roughness = formula.roughness](double alpha, double specular) {
      const double r = roughness(remap::from_alpha(Convention::kExponent, alpha), specular);
      return MappedTexel{r * r, specular};
    };
  else
    baseline.why_not = width_text(source) + ", not an exponent";
  return baseline;
}

}  // namespace

std::vector<Baseline> baselines(const ModelSide& source, const ModelSide& target) {
  std::vector<Baseline> all = {copied_alpha(), walter(source, target), copied_number(source, target),
                               pbrt(source)};
  for (const ExponentFormula& formula : kExponentFormulas) all.push_back(of_exponent(formula, source));
  return all;
}

}  // namespace remapc
