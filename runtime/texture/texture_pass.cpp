#include "texture/texture_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <future>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "error.hpp"
#include "number_text.hpp"

namespace remap {
namespace {

// Texels converted at a time: four rows of floats that stay in the cache of one core.
constexpr std::size_t kSegment = 2048;
constexpr std::size_t kMaxChannels = 3;
// Rows that EXR compresses together are 1, 16 or 32 (256 for dwab): bands do not cut them.
constexpr std::size_t kChunkRows = 32;

using FloatRow = std::array<float, kSegment>;

// Floats of one segment: the roughness, its copies, the specular channels, and channels that pass through.
struct Scratch {
  FloatRow roughness;
  FloatRow other;
  std::array<FloatRow, kMaxChannels> specular;
};

// Rows [first_row, first_row + row_count) of both maps, as the files hold them.
struct Band {
  int first_row = 0;
  int row_count = 0;
  std::vector<std::byte> roughness;
  std::vector<std::byte> specular;
};

// Where a segment of one map comes from and goes to.
struct MapView {
  const ImageLayout* source_layout = nullptr;  // null for a constant
  const ImageLayout* target_layout = nullptr;
  const std::byte* source = nullptr;
  std::byte* target = nullptr;  // may be `source`, where the layouts are the same

  void load(std::size_t channel, std::size_t first, std::size_t count, float* values) const {
    const Channel& from = source_layout->channels[channel];
    const std::size_t stride = source_layout->texel_bytes;
    load_values(from.type, source + first * stride + from.offset, stride, count, values);
  }
  std::size_t store(std::size_t channel, std::size_t first, std::size_t count, const float* values) const {
    const Channel& to = target_layout->channels[channel];
    const std::size_t stride = target_layout->texel_bytes;
    return store_values(to.type, values, count, target + first * stride + to.offset, stride);
  }
};

bool same_storage(const ImageLayout& a, const ImageLayout& b) {
  return std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                    [](const Channel& x, const Channel& y) { return x.type == y.type; });
}

bool is_ordinary(float value) { return value >= 0.0f && value <= std::numeric_limits<float>::max(); }

void count_oddities(std::size_t count, std::span<const float* const> rows, PassStatistics& statistics) {
  std::size_t odd = 0;
  for (const float* row : rows) {
    for (std::size_t i = 0; i < count; ++i) odd += !is_ordinary(row[i]);
  }
  if (odd == 0) return;  // as nearly always, and found out at the speed of memory
  for (std::size_t i = 0; i < count; ++i) {
    bool nan = false, infinite = false, negative = false;
    for (const float* row : rows) {
      nan = nan || std::isnan(row[i]);
      infinite = infinite || std::isinf(row[i]);
      negative = negative || row[i] < 0.0f;
    }
    statistics.nan_count += nan;
    statistics.infinite_count += infinite;
    statistics.negative_count += negative;
  }
}

class Pass {
 public:
  Pass(TextureSet& set, TargetMaps& target, const Converter& converter, const PassOptions& options);
  PassStatistics run();

 private:
  void read(Band& band, int first_row);
  PassStatistics convert(Band& band);
  void write(const Band& band);
  PassStatistics convert_texels(const Band& band, std::size_t begin, std::size_t end) const;
  void convert_segment(std::size_t first, std::size_t count, Scratch& scratch,
                       PassStatistics& statistics) const;
  void require_grey(const Band& band, std::size_t first, std::size_t count, Scratch& scratch) const;
  void pass_through(const MapView& view, const std::vector<std::size_t>& converted, std::size_t first,
                    std::size_t count, FloatRow& values) const;
  int rows_of_a_band() const;
  void stop_if_cancelled() const;

