// This file describes whole materials: the inputs of surface models, and translations between the models.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

// A Surface is a model of whole materials. OpenPBR is the hub: every translation passes through it.
enum class Surface {
  kOpenPbr,             // OpenPBR Surface 1.1.1
  kStandardSurface,     // Autodesk Standard Surface 1.0.1
  kGltf,                // gltf_pbr of MaterialX 1.39
  kUsdPreview,          // UsdPreviewSurface with metallic
  kUsdPreviewSpecular,  // UsdPreviewSurface with useSpecularWorkflow 1
  kPrincipled,          // Principled BSDF of Blender 5
};

// A SurfaceInput is one input of a model. Colors are linear.
struct SurfaceInput {
  std::string_view name;                // name in the model
  std::optional<Parameter> parameter;   // unset if a map cannot provide it (switches, occlusion)
  std::size_t channels = 1;             // 1 or 3
  std::array<float, 3> value{};         // default
  std::optional<std::size_t> weight{};  // index of another input that hides this input if it is 0
};

// Returns the inputs in the order of the model's definition.
std::span<const SurfaceInput> inputs_of(Surface surface);

// Returns the parameters of the inputs, in the order of Parameter.
std::vector<Parameter> parameters_of(Surface surface);

// Returns the parameter of that name: `roughness`, `base_color`, or an input of any surface, such as
// `coat_weight`. Models have several names for one parameter (`coat`, `clearcoat`). Returns nothing if no
// model has the name.
std::optional<Parameter> parameter_named(std::string_view name);
// Returns every name that parameter_named() knows.
std::vector<std::string> parameter_names();

// A SurfaceTranslation converts whole materials by the closed forms of generated/materials/materials.hpp.
struct SurfaceTranslation {
  Surface source, target;

  // Translates one material. Both arrays have the channels of all inputs, in order.
  void run(const float* source_values, float* target_values) const;
};

// Makes a converter between the parameters of both models. `ends` has the id, models and width encodings.
std::unique_ptr<Converter> make_translation_converter(const SurfaceTranslation& translation,
                                                      ConverterInfo ends);

// A SurfaceValue is an input that has one value for the whole material.
struct SurfaceValue {
  std::string name;
  std::vector<float> values;  // 1 or 3
};

// A TranslationEffect is what a translation makes of one material, some of whose inputs are maps.
struct TranslationEffect {
  std::vector<Parameter> written;    // targets that depend on a map
  std::vector<Parameter> unchanged;  // targets in `written` whose values are the source's
  std::vector<Parameter> wide;       // targets in `written` with values outside of 0 to 1
  std::vector<SurfaceValue> values;  // other targets whose value is not the default
  std::vector<std::string> lost;     // given sources that no target depends on
};

// Finds the effect by translating random texels. `given` has the constants of a source parameter, or nothing
// if the parameter is a map. Other inputs have their defaults.
using GivenInputs = std::map<Parameter, std::optional<std::vector<float>>>;
TranslationEffect effect_of(const SurfaceTranslation& translation, const GivenInputs& given);

}  // namespace remap
