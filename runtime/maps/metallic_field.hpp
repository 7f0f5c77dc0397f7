// A smooth field of metallic: it extends the metallic of reliable texels to texels where metallic is
// undetermined.
#pragma once

#include <cstddef>
#include <vector>

namespace remap {

// First all rows of a map are added, then the field is filled and read. It holds means over at most about a
// million square cells (25 MB) for a map of any size.
//
// Holes are filled by pull-push (Gortler et al. 1996, "The Lumigraph", section 3.4): where a cell has little
// weight, the mean of a larger cell replaces it.
class MetallicField {
 public:
  MetallicField(std::size_t width, std::size_t height);

  // Adds `count` texels of row y from x on, with metallic 0 to 1. Texels are skipped if `metallic_width` is
  // above kGuessWidth or NaN, or if `coverage`, which may be null, is 0 or less.
  void add(std::size_t x, std::size_t y, std::size_t count, const float* metallic,
           const float* metallic_width, const float* coverage);

  // Fills the holes after all texels were added. False if no texel was reliable; the field must not be read
  // then.
  bool fill();

  // Reads a row of the field, 0 to 1, interpolated linearly between the centers of cells.
  void read(std::size_t y, std::size_t count, float* values) const;

 private:
  // Means and their weights, 0 to 1.
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

  std::size_t cell_;  // side in texels
  Level cells_;       // sums and counts until fill()
};

}  // namespace remap
