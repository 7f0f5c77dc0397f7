#include "maps/metallic_field.hpp"

#include <algorithm>
#include <cmath>

#include "remap/converter.hpp"

namespace remap {
namespace {

constexpr std::size_t kSmallestCell = 4, kMostCells = 1024;  // per side

std::size_t parts(std::size_t length, std::size_t part) { return (length + part - 1) / part; }

std::size_t cell_of(std::size_t width, std::size_t height) {
  return std::max(kSmallestCell, parts(std::max(width, height), kMostCells));
}

// A position between two neighbours in a row or column of `count` values, with the share of the second.
struct Place {
  Place(float position, std::size_t count) {
    const float held = std::clamp(position, 0.0f, static_cast<float>(count - 1));
    first = static_cast<std::size_t>(held);
    second = std::min(first + 1, count - 1);
    share = held - static_cast<float>(first);
  }
  std::size_t first, second;
  float share;
};

}  // namespace

MetallicField::MetallicField(std::size_t width, std::size_t height)
    : cell_(cell_of(width, height)), cells_(parts(width, cell_), parts(height, cell_)) {}

void MetallicField::add(std::size_t x, std::size_t y, std::size_t count, const float* metallic,
                        const float* metallic_width, const float* coverage) {
  const std::size_t row = y / cell_ * cells_.columns;
  for (std::size_t i = 0; i < count; ++i) {
    const bool tells = metallic_width[i] <= kGuessWidth && (coverage == nullptr || coverage[i] > 0.0f);
    if (!tells) continue;
    const std::size_t cell = row + (x + i) / cell_;
    cells_.values[cell] += metallic[i];
    cells_.weights[cell] += 1.0f;
  }
}

float MetallicField::Level::between(float column, float row) const {
  const Place x(column, columns), y(row, rows);
  const float above = std::lerp(at(x.first, y.first), at(x.second, y.first), x.share);
  const float below = std::lerp(at(x.first, y.second), at(x.second, y.second), x.share);
  return std::lerp(above, below, y.share);
}

MetallicField::Level MetallicField::pulled(const Level& finer) {
  Level coarser(parts(finer.columns, 2), parts(finer.rows, 2));
  for (std::size_t row = 0; row < finer.rows; ++row)
    for (std::size_t column = 0; column < finer.columns; ++column) {
      const std::size_t from = row * finer.columns + column, to = row / 2 * coarser.columns + column / 2;
      coarser.values[to] += finer.weights[from] * finer.values[from];
      coarser.weights[to] += finer.weights[from];
    }
  for (std::size_t i = 0; i < coarser.values.size(); ++i) {
    if (coarser.weights[i] > 0.0f) coarser.values[i] /= coarser.weights[i];
    coarser.weights[i] = std::min(coarser.weights[i], 1.0f);
  }
  return coarser;
}

void MetallicField::push(const Level& coarser, Level& finer) {
  for (std::size_t row = 0; row < finer.rows; ++row)
    for (std::size_t column = 0; column < finer.columns; ++column) {
      const std::size_t i = row * finer.columns + column;
      const float around =
          coarser.between(0.5f * static_cast<float>(column) - 0.25f, 0.5f * static_cast<float>(row) - 0.25f);
      finer.values[i] = std::lerp(around, finer.values[i], finer.weights[i]);
    }
}

bool MetallicField::fill() {
  const float texels = static_cast<float>(cell_ * cell_);
  bool any = false;
  for (std::size_t i = 0; i < cells_.values.size(); ++i) {
    if (cells_.weights[i] == 0.0f) continue;
    any = true;
    cells_.values[i] /= cells_.weights[i];
    cells_.weights[i] /= texels;
  }
  if (!any) return false;
  std::vector<Level> levels;
  for (const Level* finest = &cells_; finest->columns * finest->rows > 1; finest = &levels.back())
    levels.push_back(pulled(*finest));
  for (std::size_t i = levels.size(); i-- > 0;) push(levels[i], i == 0 ? cells_ : levels[i - 1]);
  return true;
}

void MetallicField::read(std::size_t y, std::size_t count, float* values) const {
  const float scale = 1.0f / static_cast<float>(cell_);
  const float row = (static_cast<float>(y) + 0.5f) * scale - 0.5f;
  for (std::size_t x = 0; x < count; ++x)
    values[x] = cells_.between((static_cast<float>(x) + 0.5f) * scale - 0.5f, row);
}

}  // namespace remap
