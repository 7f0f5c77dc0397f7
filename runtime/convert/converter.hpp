// A converter as the texture pass sees it: rows of planar floats in, rows of planar floats out. Behind it
// stand polynomials that a fit was lowered to, or the interpreter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "convert/instruction_set.hpp"
#include "converter_data/converter_data.hpp"
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
  // `outside`: where not null, a row that gets 1 for each texel out of domain and 0 for each other.
  virtual std::size_t convert(std::size_t count, const float* roughness,
                              std::span<const float* const> specular, float* roughness_out,
                              std::span<float* const> specular_out,
                              std::uint8_t* outside = nullptr) const = 0;

  // Whether the converter gives its golden texels and, on every instruction set, the bits of the baseline.
  virtual bool self_test() const = 0;

 protected:
  explicit Converter(ConverterInfo info) : info_(std::move(info)) {}

 private:
  ConverterInfo info_;
};

// A converter that evaluates `fit` by the interpreter, in double precision: the oracle, and a hundred times
// slower than the others.
std::unique_ptr<Converter> make_interpreted_converter(Fit fit);

// A converter of what `fit` is lowered to (lower/lower.hpp, tolerances of LoweringOptions). Takes up to a
// second to make. Throws kNumeric where the mapping cannot be lowered.
std::unique_ptr<Converter> make_lowered_converter(const Fit& fit,
                                                  InstructionSet set = best_instruction_set());
// The same, `lowered` being what lower() made of the fit.
std::unique_ptr<Converter> make_lowered_converter(const Fit& fit, const Lowered& lowered, InstructionSet set);

// A converter that runs `data` as it is, at about the speed of its generated header and with the same bits.
// Throws kNumeric for a domain that is empty or negative.
std::unique_ptr<Converter> make_converter(const ConverterData& data,
                                          InstructionSet set = best_instruction_set());

}  // namespace remap
