// This file folds KHR_materials_specular and KHR_materials_ior into core. The material is first converted to
// spec-gloss, and from there to core by the projection. One converter does both.
#include <memory>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/core_maker.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "core/errors.hpp"

namespace remap {
namespace {

class SpecularFold final : public GltfDirection {
 public:
  SpecularFold(const AssetOptions& options, MaterialTextures* textures)
      : maker_(options, textures, GltfWorkflow::kDielectric, {"metallic", ""}) {}

  bool applies_to(SpanValue material) const override {
    const SpanValue extensions = material["extensions"];
    return (extensions[kSpecularExtension] || extensions[kIorExtension]) &&
           !extensions[kSpecGlossExtension] && !extensions[kUnlitExtension];
  }

  std::vector<std::string> replaced() const override {
    return {std::string(kCoreMember), "extensions/" + std::string(kSpecularExtension),
            "extensions/" + std::string(kIorExtension)};
  }

  MaterialEdit convert(SpanValue material, AssetMaterial& report) override {
    // These extensions also use the index to bend light. Core glTF always has the index 1.5.
    for (const char* name : {"KHR_materials_volume", "KHR_materials_dispersion"})
      if (material["extensions"][name])
        throw input_error("has " + std::string(name) +
                          ", which needs KHR_materials_ior (convert it without --extensions fold)");
    GltfMaterial read = read_material(material, GltfWorkflow::kDielectric, report.warnings);
    const CoreTexts texts = maker_.convert(read, report);
    report.residual = texts.residual;
    report.becomes =
        core_summary(texts, "base color map") + (texts.metal_rough_texture ? ", both times map" : "");
    MaterialEdit edit;
    edit.material = material;
    edit.core = core_members(texts);
    edit.removed_extensions = {kSpecularExtension, kIorExtension};
    if (texts.has_metal)
      edit.vertex_color_warning = "tinted its diffuse color and now tint its reflection, too";
    return edit;
  }

 private:
  CoreMaker maker_;
};

}  // namespace

std::unique_ptr<GltfDirection> make_specular_fold(const AssetOptions& options, MaterialTextures* textures) {
  return std::make_unique<SpecularFold>(options, textures);
}

}  // namespace remap
