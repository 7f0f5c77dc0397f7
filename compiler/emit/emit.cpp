// The two steps from a fit to its header: describe() gives the data of the header (header_data.hpp), fill()
// its text.
#include "emit/emit.hpp"

#include <algorithm>

#include "emit/header_data.hpp"
#include "remap/error.hpp"

namespace remapc {

const remap::ConverterData& require_converter(const remap::Fit& fit) {
  if (fit.converter) return *fit.converter;
  throw remap::Error(remap::ErrorKind::kNumeric,
                     fit.id + ": has no converter, because it could not be lowered (remapc fit --lower)");
}

std::string emit_header(const remap::Fit& fit) { return fill(describe(fit)); }

std::string emit_header(const remap::WorkflowFit& fit) { return fill(describe(fit)); }

std::string emit_header(const remap::WarpMapFit& fit) { return fill(describe(fit)); }

std::string emit_converter_list(const std::vector<remap::Fit>& fits) {
  std::vector<remap::ConverterData> converters;
  for (const remap::Fit& fit : fits) converters.push_back(require_converter(fit));
  std::ranges::sort(converters, {}, [](const remap::ConverterData& data) { return data.info.id; });
  return remap::converters_to_json(converters);
}

}  // namespace remapc
