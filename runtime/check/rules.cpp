#include "check/rules.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "core/number_text.hpp"

namespace remap {
namespace {

using namespace std::string_view_literals;

constexpr std::array kExtensions = {"KHR_materials_specular"sv,
                                    "KHR_materials_ior"sv,
                                    "KHR_materials_clearcoat"sv,
                                    "KHR_materials_sheen"sv,
                                    "KHR_materials_transmission"sv,
                                    "KHR_materials_volume"sv,
                                    "KHR_materials_iridescence"sv,
                                    "KHR_materials_anisotropy"sv,
                                    "KHR_materials_dispersion"sv,
                                    "KHR_materials_diffuse_transmission"sv,
                                    "KHR_materials_pbrSpecularGlossiness"sv};
// This list has all extensions except the last. The lists below are for importers that ignore fewer
// extensions.
constexpr std::span kAllButSpecGloss = std::span(kExtensions).first(10);
constexpr std::array kThree = {"KHR_materials_pbrSpecularGlossiness"sv};
constexpr std::array kUnreal = {"KHR_materials_volume"sv, "KHR_materials_iridescence"sv,
                                "KHR_materials_anisotropy"sv, "KHR_materials_dispersion"sv,
                                "KHR_materials_diffuse_transmission"sv};
constexpr std::array kUsd = {"KHR_materials_sheen"sv,
                             "KHR_materials_transmission"sv,
                             "KHR_materials_volume"sv,
                             "KHR_materials_iridescence"sv,
                             "KHR_materials_anisotropy"sv,
                             "KHR_materials_dispersion"sv,
                             "KHR_materials_diffuse_transmission"sv};

constexpr std::array<GltfConsumer, 6> kReaders = {{
    {"gltf", "an importer of core glTF 2.0", kExtensions},
    {"unity", "Unity (glTFast, Lit shader)", kAllButSpecGloss, true},
    {"unreal", "Unreal Engine (Interchange)", kUnreal, false, true},
    {"godot", "Godot 4", kAllButSpecGloss},
    {"threejs", "three.js (GLTFLoader)", kThree},
    {"usd", "UsdPreviewSurface", kUsd},
}};

constexpr std::array<Rule, 22> kRules = {{
    {"srgb-data", "a map of numbers (roughness, metallic, normal, ...) that its file tags as sRGB",
     look::srgb_data},
    {"linear-color", "a color map of integers whose file has the tag linear", look::linear_color},
    {"specular-color",
     "a specular map that is black or white everywhere, or whose F0 only fits another color space",
     look::specular_color},
    {"gloss-as-roughness", "a roughness map that holds gloss, or a gloss map that holds roughness",
     look::gloss_as_roughness},
    {"alpha-as-roughness", "a roughness map that is the square of another map of the set",
     look::alpha_as_roughness},
    {"channel-order", "a packed map with metallic in the wrong channel: another channel is black and white",
     look::channel_order},
    {"specgloss-channels", "a map whose name or role needs an alpha channel that the file lacks",
     look::specgloss_channels},
    {"sizes", "maps of a set that differ in size", look::sizes},
    {"metallic-greys", "metallic between 0 and 1 over areas, not only at edges", look::metallic_greys},
    {"factor-zero", "a map times a factor of 0", look::factor_zero},
    {"factor-ignored", "a factor of a map that the given importer ignores", look::factor_ignored},
    {"normal-space", "a normal map in world or object space instead of tangent space", look::normal_space},
    {"normal-orientation", "a normal map whose green channel is inverted, contrary to its name",
     look::normal_orientation},
    {"wrong-texture",
     "a map that is used for something else: normals as a color, a color as normals, one image for two roles",
     look::wrong_texture},
    {"constant-map", "a map of one value, which a number replaces", look::constant_map},
    {"banding", "low roughness in 8 bits, where one step widens highlights visibly", look::banding},
    {"bad-values", "NaN, infinite or negative values, or values above 1, in a map of floating-point numbers",
     look::bad_values},
    {"ior", "an index of refraction or a specular factor that no material has", look::index_of_refraction},
    {"ignored-by-reader", "an extension of a glTF material that the given importer does not know",
     look::ignored_by_reader},
    {"unreadable-statement", "a line of an MTL file that convert refuses", look::unreadable_statement},
    {"exponent-range", "exponents of an MTL file that are not in the range 0 to 1000", look::exponent_range},
    {"duplicate-map", "two files of different roles with the same texels", look::duplicate_map},
}};

}  // namespace

std::span<const GltfConsumer> gltf_consumers() { return kReaders; }

std::span<const Rule> rules() { return kRules; }

std::vector<MaterialFinding> findings_in(const CheckedMaterial& material, const GltfConsumer* reader) {
  std::vector<MaterialFinding> findings;
  for (const Rule& rule : kRules) rule.look(material, reader, rule, findings);
  // If a map does not hold what its role states, rules about its values do not apply.
  std::set<std::string> misread;
  for (const MaterialFinding& finding : findings)
    if (finding.rule == "wrong-texture" || finding.rule == "channel-order") misread.insert(finding.context);
  std::erase_if(findings, [&](const MaterialFinding& finding) {
    return misread.contains(finding.context) &&
           (finding.rule == "metallic-greys" || finding.rule == "banding");
  });
  return findings;
}

void unite_conversions(const std::vector<MaterialFinding*>& findings) {
  std::map<std::string, std::set<std::string>> options;
  for (const MaterialFinding* finding : findings)
    options[finding->fix.asset].insert(finding->fix.options.begin(), finding->fix.options.end());
  for (MaterialFinding* finding : findings) {
    Fix& fix = finding->fix;
    if (fix.asset.empty()) continue;
    fix.command = "texremap convert " + shell_word(fix.asset) + " --to gltf";
    for (const std::string& option : options[fix.asset]) fix.command += " " + option;
    fix.command += " -o " + shell_word(fix.output);
  }
}

bool is_color_role(Role role) {
  return role == Role::kBaseColor || role == Role::kDiffuse || role == Role::kSpecular;
}

bool is_data_role(Role role) {
  return is_roughness(role) || role == Role::kMetallic || role == Role::kOcclusion || role == Role::kNormal ||
         role == Role::kHeight || role == Role::kCavity;
}

std::filesystem::path fixed_folder(const CheckedMaterial& material) {
  return material.below.empty() ? "fixed" : "fixed" / material.below;
}

Fix image_fix(const CheckedMaterial& material, const MaterialMap& map, const std::string& words,
              const std::string& changes) {
  if (map.is_embedded) return words + " (the image is part of the asset)";
  const std::filesystem::path home =
      material.kind == MaterialKind::kFolder ? material.path : material.path.parent_path();
  std::filesystem::path name = map.file.lexically_relative(home.empty() ? "." : home);
  if (name.empty() || name == "." || *name.begin() == "..") name = map.name;
  const std::filesystem::path result = fixed_folder(material) / name;
  // The first option stops oiiotool from multiplying colors by alpha and dividing them again.
  return {words, "mkdir -p " + shell_word(result.parent_path().string()) + " && oiiotool --no-autopremult " +
                     shell_word(map.file.string()) + " " + changes + " -o " + shell_word(result.string())};
}

std::string numbers_for(const CheckedMaterial& material, const MaterialUse& use, double value,
                        double otherwise) {
  const ImageLayout& layout = material.texels(use)->layout;
  const std::optional<std::size_t> own = material.channel(use);
  const bool is_whole = use.channels == Channels::kWhole || use.channels == Channels::kRgb;
  std::string text;
  for (std::size_t c = 0; c < layout.channels.size(); ++c) {
    const bool is_alpha = static_cast<int>(c) == layout.alpha_channel;
    const bool is_changed = is_whole && !is_alpha ? true : own == c;
    text += (c > 0 ? "," : "") + number_text(is_changed ? value : otherwise);
  }
  return text;
}

std::string inversion_of(const CheckedMaterial& material, const MaterialUse& use) {
  return "--mulc " + numbers_for(material, use, -1.0, 1.0) + " --addc " +
         numbers_for(material, use, 1.0, 0.0);
}

namespace {

using Rows = std::vector<std::vector<float>>;

// Returns the largest channel of each texel.
std::vector<float> largest_of(const Rows& rows) {
  std::vector<float> largest = rows.front();
  for (const std::vector<float>& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) largest[i] = std::max(largest[i], row[i]);
  return largest;
}

double share_within(const std::vector<float>& values, float low, float high) {
  const auto inside =
      std::count_if(values.begin(), values.end(), [&](float v) { return v >= low && v <= high; });
  return static_cast<double>(inside) / static_cast<double>(values.size());
}

bool all_are(const Rows& rows, float value) {
  return std::ranges::all_of(
      rows, [&](const auto& row) { return std::ranges::all_of(row, [&](float v) { return v == value; }); });
}

// Most materials are dielectrics with an F0 of 0.03 to 0.05. In the wrong color space, this becomes 0.19 to
// 0.25, which only a few gems have, or 0.002 to 0.004, which no material has.
std::optional<ColorIssue> transfer_issue(Transfer transfer, const Rows& linear) {
  constexpr double kMuch = 0.4, kLittle = 0.05;
  const std::vector<float> values = largest_of(linear);
  if (share_within(values, 0.027f, 0.055f) > kLittle) return std::nullopt;
  const bool is_srgb = transfer == Transfer::kSrgb;
  const double share = is_srgb ? share_within(values, 0.0018f, 0.0045f) : share_within(values, 0.185f, 0.26f);
  if (share < kMuch) return std::nullopt;
  return ColorIssue{std::string("is ") + (is_srgb ? "0.002 to 0.0045" : "0.19 to 0.26") + " in " +
                        fixed(100.0 * share, 0) + " % of the texels, like F0 0.04 stored " +
                        (is_srgb ? "linear" : "in sRGB"),
                    is_srgb ? Transfer::kLinear : Transfer::kSrgb};
}

// Finds the same issues as color_issue(). The text does not name the transfer curve yet.
std::optional<ColorIssue> issue_of(Role role, Transfer transfer, const Rows& linear) {
  const bool is_specular = role == Role::kSpecular;
  if (!is_specular && role != Role::kDiffuse && role != Role::kBaseColor) return std::nullopt;
  if (linear.empty() || linear.front().empty()) return std::nullopt;
  if (all_are(linear, 0.0f) && role != Role::kDiffuse)
    return ColorIssue{std::string("is black everywhere (") +
                          (is_specular ? "dielectrics have a linear F0 of 0.04)" : "a color is needed)"),
                      {}};
  if (all_are(linear, 1.0f))
    return ColorIssue{
        std::string("is white everywhere (") +
            (is_specular ? "F0 is needed, not a specular strength)" : "a reflectance below 1 is needed)"),
        {}};
  return is_specular ? transfer_issue(transfer, linear) : std::nullopt;
}

}  // namespace

std::optional<ColorIssue> color_issue(Role role, Transfer transfer, const Rows& linear) {
  std::optional<ColorIssue> issue = issue_of(role, transfer, linear);
  if (issue) issue->text = "read as " + std::string(name_of(kTransfers, transfer)) + ", " + issue->text;
  return issue;
}

}  // namespace remap
