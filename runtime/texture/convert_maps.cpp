#include "texture/convert_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>
#include <limits>
#include <span>

#include "error.hpp"
#include "number_text.hpp"

namespace remap {
namespace {

// Texels converted at a time: rows of floats that stay in the cache of one core.
constexpr std::size_t kSegment = 2048;
constexpr std::size_t kMaxChannels = 3;

using FloatRow = std::array<float, kSegment>;

// Texels [x, x + count) of row y, counted from the first row of the buffers.
struct Segment {
  std::size_t x, y, count;
};

template <typename Byte>
Byte* at(const BasicChannelView<Byte>& view, std::size_t x, std::size_t y) {
  return view.first + static_cast<std::ptrdiff_t>(y) * view.row_stride +
         static_cast<std::ptrdiff_t>(x) * view.texel_stride;
}

void load(const ConstChannelView& view, const Segment& segment, float* values) {
  load_values(view.type, at(view, segment.x, segment.y), static_cast<std::size_t>(view.texel_stride),
              segment.count, values);
}

std::size_t store(const ChannelView& view, const Segment& segment, const float* values) {
  return store_values(view.type, values, segment.count, at(view, segment.x, segment.y),
                      static_cast<std::size_t>(view.texel_stride));
}

bool is_ordinary(float value) { return value >= 0.0f && value <= std::numeric_limits<float>::max(); }

// Even in [-1/2, 1/2), a function of the place alone (finalizer of MurmurHash3, A. Appleby, public domain).
float dither_noise(std::size_t x, std::size_t y, std::size_t channel) {
  std::uint64_t bits = (static_cast<std::uint64_t>(y) << 32 | x) + 0x9e3779b97f4a7c15u * (channel + 1);
  bits = (bits ^ bits >> 33) * 0xff51afd7ed558ccdu;
  bits = (bits ^ bits >> 33) * 0xc4ceb9fe1a85ec53u;
  bits ^= bits >> 33;
  return static_cast<float>(bits >> 40) * 0x1p-24f - 0.5f;
}

ParameterStatistics statistics_of(std::span<const float> values) {
  ParameterStatistics statistics;
  statistics.min = std::numeric_limits<float>::max();
  statistics.max = -statistics.min;
  for (const float value : values) {
    const bool counts = std::fabs(value) <= std::numeric_limits<float>::max();
    statistics.min = counts && value < statistics.min ? value : statistics.min;
    statistics.max = counts && value > statistics.max ? value : statistics.max;
    statistics.finite_count += counts;
  }
  constexpr float kBins = static_cast<float>(ParameterStatistics::kBins);
  for (const float value : values) {
    if (std::isnan(value)) continue;
    const float bin = std::clamp(value * kBins, 0.0f, kBins - 1.0f);
    ++statistics.histogram[static_cast<std::size_t>(bin)];
  }
  return statistics;
}

// The parameters of one segment as rows of floats.
struct Scratch {
  FloatRow roughness;
  FloatRow other;  // copies of the roughness; what is stored
  std::array<FloatRow, kMaxChannels> specular;
  FloatRow given_roughness;  // what a mask is found from
  std::array<FloatRow, kMaxChannels> given_specular;
};

class Conversion {
 public:
  Conversion(const Converter& converter, const MapConversion& maps)
      : converter_(converter), maps_(maps), channels_(channel_count(maps.specular)) {
    require_fitting();
  }
  MapStatistics convert_rows(std::size_t begin, std::size_t end) const;

