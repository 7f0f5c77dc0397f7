#include "remap/convert_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <span>

#include "convert/transfer.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kMaxChannels = 3;

// This many texels are converted at a time, so that their rows stay in the cache of one core.
constexpr std::size_t kSegment = 2048;
using FloatRow = std::array<float, kSegment>;

// Uses no branch, so that compilers vectorise loops over it.
bool is_ordinary(float value, float highest) {
  const bool is_high_enough = value >= 0.0f, is_low_enough = value <= highest;
  return is_high_enough & is_low_enough;
}
constexpr float kLargest = std::numeric_limits<float>::max();

// Returns uniform noise in [-1/2, 1/2) that depends only on the position (finalizer of MurmurHash3, A.
// Appleby, public domain).
float dither_noise(std::size_t x, std::size_t y, std::size_t channel) {
  std::uint64_t bits = (static_cast<std::uint64_t>(y) << 32 | x) + 0x9e3779b97f4a7c15u * (channel + 1);
  bits = (bits ^ bits >> 33) * 0xff51afd7ed558ccdu;
  bits = (bits ^ bits >> 33) * 0xc4ceb9fe1a85ec53u;
  bits ^= bits >> 33;
  return static_cast<float>(bits >> 40) * 0x1p-24f - 0.5f;
}

// A SegmentRows holds one row for each channel of the parameters of a segment. A row has its own memory, or
// it is part of a map.
template <typename Float>
class SegmentRows {
 public:
  // Makes the missing rows of a parameter.
  void make(Parameter parameter, std::size_t count) {
    std::vector<FloatRow>& own = own_[static_cast<std::size_t>(parameter)];
    if (own.size() < count) own.resize(count);
    ParameterRows<Float>& rows = rows_[parameter];
    rows.count = count;
    for (std::size_t c = 0; c < count; ++c) rows.row[c] = own[c].data();
  }
  // Uses a row of a map, so the channel needs no separate row.
  void refer(Parameter parameter, std::size_t channel, Float* row) { rows_[parameter].row[channel] = row; }

  std::size_t count(Parameter parameter) const { return rows_[parameter].count; }
  Float* row(Parameter parameter, std::size_t channel) const { return rows_[parameter].row[channel]; }
  float* own_row(Parameter parameter, std::size_t channel) {
    return own_[static_cast<std::size_t>(parameter)][channel].data();
  }
  const MaterialRows<Float>& all() const { return rows_; }

 private:
  std::array<std::vector<FloatRow>, kParameterCount> own_;
  MaterialRows<Float> rows_;
};

// A Scratch holds the parameters of one segment as rows of floats.
struct Scratch {
  SegmentRows<const float> source;
  SegmentRows<float> target;
  std::array<std::uint8_t, kSegment> outside;  // 1 for each texel out of the domain; becomes the mask
  FloatRow first, other;                       // stored values of the first channel, and values of any row
  FloatRow coverage;
};

// Returns the values of a segment as an array of floats, or null if the map does not store them as such an
// array.
template <typename Byte>
auto float_row(const BasicChannelView<Byte>& view, const Segment& segment) {
  using Float = std::conditional_t<std::is_const_v<Byte>, const float, float>;
  Byte* const first = at(view, segment.x, segment.y);
  const bool is_array = view.type == PixelType::kFloat && view.texel_stride == sizeof(float) &&
                        reinterpret_cast<std::uintptr_t>(first) % alignof(float) == 0;
  return is_array ? reinterpret_cast<Float*>(first) : nullptr;
}

template <typename Byte>
struct PlacedView {
  Parameter parameter;
  std::size_t channel;
  BasicChannelView<Byte> view;
};

// A Texels is a group of three or four channels of linear floats that fill every texel. All of them are moved
// in one step.
template <typename Byte>
using Texels = std::vector<PlacedView<Byte>>;

template <typename Byte>
Byte* first_at(const Texels<Byte>& texels, const Segment& segment) {
  return at(texels.front().view, segment.x, segment.y);
}

