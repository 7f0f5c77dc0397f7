// This file declares converters, which turn rows of planar floats into rows of planar floats. A converter is
// a list of stages: polynomials of a lowered fit, changes of the workflow, or a warp. A chain of converters
// is the list of all their stages.
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

// These are the instruction sets that converters are compiled for.

// Each set includes the sets before it. Processors other than x86-64 have only the baseline.
enum class InstructionSet {
  kBaseline,  // the set of the whole program
  kAvx2,
  kAvx512,  // F, VL, BW and DQ: Intel's servers since 2017, AMD's processors since 2022
};

// Returns `baseline`, `avx2` or `avx512`, the word on the command line and in JSON.
std::string_view instruction_set_name(InstructionSet set);

// Returns the widest set that this processor, its operating system and this build support.
InstructionSet best_instruction_set();

// Returns all instruction sets from the baseline up to `best`.
std::vector<InstructionSet> instruction_sets(InstructionSet best = best_instruction_set());

// Returns the set with this name. Throws kUsage, beginning with `context`, if the name is unknown or the set
// is above `best`.
InstructionSet instruction_set_from_name(const std::string& context, const std::string& name,
                                         InstructionSet best = best_instruction_set());

// The following types hold the parameters of materials, and materials as rows of planar floats.

// A Parameter is a parameter of a material or a measure of a conversion.
enum class Parameter {
  kRoughness,  // width of the highlight: roughness, glossiness, alpha or exponent
  kSpecular,   // reflectance at normal incidence
  kDiffuse,    // color of the specular workflow
  kBaseColor,  // color of the metallic workflow
  kMetallic,
  kMetalMask,            // source only: chooses among metallic values that look alike
  kOcclusion,            // source only: has a place in some layouts, and is never converted
  kResidual,             // target only: the part of a texel that metal-rough cannot express
  kMetallicUncertainty,  // target only: the fraction of [0, 1] that metallic could take
  kMetallicIssues,  // target only: the sum of MetallicIssue values, divided by 255, so that 8 bits hold it
  kFirstInput,      // from here on: other inputs of surface models (surface.hpp)
};
inline constexpr std::size_t kParameterCount = 96;
inline constexpr bool is_input(Parameter parameter) noexcept { return parameter >= Parameter::kFirstInput; }

// These powers of two are reasons why metallic of a texel may differ from what the author meant.
enum class MetallicIssue {
  kClamped = 1,       // a parameter is outside [0, 1], or the base color would be
  kAmbiguous = 2,     // two separate metallic values look alike
  kDark = 4,          // metallic is undetermined, because diffuse and specular are dark
  kUndetermined = 8,  // metallic is undetermined: kMetallicUncertainty is above kUndeterminedWidth
};
// Above this value of kMetallicUncertainty, metallic is undetermined. If an author made maps for both
// workflows, metallic there differs by 0.15 RMS. Below half of this value, it differs by less than 0.01.
inline constexpr float kUndeterminedWidth = 0.2f;
// A texel is dark if diffuse and F0, linear, are below this value.
inline constexpr float kDarkTexel = 0.06f;

// Returns `width`, `specular`, `diffuse`, `base_color`, `metallic`, `metal_mask`, `occlusion`,
// `residual`, `metallic_uncertainty`, `issues`, or a name such as `coat_weight`.
std::string_view parameter_name(Parameter parameter);
// Returns the name in files and messages, such as `base_color`. The width is always `roughness`.
std::string plain_name(Parameter parameter);
// Returns the option, such as `--base-color` or `--input coat_weight`. The width has `--roughness`.
std::string parameter_option(Parameter parameter);
// Returns true for measures of the result: kResidual, kMetallicUncertainty, kMetallicIssues.
bool is_measure(Parameter parameter);
// Returns true if the parameter can have three channels.
bool is_color(Parameter parameter);

// A ParameterRows holds the rows of one parameter: none, one, or one each for red, green and blue.
template <typename Float>
struct ParameterRows {
  std::array<Float*, 3> row{};
  std::size_t count = 0;
};

// A MaterialRows holds the rows of all parameters. `count` is 0 for an absent parameter.
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

// A PictureDifference states how far pictures of spheres differ from pictures of the source. It is the RMSE
// of display values under environments, in per cent of the display's range. It is a mean over materials and
// lights that the fit did not use.
struct PictureDifference {
  double converted = 0.0;
  std::optional<double> copied;  // the difference if numbers are copied instead
  bool is_estimate = false;      // true for several steps, or if it comes from an image error
  bool operator==(const PictureDifference&) const = default;
};

