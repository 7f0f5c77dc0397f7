// Rows of an image at a larger size than it is stored in, made while it is read.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "texture/image_io.hpp"

namespace remap {

// Interpolates linearly between the centres of the four nearest texels; beyond the outermost centres the edge
// goes on. Values are interpolated as light where they follow a curve. Holds the stored rows of one band.
class ResampledRows {
 public:
  // Gives `count` stored rows from `first`; tiled files: as ImageReader::read_rows asks for them.
  using ReadStored = std::function<void(int first, int count, std::byte* texels)>;

  // `stored`: how the file has its texels. `width`, `height`: at least those of the file. `transfers`: one a
  // channel.
  ResampledRows(const ImageLayout& stored, int width, int height, std::vector<Transfer> transfers);

  // Of the rows that come out: floats, with the values that the file would hold.
  const ImageLayout& layout() const noexcept { return layout_; }
  const ImageLayout& stored() const noexcept { return stored_; }

  // Rows [first_row, first_row + row_count). Stored rows are read once where bands follow each other from the
  // top.
  void read(int first_row, int row_count, std::byte* texels, const ReadStored& read_stored);

 private:
  // Between texels `first` and `second`, at `weight` of the second.
  struct Place {
    std::size_t first, second;
    float weight;
  };
  // A stored row as floats, channel after channel.
  struct FloatRow {
    int number = -1;
    std::vector<float> values;
  };

  static Place place_of(int position, int count, int stored_count);
  void hold(int first, int last, const ReadStored& read_stored);
  const std::vector<float>& stored_row(std::size_t number);
  void interpolate(const Place& row, float* texels);

  ImageLayout stored_;
  ImageLayout layout_;
  std::vector<Transfer> transfers_;
  std::vector<Place> columns_;
  std::vector<std::byte> held_;  // stored rows [held_begin_, held_end_)
  int held_begin_ = 0;
  int held_end_ = 0;
  FloatRow rows_[2];  // even and odd ones: neighbours are both there
  std::vector<float> blended_;
};

}  // namespace remap
