// A converter as the texture pass sees it: rows of planar floats in, rows of planar floats out. Behind it
// stands a generated header or, for a fit that has not been compiled, its polynomials or the interpreter.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "convert/instruction_set.hpp"
#include "lower/lowered.hpp"
#include "model/fit.hpp"

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
  InstructionSet instructions = InstructionSet::kBaseline;  // that it runs on; changes no bit of the results
  std::vector<std::string> steps;  // ids of what a chained converter runs; otherwise empty
};

// What a fit says of itself; ranges as short decimals.
ConverterInfo converter_info(const Fit& fit, InstructionSet instructions);

class Converter {
 public:
  virtual ~Converter() = default;

  const ConverterInfo& info() const noexcept { return info_; }

  // Converts `count` texels. `specular` and `specular_out` hold one row for each channel, 1 or 3 of them; an
  // output row may be exactly its input row. Domain rule as in interpreter.hpp. Safe to call from many
  // threads. Returns the number of texels out of domain.
  virtual std::size_t convert(std::size_t count, const float* roughness,
                              std::span<const float* const> specular, float* roughness_out,
                              std::span<float* const> specular_out) const = 0;

  // Whether the converter gives the values it was made with: those of the golden vectors of a generated
  // header, and on every instruction set the bits of the baseline; those of the interpreter for polynomials.
  virtual bool self_test() const = 0;

 protected:
  explicit Converter(ConverterInfo info) : info_(std::move(info)) {}

 private:
  ConverterInfo info_;
};

// A converter that evaluates `fit` by the interpreter, in double precision: the oracle, and a hundred times
// slower than the others.
std::unique_ptr<Converter> make_interpreted_converter(Fit fit);

// A converter that lowers `fit` to polynomials (lower/lower.hpp, tolerances of LoweringOptions) and evaluates
// those in floats. Takes up to a second to make. Throws kNumeric where the
// mapping cannot be lowered.
std::unique_ptr<Converter> make_lowered_converter(Fit fit, InstructionSet set = best_instruction_set());
// The same, `lowered` being what lower() made of the fit.
std::unique_ptr<Converter> make_lowered_converter(Fit fit, const Lowered& lowered, InstructionSet set);

// Every converter that was compiled into this program, in the order of their ids, for an instruction set that
// this processor has.
const std::vector<std::unique_ptr<Converter>>& compiled_converters(
    InstructionSet set = best_instruction_set());

// The compiled converter that leads from one model to another in one step; paths: path.hpp. Throws kUsage
// where there is none.
const Converter& find_converter(const std::string& source_model, const std::string& target_model,
                                InstructionSet set = best_instruction_set());

}  // namespace remap
