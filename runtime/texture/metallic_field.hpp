// The metallic around each texel: what the texels that can tell say, carried smoothly to where none can.
#pragma once

#include <cstddef>
#include <vector>

namespace remap {

// Filled by all rows of a map, then read. Holds means over square cells, about a million at most, whatever
// the size of the map: 25 MB.
//
// Holes are filled by pull-push (Gortler et al. 1996, "The Lumigraph", section 3.4): means of ever larger
// cells, each of which shows through where the smaller ones know little.
class MetallicField {
 public:
  MetallicField(std::size_t width, std::size_t height);

  // `count` texels from (x, y) on, 0 to 1. Those whose `metallic_width` is above kGuessWidth or NaN are
  // passed over, and those where `coverage`, which may be null, is 0 or less.
  void add(std::size_t x, std::size_t y, std::size_t count, const float* metallic,
           const float* metallic_width, const float* coverage);

  // Ends the adding. Whether any texel could tell: else there is nothing to read.
  bool fill();

  // The field in a row, linear between the centres of cells, 0 to 1.
  void read(std::size_t y, std::size_t count, float* values) const;

 private:
  // Means and how much they count, 0 to 1.
  struct Level {
    Level(std::size_t columns_, std::size_t rows_)
        : columns(columns_), rows(rows_), values(columns_ * rows_), weights(columns_ * rows_) {}
    float at(std::size_t column, std::size_t row) const { return values[row * columns + column]; }
    float between(float column, float row) const;
    std::size_t columns, rows;
    std::vector<float> values, weights;
  };
  static Level pulled(const Level& finer);
  static void push(const Level& coarser, Level& finer);

  std::size_t cell_;  // texels on a side
  Level cells_;       // sums and counts until fill()
};

}  // namespace remap
