#include "texture/texture_set.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> channel_names(const ImageLayout& layout) {
  std::vector<std::string> names;
  for (const Channel& channel : layout.channels) names.push_back(plain(channel.name));
  return names;
}

// If an image that cannot be read in bands is at least this large, remarks() mentions it.
constexpr std::size_t kWholeImageWorthSaying = std::size_t{64} << 20;

// Returns the numbers of a list, or nothing if one of its items is not a number.
std::optional<std::vector<float>> numbers(std::string_view text) {
  std::vector<float> values;
  for (const std::string& part : parts_between(text, ',')) {
    const auto number = parse_number(part);
    if (!number) return std::nullopt;
    values.push_back(static_cast<float>(*number));
  }
  return values;
}

void require_usable(std::string_view option, std::string_view text, const std::vector<float>& values,
                    const std::string& expected) {
  const bool usable =
      std::ranges::all_of(values, [](float value) { return std::isfinite(value) && value >= 0.0f; });
  if (usable && (values.size() == 1 || values.size() == 3)) return;
  throw usage_error(std::string(option) + ": invalid value '" + std::string(text) + "' (give " + expected +
                    ")");
}

bool same_word(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) {
    return std::toupper(static_cast<unsigned char>(x)) == std::toupper(static_cast<unsigned char>(y));
  });
}

std::optional<std::size_t> find_channel(const ImageLayout& layout, std::string_view name) {
  const auto found = std::ranges::find_if(
      layout.channels, [&](const Channel& channel) { return same_word(channel.name, name); });
  if (found == layout.channels.end()) return std::nullopt;
  return static_cast<std::size_t>(found - layout.channels.begin());
}

// Finds a channel by its name, or by the name of its part and its own name: `base.R`.
std::optional<std::size_t> find_channel(const ImageReader& reader, std::string_view name) {
  const std::string part = reader.part_name() + ".";
  if (const auto found = find_channel(reader.layout(), name)) return found;
  if (part.size() == 1 || name.size() <= part.size() || !same_word(name.substr(0, part.size()), part))
    return std::nullopt;
  return find_channel(reader.layout(), name.substr(part.size()));
}

// Returns R, G and B, or Y, or the only channel except alpha. Returns nothing if the file does not have these
// channels.
std::vector<std::size_t> color_channels(const ImageLayout& layout) {
  const auto red = find_channel(layout, "R"), green = find_channel(layout, "G"),
             blue = find_channel(layout, "B");
  if (red && green && blue) return {*red, *green, *blue};
  if (const auto grey = find_channel(layout, "Y")) return {*grey};
  const bool has_alpha = layout.alpha_channel >= 0;
  if (layout.channels.size() != (has_alpha ? 2u : 1u)) return {};
  return {layout.alpha_channel == 0 && has_alpha ? std::size_t{1} : std::size_t{0}};
}

// Returns words that occur in the names of a parameter's layers.
const std::vector<std::string_view>& layer_words(Parameter parameter) {
  static const std::map<Parameter, std::vector<std::string_view>> kWords = {
      {Parameter::kRoughness, {"rough", "gloss", "smooth"}},
      {Parameter::kSpecular, {"spec", "refl"}},
      {Parameter::kDiffuse, {"diff", "albedo"}},
      {Parameter::kBaseColor, {"base", "albedo", "col"}},
      {Parameter::kMetallic, {"metal"}}};
  static const std::vector<std::string_view> kNone;
  const auto found = kWords.find(parameter);
  return found == kWords.end() ? kNone : found->second;
}

// Returns the color channels of a layer, such as `ViewLayer.Combined.R` without the last word. If there are
// several layers, the name must have a word of the parameter. Returns nothing unless one layer fits.
std::vector<std::size_t> layer_channels(const ImageLayout& layout, std::optional<Parameter> parameter) {
  std::map<std::string, ImageLayout> layers;
  std::map<std::string, std::vector<std::size_t>> places;
  for (std::size_t c = 0; c < layout.channels.size(); ++c) {
    const std::string& name = layout.channels[c].name;
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) continue;
    Channel own = layout.channels[c];
    own.name = name.substr(dot + 1);
    ImageLayout& layer = layers[name.substr(0, dot)];
    if (same_word(own.name, "A")) layer.alpha_channel = static_cast<int>(layer.channels.size());
    layer.channels.push_back(own);
    places[name.substr(0, dot)].push_back(c);
  }
  std::vector<std::vector<std::size_t>> found;
  for (const auto& [name, layer] : layers) {
    std::string small = name;
    for (char& letter : small) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    const bool is_named =
        parameter && std::ranges::any_of(layer_words(*parameter), [&](std::string_view word) {
          return small.find(word) != std::string::npos;
        });
    if (layers.size() > 1 && !is_named) continue;
    std::vector<std::size_t> channels = color_channels(layer);
    if (channels.empty()) continue;
    for (std::size_t& channel : channels) channel = places[name][channel];
    found.push_back(std::move(channels));
  }
  return found.size() == 1 ? found.front() : std::vector<std::size_t>{};
}

