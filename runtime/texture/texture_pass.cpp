#include "texture/texture_pass.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "remap/error.hpp"

namespace remap {
namespace {

// EXR compresses 1, 16 or 32 rows together (256 for dwab). A band must not end inside such a group.
constexpr std::size_t kChunkRows = 32;

// No band of a valid image is larger than this, but a band of a damaged file may be.
constexpr std::size_t kLargestBand = std::size_t{2} << 30;
// Scans, filters and JPEG leave differences of up to 18 of 255 between channels of a grey map.
constexpr float kGreyTolerance = 20.0f / 255.0f;

// A Band holds the rows [first_row, first_row + row_count) of every map, as stored.
struct Band {
  int first_row = 0;
  int row_count = 0;
  std::vector<std::vector<std::byte>> maps;
};

// Returns the channel of the set that this channel copies, or null.
const ChannelPlace* copied(const TargetChannel& channel) { return std::get_if<ChannelPlace>(&channel); }

// A Target is a part of a file, with its writer.
struct Target {
  NewImage* writer = nullptr;
  const TargetPart* part = nullptr;
};

bool converts(const std::vector<Target>& targets) {
  return std::any_of(targets.begin(), targets.end(), [](const Target& target) {
    return std::any_of(target.part->channels.begin(), target.part->channels.end(), is_converted);
  });
}

std::vector<std::size_t> maps_needed(const TextureSet& set, const std::vector<Target>& targets) {
  std::set<std::size_t> maps;
  if (converts(targets)) maps = set.maps_of_material();
  for (const Target& target : targets)
    for (const TargetChannel& channel : target.part->channels)
      if (const ChannelPlace* from = copied(channel)) maps.insert(from->map);
  return {maps.begin(), maps.end()};
}

// A Round is the parts that are written at the same time. All files with one part are one round. Each part of
// a file with several parts is a separate round, because parts must be written in order.
struct Round {
  Round(const TextureSet& set, std::vector<Target> written, int number)
      : targets(std::move(written)),
        part(number),
        is_converting(converts(targets)),
        maps(maps_needed(set, targets)) {}

  std::vector<Target> targets;
  int part;
  bool is_converting;             // false if all channels are copies
  std::vector<std::size_t> maps;  // maps to read
};

std::vector<Round> rounds_of(const TextureSet& set, std::vector<TargetMap>& targets) {
  std::vector<Round> rounds;
  std::vector<Target> single;
  for (TargetMap& target : targets)
    if (target.parts.size() == 1) single.push_back({target.writer.get(), &target.parts.front()});
  if (!single.empty()) rounds.emplace_back(set, single, 0);
  for (TargetMap& target : targets)
    for (std::size_t part = 0; target.parts.size() > 1 && part < target.parts.size(); ++part)
      rounds.emplace_back(set, std::vector<Target>{{target.writer.get(), &target.parts[part]}},
                          static_cast<int>(part));
  return rounds;
}

// A Pass converts one mip level of a round.
class Pass {
 public:
  Pass(TextureSet& set, const Round& round, const Converter& converter, const PassOptions& options);
  // Progress is called after each band with the number of finished rows.
  using Progress = std::function<void(int)>;
  MapStatistics run(const Progress& progress);  // reads the next band while one is converted

 private:
  // Returns the index of the input band that can be overwritten in place, because all copied channels of
  // `target` come from the same channels of this band. Returns -1 if no band can.
  int map_in_place(const Target& target) const;
  int rows_of_a_band() const;
  void stop_if_cancelled() const;
  void read(Band& band, int first_row);
  MapConversion sources_of(const Band& band) const;
  MapStatistics convert(Band& band);
  void write(Band& band);
  std::byte* texels_of(std::size_t target, Band& band);
  ConstChannelView view_of(const ChannelPlace& place, const Band& band) const {
    return channel_view(band.maps[place.map].data(), set_.maps[place.map].layout(), place.channel);
  }
  SourceParameter source_of(Parameter name, const SetParameter& parameter, const Band& band) const;
  void add_target(const Target& target, const ConvertedChannel& channel, const ChannelView& view,
                  MapConversion& maps) const;

