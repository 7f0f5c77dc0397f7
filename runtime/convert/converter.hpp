// A converter as the texture pass sees it: rows of planar floats in, rows of planar floats out. Behind it
// stands a generated header or, for a fit that has not been compiled, the interpreter.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/fit.hpp"

namespace remap {

// What a person or a program needs to know of a converter before using it.
struct ConverterInfo {
  std::string id;
  ModelSide source;
  ModelSide target;
  Range roughness;  // covered range of the source's own width parameter
  Range specular;   // covered range of the source's specular, linear
  double roughness_rms_error = 0.0;
  double specular_rms_error = 0.0;
};

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

  // Whether the converter still gives the values it was made with (golden vectors of the generated header).
  virtual bool self_test() const = 0;

 protected:
  explicit Converter(ConverterInfo info) : info_(std::move(info)) {}

 private:
  ConverterInfo info_;
};

// A converter that evaluates `fit` by the interpreter, in double precision.
std::unique_ptr<Converter> make_interpreted_converter(Fit fit);

// Every converter that was compiled into this program, in the order of their ids.
const std::vector<std::unique_ptr<Converter>>& compiled_converters();

// The compiled converter from one model to another. Throws kUsage with the nearest known model where a name
// is unknown, and with the targets that can be reached where only the pair is.
const Converter& find_converter(const std::string& source_model, const std::string& target_model);

}  // namespace remap
