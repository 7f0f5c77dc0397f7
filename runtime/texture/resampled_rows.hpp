// This file enlarges an image while its rows are read.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "texture/image_layout.hpp"

namespace remap {

// A ResampledRows interpolates bilinearly between texel centers. Beyond the outermost centers, it repeats the
// edge. It interpolates values with a transfer curve as linear light. It keeps the stored rows of one band.
class ResampledRows {
 public:
  // Reads `count` stored rows from `first` on. In tiled files, the rules of StoredImage::read_rows apply.
  using ReadStored = std::function<void(int first, int count, std::byte* texels)>;

  // `stored` is the layout in the file. `width` and `height` are at least the size in the file. `transfers`
  // has one curve per channel.
  ResampledRows(const ImageLayout& stored, int width, int height, std::vector<Transfer> transfers);

  // Returns the layout of the resampled rows: floats in the encoding of the file.
  const ImageLayout& layout() const noexcept { return layout_; }
  const ImageLayout& stored() const noexcept { return stored_; }

  // Makes the rows [first_row, first_row + row_count). If bands follow each other from the top, each stored
  // row is read only once.
  void read(int first_row, int row_count, std::byte* texels, const ReadStored& read_stored);

 private:
  // A Place is a position between texels `first` and `second`. `weight` is the weight of `second`.
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
  FloatRow rows_[2];  // two neighbouring rows, the even one first
  std::vector<float> blended_;
};

}  // namespace remap