  TextureSet& set_;
  const Round& round_;
  int width_;
  int height_;
  const Converter& converter_;
  const PassOptions& options_;
  std::launch launch_;
  std::vector<int> in_place_;  // for each target, the map whose band it overwrites, or -1
  int band_rows_;
  std::vector<std::vector<std::byte>> converted_;  // bands of targets that overwrite no input band
};

Pass::Pass(TextureSet& set, const Round& round, const Converter& converter, const PassOptions& options)
    : set_(set),
      round_(round),
      width_(set.maps[round.maps.front()].layout().width),
      height_(set.maps[round.maps.front()].layout().height),
      converter_(converter),
      options_(options),
      launch_(options.thread_count > 1 ? std::launch::async : std::launch::deferred) {
  for (const Target& target : round_.targets) in_place_.push_back(map_in_place(target));
  band_rows_ = rows_of_a_band();
  for (std::size_t t = 0; t < round_.targets.size(); ++t)
    converted_.emplace_back(in_place_[t] >= 0 ? 0
                                              : static_cast<std::size_t>(band_rows_) *
                                                    round_.targets[t].writer->layout().row_bytes());
}

int Pass::map_in_place(const Target& target) const {
  const auto& channels = target.part->channels;
  const auto is_constant = [](const TargetChannel& c) { return std::holds_alternative<float>(c); };
  if (std::any_of(channels.begin(), channels.end(), is_constant)) return -1;
  const auto follows = [&](std::size_t map) {
    if (!same_pixel_types(set_.maps[map].layout(), target.writer->layout())) return false;
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (const ChannelPlace* from = copied(channels[c]); from != nullptr && *from != ChannelPlace{map, c})
        return false;
    return true;
  };
  // A map must not be overwritten if another target copies from it.
  const auto is_shared = [&](std::size_t map) {
    const auto is_from_map = [&](const TargetChannel& c) {
      const ChannelPlace* from = copied(c);
      return from != nullptr && from->map == map;
    };
    return std::any_of(round_.targets.begin(), round_.targets.end(), [&](const Target& other) {
      return other.part != target.part &&
             std::any_of(other.part->channels.begin(), other.part->channels.end(), is_from_map);
    });
  };
  const auto is_taken = [&](std::size_t map) {
    return std::find(in_place_.begin(), in_place_.end(), static_cast<int>(map)) != in_place_.end();
  };
  for (const std::size_t map : round_.maps)
    if (follows(map) && !is_shared(map) && !is_taken(map)) return static_cast<int>(map);
  return -1;
}

int Pass::rows_of_a_band() const {
  std::size_t row_bytes = 0, unit = kChunkRows;
  const auto add = [&](const ImageLayout& layout) {
    row_bytes += layout.row_bytes();
    if (layout.tile_height > 0) unit = std::lcm(unit, static_cast<std::size_t>(layout.tile_height));
  };
  for (const std::size_t map : round_.maps) add(set_.maps[map].layout());
  const std::size_t source_bytes = std::exchange(row_bytes, 0);
  for (const Target& target : round_.targets) add(target.writer->layout());
  const std::size_t unit_bytes = unit * std::max(source_bytes, row_bytes);
  if (unit_bytes > kLargestBand)
    throw Error(ErrorKind::kInput, set_.maps[round_.maps.front()].path().string() + ": " +
                                       std::to_string(unit) + " rows of " + std::to_string(width_) +
                                       " texels take " + std::to_string(unit_bytes >> 20) +
                                       " MB in this set (at most " + std::to_string(kLargestBand >> 20) +
                                       " MB; use smaller tiles)");
  const std::size_t units = options_.band_bytes / unit_bytes;
  const std::size_t rows = unit * std::max<std::size_t>(units, 1);
  return static_cast<int>(std::min(rows, static_cast<std::size_t>(height_)));
}

void Pass::stop_if_cancelled() const {
  if (options_.cancelled != nullptr && options_.cancelled->load(std::memory_order_relaxed))
    throw Error(ErrorKind::kInterrupted, "interrupted: no file was written");
}

MapStatistics Pass::run(const Progress& progress) {
  MapStatistics statistics;
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
    progress(end);
  }
  stop_if_cancelled();
  return statistics;
}

void Pass::read(Band& band, int first_row) {
  band.first_row = first_row;
  band.row_count = std::min(band_rows_, height_ - first_row);
  if (band.row_count <= 0) return;
  band.maps.resize(set_.maps.size());
  std::vector<std::future<void>> reading;
  for (const std::size_t map : round_.maps)
    reading.push_back(std::async(map != round_.maps.back() ? launch_ : std::launch::deferred, [&, map] {
      ImageReader& reader = set_.maps[map];
      band.maps[map].resize(static_cast<std::size_t>(band_rows_) * reader.layout().row_bytes());
      reader.read_rows(first_row, band.row_count, band.maps[map].data());
    }));
  for (auto part = reading.rbegin(); part != reading.rend(); ++part) part->get();
}

void Pass::write(Band& band) {
  std::vector<std::future<void>> writing;
  for (std::size_t t = 0; t < round_.targets.size(); ++t) {
    const std::byte* texels = texels_of(t, band);
    writing.push_back(std::async(
        t + 1 < round_.targets.size() ? launch_ : std::launch::deferred,
        [&, t, texels] { round_.targets[t].writer->write_rows(band.first_row, band.row_count, texels); }));
  }
  for (auto part = writing.rbegin(); part != writing.rend(); ++part) part->get();
}

std::byte* Pass::texels_of(std::size_t target, Band& band) {
  return in_place_[target] >= 0 ? band.maps[static_cast<std::size_t>(in_place_[target])].data()
                                : converted_[target].data();
}

SourceParameter Pass::source_of(Parameter name, const SetParameter& parameter, const Band& band) const {
  SourceParameter source;
  static_cast<ParameterValues&>(source) = parameter;
  source.name = parameter_option(name);
  for (const ChannelPlace& place : parameter.channels) {
    const ImageReader& reader = set_.maps[place.map];
    source.channels.push_back(view_of(place, band));
    source.channel_names.push_back(reader.layout().channels[place.channel].name);
    source.name = reader.path().string();
    source.grey_tolerance = kGreyTolerance;
  }
  source.one_channel = parameter.one_channel;
  return source;
}

void Pass::add_target(const Target& target, const ConvertedChannel& channel, const ChannelView& view,
                      MapConversion& maps) const {
  TargetParameter& parameter = maps.targets[channel.parameter];
  // If all result channels of the parameter have the same value, their order does not matter, and this one is
  // appended. Otherwise red, green and blue must be at their index.
  const auto source = set_.parameters.find(channel.parameter);
  const bool is_copy = !is_color(channel.parameter) ||
                       (source != set_.parameters.end() && source->second.channel_count() == 1 &&
                        converter_.target_channels(channel.parameter, 1) == 1);
  const std::size_t place = is_copy ? parameter.channels.size() : channel.index;
  parameter.channels.resize(std::max(parameter.channels.size(), place + 1));
  parameter.channels[place] = view;
  if (is_color(channel.parameter)) parameter.transfer = target.part->changes.colors->of(view.type);
}

MapConversion Pass::sources_of(const Band& band) const {
  MapConversion maps;
  maps.width = static_cast<std::size_t>(width_);
  maps.height = static_cast<std::size_t>(band.row_count);
  maps.first_row = static_cast<std::size_t>(band.first_row);
  if (round_.is_converting) {
    for (const auto& [parameter, values] : set_.parameters)
      maps.sources[parameter] = source_of(parameter, values, band);
    if (set_.coverage) maps.coverage = view_of(*set_.coverage, band);
  }
  maps.source_convention = set_.convention;
  maps.bad_texels = options_.bad_texels;
  return maps;
}

MapStatistics Pass::convert(Band& band) {
  MapConversion maps = sources_of(band);
  static_cast<MapTreatment&>(maps) = options_;
  std::size_t clipped = 0;
  for (std::size_t t = 0; t < round_.targets.size(); ++t) {
    const ImageLayout& layout = round_.targets[t].writer->layout();
    std::byte* texels = texels_of(t, band);
    for (std::size_t c = 0; c < layout.channels.size(); ++c) {
      const TargetChannel& channel = round_.targets[t].part->channels[c];
      const ChannelView view = channel_view(texels, layout, c);
      if (const auto* converted = std::get_if<ConvertedChannel>(&channel))
        add_target(round_.targets[t], *converted, view, maps);
      else if (std::holds_alternative<MaskChannel>(channel))
        maps.mask = view;
      else if (const auto* value = std::get_if<float>(&channel))
        clipped += copy_channel({reinterpret_cast<const std::byte*>(value), PixelType::kFloat, 0, 0}, view,
                                maps.width, maps.height);
      else if (const ChannelPlace* from = copied(channel); in_place_[t] < 0)
        clipped += copy_channel(view_of(*from, band), view, maps.width, maps.height);
    }
  }
  MapStatistics statistics;
  if (round_.is_converting) statistics = convert_maps(converter_, maps, options_.thread_count);
  statistics.clipped_count += clipped;
  return statistics;
}

// Returns the number of mip levels in the files of a round. Throws if one of its maps has a different number
// of levels.
int level_count(const TextureSet& set, const Round& round) {
  int levels = 0;
  for (const Target& target : round.targets)
    levels = std::max(levels, target.writer->level_count(round.part));
  for (const std::size_t map : round.maps) {
    const ImageReader& reader = set.maps[map];
    if (levels > 1 && reader.level_count() != levels)
      throw Error(ErrorKind::kInput, reader.path().string() + ": number of mip levels is " +
                                         std::to_string(reader.level_count()) +
                                         ", but other maps of the set have " + std::to_string(levels));
  }
  return levels;
}

}  // namespace