 private:
  static std::size_t channel_count(const SourceParameter& parameter) {
    return parameter.channels.empty() ? parameter.constants.size() : parameter.channels.size();
  }
  void require_fitting() const;
  void load_channel(const SourceParameter& parameter, std::size_t channel, const Segment& segment,
                    float* values) const;
  void require_grey(const Segment& segment, Scratch& scratch) const;
  void meet_bad_texels(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const;
  [[noreturn]] void fail_bad(const Segment& segment, std::size_t texel, const Scratch& scratch) const;
  void clamp_bad(std::size_t count, Scratch& scratch) const;
  void write_mask(const Segment& segment, std::size_t begin, std::size_t end, Scratch& scratch) const;
  std::size_t store_parameter(const TargetParameter& parameter, std::size_t channel, const Segment& segment,
                              const float* values, FloatRow& stored) const;
  void convert_segment(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const;

  const Converter& converter_;
  const MapConversion& maps_;
  std::size_t channels_;  // of specular
};

void Conversion::require_fitting() const {
  const auto fail = [](const std::string& what) { throw Error(ErrorKind::kUsage, "convert_maps: " + what); };
  const auto fits = [](const SourceParameter& parameter, std::size_t count) {
    return parameter.factors.size() <= 1 || parameter.factors.size() == count;
  };
  if (channel_count(maps_.roughness) == 0 ||
      (maps_.roughness.channels.empty() && maps_.roughness.constants.size() > 1))
    fail("the roughness has no channel; expected one, or one constant");
  if (channels_ != 1 && channels_ != kMaxChannels)
    fail("specular has " + std::to_string(channels_) + " channels; expected 1 or 3");
  const std::size_t written = maps_.specular_out.channels.size();
  if (written != 0 && written != channels_ && !(channels_ == 1 && written == kMaxChannels))
    fail("the specular to write has " + std::to_string(maps_.specular_out.channels.size()) +
         " channels; expected the " + std::to_string(channels_) + " of the source");
  if (!fits(maps_.roughness, 1) || !fits(maps_.specular, channels_))
    fail("there are more factors than channels; expected one, or one a channel");
}

void Conversion::load_channel(const SourceParameter& parameter, std::size_t channel, const Segment& segment,
                              float* values) const {
  if (parameter.channels.empty()) {
    std::fill_n(values, segment.count, parameter.constants[channel]);
  } else {
    load(parameter.channels[channel], segment, values);
    to_linear(parameter.transfer, {values, segment.count});
  }
  if (parameter.factors.empty()) return;
  const float factor = parameter.factors[parameter.factors.size() == 1 ? 0 : channel];
  if (factor == 1.0f) return;
  for (std::size_t i = 0; i < segment.count; ++i) values[i] *= factor;
}

void Conversion::require_grey(const Segment& segment, Scratch& scratch) const {
  const auto& channels = maps_.roughness.channels;
  if (channels.size() < 2) return;
  FloatRow& first = scratch.given_roughness;  // not needed yet
  load(channels[0], segment, first.data());
  for (std::size_t c = 1; c < channels.size(); ++c) {
    load(channels[c], segment, scratch.other.data());
    if (std::memcmp(scratch.other.data(), first.data(), segment.count * sizeof(float)) == 0) continue;
    const auto differs = [&](std::size_t i) {
      return std::memcmp(&scratch.other[i], &first[i], sizeof(float)) != 0 &&
             !(std::fabs(scratch.other[i] - first[i]) <= maps_.roughness.grey_tolerance);
    };
    std::size_t i = 0;
    while (i < segment.count && !differs(i)) ++i;
    if (i == segment.count) continue;
    const auto name = [&](std::size_t channel) {
      return channel < maps_.roughness.channel_names.size() ? maps_.roughness.channel_names[channel]
                                                            : "channel " + std::to_string(channel);
    };
    throw Error(ErrorKind::kInput, maps_.roughness.name + ": texel (" + std::to_string(segment.x + i) + ", " +
                                       std::to_string(maps_.first_row + segment.y) + ") is not grey, " +
                                       name(0) + " is " + number_text(static_cast<double>(first[i])) +
                                       " and " + name(c) + " is " +
                                       number_text(static_cast<double>(scratch.other[i])) +
                                       "; expected equal channels, or FILE:CHANNEL to pick one");
  }
}

void Conversion::fail_bad(const Segment& segment, std::size_t texel, const Scratch& scratch) const {
  const bool in_roughness = !is_ordinary(scratch.roughness[texel]);
  std::size_t channel = 0;
  while (!in_roughness && is_ordinary(scratch.specular[channel][texel])) ++channel;
  const SourceParameter& parameter = in_roughness ? maps_.roughness : maps_.specular;
  const float value = in_roughness ? scratch.roughness[texel] : scratch.specular[channel][texel];
  const std::string of =
      channel < parameter.channel_names.size() ? parameter.channel_names[channel] + " of " : "";
  throw Error(ErrorKind::kInput, parameter.name + ": " + of + "texel (" + std::to_string(segment.x + texel) +
                                     ", " + std::to_string(maps_.first_row + segment.y) + ") is " +
                                     number_text(static_cast<double>(value)) +
                                     "; expected finite values from 0, or --bad-texels clamp");
}

// Counts them, and ends the conversion where it is to.
void Conversion::meet_bad_texels(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const {
  std::array<const float*, kMaxChannels + 1> rows{scratch.roughness.data()};
  for (std::size_t c = 0; c < channels_; ++c) rows[c + 1] = scratch.specular[c].data();
  std::size_t odd = 0;
  for (std::size_t r = 0; r <= channels_; ++r)
    for (std::size_t i = 0; i < segment.count; ++i) odd += !is_ordinary(rows[r][i]);
  if (odd == 0) return;  // as nearly always, and found out at the speed of memory
  for (std::size_t i = 0; i < segment.count; ++i) {
    bool nan = false, infinite = false, negative = false;
    for (std::size_t r = 0; r <= channels_; ++r) {
      nan = nan || std::isnan(rows[r][i]);
      infinite = infinite || std::isinf(rows[r][i]);
      negative = negative || rows[r][i] < 0.0f;
    }
    if (!(nan || infinite || negative)) continue;
    if (maps_.bad_texels == BadTexels::kFail) fail_bad(segment, i, scratch);
    if (!statistics.first_bad) statistics.first_bad = {segment.x + i, maps_.first_row + segment.y};
    statistics.nan_count += nan;
    statistics.infinite_count += infinite;
    statistics.negative_count += negative;
  }
}

void Conversion::clamp_bad(std::size_t count, Scratch& scratch) const {
  const auto clamp = [count](FloatRow& row, const Range& range) {
    const float low = static_cast<float>(range.min), high = static_cast<float>(range.max);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(row[i] >= 0.0f)) row[i] = low;
      if (row[i] > std::numeric_limits<float>::max()) row[i] = high;
    }
  };
  clamp(scratch.roughness, converter_.info().roughness);
  for (std::size_t c = 0; c < channels_; ++c)
    clamp(scratch.specular[c], {0.0, converter_.info().specular.max});
}

// The converter counts texels and names none: halves are converted again until all or none of a part are out.
void Conversion::write_mask(const Segment& segment, std::size_t begin, std::size_t end,
                            Scratch& scratch) const {
  std::array<const float*, kMaxChannels> specular{};
  std::array<FloatRow, kMaxChannels> ignored;
  std::array<float*, kMaxChannels> specular_out{};
  for (std::size_t c = 0; c < channels_; ++c) {
    specular[c] = scratch.given_specular[c].data() + begin;
    specular_out[c] = ignored[c].data();
  }
  const std::size_t count = end - begin;
  const std::size_t outside =
      converter_.convert(count, scratch.given_roughness.data() + begin, {specular.data(), channels_},
                         scratch.other.data(), {specular_out.data(), channels_});
  if (outside > 0 && outside < count) {
    const std::size_t middle = begin + count / 2;
    write_mask(segment, begin, middle, scratch);
    write_mask(segment, middle, end, scratch);
    return;
  }
  std::fill_n(scratch.other.data(), count, outside > 0 ? 1.0f : 0.0f);
  store(*maps_.mask, {segment.x + begin, segment.y, count}, scratch.other.data());
}

std::size_t Conversion::store_parameter(const TargetParameter& parameter, std::size_t channel,
                                        const Segment& segment, const float* values, FloatRow& stored) const {
  const ChannelView& view = parameter.channels[channel];
  const bool dithered = maps_.dither && byte_count(view.type) == 1;
  if (parameter.transfer == Transfer::kLinear && !dithered) return store(view, segment, values);
  std::copy_n(values, segment.count, stored.data());
  from_linear(parameter.transfer, {stored.data(), segment.count});
  if (dithered) {
    for (std::size_t i = 0; i < segment.count; ++i)
      stored[i] = std::clamp(stored[i], 0.0f, 1.0f) +
                  dither_noise(segment.x + i, maps_.first_row + segment.y, channel) / 255.0f;
  }
  return store(view, segment, stored.data());
}

void Conversion::convert_segment(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const {
  const ConverterInfo& info = converter_.info();
  const std::size_t count = segment.count;
  require_grey(segment, scratch);
  load_channel(maps_.roughness, 0, segment, scratch.roughness.data());
  std::array<const float*, kMaxChannels> specular{};
  std::array<float*, kMaxChannels> specular_out{};
  for (std::size_t c = 0; c < channels_; ++c) {
    specular_out[c] = scratch.specular[c].data();
    specular[c] = specular_out[c];
    load_channel(maps_.specular, c, segment, specular_out[c]);
    if (maps_.value_statistics) statistics.specular += statistics_of({specular[c], count});
  }
  if (maps_.value_statistics) statistics.roughness += statistics_of({scratch.roughness.data(), count});
  statistics.texel_count += count;
  meet_bad_texels(segment, scratch, statistics);
  change_convention(maps_.source_convention.value_or(info.source.roughness), info.source.roughness,
                    {scratch.roughness.data(), count});
  if (maps_.bad_texels == BadTexels::kClamp) clamp_bad(count, scratch);
  if (maps_.mask) {
    scratch.given_roughness = scratch.roughness;
    scratch.given_specular = scratch.specular;
  }

  const std::size_t outside =
      converter_.convert(count, scratch.roughness.data(), {specular.data(), channels_},
                         scratch.roughness.data(), {specular_out.data(), channels_});
  statistics.out_of_domain_count += outside;
  if (maps_.mask) write_mask(segment, 0, count, scratch);

  change_convention(info.target.roughness, maps_.target_convention.value_or(info.target.roughness),
                    {scratch.roughness.data(), count});
  if (maps_.value_statistics) statistics.roughness_out += statistics_of({scratch.roughness.data(), count});
  std::size_t clipped = 0;  // copies of one value count once
  for (std::size_t c = 0; c < maps_.roughness_out.channels.size(); ++c)
    clipped = store_parameter(maps_.roughness_out, c, segment, scratch.roughness.data(), scratch.other);
  statistics.clipped_count += clipped;
  if (maps_.value_statistics)
    for (std::size_t c = 0; c < channels_; ++c)
      statistics.specular_out += statistics_of({specular[c], count});
  for (std::size_t c = 0; c < maps_.specular_out.channels.size(); ++c)
    statistics.clipped_count +=
        store_parameter(maps_.specular_out, c, segment, specular[channels_ == 1 ? 0 : c], scratch.other);
}

MapStatistics Conversion::convert_rows(std::size_t begin, std::size_t end) const {
  MapStatistics statistics;
  Scratch scratch;
  for (std::size_t y = begin; y < end; ++y)
    for (std::size_t x = 0; x < maps_.width; x += kSegment)
      convert_segment({x, y, std::min(kSegment, maps_.width - x)}, scratch, statistics);
  return statistics;
}

template <typename Float, typename Byte>
BasicChannelView<Byte> float_view(Float* first, std::size_t width, std::size_t values_a_texel) {
  const auto texel = static_cast<std::ptrdiff_t>(values_a_texel * sizeof(float));
  return {reinterpret_cast<Byte*>(first), PixelType::kFloat, texel,
          texel * static_cast<std::ptrdiff_t>(width)};
}

}  // namespace

ChannelView float_channel(float* first, std::size_t width, std::size_t values_a_texel) noexcept {
  return float_view<float, std::byte>(first, width, values_a_texel);
}

ConstChannelView float_channel(const float* first, std::size_t width, std::size_t values_a_texel) noexcept {
  return float_view<const float, const std::byte>(first, width, values_a_texel);
}

ParameterStatistics& ParameterStatistics::operator+=(const ParameterStatistics& other) noexcept {
  if (other.finite_count > 0) {
    min = finite_count > 0 ? std::min(min, other.min) : other.min;
    max = finite_count > 0 ? std::max(max, other.max) : other.max;
  }
  finite_count += other.finite_count;
  for (std::size_t i = 0; i < kBins; ++i) histogram[i] += other.histogram[i];
  return *this;
}

MapStatistics& MapStatistics::operator+=(const MapStatistics& other) noexcept {
  texel_count += other.texel_count;
  out_of_domain_count += other.out_of_domain_count;
  nan_count += other.nan_count;
  infinite_count += other.infinite_count;
  negative_count += other.negative_count;
  clipped_count += other.clipped_count;
  if (!first_bad) first_bad = other.first_bad;
  roughness += other.roughness;
  specular += other.specular;
  roughness_out += other.roughness_out;
  specular_out += other.specular_out;
  return *this;
}

MapStatistics convert_maps(const Converter& converter, const MapConversion& maps, int thread_count) {
  const Conversion conversion(converter, maps);
  const std::size_t parts = std::clamp<std::size_t>(static_cast<std::size_t>(std::max(thread_count, 1)), 1,
                                                    std::max<std::size_t>(maps.height, 1));
  if (parts == 1) return conversion.convert_rows(0, maps.height);
  std::vector<std::future<MapStatistics>> results;
  for (std::size_t part = 0; part < parts; ++part)
    results.push_back(std::async(std::launch::async, [&, part] {
      return conversion.convert_rows(maps.height * part / parts, maps.height * (part + 1) / parts);
    }));
  MapStatistics statistics;
  for (std::future<MapStatistics>& result : results) statistics += result.get();
  return statistics;
}

std::size_t copy_channel(const ConstChannelView& from, const ChannelView& to, std::size_t width,
                         std::size_t height) {
  std::size_t clipped = 0;
  FloatRow values;
  for (std::size_t y = 0; y < height; ++y) {
    if (from.type == to.type) {
      const std::size_t bytes = byte_count(from.type);
      const std::byte* source = at(from, 0, y);
      std::byte* target = at(to, 0, y);
      for (std::size_t x = 0; x < width; ++x, source += from.texel_stride, target += to.texel_stride)
        std::memcpy(target, source, bytes);
      continue;
    }
    for (std::size_t x = 0; x < width; x += kSegment) {
      const Segment segment{x, y, std::min(kSegment, width - x)};
      load(from, segment, values.data());
      clipped += store(to, segment, values.data());
    }
  }
  return clipped;
}

}  // namespace remap
