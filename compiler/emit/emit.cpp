// The three steps from a fit to its header: lower() (lower/lower.hpp) gives polynomials with proven bounds,
// describe() the data of the header (header_data.hpp), fill() its text.
#include "emit/emit.hpp"

#include <algorithm>

#include "emit/header_data.hpp"

namespace remapc {

std::string emit_header(const remap::Fit& fit, const remap::LoweringOptions& options) {
  return emit_lowered_header(fit, remap::lower(fit, options));
}

std::string emit_lowered_header(const remap::Fit& fit, const remap::Lowered& lowered) {
  return fill(describe(fit, lowered));
}

std::string emit_header(const remap::WorkflowFit& fit) { return fill(describe(fit)); }

std::string emit_header(const remap::WarpMapFit& fit) { return fill(describe(fit)); }

std::string emit_converter_list(std::vector<remap::ConverterData> converters) {
  std::sort(converters.begin(), converters.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return remap::converters_to_json(converters);
}

}  // namespace remapc
