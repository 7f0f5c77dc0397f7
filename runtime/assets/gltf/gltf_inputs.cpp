#include "assets/gltf/gltf_inputs.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "assets/document/gltf_extensions.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kExcerptLength = 40;
constexpr double kNoLimit = std::numeric_limits<double>::max();
constexpr std::string_view kClearcoat = "KHR_materials_clearcoat", kSheen = "KHR_materials_sheen";

// The order is the same as in GltfInput. The sources are glTF 2.0, 5.19 to 5.22, and the extensions of
// Khronos.
constexpr std::array<GltfInputInfo, kGltfInputs> kInputs = {{
    {kCoreMember, "baseColorTexture", "baseColorFactor", 4},
    {kCoreMember, "metallicRoughnessTexture", "metallicFactor", 1, 2},
    {kCoreMember, "metallicRoughnessTexture", "roughnessFactor", 1, 1},
    {"", "normalTexture", "scale", 1, 0, 1.0, -kNoLimit, kNoLimit, true},
    {"", "occlusionTexture", "strength", 1, 0, 1.0, 0.0, 1.0, true},
    {"", "emissiveTexture", "emissiveFactor", 3, 0, 0.0},
    {kSpecGlossExtension, "diffuseTexture", "diffuseFactor", 4},
    {kSpecGlossExtension, "specularGlossinessTexture", "specularFactor", 3},
    {kSpecGlossExtension, "specularGlossinessTexture", "glossinessFactor", 1, 3},
    {kSpecularExtension, "specularColorTexture", "specularColorFactor", 3, 0, 1.0, 0.0, kNoLimit},
    {kSpecularExtension, "specularTexture", "specularFactor", 1, 3},
    {kIorExtension, "", "ior", 1, 0, 1.5, 0.0, kNoLimit},
    {kClearcoat, "clearcoatTexture", "clearcoatFactor", 1, 0, 0.0},
    {kClearcoat, "clearcoatRoughnessTexture", "clearcoatRoughnessFactor", 1, 1, 0.0},
    {kSheen, "sheenColorTexture", "sheenColorFactor", 3, 0, 0.0},
    {kSheen, "sheenRoughnessTexture", "sheenRoughnessFactor", 1, 3, 0.0},
    {kTransmissionExtension, "transmissionTexture", "transmissionFactor", 1, 0, 0.0},
}};

SpanValue object_in(SpanValue object, std::string_view name) {
  const SpanValue value = object[name];
  if (value && !value.is(SpanKind::kObject)) throw input_error(std::string(name) + ": expected an object");
  return value;
}

SpanValue object_of(SpanValue material, std::string_view name) {
  if (name.empty()) return material;
  return name == kCoreMember ? object_in(material, name) : object_in(object_in(material, "extensions"), name);
}

FactorText read_number(SpanValue value, const GltfInputInfo& info, std::vector<std::string>& warnings) {
  const std::optional<double> number = value.number();
  const std::string name(info.factor), found = plain(value.raw(), kExcerptLength);
  const bool has_most = info.most != kNoLimit;
  if (!number)
    throw input_error(name + ": expected a number" +
                      (info.least < 0.0 ? ""
                       : has_most       ? " from 0 to " + number_text(info.most)
                                        : " from 0") +
                      ", found " + found);
  const double clamped = std::clamp(*number, info.least, info.most);
  if (clamped == *number) return {clamped, std::string(value.raw())};
  warnings.push_back(name + " " + found + " is outside of 0 to " +
                     (has_most ? number_text(info.most) : "infinity") + " and becomes " +
                     number_text(clamped));
  return {clamped, number_text(clamped)};
}

void read_factor(SpanValue value, const GltfInputInfo& info, GltfValue& result,
                 std::vector<std::string>& warnings) {
  if (info.count == 1) {
    result.factor[0] = read_number(value, info, warnings);
    return;
  }
  const std::vector<SpanValue> entries = value.entries();
  if (entries.size() != info.count)
    throw input_error(std::string(info.factor) + ": expected a list of " + std::to_string(info.count) +
                      " numbers, found " + plain(value.raw(), kExcerptLength));
  for (std::size_t i = 0; i < entries.size(); ++i) result.factor[i] = read_number(entries[i], info, warnings);
}

}  // namespace

std::span<const GltfInput> all_inputs() {
  static const auto inputs = [] {
    std::array<GltfInput, kGltfInputs> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<GltfInput>(i);
    return all;
  }();
  return inputs;
}

const GltfInputInfo& info_of(GltfInput input) { return kInputs[static_cast<std::size_t>(input)]; }

GltfMaterial read_inputs(SpanValue material, std::span<const GltfInput> inputs,
                         std::vector<std::string>& warnings) {
  GltfMaterial read;
  read.text = material;
  for (std::size_t i = 0; i < kGltfInputs; ++i)
    for (std::size_t c = 0; c < kInputs[i].count; ++c)
      read.values[i].factor[c] = {kInputs[i].usual, number_text(kInputs[i].usual)};
  for (const GltfInput input : inputs) {
    const GltfInputInfo& info = info_of(input);
    GltfValue& result = read[input];
    const SpanValue object = object_of(material, info.object);
    if (!info.texture.empty()) result.texture = object[info.texture];
    const SpanValue factor = (info.is_in_texture ? result.texture : object)[info.factor];
    result.is_stated = static_cast<bool>(factor);
    if (factor) read_factor(factor, info, result, warnings);
  }
  return read;
}

bool has_textures(const GltfMaterial& material, std::span<const GltfInput> inputs) {
  return std::ranges::any_of(inputs,
                             [&](GltfInput input) { return static_cast<bool>(material[input].texture); });
}

std::string list_text(const std::vector<std::string>& entries) { return "[" + joined(entries, ",") + "]"; }

MaterialFactor reported(std::string name, const std::vector<float>& values) {
  MaterialFactor factor{std::move(name), {}};
  for (const float value : values) factor.values.push_back(decimal_value(value));
  return factor;
}

}  // namespace remap
