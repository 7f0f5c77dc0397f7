// This file describes the workflows of glTF materials: their inputs, and what the inputs mean to a converter.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/gltf/gltf_inputs.hpp"
#include "assets/gltf/material_textures.hpp"
#include "assets/maps/gltf_maps.hpp"

namespace remap {

enum class GltfWorkflow {
  kMetalRough,  // core glTF
  kDielectric,  // core with KHR_materials_specular and _ior, which set the F0 of dielectrics
  kSpecGloss,   // KHR_materials_pbrSpecularGlossiness
};

// Returns the inputs that conversions of the workflow read. Messages name textures in this order.
std::span<const GltfInput> inputs_of(GltfWorkflow workflow);
// Returns the input that holds base color or diffuse.
GltfInput color_of(GltfWorkflow workflow);

// Reads the inputs of the workflow. Throws like read_inputs(), and kInput for an index between 0 and 1.
GltfMaterial read_material(SpanValue material, GltfWorkflow workflow, std::vector<std::string>& warnings);

// Makes the converter from the workflow to the workflow model `target`. Both ends have roughness.
std::unique_ptr<Converter> converter_of(GltfWorkflow workflow, const char* target,
                                        const AssetOptions& options);

// Returns the factors in the form that the converter reads.
MaterialValues values_of(GltfWorkflow workflow, const GltfMaterial& material);
// Returns the factors times the first texel of each texture.
MaterialValues first_values_of(GltfWorkflow workflow, GltfMaterial material, const UsedTextures& used);

// A GltfMaps holds the maps of a material in the form that a converter reads. At least one of them varies.
// `used` must outlive it.
struct GltfMaps {
  GltfMaps(GltfWorkflow workflow, const GltfMaterial& material, const UsedTextures& used);
  GltfMaps(const GltfMaps&) = delete;
  GltfMaps& operator=(const GltfMaps&) = delete;

  // New images have the size, pixel type and storage of these images.
  const UsedTexture& color_model;
  const UsedTexture& data_model;
  MapSources sources;
  std::string key;  // materials with equal keys have equal results, except for opacity

 private:
  ImagePixels f0_;  // only for kDielectric
};

// Returns `textures`, which read images. Throws kInput if `textures` is null.
MaterialTextures& require_images(MaterialTextures* textures);

// Loads the textures of the given inputs by MaterialTextures::load(). If all maps are constant, returns
// nothing, and `material` has their values as factors. Throws kInput if no images can be read.
std::optional<UsedTextures> used_textures(MaterialTextures* textures, GltfMaterial& material,
                                          std::span<const GltfInput> inputs, const GridReason& reason,
                                          std::vector<std::string>& warnings);

}  // namespace remap
