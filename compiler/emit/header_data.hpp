// What a generated header says, as plain data without C++ text: made once for a fit of any kind, then
// written out by fill().
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "converter/converter_data.hpp"
#include "lower/any_fit.hpp"
#include "stages/packed_warp.hpp"

namespace remap {

struct WarpHeader {
  PackedWarp warp;
  decltype(ParameterTable::entries) entries;
  double copy_rms_error = -1.0;
};

// Source or target.
struct HeaderEnd {
  std::string model;  // `mitsuba/ggx`
  std::string width;  // the name of its convention
  // The members of the header's Input or Output. `width` is the first of two, and the last of whole
  // materials.
  std::vector<MaterialParameter> parameters;
  std::string workflow = {}, diffuse = {};  // of whole materials: `specular`, `plain`
};

// A texel and what the fit gives for it: one number for each channel of each parameter.
struct GoldenValues {
  std::vector<float> in, out;
  std::vector<float> within;  // error of each output that is allowed; empty: the template has one for all
};

struct HeaderData {
  std::string id;
  std::string title;       // a sentence
  std::string provenance;  // sentences on several lines
  HeaderEnd source, target;
  std::vector<GoldenValues> golden;
  std::variant<ConverterData, WorkflowConversion, WarpHeader> code;  // a network is folded()
};

// Throws kNumeric for a fit without a converter.
HeaderData describe(const Fit& fit);
// Throw kInput for what require_valid() refuses.
HeaderData describe(const WorkflowFit& fit);
HeaderData describe(const WarpMapFit& fit);

// The text. Throws kNumeric where a number is not finite as a float.
std::string fill(const HeaderData& data);

// The converter of `fit`. Throws kNumeric where it has none.
const ConverterData& require_converter(const Fit& fit);

// Parts of describe(). Errors are rounded up to two digits.
std::string two_digits(double error);
// The network with its scalings in the weights: the first layer takes raw inputs, after the poles of their
// scalings, and the last gives raw outputs.
Network folded(const Network& network);

}  // namespace remap
