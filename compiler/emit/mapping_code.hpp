// This file writes the code of a converter for its header. The templates have the rest: rows, channels, and
// the self-test.
#pragma once

#include <string>
#include <vector>

#include "emit/header_data.hpp"

namespace remap {

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
MaterialCode material_code(const WarpHeader& header);

// network_function() returns `void NAME(std::size_t count, const float* const* in, float* const* out)`, for
// counts up to kBlock. This function computes rows of a network's outputs from rows of its inputs. The
// network must be folded(). network_helpers() returns the code that all functions with one activation need
// before them. Both use `kBlock`, `bits` and `float_from_bits` of the header.
std::string network_helpers(Activation activation);
std::string network_function(const std::string& name, const Network& network);
// Returns kBlock: the largest block, up to 128, whose rows of all layers fit into the first-level cache.
int network_block(const Network& network);

}  // namespace remap
