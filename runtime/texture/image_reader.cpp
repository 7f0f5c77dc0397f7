#include "texture/image_reader.hpp"

#include "remap/error.hpp"

namespace remap {

ImageReader::ImageReader(const std::filesystem::path& path, int part) : path_(path), part_(part) {
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
    throw Error(ErrorKind::kInput, path.string() + ": is a folder, not an image file");
  require_regular_file(path);
  image_ = image_library().open(path, part);
}

void ImageReader::resample(int width, int height, const std::vector<Transfer>& transfers) {
  image_->set_followed_size(width, height);
  resampled_ = std::make_unique<ResampledRows>(image_->layout(), width, height, transfers);
}

void ImageReader::read_rows(int first_row, int row_count, std::byte* texels) {
  if (!resampled_) return image_->read_rows(first_row, row_count, texels);
  resampled_->read(first_row, row_count, texels,
                   [this](int first, int count, std::byte* rows) { image_->read_rows(first, count, rows); });
}

}  // namespace remap