// Returns the named channels of a part, or nothing if one of them is missing.
std::vector<std::size_t> named_channels(const ImageReader& reader, const std::vector<std::string>& asked) {
  std::vector<std::size_t> channels;
  for (const std::string& name : asked) {
    const std::optional<std::size_t> found = find_channel(reader, name);
    if (!found) return {};
    channels.push_back(*found);
  }
  return channels;
}

std::string window_text(const ImageLayout& layout) {
  std::string text = std::to_string(layout.width) + "x" + std::to_string(layout.height);
  if (layout.x != 0 || layout.y != 0)
    text += " at (" + std::to_string(layout.x) + ", " + std::to_string(layout.y) + ")";
  return text;
}

void require_same_texels(const ImageReader& first, const ImageReader& other) {
  const ImageLayout &a = first.layout(), &b = other.layout();
  if (a.width == b.width && a.height == b.height && a.x == b.x && a.y == b.y) return;
  throw input_error(other.path().string() + ": size " + window_text(b) + " does not match " +
                    first.path().string() + " (" + window_text(a) +
                    ") (use --resample, or scale one of the images)");
}

// Returns the parameters that are maps.
std::vector<const SetParameter*> mapped_parameters(const TextureSet& set) {
  std::vector<const SetParameter*> mapped;
  const auto add = [&](const SetParameter& parameter) {
    if (parameter.is_map()) mapped.push_back(&parameter);
  };
  for (const auto& [parameter, values] : set.parameters) add(values);
  for (const Carried<SetParameter>& carried : set.carried) add(carried.parameter);
  return mapped;
}

ImageReader& map_of(TextureSet& set, const SetParameter& parameter) {
  return set.maps[parameter.channels.front().map];
}

// Returns the transfer curve of each channel of a map. Resampling needs them, because colors are interpolated
// as linear light.
std::vector<Transfer> transfers_of(const TextureSet& set, std::size_t map) {
  std::vector<Transfer> transfers(set.maps[map].layout().channels.size(), Transfer::kLinear);
  for (const auto& [parameter, values] : set.parameters)
    for (const ChannelPlace& place : values.channels)
      if (place.map == map) transfers[place.channel] = values.transfer;
  return transfers;
}

void resample_to_largest(TextureSet& set) {
  int width = 0, height = 0;
  const std::vector<const SetParameter*> parameters = mapped_parameters(set);
  for (const SetParameter* parameter : parameters) {
    width = std::max(width, map_of(set, *parameter).layout().width);
    height = std::max(height, map_of(set, *parameter).layout().height);
  }
  for (const SetParameter* parameter : parameters) {
    ImageReader& map = map_of(set, *parameter);
    if (map.layout().width != width || map.layout().height != height)
      map.resample(width, height, transfers_of(set, parameter->channels.front().map));
  }
}

// Returns the maps of the set that are parts of a file. Opens the file if the set does not have it.
std::vector<std::size_t> open_file(const fs::path& file, TextureSet& set) {
  std::vector<std::size_t> parts;
  for (std::size_t i = 0; i < set.maps.size(); ++i)
    if (same_file(set.maps[i].path(), file)) parts.push_back(i);
  if (!parts.empty()) return parts;
  parts.push_back(set.maps.size());
  set.maps.emplace_back(file);
  const std::shared_ptr<const InputFile> opened = set.maps.back().file();
  const int count = set.maps.back().part_count();
  for (int part = 1; part < count; ++part) {
    parts.push_back(set.maps.size());
    set.maps.emplace_back(opened, part);
  }
  return parts;
}

[[noreturn]] void fail_missing(const ImageReader& reader, const MapName& name, const std::string& expected) {
  const std::vector<std::string> known = channel_names(reader.layout());
  for (const std::string& asked : name.channels)
    if (!find_channel(reader, asked))
      throw usage_error(name.file.string() + ": no channel '" + asked + "'" + suggestion(asked, known));
  throw input_error(name.file.string() + ": has the channels " + joined(known, ", ") + ", but needs " +
                    expected + " (choose a channel, such as " + name.file.string() + ":" +
                    plain(known.front()) + ")");
}

