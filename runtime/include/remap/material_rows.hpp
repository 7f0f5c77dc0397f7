// The parameters of materials, and materials as rows of planar floats.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// The parameters of materials, and measures of a conversion.
enum class Parameter {
  kWidth,      // of the highlight: roughness, glossiness, alpha or a Phong exponent
  kSpecular,   // reflectance at normal incidence
  kDiffuse,    // of the specular workflow
  kBaseColor,  // of the metallic workflow
  kMetallic,
  kMetalMask,       // source only: chooses among metallic values that look alike
  kNearbyMetallic,  // source only: metallic around a texel, used if its own is undetermined
  kResidual,        // target only: the part of a texel that metal-rough cannot represent
  kMetallicWidth,   // target only: the share of [0, 1] that metallic could take
  kDoubts,          // target only: the sum of Doubt values, divided by 255, so that 8 bits hold it
};
inline constexpr std::size_t kParameterCount = 10;

// Reasons why the metallic material of a texel may differ from the intended one; powers of two.
enum class Doubt {
  kClamped = 1,     // a parameter is outside [0, 1], or the base color would be
  kTwoAnswers = 2,  // two separate metallic values look alike
  kDark = 4,        // metallic is undetermined, because diffuse and specular are dark
  kGuess = 8,       // metallic is undetermined: kMetallicWidth is above kGuessWidth
};
// The value of kMetallicWidth above which metallic is undetermined: maps authored in both workflows differ by
// 0.15 RMS there, and by less than 0.01 below half of it.
inline constexpr float kGuessWidth = 0.2f;
// A texel is dark if diffuse and F0, linear, are below this value.
inline constexpr float kDarkTexel = 0.06f;

// `width`, `specular`, `diffuse`, `base_color`, `metallic`, `metal_mask`, `nearby_metallic`, `residual`,
// `metallic_width`, `doubts`.
std::string_view parameter_name(Parameter parameter);
// The name in files and messages: `base_color`; always `roughness` for the width.
std::string plain_name(Parameter parameter);
// `--base-color`; `--roughness` for the width.
std::string parameter_option(Parameter parameter);
// Whether it measures the result: kResidual, kMetallicWidth, kDoubts.
bool is_measure(Parameter parameter);
// Whether it can have three channels.
bool is_color(Parameter parameter);

// The rows of one parameter: none, one, or one each for red, green and blue.
template <typename Float>
struct ParameterRows {
  std::array<Float*, 3> row{};
  std::size_t count = 0;
};

// The rows of all parameters; `count` is 0 for an absent one.
template <typename Float>
class MaterialRows {
 public:
  ParameterRows<Float>& operator[](Parameter parameter) noexcept {
    return rows_[static_cast<std::size_t>(parameter)];
  }
  const ParameterRows<Float>& operator[](Parameter parameter) const noexcept {
    return rows_[static_cast<std::size_t>(parameter)];
  }

 private:
  std::array<ParameterRows<Float>, kParameterCount> rows_;
};

}  // namespace remap
