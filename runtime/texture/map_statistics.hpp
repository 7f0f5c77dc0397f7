// The statistics of maps, a row at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "convert/material_rows.hpp"

namespace remap {

// The values of one parameter, as the map has them (linear, in the encoding of the map), all channels
// together. All 0 where they were not asked for.
struct ParameterStatistics {
  static constexpr std::size_t kBins = 32;
  float min = 0.0f;  // of finite values; both 0 where there is none
  float max = 0.0f;
  std::size_t finite_count = 0;
  std::array<std::size_t, kBins> histogram{};  // [0, 1] in equal parts; values beyond count in the outermost

  ParameterStatistics& operator+=(const ParameterStatistics& other) noexcept;
};

struct TexelPosition {
  std::size_t x = 0;
  std::size_t y = 0;
};

// Texels with one Doubt.
struct DoubtStatistics {
  std::size_t count = 0;
  std::optional<TexelPosition> first;  // row by row

  // `other`: of rows below.
  DoubtStatistics& operator+=(const DoubtStatistics& other) noexcept;
};

// How far metallic can be trusted, over the texels that are covered and hold no NaN. All 0 where that was not
// asked for, or the converter cannot say it (MaterialConverter::can_diagnose).
struct MetallicStatistics {
  std::size_t texel_count = 0;
  // Sum of squared residuals in whole units of 2^-40: the same in any order.
  std::uint64_t residual_squares = 0;
  float largest_residual = 0.0f;
  DoubtStatistics guess, dark, two_answers, clamped;

  double rms_residual() const noexcept;
  MetallicStatistics& operator+=(const MetallicStatistics& other) noexcept;
};

// What was met on the way. Texels count once in each line that applies to them.
struct MapStatistics {
  std::size_t texel_count = 0;
  std::size_t out_of_domain_count = 0;     // texels, as the converter counts them
  std::size_t nan_count = 0;               // texels with a NaN in any source
  std::size_t infinite_count = 0;          // texels with an infinity there
  std::size_t negative_count = 0;          // texels with a value below 0 there
  std::size_t clipped_count = 0;           // values, not texels, that an integer pixel type cut to its range
  std::size_t masked_count = 0;            // texels that coverage takes out
  std::size_t above_one_count = 0;         // texels with a finite source above 1 that is no width
  std::optional<TexelPosition> first_bad;  // the first, row by row, of those with NaN, infinity or below 0
  std::map<Parameter, ParameterStatistics> sources, targets;
  MetallicStatistics metallic;

  // `other`: of rows below.
  MapStatistics& operator+=(const MapStatistics& other);
};

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
