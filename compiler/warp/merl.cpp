// This file reads measured BRDFs of the MERL database (Matusik et al. 2003). A file has three 32-bit counts
// (90 half angles, 90 difference angles, 180 azimuths). Then it has a 64-bit value of red for each cell, then
// of green, then of blue. All numbers are little-endian.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "warp/quadrature.hpp"
#include "warp/tabulated_set.hpp"

namespace remap {
namespace {

using std::numbers::pi;

static_assert(std::endian::native == std::endian::little, "the file format is little-endian");

constexpr std::array<std::int32_t, 3> kCounts = {90, 90, 180};
constexpr std::size_t kCells = 90 * 90 * 180;
constexpr std::size_t kFileBytes = sizeof kCounts + 3 * kCells * sizeof(double);
constexpr std::array<double, 3> kScales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};

std::size_t cell(double share, std::int32_t count) {
  return static_cast<std::size_t>(std::clamp(static_cast<std::int32_t>(share * count), 0, count - 1));
}

// Returns the cell of a direction. Half angles have cells of equal size in the square root of the angle.
std::size_t cell_of(const QuadratureDirection& direction) {
  const std::size_t half = cell(std::sqrt(direction.half_angle / (pi / 2.0)), kCounts[0]),
                    difference = cell(direction.difference_angle / (pi / 2.0), kCounts[1]),
                    azimuth = cell(direction.azimuth / pi, kCounts[2]);
  return (half * 90 + difference) * 180 + azimuth;
}

}  // namespace

std::vector<float> read_merl(const std::filesystem::path& file) {
  const InputFile input(file);
  std::array<std::int32_t, 3> counts{};
  input.read(0, reinterpret_cast<char*>(counts.data()), sizeof counts);
  const bool is_merl = input.size() == kFileBytes && counts == kCounts;
  std::vector<double> values(is_merl ? 3 * kCells : 0);
  const std::size_t bytes = values.size() * sizeof(double);
  if (!is_merl || input.read(sizeof counts, reinterpret_cast<char*>(values.data()), bytes) != bytes)
    throw input_error(file.string() +
                      ": is not a BRDF of the MERL database (90 x 90 x 180 cells of three channels)");
  std::vector<float> samples;
  for (std::size_t c = 0; c < kScales.size(); ++c)
    for (const QuadratureDirection& direction : half_vector_quadrature()) {
      const double value = kScales[c] * values[c * kCells + cell_of(direction)];
      // If a value is above the largest float, the file is as damaged as with an infinite value.
      const bool is_measured = value > 0.0 && value <= std::numeric_limits<float>::max();
      samples.push_back(is_measured ? static_cast<float>(value) : 0.0f);
    }
  return samples;
}

}  // namespace remap
