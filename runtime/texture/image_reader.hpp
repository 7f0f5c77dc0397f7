// This file reads and writes images in bands of rows, in the pixel types of the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remap/pixels.hpp"
#include "texture/image_library.hpp"
#include "texture/resampled_rows.hpp"

namespace remap {

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
