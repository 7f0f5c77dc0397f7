// Converters: rows of planar floats in, rows of planar floats out. A converter is a list of stages: the
// polynomials that a fit was lowered to, changes of the workflow, a warp. A chain of converters is the list
// of all their stages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "remap/model.hpp"

namespace remap {

// The instruction sets that converters are compiled for, and those of this processor.

// Each includes the ones before it. Other processors than x86-64 have the baseline only.
enum class InstructionSet {
  kBaseline,  // that of the whole program
  kAvx2,
  kAvx512,  // F, VL, BW and DQ: Intel's servers since 2017, AMD's processors since 2022
};

// `baseline`, `avx2`, `avx512`: the word on the command line and in JSON.
std::string_view instruction_set_name(InstructionSet set);

// The widest set that this processor, its operating system and this build support.
InstructionSet best_instruction_set();

// Returns all instruction sets from the baseline up to `best`.
std::vector<InstructionSet> instruction_sets(InstructionSet best = best_instruction_set());

// The set of that name. Throws kUsage, with `context` at the start of the message, if the name is unknown or
// the set is beyond `best`.
InstructionSet instruction_set_from_name(const std::string& context, const std::string& name,
                                         InstructionSet best = best_instruction_set());

// The parameters of materials, and materials as rows of planar floats.

// The parameters of materials, and measures of a conversion.
enum class Parameter {
  kRoughness,  // of the highlight: roughness, glossiness, alpha or a Phong exponent
  kSpecular,   // reflectance at normal incidence
  kDiffuse,    // of the specular workflow
  kBaseColor,  // of the metallic workflow
  kMetallic,
  kMetalMask,            // source only: chooses among metallic values that look alike
  kResidual,             // target only: the part of a texel that metal-rough cannot represent
  kMetallicUncertainty,  // target only: the share of [0, 1] that metallic could take
  kMetallicIssues,  // target only: the sum of MetallicIssue values, divided by 255, so that 8 bits hold it
};
inline constexpr std::size_t kParameterCount = 9;

// Reasons why the metallic material of a texel may differ from the intended one; powers of two.
enum class MetallicIssue {
  kClamped = 1,       // a parameter is outside [0, 1], or the base color would be
  kAmbiguous = 2,     // two separate metallic values look alike
  kDark = 4,          // metallic is undetermined, because diffuse and specular are dark
  kUndetermined = 8,  // metallic is undetermined: kMetallicUncertainty is above kUndeterminedWidth
};
// The value of kMetallicUncertainty above which metallic is undetermined: maps authored in both workflows
// differ by 0.15 RMS there, and by less than 0.01 below half of it.
inline constexpr float kUndeterminedWidth = 0.2f;
// A texel is dark if diffuse and F0, linear, are below this value.
inline constexpr float kDarkTexel = 0.06f;

// `width`, `specular`, `diffuse`, `base_color`, `metallic`, `metal_mask`, `residual`,
// `metallic_uncertainty`, `issues`.
std::string_view parameter_name(Parameter parameter);
// The name in files and messages: `base_color`; always `roughness` for the width.
std::string plain_name(Parameter parameter);
// `--base-color`; `--roughness` for the width.
std::string parameter_option(Parameter parameter);
// Whether it measures the result: kResidual, kMetallicUncertainty, kMetallicIssues.
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

// How far pictures of spheres differ from those of the source: RMSE of display values under environments, in
// percent of the display's range. Mean over materials and lights that had no part in the fit.
struct PictureDifference {
  double converted = 0.0;
  double copied = 0.0;  // where the numbers are copied instead
  bool operator==(const PictureDifference&) const = default;
};

// Facts about a converter that a person or a program needs before using it.
struct ConverterInfo {
  std::string id;
  ModelSide source;
  ModelSide target;
  Range roughness;  // covered range of the source's own width parameter
  Range specular;   // covered range of the source's specular, linear
  // The rms errors of a fit to a table, in the target's alpha and specular; none if it was fitted to
  // pictures, or if they are not known.
  std::optional<double> roughness_rms_error;
  std::optional<double> specular_rms_error;
  std::optional<double> image_rms_error;  // of the pictures at the best parameters, relative; none if unknown
  // Structural similarity of spheres at the best parameters, mean over widths; none if unknown. Of a chained
  // converter: that of its worst step.
  std::optional<double> ssim;
  std::optional<PictureDifference> pictures;  // none where the built-in renderer lacks a model
  bool is_copy = false;  // alpha and specular stay what they are: both models have one lobe
  InstructionSet instructions = InstructionSet::kBaseline;  // that it runs on; changes no bit of the results
  std::vector<std::string> steps;  // ids of what a chained converter runs; otherwise empty
  bool operator==(const ConverterInfo&) const = default;
};

// Replaces rows of a block of texels (stages/stage.hpp).
class Stage;
using StageList = std::vector<std::shared_ptr<const Stage>>;

// Converts rows of texels: the parameters of one material model to those of another.
class Converter {
 public:
  // A converter of width and specular alone.
  Converter(ConverterInfo info, StageList stages)
      : Converter(std::move(info), {Parameter::kRoughness, Parameter::kSpecular},
                  {Parameter::kRoughness, Parameter::kSpecular}, std::move(stages)) {}
  Converter(ConverterInfo info, std::vector<Parameter> sources, std::vector<Parameter> targets,
            StageList stages)
      : info_(std::move(info)),
        sources_(std::move(sources)),
        targets_(std::move(targets)),
        stages_(std::move(stages)) {}

