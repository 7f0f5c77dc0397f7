// Materials as rows of planar floats: which parameters there are, and the rows of each.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// What maps say of a material, and what a conversion says of its result.
enum class Parameter {
  kWidth,      // of the highlight: roughness, glossiness, alpha or an exponent
  kSpecular,   // reflectance at normal incidence
  kDiffuse,    // of the specular workflow
  kBaseColor,  // of the metallic workflow
  kMetallic,
  kMetalMask,       // source only: which of several metallic values that look alike is meant
  kNearbyMetallic,  // source only: the metallic around a texel, taken where its own is a guess
  kResidual,        // target only: what metallic cannot say of a texel (workflow/diagnosis.hpp)
  kMetallicWidth,   // target only: share of [0, 1] in which metallic could lie
  kDoubts,          // target only: a sum of Doubt, over 255: 8 bits hold it
};
inline constexpr std::size_t kParameterCount = 10;

// Why the metallic material of a texel may not be the one that was meant; powers of two.
enum class Doubt {
  kClamped = 1,     // a parameter beyond 0 to 1, or a base color that would have to be
  kTwoAnswers = 2,  // metallic values apart from each other, none between them, look alike
  kDark = 4,        // metallic is a guess, and diffuse and specular are too dark to tell
  kGuess = 8,       // metallic is a guess: its width is above kGuessWidth
};
// Width of metallic above which it is a guess: maps that were authored in both workflows differ by 0.15 rms
// there, by less than 0.01 below half of it.
inline constexpr float kGuessWidth = 0.2f;
// Diffuse and F0 below which a texel counts as dark, linear.
inline constexpr float kDarkTexel = 0.06f;

// `width`, `specular`, `diffuse`, `base_color`, `metallic`, `metal_mask`, `nearby_metallic`, `residual`,
// `metallic_width`, `doubts`.
std::string_view parameter_name(Parameter parameter);
// `base_color`, as for files and messages; `roughness` for the width, whatever its parameter.
std::string plain_name(Parameter parameter);
// `--base-color`; `--roughness` for the width.
std::string parameter_option(Parameter parameter);
// Whether it is said of the result, and no parameter of it: kResidual, kMetallicWidth, kDoubts.
bool is_measure(Parameter parameter);
// Whether it has three channels, or may have.
bool is_color(Parameter parameter);

// The rows of one parameter: none, one, or one each for red, green and blue.
template <typename Float>
struct ParameterRows {
  std::array<Float*, 3> row{};
  std::size_t count = 0;
};

// Those of all parameters; `count` is 0 for what is not there.
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
