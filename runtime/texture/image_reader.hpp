// This file reads and writes images in bands of rows, in the pixel types of the file. It enlarges
// images, in bands or in memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "remap/pixels.hpp"
#include "texture/image_library.hpp"

namespace remap {

// Implements AssetResources::enlarged() (assets/document/asset.hpp).
ImagePixels enlarged_pixels(const ImagePixels& pixels, std::size_t width, std::size_t height);

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

// An ImageReader is a StoredImage (image_library.hpp) that can be resampled.
class ImageReader {
 public:
  // Loads the module of images, except for paths that cannot be image files.
  explicit ImageReader(const std::filesystem::path& path, int part = 0);
  // Opens a part of an open file.
  ImageReader(std::shared_ptr<const InputFile> file, int part);

  const std::shared_ptr<const InputFile>& file() const noexcept { return file_; }
  const std::filesystem::path& path() const noexcept { return file_->path(); }
  const ImageLayout& layout() const noexcept { return resampled_ ? resampled_->layout() : image_->layout(); }
  int part() const noexcept { return part_; }
  std::string part_name() const { return image_->part_name(); }
  int part_count() const noexcept { return image_->part_count(); }
  int level_count() const noexcept { return image_->level_count(); }
  void select_level(int level) { image_->select_level(level); }
  std::optional<std::string> noted_metadata(const std::string& name) const {
    return image_->noted_metadata(name);
  }
  const StoredImage& stored() const noexcept { return *image_; }

  // Makes layout() and read_rows() return the picture at this size, as floats. A new image that is made from
  // this one has the same size. `width` and `height` are at least the size in the file. `transfers` has the
  // curve of each channel. Throws kInput for a picture with mip levels, or with a data window that differs
  // from its display window.
  void resample(int width, int height, const std::vector<Transfer>& transfers);
  bool is_resampled() const noexcept { return resampled_ != nullptr; }

  // Reads rows with the rules of StoredImage::read_rows.
  void read_rows(int first_row, int row_count, std::byte* texels);

 private:
  std::shared_ptr<const InputFile> file_;
  int part_ = 0;
  std::unique_ptr<StoredImage> image_;
  std::unique_ptr<ResampledRows> resampled_;
};

}  // namespace remap
