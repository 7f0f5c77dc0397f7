// What the code of a converter contributes to the text of its header. The templates own everything else:
// rows, channels, self-test.
#pragma once

#include <string>
#include <vector>

#include "emit/header_data.hpp"

namespace remap {

// How the domain rule calls what a mapping contributes; functions of namespace detail in the header.
enum class CodeForm {
  // `float target_alpha(float alpha)` and `float specular_slope(float alpha)`: a factor for every channel.
  kProportional,
  // `float target_alpha(float alpha, float specular)`; `struct Terms` of float[kBlock] rows, `alpha` among
  // them, from which `void specular_terms(Count, Terms&)` computes the others, for any type of count; `float
  // target_specular(const Terms&, std::size_t i, float specular)`.
  kTerms,
  // The same, with limits and regimes (converter/lowered.hpp): `float wide_specular(float alpha, float
  // specular)`, `float
  // bright_alpha(float alpha, float specular)`, if there are any.
  kRegimes,
};

struct MappingCode {
  CodeForm form = CodeForm::kTerms;
  std::string functions;
  bool is_positive = false;  // of kProportional: whether the factor is proven to be above 0
};

MappingCode mapping_code(const Lowered& lowered);

// Functions of namespace detail: clamped_width(), channel_outside(), and convert_block(), which converts up
// to kBlock texels by the functions of `code`; also its parameter types Mapping and Block.
std::string block_code(const ConverterData& converter, const MappingCode& code);

// What whole materials contribute.
struct MaterialCode {
  std::string formula;
  std::string constants;  // definitions beside those of the ends
  std::string functions;  // for namespace detail
  std::string block;      // the number of texels that are converted together
  std::string call;       // converts a block: rows `from` to rows `to`
  std::string within;     // of golden values, a float literal
};

MaterialCode material_code(const WorkflowConversion& conversion);
MaterialCode material_code(const WarpHeader& header);

// `void NAME(std::size_t count, const float* const* in, float* const* out)`, count up to kBlock: rows of the
// inputs of a network that is folded() to rows of its outputs. `network_helpers` come once before the
// functions of one activation. Both use `kBlock`, `bits` and `float_from_bits` of the header.
std::string network_helpers(Activation activation);
std::string network_function(const std::string& name, const Network& network);
// The kBlock, up to 128, with which the rows of all layers fit the first-level cache.
int network_block(const Network& network);

}  // namespace remap