// A ConverterInfo holds what a person or a program needs to know before it uses a converter.
struct ConverterInfo {
  std::string id;
  ModelSide source;
  ModelSide target;
  Range roughness;  // covered range of the source's own width parameter
  Range specular;   // covered range of the source's specular, linear
  // This is the rms error of a fit to a table, in alpha and specular of the target. It is unset if it is
  // unknown, or if the fit was made from pictures.
  std::optional<double> roughness_rms_error;
  std::optional<double> specular_rms_error;
  std::optional<double> image_rms_error;  // relative error of pictures at the best parameters
  std::optional<double> ssim;
  std::optional<PictureDifference> pictures;  // unset if the built-in renderer lacks a model
  bool is_copy = false;  // true if both models have one lobe, so that alpha and specular stay unchanged
  InstructionSet instructions =
      InstructionSet::kBaseline;   // instruction set that it uses; results have the same bits on all
  std::vector<std::string> steps;  // ids of the parts of a chained converter; otherwise empty
  bool operator==(const ConverterInfo&) const = default;
};

// A Stage replaces rows of a block of texels (stages/stage.hpp).
class Stage;
using StageList = std::vector<std::shared_ptr<const Stage>>;

// A Converter turns the parameters of one material model into the parameters of another, row by row.
class Converter {
 public:
  // Makes a converter that handles only width and specular.
  Converter(ConverterInfo info, StageList stages)
      : Converter(std::move(info), {Parameter::kRoughness, Parameter::kSpecular},
                  {Parameter::kRoughness, Parameter::kSpecular}, std::move(stages)) {}
  Converter(ConverterInfo info, std::vector<Parameter> sources, std::vector<Parameter> targets,
            StageList stages)
      : info_(std::move(info)),
        sources_(std::move(sources)),
        targets_(std::move(targets)),
        stages_(std::move(stages)) {}

  // Returns the models, width parameters and ranges of both ends.
  const ConverterInfo& info() const noexcept { return info_; }
  // Return the parameters that the converter needs and the parameters that it makes, in the order of
  // Parameter. They are width and specular of a BRDF, or the parameters of a workflow. A converter with
  // diagnostics may read kMetalMask.
  const std::vector<Parameter>& sources() const noexcept { return sources_; }
  const std::vector<Parameter>& targets() const noexcept { return targets_; }
  bool has_source(Parameter parameter) const noexcept;
  bool has_target(Parameter parameter) const noexcept;
  // Returns true if it converts only width and specular.
  bool converts_brdf_only() const noexcept { return sources_.size() == 2; }
  // Returns true if it can make kResidual, kMetallicUncertainty and kMetallicIssues.
  bool has_diagnostics() const noexcept { return has_target(Parameter::kResidual); }
  // Returns the number of rows that the converter writes for a parameter, if the source has
  // `specular_channels`.
  std::size_t target_channels(Parameter parameter, std::size_t specular_channels) const noexcept;

  // Converts `count` texels. `in` has rows of all sources(), colors in one or three rows. Only targets with
  // rows in `out` are written; width and specular of a BRDF must have as many rows as the source. An output
  // row may be exactly the input row of the same parameter and channel. Widths are the parameters that info()
  // names.
  // Domain rule: a width is clamped to the covered range, and specular below 0 to 0. If a channel exceeds the
  // covered specular, all channels are scaled so that the largest lies on the edge, converted, and scaled
  // back. `outside`, if not null, receives 1 for each texel outside the domain and 0 for each other. Returns
  // the number of texels outside. Many threads may call it. Throws kUsage unless specular has 1 or 3 rows.
  std::size_t convert(std::size_t count, const MaterialRows<const float>& in, const MaterialRows<float>& out,
                      std::uint8_t* outside = nullptr) const;
  // Converts only width and specular, by the same rules.
  std::size_t convert(std::size_t count, const float* width, std::span<const float* const> specular,
                      float* width_out, std::span<float* const> specular_out,
                      std::uint8_t* outside = nullptr) const;

  // Returns true if the converter reproduces its golden texels and, on every instruction set, the bits of the
  // baseline. Returns true if it has no golden texels.
  bool self_test() const;

  const StageList& stages() const noexcept { return stages_; }

 private:
  ConverterInfo info_;
  std::vector<Parameter> sources_, targets_;
  StageList stages_;
};

}  // namespace remap
