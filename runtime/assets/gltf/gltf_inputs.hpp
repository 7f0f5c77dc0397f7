// This file reads the inputs of glTF materials: factors, and textures that multiply them. A factor keeps its
// text, so that a number that no conversion changes keeps its digits.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
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
  // The following come from KHR_materials_pbrSpecularGlossiness.
  kDiffuse,
  kSpecGlossSpecular,
  kGlossiness,
  // The following come from KHR_materials_specular, KHR_materials_ior, _clearcoat, _sheen and _transmission.
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

// A GltfInputInfo is the place of an input in a material.
struct GltfInputInfo {
  std::string_view object;   // the member or extension that holds it; empty for the material itself
  std::string_view texture;  // the member with the texture; empty if there is none
  std::string_view factor;   // the member with the factor
  std::size_t count = 1;     // count of numbers in the factor; the fourth is opacity
  std::size_t channel = 0;   // channel of the texture, if the factor is one number
  double usual = 1.0;        // default of each number
  double least = 0.0, most = 1.0;
  bool is_in_texture = false;  // true if the factor is a member of the texture
};
const GltfInputInfo& info_of(GltfInput input);
std::span<const GltfInput> all_inputs();

// A FactorText is a number. Its text comes from the file, or is the text of the clamped value.
struct FactorText {
  double value = 1.0;
  std::string text = "1";
};

struct GltfValue {
  std::array<FactorText, 4> factor;  // numbers beyond `count` are 1
  bool is_stated = false;            // true if the file has the factor
  SpanValue texture;                 // the info of the texture, or empty
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

// Reads the given inputs. The others get their defaults. Appends a warning for each factor that it clamps.
// Throws kInput if an object, a list or a number has another type.
GltfMaterial read_inputs(SpanValue material, std::span<const GltfInput> inputs,
                         std::vector<std::string>& warnings);

bool has_textures(const GltfMaterial& material, std::span<const GltfInput> inputs);

// Returns the shortest text that reads back as the float.
inline std::string float_text(float value) { return number_text(decimal_value(value)); }

// Returns true if `own` equals `value`, apart from rounding in floats.
inline bool is_factor(float value, const FactorText& own) {
  return std::fabs(static_cast<double>(value) - own.value) < 1e-6;
}
// Returns the text of `own` if it equals `value`, otherwise a text of `value`.
inline std::string factor_text(float value, const FactorText& own) {
  return is_factor(value, own) ? own.text : float_text(value);
}

// Returns a text such as `[1,0.5,0]`.
std::string list_text(const std::vector<std::string>& entries);

// Returns values in the form of a report.
MaterialFactor reported(std::string name, const std::vector<float>& values);

}  // namespace remap