// Returns the groups of channels that fill whole texels of floats. Parameters that share a map are in
// separate groups.
template <typename Byte>
std::vector<Texels<Byte>> filled_texels(const std::vector<PlacedView<Byte>>& channels) {
  std::vector<Texels<Byte>> all;
  for (const PlacedView<Byte>& first : channels) {
    const auto size = static_cast<std::size_t>(first.view.texel_stride) / sizeof(float);
    if (first.view.texel_stride != 3 * sizeof(float) && first.view.texel_stride != 4 * sizeof(float))
      continue;
    Texels<Byte> texels;
    for (std::size_t c = 0; c < size; ++c) {
      const PlacedView<Byte>* next = nullptr;
      for (const PlacedView<Byte>& other : channels)
        if (other.view.first == first.view.first + c * sizeof(float) &&
            other.view.texel_stride == first.view.texel_stride &&
            other.view.row_stride == first.view.row_stride &&
            (next == nullptr || other.parameter == first.parameter))
          next = &other;
      if (next != nullptr) texels.push_back(*next);
    }
    if (texels.size() == size) all.push_back(std::move(texels));
  }
  return all;
}

class Conversion {
 public:
  Conversion(const Converter& converter, const MapConversion& maps);
  MapStatistics convert_rows(std::size_t begin, std::size_t end) const;

