// This file provides the code of a converter for the text of its header. The templates contain everything
// else: rows, channels, self-test.
#pragma once

#include <string>
#include <vector>

#include "emit/header_data.hpp"

namespace remap {

// Returns `struct Form` of a converter, which runtime/stages/code/form_rows.inc uses.
std::string form_code(const ConverterData& converter);

struct MaterialCode {
  std::string formula;
  std::string constants;  // definitions beside the ones of the ends
  std::string functions;  // for namespace detail
  std::string block;      // the number of texels that are converted together
  std::string call;       // converts a block: rows `from` to rows `to`
  std::string within;     // tolerance for golden values, a float literal
};

MaterialCode material_code(const WorkflowConversion& conversion);
MaterialCode material_code(const WarpHeader& header);

// Returns `void NAME(std::size_t count, const float* const* in, float* const* out)`, count up to kBlock. It
// turns rows of the inputs of a network that is folded() into rows of its outputs. `network_helpers` come
// once before the functions of one activation. Both use `kBlock`, `bits` and `float_from_bits` of the header.
std::string network_helpers(Activation activation);
std::string network_function(const std::string& name, const Network& network);
// Returns kBlock: the largest block, up to 128, whose rows of all layers fit into the first-level cache.
int network_block(const Network& network);

}  // namespace remap
