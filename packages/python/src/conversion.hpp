// A converter of Python: arrays in, arrays out.
#pragma once

#include <map>
#include <memory>
#include <nanobind/nanobind.h>
#include <optional>
#include <string>
#include <vector>

#include "remap/conversion.hpp"
#include "remap/convert_maps.hpp"
#include "remap/shipped_converters.hpp"

namespace remap::python {

// `source`, `target` and what else a ConversionRequest has, by the names of its members; `converters`: a file
// or folder in place of the shipped ones. None and missing members have their defaults.
using Request = nanobind::dict;

class MaterialConversion {
 public:
  explicit MaterialConversion(const Request& request);
  // The converter of a fit, or of a warp, whose source may be of the metallic workflow.
  static MaterialConversion load(const std::string& path, const std::optional<std::string>& source_workflow);

  // `sources`: arrays (height, width, channels) or lists of constants, by the names of parameters; `targets`:
  // writable arrays. `options`: members of MapTreatment and MapConversion by name, `transfers` of each.
  // Returns the counts of MapStatistics. Throws as convert_maps().
  nanobind::dict convert(const nanobind::dict& sources, const nanobind::dict& targets,
                         const nanobind::dict& options) const;
  std::size_t target_channels(const std::string& parameter, std::size_t specular_channels) const;
  nanobind::dict describe() const;

 private:
  MaterialConversion() = default;

  std::shared_ptr<const ConverterList> read_;  // of a file; null for the shipped ones
  ConversionChoice choice_;
  std::shared_ptr<const BuiltConversion> built_;
};

}  // namespace remap::python