  TextureSet& set_;
  TargetMaps& target_;
  const Converter& converter_;
  const PassOptions& options_;
  const std::launch launch_;  // of work that may run beside other work
  SourceMap* const specular_map_;
  const std::size_t specular_channels_;
  const int band_rows_;
  MapView roughness_;
  MapView specular_;
  std::vector<std::byte> roughness_out_;  // empty where the map is converted in place
  std::vector<std::byte> specular_out_;
};

Pass::Pass(TextureSet& set, TargetMaps& target, const Converter& converter, const PassOptions& options)
    : set_(set),
      target_(target),
      converter_(converter),
      options_(options),
      launch_(options.thread_count > 1 ? std::launch::async : std::launch::deferred),
      specular_map_(std::get_if<SourceMap>(&set.specular)),
      specular_channels_(set.specular_channel_count()),
      band_rows_(rows_of_a_band()) {
  roughness_.source_layout = &set.roughness.reader.layout();
  roughness_.target_layout = &target.roughness.layout();
  specular_.source_layout = specular_map_ != nullptr ? &specular_map_->reader.layout() : nullptr;
  specular_.target_layout = &target.specular.layout();
  const auto rows = static_cast<std::size_t>(band_rows_);
  if (!same_storage(*roughness_.source_layout, *roughness_.target_layout))
    roughness_out_.resize(rows * roughness_.target_layout->row_bytes());
  if (specular_map_ == nullptr || !same_storage(*specular_.source_layout, *specular_.target_layout))
    specular_out_.resize(rows * specular_.target_layout->row_bytes());
}

int Pass::rows_of_a_band() const {
  std::size_t row_bytes = 0, unit = kChunkRows;
  const auto add = [&](const ImageLayout& layout) {
    row_bytes += layout.row_bytes();
    if (layout.tile_height > 0) unit = std::lcm(unit, static_cast<std::size_t>(layout.tile_height));
  };
  add(set_.roughness.reader.layout());
  if (specular_map_ != nullptr) add(specular_map_->reader.layout());
  const std::size_t source_bytes = std::exchange(row_bytes, 0);
  add(target_.roughness.layout());
  add(target_.specular.layout());
  const std::size_t units = options_.band_bytes / (unit * std::max(source_bytes, row_bytes));
  const std::size_t rows = unit * std::max<std::size_t>(units, 1);
  return static_cast<int>(std::min(rows, static_cast<std::size_t>(set_.height())));
}

void Pass::stop_if_cancelled() const {
  if (options_.cancelled != nullptr && options_.cancelled->load(std::memory_order_relaxed))
    throw Error(ErrorKind::kInterrupted, "interrupted: no file was written");
}

PassStatistics Pass::run() {
  PassStatistics statistics;
  Band present, next;
  read(present, 0);
  while (present.row_count > 0) {
    stop_if_cancelled();
    const int end = present.first_row + present.row_count;
    std::future<void> reading = std::async(launch_, [&] { read(next, end); });
    statistics += convert(present);
    write(present);
    reading.get();
    std::swap(present, next);
    if (options_.progress) options_.progress(static_cast<std::size_t>(end));
  }
  target_.roughness.finish();
  target_.specular.finish();
  stop_if_cancelled();
  target_.roughness.commit();
  target_.specular.commit();
  return statistics;
}

void Pass::read(Band& band, int first_row) {
  band.first_row = first_row;
  band.row_count = std::min(band_rows_, set_.height() - first_row);
  if (band.row_count <= 0) return;
  const auto rows = static_cast<std::size_t>(band_rows_);
  std::future<void> beside;
  if (specular_map_ != nullptr) {
    band.specular.resize(rows * specular_.source_layout->row_bytes());
    beside = std::async(
        launch_, [&] { specular_map_->reader.read_rows(first_row, band.row_count, band.specular.data()); });
  }
  band.roughness.resize(rows * roughness_.source_layout->row_bytes());
  set_.roughness.reader.read_rows(first_row, band.row_count, band.roughness.data());
  if (beside.valid()) beside.get();
}

void Pass::write(const Band& band) {
  std::future<void> beside = std::async(
      launch_, [&] { target_.specular.write_rows(band.first_row, band.row_count, specular_.target); });
  target_.roughness.write_rows(band.first_row, band.row_count, roughness_.target);
  beside.get();
}

PassStatistics Pass::convert(Band& band) {
  roughness_.source = band.roughness.data();
  roughness_.target = roughness_out_.empty() ? band.roughness.data() : roughness_out_.data();
  specular_.source = band.specular.data();
  specular_.target = specular_out_.empty() ? band.specular.data() : specular_out_.data();
  const std::size_t texels =
      static_cast<std::size_t>(band.row_count) * static_cast<std::size_t>(set_.width());
  const std::size_t parts = static_cast<std::size_t>(std::max(options_.thread_count, 1));
  std::vector<std::future<PassStatistics>> results;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = texels * part / parts, end = texels * (part + 1) / parts;
    results.push_back(
        std::async(launch_, [this, &band, begin, end] { return convert_texels(band, begin, end); }));
  }
  PassStatistics statistics;
  for (std::future<PassStatistics>& result : results) statistics += result.get();
  return statistics;
}

