// The workflows of glTF materials: their inputs, and what these are for a converter.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/gltf/gltf_inputs.hpp"
#include "assets/gltf/material_textures.hpp"
#include "assets/maps/gltf_maps.hpp"
#include "assets/maps/workflow_values.hpp"

namespace remap {

enum class GltfWorkflow {
  kMetalRough,  // core
  kDielectric,  // core with KHR_materials_specular and _ior, which give dielectrics their F0
  kSpecGloss,   // KHR_materials_pbrSpecularGlossiness
};

// That its conversions read, in the order in which textures follow each other.
std::span<const GltfInput> inputs_of(GltfWorkflow workflow);
// Base color, or diffuse.
GltfInput color_of(GltfWorkflow workflow);

// Reads a material. Throws kInput as read_inputs(), and for an index of refraction between 0 and 1.
GltfMaterial read_material(SpanValue material, GltfWorkflow workflow, std::vector<std::string>& warnings);

// To `target`, a workflow model, with roughness at both ends.
std::unique_ptr<Converter> converter_of(GltfWorkflow workflow, const char* target,
                                        const AssetOptions& options);

// The factors as the converter takes them.
MaterialValues values_of(GltfWorkflow workflow, const GltfMaterial& material);
// The same of the first texel.
MaterialValues first_values_of(GltfWorkflow workflow, GltfMaterial material, const UsedTextures& used);

// Maps of a material, of which at least one varies.
struct GltfMaps {
  GltfMaps(GltfWorkflow workflow, const GltfMaterial& material, const UsedTextures& used);
  GltfMaps(const GltfMaps&) = delete;
  GltfMaps& operator=(const GltfMaps&) = delete;

  // Whose size, type and place new images have.
  const UsedTexture& color_model;
  const UsedTexture& data_model;
  MapSources sources;
  std::string key;  // tells apart what becomes of them: images and factors, but not opacity

 private:
  ImagePixels f0_;  // of kDielectric
};

// Loads the textures of some inputs, as MaterialTextures::load(). None where all maps are constant: they are
// then factors of `material`. Throws kInput where no images can be read.
std::optional<UsedTextures> used_textures(MaterialTextures* textures, GltfMaterial& material,
                                          std::span<const GltfInput> inputs, const GridReason& reason,
                                          std::vector<std::string>& warnings);

}  // namespace remap
