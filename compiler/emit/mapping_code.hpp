// What each kind of code contributes to the text of its header. The templates own everything else: rows,
// channels, self-test.
#pragma once

#include <string>
#include <vector>

#include "emit/header_data.hpp"

namespace remapc {

// How the domain rule calls what a mapping contributes; functions of namespace detail in the header.
enum class CodeForm {
  // `float target_alpha(float alpha)` and `float specular_slope(float alpha)`: a factor for every channel.
  kProportional,
  // `float target_alpha(float alpha, float specular)`; `struct Terms` of float[kBlock] rows, `alpha` among
  // them, from which `void specular_terms(Count, Terms&)` computes the others, for any type of count; `float
  // target_specular(const Terms&, std::size_t i, float specular)`.
  kTerms,
  // The same, with limits and regimes (lower/lowered.hpp): `float wide_specular(float alpha, float
  // specular)`, `float
  // bright_alpha(float alpha, float specular)`, if there are any.
  kRegimes,
  // `void target_alpha_rows(std::size_t count, const float* alpha, const float* specular, float* out)` and
  // target_specular_rows of the same shape, count up to kBlock: for long sums.
  kRows,
};

struct MappingCode {
  CodeForm form = CodeForm::kTerms;
  std::string functions;
  int block = 128;           // texels that are converted together; their rows stay in the first-level cache
  bool is_positive = false;  // of kProportional: whether the factor is proven to be above 0
};

MappingCode mapping_code(const remap::Lowered& lowered);
MappingCode mapping_code(const FittedCurves& curves);
MappingCode mapping_code(const FittedGaussians& gaussians);
MappingCode mapping_code(const remap::Mlp& mlp);

// Functions of namespace detail: held_width(), channel_outside(), and convert_block(), which converts up to
// kBlock texels by the functions of `code`; also its parameter types Mapping and Block.
std::string block_code(const ConverterHeader& header, const std::string& specular_name,
                       const MappingCode& code);

// What whole materials contribute.
struct MaterialCode {
  std::string formula;
  std::string constants;  // definitions beside those of the ends
  std::string functions;  // for namespace detail
  std::string block;      // the number of texels that are converted together
  std::string call;       // converts a block: rows `from` to rows `to`
  std::string within;     // of golden values, a float literal
};

MaterialCode material_code(const remap::WorkflowConversion& conversion);
MaterialCode material_code(const WarpHeader& header);

// `void NAME(std::size_t count, const float* const* in, float* const* out)`, count up to kBlock: rows of the
// inputs of a network that is folded() to rows of its outputs. `network_helpers` come once before the
// functions of one activation. Both use `kBlock`, `bits` and `float_from_bits` of the header.
std::string network_helpers(remap::Activation activation);
std::string network_function(const std::string& name, const remap::Network& network);
// The kBlock, up to 128, with which the rows of all layers fit the first-level cache.
int network_block(const remap::Network& network);

// Parts of the code of polynomials and curves.

// An inline function of floats. Its statements end with a return.
struct FunctionParts {
  std::string comment, table;  // before it; empty for none
  std::string name;
  std::string parameters;
  std::string statements;
};
std::string function_code(const FunctionParts& parts);

// `struct Terms`, specular_terms() and target_specular(): a polynomial in the source's specular, whose
// coefficients are functions of alpha.
struct TermsParts {
  std::string comment, table;
  std::vector<std::string> names;  // of the coefficients
  std::string more_rows = {};      // members of Terms
  bool uses_alpha = true;          // whether any coefficient depends on it
  std::string statements;          // that compute the coefficients
  bool uses_specular = true;
  std::string sum;  // statements that return the polynomial of terms.NAME[i]
};
std::string terms_code(const TermsParts& parts);

// `float RESULT`, a polynomial of `variable` with these coefficients, by Horner's rule from the highest down:
// every product feeds one sum, so that a compiler that fuses, fuses the same in every copy of the loop.
// Coefficients that are empty are 0.
std::string horner_code(const std::vector<std::string>& coefficients, const std::string& result,
                        const std::string& variable);

}  // namespace remapc
