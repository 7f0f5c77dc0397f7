// The converters of a folder as one file of data, which texremap runs without compiling anything.
#include <algorithm>

#include "converter_data/converter_data.hpp"
#include "emit/emit.hpp"

namespace remapc {

std::string emit_converter_list(std::vector<remap::ConverterData> converters) {
  std::sort(converters.begin(), converters.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return remap::converters_to_json(converters);
}

}  // namespace remapc