  // Models, width parameters and ranges of both ends.
  const ConverterInfo& info() const noexcept { return info_; }
  // The parameters that it needs, and those that it makes, each in the order of Parameter: width and specular
  // of a BRDF, or those of a workflow. One that can diagnose may take kMetalMask as well.
  const std::vector<Parameter>& sources() const noexcept { return sources_; }
  const std::vector<Parameter>& targets() const noexcept { return targets_; }
  bool has_source(Parameter parameter) const noexcept;
  bool has_target(Parameter parameter) const noexcept;
  // Whether it takes and makes width and specular alone.
  bool converts_brdf_only() const noexcept { return sources_.size() == 2; }
  // Whether it can make kResidual, kMetallicUncertainty and kMetallicIssues.
  bool has_diagnostics() const noexcept { return has_target(Parameter::kResidual); }
  // The rows that it writes for a parameter if the source has `specular_channels` of specular.
  std::size_t target_channels(Parameter parameter, std::size_t specular_channels) const noexcept;

  // Converts `count` texels. `in` has rows of all sources(), colors in one or three rows; of `out` those with
  // rows are written, and width and specular of a BRDF must have them, as many as the source. An output row
  // may be exactly the input row of the same parameter and channel. Widths are the parameters that info()
  // names. The domain rule: a width is
  // clamped to the covered range, and specular below 0 to 0; where a channel exceeds the covered specular,
  // all are scaled so that the largest lies on the edge, converted and scaled back. `outside`: if not null, a
  // row that receives 1 for each texel outside the domain and 0 for each other. Returns the number of texels
  // outside. Can be called from many threads. Throws kUsage for a number of specular rows that is neither 1
  // nor 3.
  std::size_t convert(std::size_t count, const MaterialRows<const float>& in, const MaterialRows<float>& out,
                      std::uint8_t* outside = nullptr) const;
  // The same for width and specular alone.
  std::size_t convert(std::size_t count, const float* width, std::span<const float* const> specular,
                      float* width_out, std::span<float* const> specular_out,
                      std::uint8_t* outside = nullptr) const;

  // Whether the converter gives its golden texels and, on every instruction set, the bits of the baseline.
  // True if it has none.
  bool self_test() const;

  const StageList& stages() const noexcept { return stages_; }

 private:
  ConverterInfo info_;
  std::vector<Parameter> sources_, targets_;
  StageList stages_;
};

}  // namespace remap
