// A closed interval.
#pragma once

namespace remap {

struct Range {
  double min = 0.0;
  double max = 0.0;
  bool contains(double value) const noexcept { return value >= min && value <= max; }
  bool operator==(const Range&) const = default;
};

}  // namespace remap
