// The two steps from a fit to its header: describe() gives the data of the header (header_data.hpp), fill()
// its text.
#include "emit/emit.hpp"

#include <algorithm>

#include "emit/header_data.hpp"
#include "remap/error.hpp"

namespace remap {

const ConverterData& require_converter(const Fit& fit) {
  if (fit.converter) return *fit.converter;
  throw Error(ErrorKind::kNumeric,
              fit.id + ": has no converter, because it could not be lowered (remapc fit --lower)");
}

std::string emit_header(const Fit& fit) { return fill(describe(fit)); }

std::string emit_header(const WorkflowFit& fit) { return fill(describe(fit)); }

std::string emit_header(const WarpMapFit& fit) { return fill(describe(fit)); }

std::string emit_converter_list(const std::vector<Fit>& fits) {
  std::vector<ConverterData> converters;
  for (const Fit& fit : fits) converters.push_back(require_converter(fit));
  std::ranges::sort(converters, {}, [](const ConverterData& data) { return data.info.id; });
  return converters_to_json(converters);
}

}  // namespace remap
