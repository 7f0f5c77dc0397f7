#include "texture/image_reader.hpp"

#include <utility>

#include "remap/error.hpp"

namespace remap {

namespace {

std::shared_ptr<const InputFile> opened(const std::filesystem::path& path) {
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
    throw Error(ErrorKind::kInput, path.string() + ": is a folder, not an image file (give an image file)");
  return std::make_shared<const InputFile>(path);
}

}  // namespace

ImageReader::ImageReader(const std::filesystem::path& path, int part) : ImageReader(opened(path), part) {}

ImageReader::ImageReader(std::shared_ptr<const InputFile> file, int part)
    : file_(std::move(file)), part_(part), image_(image_library().open_part(file_, part)) {}

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
