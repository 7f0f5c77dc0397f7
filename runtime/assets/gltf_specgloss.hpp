// Spec-gloss materials of a glTF file become core metallic-roughness, in the text of the file
// (KHR_materials_pbrSpecularGlossiness, an archived extension of Khronos).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/gltf_images.hpp"
#include "assets/json_spans.hpp"
#include "assets/specgloss_factors.hpp"
#include "remap/model.hpp"

namespace remap {

inline constexpr std::string_view kSpecGlossExtension = "KHR_materials_pbrSpecularGlossiness";

enum class MaterialProfile {
  kCore,        // base color, metallic and roughness, by the projection
  kExtensions,  // exact, for viewers that read KHR_materials_specular and KHR_materials_ior
};
inline constexpr NamedValues<MaterialProfile, 2> kMaterialProfiles = {
    {{MaterialProfile::kCore, "core"}, {MaterialProfile::kExtensions, "extensions"}}};

struct SpecGlossOptions {
  MaterialProfile profile = MaterialProfile::kCore;
  double prior = kCleanPrior;  // of the projection
  InstructionSet instructions = best_instruction_set();
  bool enlarges = false;  // images of a material that are smaller than the other one
};

enum class MaterialState {
  kUntouched,  // no spec-gloss
  kConverted,
  kFailed,  // stays spec-gloss
};
inline constexpr NamedValues<MaterialState, 3> kMaterialStates = {{{MaterialState::kUntouched, "untouched"},
                                                                   {MaterialState::kConverted, "converted"},
                                                                   {MaterialState::kFailed, "failed"}}};

// What images need.
struct AssetParts {
  const GltfContainer& container;
  const ByteSource& source;
  const AssetResources& resources;
};

// What becomes of a material of the file.
struct AssetMaterial {
  std::size_t index = 0;
  std::string name;  // of the file; may be empty
  MaterialState state = MaterialState::kUntouched;
  std::optional<SpecGlossFactors> source;   // of a converted one without maps that vary
  std::optional<MetalRoughFactors> result;  // in the exact form metallic is 0
  double residual = 0.0;                    // Parameter::kResidual; of maps the root of its mean square
  std::string becomes;                      // `base color 0.2 0.3 0.4, metallic 0, roughness 0.75`
  std::vector<std::string> warnings;        // without the name of the material
  std::string failure;

  // `material 3 "Paint"`, fit for a message.
  std::string title() const;
};

struct SpecGlossResult {
  std::string json;      // the edited text; the text itself where nothing was converted
  bool changed = false;  // whether a material was converted
  std::vector<AssetMaterial> materials;
  std::vector<std::string> warnings;  // of the file
  std::vector<TextSpan> touched;      // bytes of the source that were replaced or removed
  std::string appended;               // to the binary chunk, from a multiple of four
  std::vector<NewResource> files;     // new images

  std::size_t count(MaterialState state) const;
};

// Throws kInput, beginning with `place`, for a text that is not glTF 2. Without `asset`, materials with
// textures fail.
SpecGlossResult convert_specgloss(const SpannedJson& json, const std::string& place,
                                  const SpecGlossOptions& options = {}, const AssetParts* asset = nullptr);

}  // namespace remap
