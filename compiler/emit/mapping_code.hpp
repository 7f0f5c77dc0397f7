// What a kind of mapping contributes to its header. The layout (header.cpp) owns everything else: domain
// rule, rows, channels, self-test.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lower/lowered.hpp"
#include "remap/fit.hpp"

namespace remapc {

// How the layout calls what the kind contributes; functions of namespace detail in the header.
enum class CodeForm {
  // `float target_alpha(float alpha)` and `float specular_slope(float alpha)`: a factor for every channel.
  kProportional,
  // `float target_alpha(float alpha, float specular)`; `struct Terms` of float[kBlock] rows, `alpha` among
  // them,
  // from which `void specular_terms(Count, Terms&)` makes the others, for any type of count; `float
  // target_specular(const Terms&, std::size_t i, float specular)`.
  kTerms,
  // `void target_alpha_rows(std::size_t count, const float* alpha, const float* specular, float* out)` and
  // target_specular_rows of the same shape, count up to kBlock: for sums that are long.
  kRows,
};

// Stands before a loop whose output rows may be exactly its input rows and overlap nothing else: no iteration
// waits for another, and compilers need not ask which rows overlap.
inline constexpr std::string_view kIndependentLoop = R"(#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#elif defined(_MSC_VER)
#pragma loop(ivdep)
#endif)";

struct MappingCode {
  CodeForm form = CodeForm::kTerms;
  std::string description;  // comment lines without `// `: how it is computed, and how exactly
  std::string functions;
  int block = 128;           // texels that are converted together; their rows stay in the first-level cache
  bool is_positive = false;  // of kProportional: whether the factor is proven to be above 0
  // How far from the fit the header may be: target alpha, target specular within the domain.
  double alpha_error = 1e-6, specular_error = 1e-6;
};

// Lowered to polynomials.
MappingCode lowered_code(const remap::Lowered& lowered);

// The mapping as it was fitted.
MappingCode exact_code(const remap::Parametric& form, const remap::Domain& domain);
MappingCode exact_code(const remap::Svr& svr, const remap::Domain& domain);
MappingCode exact_code(const remap::Mlp& mlp, const remap::Domain& domain);
// Throws kUsage: a chain is one pass as polynomials only.
MappingCode exact_code(const remap::Chain& chain, const remap::Domain& domain);

// `void NAME(std::size_t count, const float* const* in, float* const* out)`, count up to kBlock: rows of a
// network's raw inputs to rows of its raw outputs. `network_helpers` come once before the functions of one
// activation; `kBlock`, `bits` and `float_from_bits` are taken from around them.
std::string network_helpers(remap::Activation activation);
std::string network_function(const std::string& name, const remap::Network& network);
// A good kBlock for it.
int network_block(const remap::Network& network);

// One float literal, rounded from a double. Throws kNumeric where it is not finite.
std::string literal(double value);
// The shortest double literal that reads back. Throws kNumeric where it is not finite.
std::string double_literal(double value);

}  // namespace remapc
