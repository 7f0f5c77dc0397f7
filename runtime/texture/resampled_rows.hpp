// This file enlarges an image while its rows are read.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "texture/image_layout.hpp"

namespace remap {

// ResampledRows interpolates bilinearly between texel centers and extends the edge beyond the outermost ones.
// Values with a transfer curve are interpolated as linear light. It holds the stored rows of one band.
class ResampledRows {
 public:
  // Reads `count` stored rows from `first`; for tiled files with the rules of StoredImage::read_rows.
  using ReadStored = std::function<void(int first, int count, std::byte* texels)>;

  // `stored` is the layout in the file. `width` and `height` are at least the size in the file. `transfers`
  // has one curve per channel.
  ResampledRows(const ImageLayout& stored, int width, int height, std::vector<Transfer> transfers);

  // Returns the layout of the resampled rows: floats in the encoding of the file.
  const ImageLayout& layout() const noexcept { return layout_; }
  const ImageLayout& stored() const noexcept { return stored_; }

  // Makes rows [first_row, first_row + row_count). Each stored row is read once if bands follow each other
  // from the top.
  void read(int first_row, int row_count, std::byte* texels, const ReadStored& read_stored);

 private:
  // A Place is a position between texels `first` and `second`; `weight` belongs to the second.
  struct Place {
    std::size_t first, second;
    float weight;
  };
  // A FloatRow is a stored row as floats, channel by channel.
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
  FloatRow rows_[2];  // one even and one odd row, which are neighbours
  std::vector<float> blended_;
};

}  // namespace remap
