#include <algorithm>
#include <cmath>

#include "check/material.hpp"
#include "texture/image_reader.hpp"

namespace remap {
namespace {

// An image of up to this many texels a side is read whole; of a larger one as many squares of kRun texels a
// side as fit into that size.
constexpr int kSide = 1024, kRun = 64;

// The columns or rows that are kept of `size`.
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

}  // namespace

bool TexelSample::has_floats() const {
  return std::ranges::any_of(layout.channels,
                             [](const Channel& channel) { return !is_integer(channel.type); });
}

TexelSample sample_of(const std::filesystem::path& file) {
  ImageReader reader(file);
  TexelSample sample;
  sample.layout = reader.layout();
  const ImageLayout& layout = sample.layout;
  const std::vector<int> columns = kept_of(layout.width), rows = kept_of(layout.height);
  sample.columns = static_cast<int>(columns.size());
  sample.rows = static_cast<int>(rows.size());
  sample.channels.resize(layout.channels.size());
  const int band = layout.tile_height > 0 ? layout.tile_height : std::min(layout.height, 32);
  std::vector<std::byte> stored(static_cast<std::size_t>(band) * layout.row_bytes());
  std::vector<float> values(static_cast<std::size_t>(layout.width));
  const bool has_floats = sample.has_floats();
  std::size_t next = 0;  // of `rows`
  for (int first = 0; first < layout.height; first += band) {
    const int count = std::min(band, layout.height - first);
    reader.read_rows(first, count, stored.data());
    for (int y = first; y < first + count; ++y) {
      const bool is_kept = next < rows.size() && rows[next] == y;
      for (std::size_t c = 0; c < layout.channels.size() && (is_kept || has_floats); ++c) {
        load(channel_view(stored.data(), layout, c), {0, static_cast<std::size_t>(y - first), values.size()},
             values.data());
        if (!is_integer(layout.channels[c].type)) count_bad(values, sample);
        if (!is_kept) continue;
        for (const int x : columns) sample.channels[c].push_back(values[static_cast<std::size_t>(x)]);
      }
      next += is_kept;
    }
  }
  return sample;
}

}  // namespace remap