// Finds the named channels, or the color channels, in a file. Only one part of the file may have them.
std::vector<ChannelPlace> find_channels(const MapName& name, std::optional<Parameter> parameter,
                                        const std::string& expected, TextureSet& set) {
  const std::vector<std::size_t> parts = open_file(name.file, set);
  std::vector<std::vector<ChannelPlace>> candidates;
  std::vector<std::string> part_names;
  for (const std::size_t map : parts) {
    const ImageReader& reader = set.maps[map];
    std::vector<std::size_t> channels =
        name.channels.empty() ? color_channels(reader.layout()) : named_channels(reader, name.channels);
    if (channels.empty() && name.channels.empty()) channels = layer_channels(reader.layout(), parameter);
    if (!channels.empty()) candidates.emplace_back();
    for (const std::size_t channel : channels) candidates.back().push_back({map, channel});
    part_names.push_back(reader.part_name().empty() ? std::to_string(reader.part())
                                                    : plain(reader.part_name()));
  }
  if (candidates.size() == 1) return candidates.front();
  if (candidates.empty()) fail_missing(set.maps[parts.front()], name, expected);
  throw usage_error(name.file.string() + ": several parts of the file (" + joined(part_names, ", ") +
                    ") have such channels (choose a part: FILE:PART.CHANNEL or FILE:PART.R,PART.G,PART.B)");
}

// The color space that the user gives overrides the tag of the file. Tags count only for integers.
void choose_transfer(const TextureSet& set, std::optional<Transfer> asked, SetParameter& color) {
  const ChannelPlace first = color.channels.front();
  const ImageLayout& layout = set.maps[first.map].layout();
  const PixelType type = layout.channels[first.channel].type;
  color.is_whole_numbers = is_integer(type);
  const std::optional<Transfer> tagged = color.is_whole_numbers ? layout.tagged_transfer : std::nullopt;
  color.transfer = asked.value_or(tagged.value_or(usual_color_transfer(type)));
  color.transfer_reason = asked    ? TransferReason::kUser
                          : tagged ? TransferReason::kFile
                                   : TransferReason::kUsual;
}

SetParameter open_parameter(const ParameterRequest& request, std::optional<Parameter> role,
                            const std::string& expected, TextureSet& set) {
  SetParameter parameter;
  parameter.factors = request.factors;
  if (const auto* constants = std::get_if<ConstantValues>(&request.source)) {
    parameter.constants = *constants;
    return parameter;
  }
  const auto& map = std::get<MapName>(request.source);
  parameter.channels = find_channels(map, role, expected, set);
  // If the channels are copies of one value, green keeps it best through lossy compression and filters.
  const bool is_copied = !(role && is_color(*role)) && map.channels.empty() && parameter.channels.size() == 3;
  if (is_copied) std::swap(parameter.channels[0], parameter.channels[1]);
  parameter.one_channel = request.one_channel;
  return parameter;
}

void require_factors(std::string_view option, const SetParameter& parameter) {
  if (parameter.factors.size() > 1 && parameter.factors.size() != parameter.channel_count())
    throw usage_error(std::string(option) + ": has " + std::to_string(parameter.factors.size()) +
                      " values (give one, or one for each of the " +
                      std::to_string(parameter.channel_count()) + " channels)");
}

std::optional<ChannelPlace> find_coverage(const TextureSet& set) {
  for (const Parameter parameter : {Parameter::kDiffuse, Parameter::kBaseColor}) {
    const SetParameter* color = set.map_of(parameter);
    if (color == nullptr) continue;
    const std::size_t map = color->channels.front().map;
    const int alpha = set.maps[map].layout().alpha_channel;
    if (alpha < 0) continue;
    const ChannelPlace place{map, static_cast<std::size_t>(alpha)};
    if (!set.holds(place)) return place;
  }
  return std::nullopt;
}

// Returns a text such as `--roughness, --specular`.
std::string listed_options(const TextureSet& set) {
  std::vector<std::string> options;
  for (const auto& [parameter, values] : set.parameters) options.push_back(parameter_option(parameter));
  return joined(options, ", ");
}

}  // namespace