MapStatistics run_texture_pass(TextureSet& set, std::vector<TargetMap>& targets, const Converter& converter,
                               const PassOptions& options) {
  const std::vector<Round> rounds = rounds_of(set, targets);
  MapStatistics statistics;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const Round& round = rounds[i];
    const int levels = level_count(set, round);
    for (int level = 0; level < levels; ++level) {
      for (const std::size_t map : round.maps) set.maps[map].select_level(level);
      for (const Target& target : round.targets) target.writer->select(round.part, level);
      const double rows = set.maps[round.maps.front()].layout().height;
      // Each level takes a quarter of the time of the previous level, and the round ends with the last level.
      const double left = std::ldexp(1.0, -2 * level), own_share = level + 1 < levels ? 0.75 : 1.0;
      const MapStatistics plane = Pass(set, round, converter, options).run([&](int done) {
        const double of_round = 1.0 - left * (1.0 - own_share * done / rows);
        if (options.progress)
          options.progress((static_cast<double>(i) + of_round) / static_cast<double>(rounds.size()));
      });
      // Count the texels of the full picture once, even if several files hold them.
      if (level == 0 && statistics.texel_count == 0) statistics = plane;
    }
  }
  for (TargetMap& target : targets) target.writer->finish();
  if (options.commit)
    options.commit(targets);
  else
    for (TargetMap& target : targets) target.writer->commit(Flush::kYes);
  return statistics;
}

}  // namespace remap
