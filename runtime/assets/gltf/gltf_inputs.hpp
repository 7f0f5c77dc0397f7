// The inputs of glTF materials as a file describes them: factors, and textures that multiply them. A factor
// keeps its text: a number that no conversion changes stays as it is written.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"
#include "core/json_spans.hpp"
#include "core/number_text.hpp"

namespace remap {

enum class GltfInput : std::size_t {
  kBaseColor,
  kMetallic,
  kRoughness,
  kNormal,
  kOcclusion,
  kEmissive,
  // KHR_materials_pbrSpecularGlossiness
  kDiffuse,
  kSpecGlossSpecular,
  kGlossiness,
  // KHR_materials_specular, _ior, _clearcoat, _sheen and _transmission
  kSpecularColor,
  kSpecular,
  kIor,
  kClearcoat,
  kClearcoatRoughness,
  kSheenColor,
  kSheenRoughness,
  kTransmission,
};
inline constexpr std::size_t kGltfInputs = 17;

// The place of an input in a material.
struct GltfInputInfo {
  std::string_view object;   // the member or extension that holds it; empty for the material itself
  std::string_view texture;  // the member with the texture; empty if an input has none
  std::string_view factor;   // the member with the factor
  std::size_t count = 1;     // how many numbers the factor has; the fourth is opacity
  std::size_t channel = 0;   // which channel of the texture is read, if the factor is one number
  double usual = 1.0;        // the default of each number
  double least = 0.0, most = 1.0;
  bool is_in_texture = false;  // the factor is a member of the texture
};
const GltfInputInfo& info_of(GltfInput input);
std::span<const GltfInput> all_inputs();

// A number as the file writes it, or as it was clamped.
struct FactorText {
  double value = 1.0;
  std::string text = "1";
};

struct GltfValue {
  std::array<FactorText, 4> factor;  // numbers beyond the count are 1
  bool is_stated = false;            // whether the file has the factor
  SpanValue texture;                 // the info of the texture; empty without one
};

struct GltfMaterial {
  SpanValue text;
  std::array<GltfValue, kGltfInputs> values;

  GltfValue& operator[](GltfInput input) { return values[static_cast<std::size_t>(input)]; }
  const GltfValue& operator[](GltfInput input) const { return values[static_cast<std::size_t>(input)]; }
  double number(GltfInput input) const { return (*this)[input].factor[0].value; }
  std::array<double, 3> color(GltfInput input) const {
    const std::array<FactorText, 4>& factor = (*this)[input].factor;
    return {factor[0].value, factor[1].value, factor[2].value};
  }
};

// Reads the given inputs; the others get their defaults. Appends a warning for each factor that it clamps.
// Throws kInput if an object, a list or a number is something else.
GltfMaterial read_inputs(SpanValue material, std::span<const GltfInput> inputs,
                         std::vector<std::string>& warnings);

bool has_textures(const GltfMaterial& material, std::span<const GltfInput> inputs);

// The shortest text that reads back as the float.
inline std::string float_text(float value) { return number_text(decimal_value(value)); }

// Whether `own` is that number; arithmetic of floats moves a factor by less.
inline bool is_factor(float value, const FactorText& own) {
  return std::fabs(static_cast<double>(value) - own.value) < 1e-6;
}
// The text of `own` where it is that number, otherwise a text of the number.
inline std::string factor_text(float value, const FactorText& own) {
  return is_factor(value, own) ? own.text : float_text(value);
}

// `[1,0.5,0]`.
std::string list_text(const std::vector<std::string>& entries);

// Values as a report gives them.
MaterialFactor reported(std::string name, const std::vector<float>& values);

}  // namespace remap
