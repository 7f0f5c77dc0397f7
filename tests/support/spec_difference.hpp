// This file compares two descriptions of images, attribute by attribute.
#pragma once

#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace remap {

struct SpecDifference {
  std::string name;    // name of the attribute, or of the field of the description
  std::string before;  // type and value, or `nothing`
  std::string after;
  bool operator==(const SpecDifference&) const = default;
};

// Returns the differences. First come attributes that do not occur in both with the same type and bytes. Then
// come fields: windows, tiles, channels, their types and roles.
std::vector<SpecDifference> differences(const OIIO::ImageSpec& before, const OIIO::ImageSpec& after);

}  // namespace remap
