#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "check/material.hpp"
#include "core/input_file.hpp"
#include "texture/image_library.hpp"
#include "texture/image_reader.hpp"

namespace remap {
namespace {

// An image of at most so many texels a side is read whole. From a larger image, squares with kRun texels a
// side are read, as many as fit into kSide.
constexpr int kSide = 1024, kRun = 64;

// Returns which of `size` columns or rows are kept.
std::vector<int> kept_of(int size) {
  std::vector<int> kept;
  if (size <= kSide) {
    for (int i = 0; i < size; ++i) kept.push_back(i);
    return kept;
  }
  constexpr int kRuns = kSide / kRun;
  for (int run = 0; run < kRuns; ++run) {
    const int first = static_cast<int>(static_cast<long long>(size - kRun) * run / (kRuns - 1));
    for (int i = 0; i < kRun; ++i) kept.push_back(first + i);
  }
  return kept;
}

void count_bad(const std::vector<float>& values, TexelSample& sample) {
  for (const float value : values) {
    sample.nan_count += !std::isfinite(value);
    sample.negative_count += value < 0.0f;
    sample.above_one_count += value > 1.0f;
  }
}

// SampledRows samples an image from its rows, which are added from the top.
class SampledRows {
 public:
  explicit SampledRows(const ImageLayout& layout)
      : columns_(kept_of(layout.width)),
        rows_(kept_of(layout.height)),
        values_(static_cast<std::size_t>(layout.width)) {
    sample.layout = layout;
    sample.columns = static_cast<int>(columns_.size());
    sample.rows = static_cast<int>(rows_.size());
    sample.channels.resize(layout.channels.size());
    has_floats_ = sample.has_floats();
  }

  void add(int first, int count, const std::byte* texels) {
    const ImageLayout& layout = sample.layout;
    for (int y = first; y < first + count; ++y) {
      const bool is_kept = next_ < rows_.size() && rows_[next_] == y;
      for (std::size_t c = 0; c < layout.channels.size() && (is_kept || has_floats_); ++c) {
        load(channel_view(texels, layout, c), {0, static_cast<std::size_t>(y - first), values_.size()},
             values_.data());
        if (!is_integer(layout.channels[c].type)) count_bad(values_, sample);
        if (!is_kept) continue;
        for (const int x : columns_) sample.channels[c].push_back(values_[static_cast<std::size_t>(x)]);
      }
      next_ += is_kept;
    }
  }

  TexelSample sample;

 private:
  std::vector<int> columns_, rows_;
  std::vector<float> values_;
  std::size_t next_ = 0;  // index into rows_
  bool has_floats_ = false;
};

bool is_webp(const std::filesystem::path& file) {
  std::array<char, 12> head{};
  const std::string_view text(head.data(), InputFile(file).read(0, head.data(), head.size()));
  return text.starts_with("RIFF") && text.ends_with("WEBP");
}

constexpr std::uintmax_t kLargestTexture = std::uintmax_t{4} << 30;  // the limit of the glb format

}  // namespace

bool TexelSample::has_floats() const {
  return std::ranges::any_of(layout.channels,
                             [](const Channel& channel) { return !is_integer(channel.type); });
}

TexelSample sample_of(const std::filesystem::path& file) {
  ImageReader reader(file);
  SampledRows rows(reader.layout());
  const ImageLayout& layout = rows.sample.layout;
  const int band = layout.tile_height > 0 ? layout.tile_height : std::min(layout.height, 32);
  std::vector<std::byte> stored(static_cast<std::size_t>(band) * layout.row_bytes());
  for (int first = 0; first < layout.height; first += band) {
    const int count = std::min(band, layout.height - first);
    reader.read_rows(first, count, stored.data());
    rows.add(first, count, stored.data());
  }
  return std::move(rows.sample);
}

TexelSample sample_of_texture(const std::filesystem::path& file) {
  if (!is_webp(file)) return sample_of(file);
  const ImagePixels pixels = image_library().codec().decode(read_file(file, kLargestTexture), file.string());
  constexpr std::array<std::string_view, 4> kGrey = {"Y", "A"}, kColor = {"R", "G", "B", "A"};
  ImageLayout layout;
  layout.width = static_cast<int>(pixels.width);
  layout.height = static_cast<int>(pixels.height);
  layout.alpha_channel = pixels.has_alpha() ? static_cast<int>(pixels.channels) - 1 : -1;
  for (std::size_t c = 0; c < pixels.channels; ++c) {
    layout.channels.push_back(
        {std::string((pixels.is_grey() ? kGrey : kColor)[c]), pixels.type, layout.texel_bytes});
    layout.texel_bytes += byte_count(pixels.type);
  }
  SampledRows rows(layout);
  rows.add(0, layout.height, pixels.bytes.data());
  return std::move(rows.sample);
}

}  // namespace remap
