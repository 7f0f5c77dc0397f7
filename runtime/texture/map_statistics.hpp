// The statistics of maps, a row at a time.
#pragma once

#include <span>

#include "texture/convert_maps.hpp"

namespace remap {

ParameterStatistics statistics_of(std::span<const float> values);

// Of rows as a converter gives them; `coverage` may be null.
struct DiagnosedRow {
  TexelPosition first;
  const float* residual;
  const float* doubts;
  const float* coverage;
};
MetallicStatistics statistics_of(std::size_t count, const DiagnosedRow& row);

}  // namespace remap
