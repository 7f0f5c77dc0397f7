#include "study/exponent_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "study/form_rule.hpp"

namespace remap {
namespace {

constexpr double kGlassF0 = 0.04;

double clamped01(double value) { return std::clamp(value, 0.0, 1.0); }
double luma_of(const Rgb& color) { return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]; }
double mean_of(const Rgb& color) { return (color[0] + color[1] + color[2]) / 3.0; }
double exponent_of(double alpha) { return from_alpha(RoughnessConvention::kExponent, alpha); }

double fourth_root(double n, double) { return std::pow(2.0 / (n + 2.0), 0.25); }

// Core glTF: a dielectric of F0 0.04 and a metal, mixed. Diffuse light passes the surface twice (appendix B
// of glTF 2.0): it counts 1 - F.
LobeSurface core_surface(double alpha, const Rgb& base, double metallic) {
  LobeSurface surface{alpha, {}, {}, false};
  for (std::size_t c = 0; c < 3; ++c) {
    surface.specular[c] = kGlassF0 * (1.0 - metallic) + base[c] * metallic;
    surface.diffuse[c] = (1.0 - kGlassF0) * (1.0 - metallic) * base[c];
  }
  return surface;
}

// Base color and metallic that keep the sum of diffuse and specular; metallic 0 where the highlight is weaker
// than that of glass.
LobeSurface core_of(const LobeSurface& exact, bool is_wide) {
  const double d = mean_of(exact.diffuse), s = mean_of(exact.specular), sum = s + d;
  const double n =
      std::min(1.0, 2.0 * d / std::max(1e-9, sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * kGlassF0 * d))));
  Rgb base{};
  for (std::size_t c = 0; c < 3; ++c)
    base[c] = clamped01(exact.diffuse[c] + exact.specular[c] - kGlassF0 * n);
  const double roughness = std::sqrt(exact.alpha);
  const double wide = is_wide && s < kGlassF0
                          ? std::min(1.0, roughness * std::sqrt(kGlassF0 / std::max(s, 1e-9)))
                          : roughness;
  return core_surface(wide * wide, base, 1.0 - n);
}

}  // namespace

std::vector<ExponentRule> exponent_rules() {
  using S = RuleStrength;
  return {
      {"short form", "this project, KHR_materials_specular", S::kShortForm, nullptr},
      {"short form, core", "the same in core glTF", S::kCore, nullptr},
      {"short form, core, wide", "the same, wider below F0 0.04", S::kCoreWide, nullptr},
      {"fourth root, form's F0", "(2 / (n + 2))^0.25 with F0 and base of the short form", S::kShortForm,
       fourth_root},
      {"trimesh, O3DE, Yocto/GL", "(2 / (n + 2))^0.25", S::kGlass, fourth_root},
      {"FBX2glTF", "sqrt(2 / (2 + n)), metallic 0.4", S::kHalfMetal,
       [](double n, double) { return std::sqrt(2.0 / (2.0 + n)); }},
      {"alpha as roughness", "sqrt(2 / (2 + n))", S::kGlass,
       [](double n, double) { return std::sqrt(2.0 / (2.0 + n)); }},
      {"Blender OBJ", "1 - sqrt(min(n, 1000) / 1000), F0 0.08 Ks", S::kBlender,
       [](double n, double) { return 1.0 - std::sqrt(std::min(n, 1000.0) / 1000.0); }},
      {"obj2gltf", "1 - n / 1000, times 1 - luma(Ks) below 0.1", S::kGlass,
       [](double n, double luma) { return clamped01((1.0 - n / 1000.0) * (luma < 0.1 ? 1.0 - luma : 1.0)); }},
      {"assimp, glTF export", "1 - luma(Ks) sqrt(n / 1000)", S::kGlass,
       [](double n, double luma) { return 1.0 - luma * clamped01(std::sqrt(n / 1000.0)); }},
      {"assimp, FBX import", "1 - sqrt(n) / 10", S::kGlass,
       [](double n, double) { return 1.0 - std::sqrt(n) / 10.0; }},
      {"ufbx", "max(0, 1 - sqrt(n) / 10)", S::kGlass,
       [](double n, double) { return std::max(0.0, 1.0 - std::sqrt(n) / 10.0); }},
      {"Adobe's USD plugins", "sqrt(2 / (n luma(Ks) + 2)), below 0.08: 0", S::kGlass,
       [](double n, double luma) {
         const double roughness = std::sqrt(2.0 / (n * luma + 2.0));
         return roughness < 0.08 ? 0.0 : roughness;
       }},
      {"Adobe's, textured", "sqrt(2 / (20 n luma(Ks) + 2))", S::kGlass,
       [](double n, double luma) {
         const double roughness = std::sqrt(2.0 / (20.0 * n * luma + 2.0));
         return roughness < 0.08 ? 0.0 : roughness;
       }},
      {"Babylon", "0.1 + 0.9 (1 - (n / 1300)^(1/3))^3", S::kGlass,
       [](double n, double) {
         return 0.1 + 0.9 * std::pow(1.0 - std::cbrt(std::min(n, 1300.0) / 1300.0), 3.0);
       }},
      {"Maxon", "1 - log2(n) / 10", S::kGlass,
       [](double n, double) { return clamped01(1.0 - std::log2(std::max(n, 1.0)) / 10.0); }},
      {"mujoco-usd until 2026", "1 - n / 128, F0 Ks", S::kCopied,
       [](double n, double) { return clamped01(1.0 - n / 128.0); }},
      {"mujoco-usd 0.8", "1 - n / 128", S::kGlass,
       [](double n, double) { return clamped01(1.0 - n / 128.0); }},
      {"Ks as F0", "(2 / (n + 2))^0.25, F0 Ks", S::kCopied, fourth_root},
      {"1 / n", "1 / n", S::kGlass, [](double n, double) { return std::min(1.0, 1.0 / n); }},
      {"sqrt(1 - n / 1000)", "sqrt(1 - n / 1000)", S::kGlass,
       [](double n, double) { return std::sqrt(std::max(0.0, 1.0 - n / 1000.0)); }},
      {"constant", "0.5", S::kGlass, [](double, double) { return 0.5; }},
  };
}

