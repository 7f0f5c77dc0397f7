#include "assets/gltf/core_material.hpp"

#include <utility>

#include "assets/document/gltf_extensions.hpp"
#include "core/errors.hpp"

namespace remap {
namespace {

SpanValue object_in(SpanValue object, std::string_view name) {
  const SpanValue value = object[name];
  if (value && !value.is(SpanKind::kObject)) throw input_error(std::string(name) + ": expected an object");
  return value;
}

}  // namespace

CoreFactors CoreMaterial::factors() const {
  return {{base_color[0].value, base_color[1].value, base_color[2].value},
          metallic.value,
          roughness.value,
          remap::f0_of_index(ior.value),
          specular.value,
          {specular_color[0].value, specular_color[1].value, specular_color[2].value}};
}

CoreMaterial read_core_material(SpanValue material, std::vector<std::string>& warnings) {
  CoreMaterial read;
  read.material = material;
  const SpanValue core = object_in(material, kCoreMember), extensions = object_in(material, "extensions"),
                  specular = object_in(extensions, kSpecularExtension),
                  ior = object_in(extensions, kIorExtension);
  const FactorReader core_factors(core, warnings), specular_factors(specular, warnings),
      ior_factors(ior, warnings);
  core_factors.read("baseColorFactor", read.base_color);
  core_factors.read("metallicFactor", read.metallic);
  core_factors.read("roughnessFactor", read.roughness);
  specular_factors.read("specularFactor", read.specular);
  specular_factors.read("specularColorFactor", read.specular_color, FactorReader::kNoLimit);
  ior_factors.read("ior", read.ior, FactorReader::kNoLimit);
  if (read.ior.value > 0.0 && read.ior.value < 1.0)
    throw input_error("ior " + read.ior.text + ": expected 0 or a number from 1");
  read.base_texture = core["baseColorTexture"];
  read.metal_rough_texture = core["metallicRoughnessTexture"];
  read.specular_texture = specular["specularTexture"];
  read.specular_color_texture = specular["specularColorTexture"];
  read.has_dielectric = specular || ior;
  return read;
}

std::vector<MemberText> core_members(const CoreTexts& texts) {
  return {{"baseColorFactor", list_text({texts.base_color.begin(), texts.base_color.end()}), {}},
          {"baseColorTexture", "", texts.base_texture},
          {"metallicFactor", texts.metallic, {}},
          {"roughnessFactor", texts.roughness, {}},
          {"metallicRoughnessTexture", "", texts.metal_rough_texture}};
}

std::string core_summary(const CoreTexts& texts, const std::string& kept) {
  std::string text = "base color ";
  if (texts.base_texture) text += (texts.base_texture.added ? "map" : kept) + " times ";
  text += texts.base_color[0] + " " + texts.base_color[1] + " " + texts.base_color[2];
  if (texts.base_color[3] != "1") text += ", alpha " + texts.base_color[3];
  text += ", metallic " + texts.metallic + ", roughness " + texts.roughness;
  return text;
}

}  // namespace remap
