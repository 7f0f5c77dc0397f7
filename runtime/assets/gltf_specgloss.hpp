// Spec-gloss materials of a glTF file become core metallic-roughness, in the text of the file
// (KHR_materials_pbrSpecularGlossiness, an archived extension of Khronos).
#pragma once

#include <string>
#include <string_view>

#include "assets/asset.hpp"
#include "assets/gltf_container.hpp"
#include "assets/json_spans.hpp"

namespace remap {

inline constexpr std::string_view kSpecGlossExtension = "KHR_materials_pbrSpecularGlossiness";

// What images need.
struct AssetParts {
  const GltfContainer& container;
  const ByteSource& source;
  const AssetResources& resources;
};

struct SpecGlossResult {
  AssetConversion asset;  // without pieces and resources
  std::string appended;   // to the binary chunk, from a multiple of four
};

// Throws kInput, beginning with `place`, for a text that is not glTF 2. Without `asset`, materials with
// textures fail.
SpecGlossResult convert_specgloss(const SpannedJson& json, const std::string& place,
                                  const AssetOptions& options = {}, const AssetParts* asset = nullptr);

}  // namespace remap
