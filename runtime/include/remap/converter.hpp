// Converters: rows of planar floats in, rows of planar floats out. Behind the interface are the polynomials
// that a fit was lowered to, a chain of converters, a workflow or a warp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "remap/instruction_set.hpp"
#include "remap/material_rows.hpp"
#include "remap/model_side.hpp"
#include "remap/range.hpp"

namespace remap {

// What a person or a program needs to know of a converter before using it.
struct ConverterInfo {
  std::string id;
  ModelSide source;
  ModelSide target;
  Range roughness;  // covered range of the source's own width parameter
  Range specular;   // covered range of the source's specular, linear
  // Of the fit, in the target's alpha and specular; none where they are not known.
  std::optional<double> roughness_rms_error;
  std::optional<double> specular_rms_error;
  std::optional<double> image_rms_error;  // of the pictures at the best parameters, relative; none if unknown
  // Structural similarity of spheres at the best parameters, mean over widths; none if unknown. Of a chained
  // converter: that of its worst step.
  std::optional<double> ssim;
  InstructionSet instructions = InstructionSet::kBaseline;  // that it runs on; changes no bit of the results
  std::vector<std::string> steps;  // ids of what a chained converter runs; otherwise empty
  bool operator==(const ConverterInfo&) const = default;
};

// Converts rows of texels: the parameters of one material model to those of another.
class Converter {
 public:
  virtual ~Converter() = default;

  // Models, width parameters and ranges of both ends.
  const ConverterInfo& info() const noexcept { return info_; }
  // The parameters that it needs, and those that it makes, each in the order of Parameter: width and specular
  // of a BRDF, or those of a workflow. One that can diagnose may take kMetalMask or kNearbyMetallic as well.
  const std::vector<Parameter>& sources() const noexcept { return sources_; }
  const std::vector<Parameter>& targets() const noexcept { return targets_; }
  bool has_source(Parameter parameter) const noexcept;
  bool has_target(Parameter parameter) const noexcept;
  // Whether it takes and makes width and specular alone.
  bool is_of_brdf() const noexcept { return sources_.size() == 2; }
  // Whether it can make kResidual, kMetallicWidth and kDoubts.
  bool can_diagnose() const noexcept { return has_target(Parameter::kResidual); }
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
  virtual bool self_test() const { return true; }

 protected:
  // A converter of width and specular alone.
  explicit Converter(ConverterInfo info)
      : Converter(std::move(info), {Parameter::kWidth, Parameter::kSpecular},
                  {Parameter::kWidth, Parameter::kSpecular}) {}
  Converter(ConverterInfo info, std::vector<Parameter> sources, std::vector<Parameter> targets)
      : info_(std::move(info)), sources_(std::move(sources)), targets_(std::move(targets)) {}

 private:
  // convert() of rows whose numbers are valid.
  virtual std::size_t convert_rows(std::size_t count, const MaterialRows<const float>& in,
                                   const MaterialRows<float>& out, std::uint8_t* outside) const = 0;

  ConverterInfo info_;
  std::vector<Parameter> sources_, targets_;
};

}  // namespace remap
