#include "texture/image_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "convert/transfer.hpp"
#include "core/errors.hpp"

namespace remap {
namespace {

std::shared_ptr<const InputFile> opened(const std::filesystem::path& path) {
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored))
    throw input_error(path.string() + ": is a folder, not an image file (give an image file)");
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

namespace {

// Interpolates. If the weight is 0, the second value must have no effect, even if it is NaN or infinity.
float between(float a, float b, float weight) { return weight == 0.0f ? a : a + weight * (b - a); }

}  // namespace

ResampledRows::ResampledRows(const ImageLayout& stored, int width, int height,
                             std::vector<Transfer> transfers)
    : stored_(stored), layout_(stored), transfers_(std::move(transfers)) {
  layout_.width = width;
  layout_.height = height;
  layout_.tile_height = 0;
  layout_.texel_bytes = 0;
  for (Channel& channel : layout_.channels) {
    channel.type = PixelType::kFloat;
    channel.offset = layout_.texel_bytes;
    layout_.texel_bytes += sizeof(float);
  }
  for (int x = 0; x < width; ++x) columns_.push_back(place_of(x, width, stored_.width));
  blended_.resize(static_cast<std::size_t>(stored_.width));
}

ResampledRows::Place ResampledRows::place_of(int position, int count, int stored_count) {
  const double centre = (position + 0.5) * stored_count / count - 0.5;
  const double held = std::clamp(centre, 0.0, stored_count - 1.0);
  const double first = std::floor(held);
  return {static_cast<std::size_t>(first),
          static_cast<std::size_t>(std::min(first + 1.0, stored_count - 1.0)),
          static_cast<float>(held - first)};
}

// Makes `held_` hold the rows [first, last]. Keeps rows that it has already, and reads the others.
void ResampledRows::hold(int first, int last, const ReadStored& read_stored) {
  const int unit = std::max(stored_.tile_height, 1);
  const std::size_t row_bytes = stored_.row_bytes();
  if (first < held_begin_ || first > held_end_) {
    held_.clear();
    held_begin_ = held_end_ = first / unit * unit;
  }
  if (last >= held_end_) {
    const int end = std::min((last / unit + 1) * unit, stored_.height);
    const std::size_t known = held_.size();
    held_.resize(known + static_cast<std::size_t>(end - held_end_) * row_bytes);
    read_stored(held_end_, end - held_end_, held_.data() + known);
    held_end_ = end;
  }
  const std::size_t passed = static_cast<std::size_t>(first - held_begin_) * row_bytes;
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(passed));
  held_begin_ = first;
}

const std::vector<float>& ResampledRows::stored_row(std::size_t number) {
  FloatRow& row = rows_[number % 2];
  if (row.number == static_cast<int>(number)) return row.values;
  row.number = static_cast<int>(number);
  const auto width = static_cast<std::size_t>(stored_.width);
  row.values.resize(width * stored_.channels.size());
  const std::byte* texels =
      held_.data() + (number - static_cast<std::size_t>(held_begin_)) * stored_.row_bytes();
  for (std::size_t c = 0; c < stored_.channels.size(); ++c) {
    float* values = row.values.data() + c * width;
    load_linear(transfers_[c], stored_.channels[c].type, texels + stored_.channels[c].offset,
                stored_.texel_bytes, width, values);
  }
  return row.values;
}

void ResampledRows::interpolate(const Place& row, float* texels) {
  const std::vector<float>& upper = stored_row(row.first);
  const std::vector<float>& lower = stored_row(row.second);
  const std::size_t channel_count = stored_.channels.size(), width = blended_.size();
  std::vector<float> line(columns_.size());
  for (std::size_t c = 0; c < channel_count; ++c) {
    for (std::size_t x = 0; x < width; ++x)
      blended_[x] = between(upper[c * width + x], lower[c * width + x], row.weight);
    for (std::size_t x = 0; x < line.size(); ++x)
      line[x] = between(blended_[columns_[x].first], blended_[columns_[x].second], columns_[x].weight);
    from_linear(transfers_[c], line);
    for (std::size_t x = 0; x < line.size(); ++x) texels[x * channel_count + c] = line[x];
  }
}

void ResampledRows::read(int first_row, int row_count, std::byte* texels, const ReadStored& read_stored) {
  const auto place = [&](int row) { return place_of(row, layout_.height, stored_.height); };
  hold(static_cast<int>(place(first_row).first), static_cast<int>(place(first_row + row_count - 1).second),
       read_stored);
  std::vector<float> row(columns_.size() * stored_.channels.size());
  for (int y = 0; y < row_count; ++y) {
    interpolate(place(first_row + y), row.data());
    std::memcpy(texels + static_cast<std::size_t>(y) * layout_.row_bytes(), row.data(), layout_.row_bytes());
  }
}

ImagePixels enlarged_pixels(const ImagePixels& pixels, std::size_t width, std::size_t height) {
  ImageLayout stored;
  stored.width = static_cast<int>(pixels.width);
  stored.height = static_cast<int>(pixels.height);
  std::vector<Transfer> transfers(pixels.channels, Transfer::kSrgb);
  if (pixels.has_alpha()) transfers.back() = Transfer::kLinear;
  for (std::size_t c = 0; c < pixels.channels; ++c)
    stored.channels.push_back({std::string(1, "RGBA"[c]), pixels.type, c * byte_count(pixels.type)});
  stored.texel_bytes = pixels.texel_bytes();
  ResampledRows rows(stored, static_cast<int>(width), static_cast<int>(height), std::move(transfers));
  const auto read_stored = [&](int first, int count, std::byte* texels) {
    const std::size_t row = pixels.width * pixels.texel_bytes();
    std::memcpy(texels, pixels.bytes.data() + static_cast<std::size_t>(first) * row,
                static_cast<std::size_t>(count) * row);
  };
  ImagePixels result{width, height, pixels.channels, pixels.type, {}};
  result.bytes.resize(width * height * result.texel_bytes());
  std::vector<float> values(width * pixels.channels);
  for (std::size_t y = 0; y < height; ++y) {
    rows.read(static_cast<int>(y), 1, reinterpret_cast<std::byte*>(values.data()), read_stored);
    (void)store_values(result.type, values.data(), values.size(),
                       result.bytes.data() + y * width * result.texel_bytes(), byte_count(result.type));
  }
  return result;
}

}  // namespace remap