std::variant<MapName, ConstantValues> parameter_source(std::string_view option, std::string_view text) {
  if (const auto values = numbers(text)) {
    require_usable(option, text, *values, "a file, or one or three finite numbers from 0");
    return *values;
  }
  std::error_code none;
  if (text.ends_with('%') && numbers(text.substr(0, text.size() - 1)) && !fs::exists(fs::path(text), none))
    throw usage_error(std::string(option) + ": '" + std::string(text) +
                      "' is not a number or a file (write 30 % as 0.3)");
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0 || text.find('/', colon) != std::string_view::npos ||
      fs::exists(fs::path(text), none))
    return MapName{fs::path(text), {}};
  const std::vector<std::string> channels = parts_between(text.substr(colon + 1), ',');
  const bool named = std::ranges::none_of(channels, [](auto& name) { return name.empty(); });
  if (!named || (channels.size() != 1 && channels.size() != 3))
    throw usage_error(std::string(option) + ": invalid channels in '" + std::string(text) +
                      "' (use FILE:CHANNEL or FILE:R,G,B)");
  return MapName{fs::path(text.substr(0, colon)), channels};
}

std::vector<float> parse_factors(std::string_view option, std::string_view text) {
  const auto values = numbers(text);
  require_usable(option, text, values.value_or(std::vector<float>{}), "one or three finite factors from 0");
  return *values;
}

bool TextureSet::holds(const ChannelPlace& place) const {
  const std::vector<const SetParameter*> mapped = mapped_parameters(*this);
  return std::ranges::any_of(
      mapped, [&](const SetParameter* parameter) { return contains(parameter->channels, place); });
}

std::set<std::size_t> TextureSet::maps_of_material() const {
  std::set<std::size_t> used;
  for (const auto& [parameter, values] : parameters)
    for (const ChannelPlace& place : values.channels) used.insert(place.map);
  if (coverage) used.insert(coverage->map);
  return used;
}

std::size_t TextureSet::first_map() const {
  for (const auto& [parameter, values] : parameters)
    if (values.is_map()) return values.channels.front().map;
  throw usage_error(listed_options(*this) + ": all of these are numbers (give at least one map)");
}

TextureSet open_texture_set(const TextureSetRequest& request) {
  TextureSet set;
  set.convention = request.convention;
  for (const auto& [parameter, asked] : request.parameters) {
    const bool color = is_color(parameter);
    SetParameter opened = open_parameter(
        asked, parameter, color ? "R, G and B, or one channel" : "one channel, Y, or R, G and B", set);
    if (color && opened.is_map()) choose_transfer(set, asked.transfer, opened);
    if (!color && !opened.is_map() && opened.constants.size() != 1)
      throw usage_error(parameter_option(parameter) + ": has three values (give one)");
    require_factors("--factor " + plain_name(parameter), opened);
    set.parameters[parameter] = std::move(opened);
  }
  (void)set.first_map();  // throws if all parameters are numbers
  for (const Carried<ParameterRequest>& carried : request.carried) {
    SetParameter parameter =
        open_parameter(carried.parameter, std::nullopt, "one channel, Y, or R, G and B", set);
    if (parameter.is_map()) parameter.channels.resize(1);
    if (parameter.channel_count() != 1)
      throw usage_error("--" + carried.name + ": has three values (give one)");
    set.carried.push_back({carried.name, parameter});
  }
  set.coverage = find_coverage(set);
  if (request.resample) resample_to_largest(set);
  for (const SetParameter* parameter : mapped_parameters(set))
    require_same_texels(set.maps[set.first_map()], set.maps[parameter->channels.front().map]);
  return set;
}

void require_scale(const TextureSet& set, RoughnessEncoding width) {
  const SetParameter* map = set.map_of(Parameter::kRoughness);
  if (width != RoughnessEncoding::kExponent || map == nullptr || !map->factors.empty()) return;
  const ChannelPlace place = map->channels.front();
  if (is_integer(set.maps[place.map].layout().channels[place.channel].type))
    throw input_error(
        set.maps[place.map].path().string() +
        ": contains integers, which texremap cannot read as exponents (--factor roughness=NUMBER sets the "
        "exponent that a white texel means: 1000 in MTL files, 128 in OpenGL, 100 for percent)");
}

std::vector<std::string> remarks(const TextureSet& set) {
  std::vector<std::string> messages;
  constexpr std::size_t kMegabyte = std::size_t{1} << 20;
  for (const ImageReader& map : set.maps) {
    // OpenImageIO reads Targa files as a whole, and other formats by rows or tiles.
    const std::size_t bytes = map.layout().row_bytes() * static_cast<std::size_t>(map.layout().height);
    if (map.layout().format == "targa" && bytes >= kWholeImageWorthSaying)
      messages.push_back(map.path().string() + ": the whole Targa image is clamped in memory (" +
                         std::to_string(bytes / kMegabyte) + " MB); other formats are streamed");
  }
  for (const ImageReader& map : set.maps)
    if (map.is_resampled())
      messages.push_back(map.path().string() + ": resampled to " + window_text(map.layout()));
  return messages;
}

}  // namespace remap
