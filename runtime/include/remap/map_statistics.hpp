// Statistics of maps, collected row by row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "remap/material_rows.hpp"

namespace remap {

// Statistics of one parameter over all channels of its map; values are linear, in the encoding of the map.
// All members are 0 if they were not requested.
struct ParameterStatistics {
  static constexpr std::size_t kBins = 32;
  float min = 0.0f;  // of finite values; min and max are 0 without any
  float max = 0.0f;
  std::size_t finite_count = 0;
  std::array<std::size_t, kBins>
      histogram{};  // equal parts of [0, 1]; values outside count in the first or last

  ParameterStatistics& operator+=(const ParameterStatistics& other) noexcept;
};

struct TexelPosition {
  std::size_t x = 0;
  std::size_t y = 0;
};

// Statistics of the texels with one Doubt.
struct DoubtStatistics {
  std::size_t count = 0;
  std::optional<TexelPosition> first;  // in row order

  // Adds the statistics of rows below.
  DoubtStatistics& operator+=(const DoubtStatistics& other) noexcept;
};

// The reliability of metallic over all covered texels without NaN. All members are 0 if they were not
// requested or if the converter cannot diagnose (Converter::can_diagnose).
struct MetallicStatistics {
  std::size_t texel_count = 0;
  // Sum of squared residuals in units of 2^-40. The integer sum does not depend on the order.
  std::uint64_t residual_squares = 0;
  float largest_residual = 0.0f;
  DoubtStatistics guess, dark, two_answers, clamped;

  double rms_residual() const noexcept;
  MetallicStatistics& operator+=(const MetallicStatistics& other) noexcept;
};

// Statistics of a conversion. A texel counts once in each member that applies to it.
struct MapStatistics {
  std::size_t texel_count = 0;
  std::size_t out_of_domain_count = 0;     // texels outside the domain of the converter
  std::size_t nan_count = 0;               // texels with a NaN in any source
  std::size_t infinite_count = 0;          // texels with an infinity in any source
  std::size_t negative_count = 0;          // texels with a value below 0 in any source
  std::size_t clipped_count = 0;           // values, not texels, that an integer pixel type clipped
  std::size_t masked_count = 0;            // texels with coverage 0 or less
  std::size_t above_one_count = 0;         // texels with a finite source above 1, roughness excepted
  std::optional<TexelPosition> first_bad;  // with NaN, infinity or a negative value, in row order
  std::map<Parameter, ParameterStatistics> sources, targets;
  MetallicStatistics metallic;

  // Adds the statistics of rows below.
  MapStatistics& operator+=(const MapStatistics& other);
};

ParameterStatistics statistics_of(std::span<const float> values);

// Rows of a converter; `coverage` may be null.
struct DiagnosedRow {
  TexelPosition first;
  const float* residual;
  const float* doubts;
  const float* coverage;
};
MetallicStatistics statistics_of(std::size_t count, const DiagnosedRow& row);

}  // namespace remap
