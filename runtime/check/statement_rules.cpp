// This file has the rules that check names and numbers in assets, not texels.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/gltf_extensions.hpp"
#include "check/rules.hpp"
#include "core/contains.hpp"
#include "core/number_text.hpp"

namespace remap::look {
namespace {

std::string file_of(const CheckedMaterial& material) { return material.path.filename().string(); }

// Returns true for extensions of dielectrics. Metal reflects its base color, and transmits nothing.
bool is_of_dielectrics(std::string_view extension) {
  constexpr std::array<std::string_view, 6> kNames = {
      kSpecularExtension,           kIorExtension,
      "KHR_materials_transmission", "KHR_materials_volume",
      "KHR_materials_dispersion",   "KHR_materials_diffuse_transmission"};
  return contains(kNames, extension);
}

// Returns true if `texremap convert --extensions fold` can fold the extension. The index of refraction of a
// volume must stay.
bool can_fold(const CheckedMaterial& material, std::string_view extension) {
  return (extension == kSpecularExtension || extension == kIorExtension) && !material.gltf.has_volume;
}

// Returns a fix that converts the asset, with the options that its maps need to share one grid.
Fix asset_fix(const CheckedMaterial& material, const std::string& words, std::vector<std::string> options) {
  std::vector<MaterialUse> uses = material.uses;
  uses.insert(uses.end(), material.unread.begin(), material.unread.end());
  std::erase_if(uses, [](const MaterialUse& use) {
    return use.is_neighbour || !(is_color_role(use.role) || is_roughness(use.role) ||
                                 use.role == Role::kMetallic || use.slot.starts_with("specular"));
  });
  const auto all_agree = [&](auto same) {
    return std::ranges::all_of(uses, [&](const MaterialUse& use) { return same(use, uses.front()); });
  };
  if (!all_agree([](const auto& a, const auto& b) { return a.tex_coord == b.tex_coord; }))
    return words + " (first bring its textures to one set of texture coordinates)";
  if (!all_agree([&](const auto& a, const auto& b) {
        return a.transform == b.transform && material.same_size(a, b);
      }))
    options.emplace_back("--resample");
  Fix fix = words;
  fix.asset = material.path.string();
  fix.output = fixed_folder(material).string();
  fix.options = std::move(options);
  return fix;
}

bool all_zero(const std::vector<double>& factors) {
  return !factors.empty() && std::ranges::all_of(factors, [](double factor) { return factor == 0.0; });
}

}  // namespace

void factor_zero(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                 std::vector<MaterialFinding>& findings) {
  const auto add = [&](const MaterialUse& use, Confidence confidence, const std::string& what) {
    findings.push_back({rule.name, confidence, material.name, "", use.factor_name + what,
                        "set " + use.factor_name + " to 1 in " + file_of(material) +
                            (use.channels == Channels::kRgb ? " (for each channel)" : "") +
                            ", or remove the texture"});
  };
  for (const MaterialUse& use : material.uses) {
    // glTF packs metallic and roughness in one map. A factor of 0 may mean that this channel is unused.
    const std::vector<float>* plane = material.plane(use);
    const bool is_unused =
        plane != nullptr && std::ranges::minmax(*plane).min == std::ranges::minmax(*plane).max;
    if (all_zero(use.factors) && !is_unused)
      add(use, Confidence::kCertain, " 0 times the map " + material.maps[use.map].shown + " is 0 everywhere");
  }
  for (const MaterialUse& use : material.unread)
    if (use.factors.empty() && !use.factor_name.empty())
      add(use, Confidence::kPossible,
          " is missing, which means 0: the map " + material.maps[use.map].shown + " is not used");
}

void factor_ignored(const CheckedMaterial& material, const GltfConsumer* reader, const Rule& rule,
                    std::vector<MaterialFinding>& findings) {
  if (reader == nullptr || !reader->ignores_factors_beside_maps) return;
  const auto judge = [&](const MaterialUse& use) {
    if (use.is_neighbour || (use.role != Role::kMetallic && use.role != Role::kRoughness)) return;
    if (use.factors.empty() || use.factors.front() == 1.0) return;
    const std::string role(role_name(use.role)), factor = number_text(use.factors.front());
    findings.push_back(
        {rule.name, Confidence::kLikely, material.name, "",
         use.factor_name + " " + factor + " is ignored: " + std::string(reader->title) + " reads " + role +
             " only from the map",
         "multiply " + role + " in the map by " + factor + ", and set " + use.factor_name + " to 1"});
  };
  for (const MaterialUse& use : material.uses)
    if (!all_zero(use.factors)) judge(use);  // the rule factor_zero reports uses whose factors are all 0
  for (const MaterialUse& use : material.unread) {
    const std::vector<float>* plane = material.plane(use);
    if (plane != nullptr && std::ranges::any_of(*plane, [](float value) { return value > 0.0f; })) judge(use);
  }
}

// Real dielectrics reflect 2 to 17 % at normal incidence. Their index is 1.3 (water) to 2.42 (diamond).
void index_of_refraction(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                         std::vector<MaterialFinding>& findings) {
  if (material.is_all_metal()) return;
  const GltfStatements& stated = material.gltf;
  const auto add = [&](Confidence confidence, const std::string& message, const std::string& fix) {
    findings.push_back({rule.name, confidence, material.name, "", message, fix});
  };
  constexpr double kLeast = 1.05, kMost = 3.0;
  if (stated.ior && *stated.ior > kMost)
    add(Confidence::kLikely,
        "KHR_materials_ior: ior " + number_text(*stated.ior) +
            " makes a mirror, but importers without this extension show plastic",
        "make it a metal: set metallicFactor to 1 and baseColorFactor to its color, and remove "
        "KHR_materials_ior");
  if (stated.ior && *stated.ior != 0.0 && *stated.ior < kLeast && !stated.transmits)
    add(Confidence::kLikely,
        "KHR_materials_ior: ior " + number_text(*stated.ior) + " reflects nothing (F0 below 0.001)",
        "set ior to 1.5, or to the index of the material (water 1.33, plastics 1.45 to 1.6)");
  if (!stated.specular_factor) return;
  const double factor = *stated.specular_factor;
  if (factor > 1.0 || factor < 0.0)
    add(Confidence::kCertain,
        "KHR_materials_specular: specularFactor " + number_text(factor) + " is outside 0 to 1",
        "set specularFactor to 1, and set the reflectance by ior in KHR_materials_ior");
  if (factor > 0.0 && factor <= 0.5 && !stated.has_specular_map && stated.ior.value_or(1.5) == 1.5)
    add(Confidence::kPossible,
        "KHR_materials_specular: specularFactor " + number_text(factor) + " gives F0 " +
            number_text(rounded(0.04 * factor, 2)) +
            ", less than water; it may be the specular level of a shader node, where 0.5 means F0 0.04",
        "set specularFactor to " + number_text(std::min(1.0, 2.0 * factor)) + " if it is such a level");
  if (factor == 0.0 && !stated.has_specular_map)
    add(Confidence::kLikely,
        "KHR_materials_specular: specularFactor 0 switches off all reflection of the dielectric",
        "remove KHR_materials_specular, or set specularFactor to 1");
}

void ignored_by_reader(const CheckedMaterial& material, const GltfConsumer* reader, const Rule& rule,
                       std::vector<MaterialFinding>& findings) {
  if (reader == nullptr) return;
  for (const std::string_view extension : reader->ignored) {
    if (!material.gltf.extensions.contains(std::string(extension))) continue;
    if (material.is_all_metal() && is_of_dielectrics(extension)) continue;
    const std::string what = std::string(extension) + " is ignored by " + std::string(reader->title);
    if (extension == kSpecGlossExtension)
      findings.push_back({rule.name, Confidence::kCertain, material.name, "",
                          what + ", which shows the material by its metallic values instead",
                          asset_fix(material, "convert the material to the metallic workflow", {})});
    else
      findings.push_back(
          {rule.name, Confidence::kCertain, material.name, "", what,
           can_fold(material, extension)
               ? asset_fix(material, "fold it into base color, metallic and roughness", {"--extensions fold"})
               : Fix("express it by base color, metallic and roughness, or remove " +
                     std::string(extension))});
  }
}

void unreadable_statement(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                          std::vector<MaterialFinding>& findings) {
  for (const std::string& failure : material.failures)
    findings.push_back(
        {rule.name, Confidence::kCertain, material.name, "", failure, "correct this line of the file"});
}

// Ns of MTL files is from 0 to 1000 (Wavefront, Advanced Visualizer manual, appendix B).
void exponent_range(const CheckedMaterial& material, const GltfConsumer*, const Rule& rule,
                    std::vector<MaterialFinding>& findings) {
  double largest = 0.0;
  std::size_t below_zero = 0, above_zero = 0, whole_tens = 0;
  for (const double exponent : material.exponents) {
    largest = std::max(largest, exponent);
    below_zero += exponent < 0.0;
    above_zero += exponent > 0.0;
    whole_tens += exponent > 0.0 && std::fmod(exponent, 5.0) == 0.0;
  }
  if (below_zero > 0)
    findings.push_back({rule.name, Confidence::kLikely, material.path.string(), "",
                        std::to_string(below_zero) + (below_zero == 1 ? " exponent is" : " exponents are") +
                            " below 0, which texremap convert treats as no highlight",
                        "write the exponent of the highlight as Ns, or 0 for none"});
  if (above_zero == 0) return;
  const std::string context = material.path.string(), all = std::to_string(above_zero) +
                                                            (above_zero == 1 ? " exponent" : " exponents") +
                                                            " (Ns) up to " + number_text(largest);
  const auto add = [&](Confidence confidence, const std::string& what, const std::string& fix) {
    findings.push_back({rule.name, confidence, context, "", all + ": " + what, fix});
  };
  if (largest <= 1.0)
    add(above_zero > 1 ? Confidence::kLikely : Confidence::kPossible,
        "a fraction from 0 to 1, but the format has exponents from 0 to 1000",
        "multiply Ns by the range that the exporter meant: 1000, or 128 for fixed-function GL");
  else if (largest > 1000.0)
    add(Confidence::kCertain, "beyond the range of the format, 0 to 1000",
        "divide Ns until it is at most 1000");
  else if (largest <= 100.0 && above_zero >= 3 && whole_tens == above_zero)
    add(Confidence::kPossible, "all are multiples of 5 up to 100, which looks like percent",
        "multiply Ns by 10, if the exporter wrote percent of the range 0 to 1000");
  else if (largest == 128.0 && above_zero >= 2)
    add(Confidence::kPossible, "the largest is 128, which looks like the range of fixed-function GL",
        "multiply Ns by 1000 / 128, if the exporter scaled shininess to 0 to 128");
}

}  // namespace remap::look
