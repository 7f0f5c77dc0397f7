// This file holds the content of a generated header as plain data without C++ text. It is made once for a fit
// of any kind, then written out by fill(). The templates have rows, channels and the self-test, and functions
// declared here write the code of the converter.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "converter/converter_data.hpp"
#include "lower/fit_file.hpp"

namespace remap {

// A HeaderEnd is the source or the target of a header.
struct HeaderEnd {
  std::string model;  // such as `mitsuba/ggx`
  std::string width;  // name of its roughness encoding
  // These are the members of the header's Input or Output. `width` comes first if there are two, and last for
  // materials.
  std::vector<MaterialParameter> parameters;
  std::string workflow = {}, diffuse = {};  // for whole materials: `specular`, `plain`
};

// A GoldenValues holds a texel and the result of the fit. Both have one number for each channel of each
// parameter.
struct GoldenValues {
  std::vector<float> in, out;
  std::vector<float> within;  // permitted error of each output; if empty, the template has one error for all
};

struct HeaderData {
  std::string id;
  std::string title;       // one sentence
  std::string provenance;  // sentences on several lines
  HeaderEnd source, target;
  std::vector<GoldenValues> golden;
  std::variant<ConverterData, WorkflowConversion, WarpMapFit> code;  // a network must be folded()
};

// Describes a fit. Throws kNumeric for a fit without a converter.
HeaderData describe(const Fit& fit);
// Describe fits of whole materials. Both functions throw the errors of require_valid().
HeaderData describe(const WorkflowFit& fit);
HeaderData describe(const WarpMapFit& fit);

// Returns the text of the header. Throws kNumeric if a number is not finite as a float.
std::string fill(const HeaderData& data);

// Returns the converter of `fit`. Throws kNumeric if there is none.
const ConverterData& require_converter(const Fit& fit);

// The following are parts of describe(). Errors are rounded up to two digits.
std::string two_digits(double error);
// Returns the network with its scalings folded into the weights. Then the first layer reads inputs without
// scaling (after the poles), and the last layer returns outputs without scaling.
Network folded(const Network& network);

// Returns the code of `struct Form` for a converter. runtime/stages/code/form_rows.inc uses this struct.
std::string form_code(const ConverterData& converter);

struct MaterialCode {
  std::string formula;
  std::string constants;  // definitions, except for source and target
  std::string functions;  // functions of namespace detail
  std::string block;      // number of texels that are converted together
  std::string call;       // call that converts a block, from rows `from` to rows `to`
  std::string within;     // tolerance for golden values, as a float literal
};

MaterialCode material_code(const WorkflowConversion& conversion);
MaterialCode material_code(const WarpMapFit& fit);

// network_function() returns `void NAME(std::size_t count, const float* const* in, float* const* out)`, for
// counts up to kBlock. This function computes rows of a network's outputs from rows of its inputs. The
// network must be folded(). network_helpers() returns the code that all functions with one activation need
// before them. Both use `kBlock`, `bits` and `float_from_bits` of the header.
std::string network_helpers(Activation activation);
std::string network_function(const std::string& name, const Network& network);
// Returns kBlock: the largest block, up to 128, whose rows of all layers fit into the first-level cache.
int network_block(const Network& network);

}  // namespace remap