 private:
  void require_fitting() const;
  const TargetParameter* wanted(Parameter parameter) const;
  bool is_made(Parameter parameter) const;
  float highest(Parameter parameter) const;
  RoughnessEncoding source_convention() const {
    return maps_.source_convention.value_or(converter_.info().source.roughness);
  }
  RoughnessEncoding target_convention() const {
    return maps_.target_convention.value_or(converter_.info().target.roughness);
  }
  void load_channel(const SourceParameter& parameter, std::size_t channel, const Segment& segment,
                    float* values) const;
  const float* row_of_map(const SourceParameter& parameter, std::size_t channel,
                          const Segment& segment) const;
  void find_texels();
  void load_texels(const Segment& segment, Scratch& scratch) const;
  void refer_to_targets(const Segment& segment, Scratch& scratch) const;
  bool is_source_of_another(Parameter target, std::size_t channel, const float* row, std::size_t count,
                            const Scratch& scratch) const;
  void require_grey(Parameter parameter, const Segment& segment, Scratch& scratch,
                    MapStatistics& statistics) const;
  void load_sources(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const;
  void count_invalid_texels(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const;
  [[noreturn]] void throw_invalid_texel(const Segment& segment, std::size_t texel, Scratch& scratch) const;
  void clamp_bad(std::size_t count, Scratch& scratch) const;
  void write_mask(const Segment& segment, Scratch& scratch) const;
  std::size_t store_parameter(const TargetParameter& parameter, std::size_t channel, const Segment& segment,
                              const float* values, FloatRow& stored) const;
  void store_targets(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const;
  ParameterStatistics value_statistics(std::size_t count, const float* values, Scratch& scratch) const;
  bool is_covered(const Scratch& scratch, std::size_t texel) const {
    return !maps_.coverage || scratch.coverage[texel] > 0.0f;
  }
  void convert_segment(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const;

  const Converter& converter_;
  const MapConversion& maps_;
  std::vector<Parameter> sources_;  // sources of the converter, plus the metal mask if there is one
  std::vector<Texels<const std::byte>> source_texels_;
  std::vector<Texels<std::byte>> target_texels_;
};

// Returns true if the channel belongs to a group that is moved in one step.
template <typename Byte>
bool is_in(const std::vector<Texels<Byte>>& all, Parameter parameter, std::size_t channel) {
  return std::ranges::any_of(all, [&](const Texels<Byte>& texels) {
    return std::ranges::any_of(texels, [&](const PlacedView<Byte>& placed) {
      return placed.parameter == parameter && placed.channel == channel;
    });
  });
}

std::size_t channel_count(const SourceParameter& parameter) {
  return parameter.channels.empty() ? parameter.constants.size() : parameter.channels.size();
}

Conversion::Conversion(const Converter& converter, const MapConversion& maps)
    : converter_(converter), maps_(maps), sources_(converter.sources()) {
  if (maps.sources.count(Parameter::kMetalMask) > 0) sources_.push_back(Parameter::kMetalMask);
  require_fitting();
  find_texels();
}

void Conversion::require_fitting() const {
  const auto fail = [](const std::string& what) { throw usage_error("convert_maps: " + what); };
  for (const Parameter parameter : sources_) {
    const auto found = maps_.sources.find(parameter);
    const std::size_t count = found == maps_.sources.end() ? 0 : channel_count(found->second);
    const std::string name = plain_name(parameter);
    if (!is_color(parameter) && (count == 0 || (found->second.channels.empty() && count > 1)))
      fail(name + " has no channel (give one channel or one constant)");
    if (is_color(parameter) && count != 1 && count != kMaxChannels)
      fail(name + " has " + std::to_string(count) + " channels (give 1 or 3)");
    const std::size_t factors = found->second.factors.size();
    if (factors > 1 && (!is_color(parameter) || factors != count))
      fail(name + " has more factors than channels (give one, or one per channel)");
  }
  const auto specular = maps_.sources.find(Parameter::kSpecular);
  const std::size_t channels = specular == maps_.sources.end() ? 3 : channel_count(specular->second);
  for (const auto& [parameter, target] : maps_.targets) {
    const std::size_t written = target.channels.size(),
                      given = converter_.target_channels(parameter, channels);
    if (written == 0) continue;
    if (!converter_.has_target(parameter)) fail("the converter does not make " + plain_name(parameter));
    if (is_color(parameter) && written != given && !(given == 1 && written == kMaxChannels))
      fail("target " + plain_name(parameter) + " has " + std::to_string(written) +
           " channels, but the converter makes " + std::to_string(given));
  }
}

const TargetParameter* Conversion::wanted(Parameter parameter) const {
  const auto found = maps_.targets.find(parameter);
  return found == maps_.targets.end() || found->second.channels.empty() ? nullptr : &found->second;
}

// Returns false for a measure if no map and no statistics need it.
bool Conversion::is_made(Parameter parameter) const {
  const bool counts = maps_.metallic_statistics && parameter != Parameter::kMetallicUncertainty;
  return !is_measure(parameter) || counts || wanted(parameter) != nullptr;
}

// Returns the largest valid value of a parameter. Roughness, specular without a workflow, and inputs of
// surfaces such as an index of refraction have no limit.
float Conversion::highest(Parameter parameter) const {
  const bool is_fraction = !converter_.converts_brdf_only() && parameter != Parameter::kRoughness;
  return is_fraction && !is_input(parameter) ? 1.0f : kLargest;
}

// Returns the row of the map if it holds the values as they are needed. Returns null if they must be loaded
// into another row.
const float* Conversion::row_of_map(const SourceParameter& parameter, std::size_t channel,
                                    const Segment& segment) const {
  const bool is_plain = !parameter.channels.empty() && parameter.transfer == Transfer::kLinear &&
                        parameter.factor(channel) == 1.0f;
  return is_plain ? float_row(parameter.channels[channel], segment) : nullptr;
}

void Conversion::load_channel(const SourceParameter& parameter, std::size_t channel, const Segment& segment,
                              float* values) const {
  if (parameter.channels.empty()) {
    std::fill_n(values, segment.count, parameter.constants[channel]);
  } else {
    const ConstChannelView& view = parameter.channels[channel];
    load_linear(parameter.transfer, view.type, at(view, segment.x, segment.y),
                static_cast<std::size_t>(view.texel_stride), segment.count, values);
  }
  const float factor = parameter.factor(channel);
  if (factor == 1.0f) return;
  for (std::size_t i = 0; i < segment.count; ++i) values[i] *= factor;
}

void Conversion::find_texels() {
  std::vector<PlacedView<const std::byte>> sources;
  for (const Parameter parameter : sources_) {
    const SourceParameter& source = maps_.sources.at(parameter);
    const std::size_t count = std::min(source.channels.size(), is_color(parameter) ? kMaxChannels : 1);
    for (std::size_t c = 0; c < count; ++c)
      if (source.channels[c].type == PixelType::kFloat && source.transfer == Transfer::kLinear &&
          source.factor(c) == 1.0f)
        sources.push_back({parameter, c, source.channels[c]});
  }
  std::vector<PlacedView<std::byte>> targets;
  for (const auto& [parameter, target] : maps_.targets)
    for (std::size_t c = 0; c < target.channels.size(); ++c)
      if (target.channels[c].type == PixelType::kFloat && target.transfer == Transfer::kLinear)
        targets.push_back({parameter, c, target.channels[c]});
  source_texels_ = filled_texels(sources);
  target_texels_ = filled_texels(targets);
}

void Conversion::load_texels(const Segment& segment, Scratch& scratch) const {
  for (const Texels<const std::byte>& texels : source_texels_) {
    std::vector<float*> rows;
    for (const auto& placed : texels)
      rows.push_back(scratch.source.own_row(placed.parameter, placed.channel));
    load_interleaved(first_at(texels, segment), segment.count, rows);
  }
}

// Lets results go directly into rows of a map. The map must store floats unchanged. The row must not be the
// row of a source that is needed later.
void Conversion::refer_to_targets(const Segment& segment, Scratch& scratch) const {
  for (const auto& [parameter, target] : maps_.targets) {
    const bool changes =
        parameter == Parameter::kRoughness &&
        (target_convention() != converter_.info().target.roughness || maps_.target_roughness_factor != 1.0f);
    if (changes || target.transfer != Transfer::kLinear) continue;
    const std::size_t count = std::min(scratch.target.count(parameter), target.channels.size());
    for (std::size_t c = 0; c < count; ++c) {
      float* const row = float_row(target.channels[c], segment);
      if (row != nullptr && !is_source_of_another(parameter, c, row, segment.count, scratch))
        scratch.target.refer(parameter, c, row);
    }
  }
}

// Returns true if `row` shares memory with the row of a source other than this channel of `target`.
bool Conversion::is_source_of_another(Parameter target, std::size_t channel, const float* row,
                                      std::size_t count, const Scratch& scratch) const {
  const std::less<const float*> before;
  for (const Parameter parameter : sources_)
    for (std::size_t c = 0; c < scratch.source.count(parameter); ++c) {
      const float* const source = scratch.source.row(parameter, c);
      const bool is_same = source == row && parameter == target && c == channel;
      if (!is_same && before(source, row + count) && before(row, source + count)) return true;
    }
  return false;
}

void Conversion::require_grey(Parameter parameter, const Segment& segment, Scratch& scratch,
                              MapStatistics& statistics) const {
  const SourceParameter& source = maps_.sources.at(parameter);
  const auto& channels = source.channels;
  if (channels.size() < 2) return;
  FloatRow& first = scratch.first;
  load(channels[0], segment, first.data());
  for (std::size_t c = 1; c < channels.size(); ++c) {
    load(channels[c], segment, scratch.other.data());
    if (std::memcmp(scratch.other.data(), first.data(), segment.count * sizeof(float)) == 0) continue;
    float& tint = statistics.tints[parameter];
    const auto differs = [&](std::size_t i) {
      if (std::memcmp(&scratch.other[i], &first[i], sizeof(float)) == 0) return false;
      const float difference = std::fabs(scratch.other[i] - first[i]);
      if (!(difference <= source.grey_tolerance)) return true;
      tint = std::max(tint, difference);
      return false;
    };
    std::size_t i = 0;
    while (i < segment.count && !differs(i)) ++i;
    if (i == segment.count) continue;
    const auto name = [&](std::size_t channel) {
      return channel < source.channel_names.size() ? source.channel_names[channel]
                                                   : "channel " + std::to_string(channel);
    };
    throw input_error(source.name + ": texel (" + std::to_string(segment.x + i) + ", " +
                      std::to_string(maps_.first_row + segment.y) + ") is not grey: " + name(0) + " is " +
                      number_text(rounded(static_cast<double>(first[i]), 4)) + " and " + name(c) + " is " +
                      number_text(rounded(static_cast<double>(scratch.other[i]), 4)) +
                      " (choose one channel" + (source.one_channel.empty() ? "" : ": " + source.one_channel) +
                      ")");
  }
}

ParameterStatistics Conversion::value_statistics(std::size_t count, const float* values,
                                                 Scratch& scratch) const {
  if (!maps_.coverage) return statistics_of({values, count});
  std::size_t covered = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (is_covered(scratch, i)) scratch.other[covered++] = values[i];
  return statistics_of({scratch.other.data(), covered});
}

void Conversion::load_sources(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const {
  for (const Parameter parameter : sources_) {
    if (!is_color(parameter)) require_grey(parameter, segment, scratch, statistics);
    scratch.source.make(parameter, is_color(parameter) ? channel_count(maps_.sources.at(parameter)) : 1);
  }
  load_texels(segment, scratch);
  for (const Parameter parameter : sources_) {
    const SourceParameter& source = maps_.sources.at(parameter);
    const bool changes =
        maps_.bad_texels == BadTexels::kClamp ||
        (parameter == Parameter::kRoughness && source_convention() != converter_.info().source.roughness);
    for (std::size_t c = 0; c < scratch.source.count(parameter); ++c) {
      const float* const stored = changes ? nullptr : row_of_map(source, c, segment);
      if (stored != nullptr)
        scratch.source.refer(parameter, c, stored);
      else if (!is_in(source_texels_, parameter, c))
        load_channel(source, c, segment, scratch.source.own_row(parameter, c));
      if (maps_.value_statistics)
        statistics.sources[parameter] +=
            value_statistics(segment.count, scratch.source.row(parameter, c), scratch);
    }
  }
}

void Conversion::throw_invalid_texel(const Segment& segment, std::size_t texel, Scratch& scratch) const {
  for (const Parameter parameter : sources_)
    for (std::size_t c = 0; c < scratch.source.count(parameter); ++c) {
      const float value = scratch.source.row(parameter, c)[texel];
      if (is_ordinary(value, kLargest)) continue;
      const SourceParameter& source = maps_.sources.at(parameter);
      const std::string of = c < source.channel_names.size() ? source.channel_names[c] + " of " : "";
      throw input_error(source.name + ": " + of + "texel (" + std::to_string(segment.x + texel) + ", " +
                        std::to_string(maps_.first_row + segment.y) + ") is " +
                        number_text(static_cast<double>(value)) + " (--nan clamp replaces such values)");
    }
  throw usage_error("convert_maps: no invalid texel found");
}

// Counts invalid texels. With BadTexels::kFail, throws for the first invalid texel.
void Conversion::count_invalid_texels(const Segment& segment, Scratch& scratch,
                                      MapStatistics& statistics) const {
  struct CheckedRow {
    const float* values;
    float highest;
  };
  std::vector<CheckedRow> rows;
  for (const Parameter parameter : sources_)
    for (std::size_t c = 0; c < scratch.source.count(parameter); ++c)
      rows.push_back({scratch.source.row(parameter, c), highest(parameter)});
  constexpr std::size_t kRun = 128;  // short, because memory delivers several rows at once faster than one
  int odd = 0;                       // as wide as a float, so that compilers vectorise the loop
  for (std::size_t begin = 0; begin < segment.count; begin += kRun) {
    const std::size_t end = std::min(segment.count, begin + kRun);
    for (const CheckedRow& row : rows)
      for (std::size_t i = begin; i < end; ++i) odd |= !is_ordinary(row.values[i], row.highest);
  }
  if (odd == 0) return;  // the usual case, as fast as memory can be read
  for (std::size_t i = 0; i < segment.count; ++i) {
    bool nan = false, infinite = false, negative = false, above = false;
    for (const CheckedRow& row : rows) {
      const float value = row.values[i];
      nan = nan || std::isnan(value);
      infinite = infinite || std::isinf(value);
      negative = negative || value < 0.0f;
      above = above || (value > row.highest && !std::isinf(value));
    }
    if (!is_covered(scratch, i)) continue;
    statistics.above_one_count += above;
    if (!(nan || infinite || negative)) continue;
    if (maps_.bad_texels == BadTexels::kFail) throw_invalid_texel(segment, i, scratch);
    if (!statistics.first_bad) statistics.first_bad = {segment.x + i, maps_.first_row + segment.y};
    statistics.nan_count += nan;
    statistics.infinite_count += infinite;
    statistics.negative_count += negative;
  }
}

void Conversion::clamp_bad(std::size_t count, Scratch& scratch) const {
  // Clamps values. NaN becomes the lowest value.
  const auto clamp = [count](float* row, const Range& range) {
    const float low = static_cast<float>(range.min), high = static_cast<float>(range.max);
    for (std::size_t i = 0; i < count; ++i) row[i] = row[i] >= low ? std::min(row[i], high) : low;
  };
  for (const Parameter parameter : sources_) {
    Range range{0.0, 1.0};
    if (parameter == Parameter::kRoughness) range = converter_.info().roughness;
    if (parameter == Parameter::kSpecular) range.max = converter_.info().specular.max;
    if (is_input(parameter)) range.max = static_cast<double>(kLargest);
    for (std::size_t c = 0; c < scratch.source.count(parameter); ++c)
      clamp(scratch.source.own_row(parameter, c), range);
  }
}

void Conversion::write_mask(const Segment& segment, Scratch& scratch) const {
  for (std::size_t i = 0; i < segment.count; ++i) scratch.other[i] = scratch.outside[i] != 0 ? 1.0f : 0.0f;
  store(*maps_.mask, segment, scratch.other.data());
}

std::size_t Conversion::store_parameter(const TargetParameter& parameter, std::size_t channel,
                                        const Segment& segment, const float* values, FloatRow& stored) const {
  const ChannelView& view = parameter.channels[channel];
  if (!maps_.dither || byte_count(view.type) != 1)
    return store_linear(parameter.transfer, view.type, values, segment.count, at(view, segment.x, segment.y),
                        static_cast<std::size_t>(view.texel_stride));
  std::copy_n(values, segment.count, stored.data());
  from_linear(parameter.transfer, {stored.data(), segment.count});
  for (std::size_t i = 0; i < segment.count; ++i)
    stored[i] = std::clamp(stored[i], 0.0f, 1.0f) +
                dither_noise(segment.x + i, maps_.first_row + segment.y, channel) / 255.0f;
  return store(view, segment, stored.data());
}

void Conversion::store_targets(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const {
  for (const Parameter parameter : converter_.targets()) {
    const std::size_t made = scratch.target.count(parameter);
    if (maps_.value_statistics && parameter != Parameter::kMetallicIssues)
      for (std::size_t c = 0; c < made; ++c)
        statistics.targets[parameter] +=
            value_statistics(segment.count, scratch.target.row(parameter, c), scratch);
    const TargetParameter* target = wanted(parameter);
    if (target == nullptr) continue;
    std::size_t clipped = 0;
    for (std::size_t c = 0; c < target->channels.size(); ++c) {
      if (is_in(target_texels_, parameter, c)) continue;
      const float* const row = scratch.target.row(parameter, std::min(c, made - 1));
      const bool is_there = row == float_row(target->channels[c], segment);
      const std::size_t own = is_there ? 0 : store_parameter(*target, c, segment, row, scratch.other);
      clipped = is_color(parameter) ? clipped + own : own;  // equal channels of a parameter count once
    }
    statistics.clipped_count += clipped;
  }
  for (const Texels<std::byte>& texels : target_texels_) {
    std::vector<const float*> rows;
    for (const auto& [parameter, channel, view] : texels)
      rows.push_back(scratch.target.row(parameter, std::min(channel, scratch.target.count(parameter) - 1)));
    store_interleaved(rows, segment.count, first_at(texels, segment));
  }
}

void Conversion::convert_segment(const Segment& segment, Scratch& scratch, MapStatistics& statistics) const {
  const ConverterInfo& info = converter_.info();
  const std::size_t count = segment.count;
  if (maps_.coverage) {
    load(*maps_.coverage, segment, scratch.coverage.data());
    for (std::size_t i = 0; i < count; ++i) statistics.masked_count += !is_covered(scratch, i);
  }
  load_sources(segment, scratch, statistics);
  statistics.texel_count += count;
  count_invalid_texels(segment, scratch, statistics);
  change_convention(source_convention(), info.source.roughness,
                    {scratch.source.own_row(Parameter::kRoughness, 0), count});
  if (maps_.bad_texels == BadTexels::kClamp) clamp_bad(count, scratch);

  const std::size_t specular = scratch.source.count(Parameter::kSpecular);
  for (const Parameter parameter : converter_.targets())
    if (is_made(parameter)) scratch.target.make(parameter, converter_.target_channels(parameter, specular));
  refer_to_targets(segment, scratch);
  statistics.out_of_domain_count += converter_.convert(count, scratch.source.all(), scratch.target.all(),
                                                       maps_.mask ? scratch.outside.data() : nullptr);
  if (maps_.mask) write_mask(segment, scratch);
  if (converter_.has_diagnostics() && maps_.metallic_statistics)
    statistics.metallic += statistics_of({segment.x, maps_.first_row + segment.y},
                                         {scratch.target.row(Parameter::kResidual, 0), count},
                                         scratch.target.row(Parameter::kMetallicIssues, 0),
                                         maps_.coverage ? scratch.coverage.data() : nullptr);
  change_convention(info.target.roughness, target_convention(),
                    {scratch.target.row(Parameter::kRoughness, 0), count});
  if (maps_.target_roughness_factor != 1.0f)
    for (float& value : std::span(scratch.target.row(Parameter::kRoughness, 0), count))
      value /= maps_.target_roughness_factor;
  store_targets(segment, scratch, statistics);
}

MapStatistics Conversion::convert_rows(std::size_t begin, std::size_t end) const {
  MapStatistics statistics;
  const auto scratch = std::make_unique<Scratch>();
  for (std::size_t y = begin; y < end; ++y)
    for (std::size_t x = 0; x < maps_.width; x += kSegment)
      convert_segment({x, y, std::min(kSegment, maps_.width - x)}, *scratch, statistics);
  return statistics;
}

}  // namespace

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