PassStatistics Pass::convert_texels(const Band& band, std::size_t begin, std::size_t end) const {
  PassStatistics statistics;
  Scratch scratch;
  for (std::size_t first = begin; first < end; first += kSegment) {
    const std::size_t count = std::min(kSegment, end - first);
    roughness_.load(set_.roughness.channels.front(), first, count, scratch.roughness.data());
    if (set_.roughness.copies) require_grey(band, first, count, scratch);
    convert_segment(first, count, scratch, statistics);
  }
  return statistics;
}

void Pass::require_grey(const Band& band, std::size_t first, std::size_t count, Scratch& scratch) const {
  for (const std::size_t channel : set_.roughness.channels) {
    roughness_.load(channel, first, count, scratch.other.data());
    if (std::memcmp(scratch.other.data(), scratch.roughness.data(), count * sizeof(float)) == 0) continue;
    const auto differs = [&](std::size_t i) {
      return std::memcmp(&scratch.other[i], &scratch.roughness[i], sizeof(float)) != 0;
    };
    std::size_t i = 0;
    while (!differs(i)) ++i;
    const std::size_t width = static_cast<std::size_t>(set_.width()), texel = first + i;
    const std::size_t row = static_cast<std::size_t>(band.first_row) + texel / width;
    const auto& channels = roughness_.source_layout->channels;
    throw Error(ErrorKind::kInput,
                set_.roughness.reader.path().string() + ": texel (" + std::to_string(texel % width) + ", " +
                    std::to_string(row) + ") is not grey, " + channels[set_.roughness.channels.front()].name +
                    " is " + number_text(static_cast<double>(scratch.roughness[i])) + " and " +
                    channels[channel].name + " is " + number_text(static_cast<double>(scratch.other[i])) +
                    "; expected equal channels, or --roughness-channel NAME to pick one");
  }
}

void Pass::convert_segment(std::size_t first, std::size_t count, Scratch& scratch,
                           PassStatistics& statistics) const {
  std::array<const float*, kMaxChannels + 1> rows{};
  std::array<float*, kMaxChannels> specular{};
  for (std::size_t c = 0; c < specular_channels_; ++c) {
    specular[c] = scratch.specular[c].data();
    rows[c] = specular[c];
    if (specular_map_ != nullptr)
      specular_.load(specular_map_->channels[c], first, count, specular[c]);
    else
      std::fill_n(specular[c], count, std::get<ConstantSpecular>(set_.specular)[c]);
  }
  rows[specular_channels_] = scratch.roughness.data();
  statistics.texel_count += count;
  count_oddities(count, {rows.data(), specular_channels_ + 1}, statistics);
  statistics.out_of_domain_count +=
      converter_.convert(count, scratch.roughness.data(), {rows.data(), specular_channels_},
                         scratch.roughness.data(), {specular.data(), specular_channels_});

  if (!roughness_out_.empty()) pass_through(roughness_, set_.roughness.channels, first, count, scratch.other);
  if (!specular_out_.empty() && specular_map_ != nullptr)
    pass_through(specular_, specular_map_->channels, first, count, scratch.other);
  for (std::size_t c = 0; c < specular_channels_; ++c) {
    const std::size_t channel = specular_map_ != nullptr ? specular_map_->channels[c] : c;
    statistics.clipped_count += specular_.store(channel, first, count, specular[c]);
  }
  std::size_t clipped = 0;  // copies of one value count once
  for (const std::size_t channel : set_.roughness.channels)
    clipped = roughness_.store(channel, first, count, scratch.roughness.data());
  statistics.clipped_count += clipped;
}

void Pass::pass_through(const MapView& view, const std::vector<std::size_t>& converted, std::size_t first,
                        std::size_t count, FloatRow& values) const {
  for (std::size_t channel = 0; channel < view.source_layout->channels.size(); ++channel) {
    if (std::find(converted.begin(), converted.end(), channel) != converted.end()) continue;
    view.load(channel, first, count, values.data());
    view.store(channel, first, count, values.data());
  }
}

}  // namespace

PassStatistics& PassStatistics::operator+=(const PassStatistics& other) noexcept {
  texel_count += other.texel_count;
  out_of_domain_count += other.out_of_domain_count;
  nan_count += other.nan_count;
  infinite_count += other.infinite_count;
  negative_count += other.negative_count;
  clipped_count += other.clipped_count;
  return *this;
}

PassStatistics run_texture_pass(TextureSet& set, TargetMaps& target, const Converter& converter,
                                const PassOptions& options) {
  return Pass(set, target, converter, options).run();
}

}  // namespace remap
