// This file is a converter for Python: arrays in, arrays out.
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

// A Request holds `source`, `target` and other members of ConversionRequest by their names. `converters` is a
// file or folder that replaces the shipped ones. None and missing members have their defaults.
using Request = nanobind::dict;

class MaterialConversion {
 public:
  explicit MaterialConversion(const Request& request);
  // Loads the converter of a fit, or of a warp, whose source may be of the metallic workflow.
  static MaterialConversion load(const std::string& path, const std::optional<std::string>& source_workflow);

  // Converts maps. `sources` holds arrays (height, width, channels) or lists of constants, by the names of
  // parameters. `targets` holds writable arrays. `options` holds members of MapTreatment and MapConversion by
  // name, and `transfers` of each. Returns the counts of MapStatistics. Throws like convert_maps().
  nanobind::dict convert(const nanobind::dict& sources, const nanobind::dict& targets,
                         const nanobind::dict& options) const;
  std::size_t target_channels(const std::string& parameter, std::size_t specular_channels) const;
  nanobind::dict describe() const;

 private:
  MaterialConversion() = default;

  std::shared_ptr<const ConverterList> read_;  // of a file; null for the shipped ones
  std::shared_ptr<const BuiltConversion> built_;
};

}  // namespace remap::python