LobeRule rule_of(const ExponentRule& rule, const ShortForm& form) {
  return [rule, own = FormRule(form)](const LobeMaterial& material) {
    LobeSurface exact = own(material);
    if (rule.roughness != nullptr) {
      const double roughness =
          clamped01(rule.roughness(exponent_of(material.alpha), luma_of(material.specular)));
      exact.alpha = std::max(1e-3, roughness * roughness);
    }
    LobeSurface surface{exact.alpha, {}, {}, false};
    switch (rule.strength) {
      case RuleStrength::kShortForm:
        return exact;
      case RuleStrength::kCore:
        return core_of(exact, false);
      case RuleStrength::kCoreWide:
        return core_of(exact, true);
      case RuleStrength::kGlass:
        return core_surface(exact.alpha, material.diffuse, 0.0);
      case RuleStrength::kHalfMetal:
        return core_surface(exact.alpha, material.diffuse, 0.4);
      case RuleStrength::kBlender:
        surface.specular.fill(0.08 * mean_of(material.specular));
        break;
      case RuleStrength::kCopied:
        surface.specular = material.specular;
        break;
    }
    const double f = *std::ranges::max_element(surface.specular);
    for (std::size_t c = 0; c < 3; ++c) surface.diffuse[c] = (1.0 - f) * material.diffuse[c];
    return surface;
  };
}

std::vector<LobeMaterial> opengl_materials() {
  struct Row {
    Rgb diffuse, specular;
    double shininess;  // times 128 is the exponent
  };
  constexpr std::array<Row, 24> kRows = {{
      {{0.07568, 0.61424, 0.07568}, {0.633, 0.727811, 0.633}, 0.6},                  // emerald
      {{0.54, 0.89, 0.63}, {0.316228, 0.316228, 0.316228}, 0.1},                     // jade
      {{0.18275, 0.17, 0.22525}, {0.332741, 0.328634, 0.346435}, 0.3},               // obsidian
      {{1.0, 0.829, 0.829}, {0.296648, 0.296648, 0.296648}, 0.088},                  // pearl
      {{0.61424, 0.04136, 0.04136}, {0.727811, 0.626959, 0.626959}, 0.6},            // ruby
      {{0.396, 0.74151, 0.69102}, {0.297254, 0.30829, 0.306678}, 0.1},               // turquoise
      {{0.780392, 0.568627, 0.113725}, {0.992157, 0.941176, 0.807843}, 0.21794872},  // brass
      {{0.714, 0.4284, 0.18144}, {0.393548, 0.271906, 0.166721}, 0.2},               // bronze
      {{0.4, 0.4, 0.4}, {0.774597, 0.774597, 0.774597}, 0.6},                        // chrome
      {{0.7038, 0.27048, 0.0828}, {0.256777, 0.137622, 0.086014}, 0.1},              // copper
      {{0.75164, 0.60648, 0.22648}, {0.628281, 0.555802, 0.366065}, 0.4},            // gold
      {{0.50754, 0.50754, 0.50754}, {0.508273, 0.508273, 0.508273}, 0.4},            // silver
      {{0.01, 0.01, 0.01}, {0.5, 0.5, 0.5}, 0.25},                                   // plastics: black
      {{0.0, 0.50980392, 0.50980392}, {0.50196078, 0.50196078, 0.50196078}, 0.25},   // cyan
      {{0.1, 0.35, 0.1}, {0.45, 0.55, 0.45}, 0.25},                                  // green
      {{0.5, 0.0, 0.0}, {0.7, 0.6, 0.6}, 0.25},                                      // red
      {{0.55, 0.55, 0.55}, {0.7, 0.7, 0.7}, 0.25},                                   // white
      {{0.5, 0.5, 0.0}, {0.6, 0.6, 0.5}, 0.25},                                      // yellow
      {{0.01, 0.01, 0.01}, {0.4, 0.4, 0.4}, 0.078125},                               // rubbers: black
      {{0.4, 0.5, 0.5}, {0.04, 0.7, 0.7}, 0.078125},                                 // cyan
      {{0.4, 0.5, 0.4}, {0.04, 0.7, 0.04}, 0.078125},                                // green
      {{0.5, 0.4, 0.4}, {0.7, 0.04, 0.04}, 0.078125},                                // red
      {{0.5, 0.5, 0.5}, {0.7, 0.7, 0.7}, 0.078125},                                  // white
      {{0.5, 0.5, 0.4}, {0.7, 0.7, 0.04}, 0.078125},                                 // yellow
  }};
  std::vector<LobeMaterial> materials;
  for (const Row& row : kRows)
    materials.push_back(
        {to_alpha(RoughnessConvention::kExponent, 128.0 * row.shininess), row.specular, row.diffuse});
  return materials;
}

}  // namespace remap
