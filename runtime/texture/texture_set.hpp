// This file describes the maps of one material. It records which channels of which files hold the parameters
// of a converter.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "remap/pixels.hpp"
#include "texture/image_reader.hpp"

namespace remap {

// A ConstantValues holds linear values instead of a map. It has one value, or three for red, green and blue.
using ConstantValues = std::vector<float>;

// A MapName is a file and the names of channels in it. If there are no names, it means the color channels, or
// the only channel.
struct MapName {
  std::filesystem::path file;
  std::vector<std::string> channels;
};

struct ParameterRequest {
  std::variant<MapName, ConstantValues> source;
  std::vector<float> factors;        // factors for the linear values: none, one, or one per channel
  std::optional<Transfer> transfer;  // curve of a color; if unset, from the file or the usual curve
  std::string one_channel = {};      // option that reads one channel of the map, for messages
};

// Parses the value of an option. `0.5` and `0.9,0.6,0.2` are constants. `maps.png:G` and `maps.exr:R,G,B`
// name channels of a file, unless there is a file of this whole name. Any other text is a file. Throws
// kUsage, with `option`, for two or more than three numbers, for a negative or infinite number, and for a
// percentage.
std::variant<MapName, ConstantValues> parameter_source(std::string_view option, std::string_view text);

// Parses one or three finite factors of at least 0. Throws like parameter_source().
std::vector<float> parse_factors(std::string_view option, std::string_view text);

// A Carried is a parameter that is not converted, but has a place in a layout. It is a ParameterRequest, or
// in an open set a SetParameter. It has one channel, or is one constant.
template <typename AnyParameter>
struct Carried {
  std::string name;  // such as `occlusion` or `metallic`
  AnyParameter parameter;
};

struct TextureSetRequest {
  std::map<Parameter, ParameterRequest> parameters;
  std::vector<Carried<ParameterRequest>> carried;
  std::optional<RoughnessEncoding> convention;  // encoding of the roughness map; by default the model's
  bool resample = false;                        // enlarge maps to the largest width and height among them
};

struct ChannelPlace {
  std::size_t map = 0;
  std::size_t channel = 0;  // index into the channels of its layout
  bool operator==(const ChannelPlace&) const = default;
};

// A TransferReason is the origin of a color's transfer curve.
enum class TransferReason {
  kUsual,  // neither a file nor the user states it: usual_color_transfer()
  kFile,
  kUser,
};

// A SetParameter is one parameter of an open set.
struct SetParameter : ParameterValues {
  // These are the channels that hold the parameter. They are empty for a constant. If a parameter other than
  // a color has several channels, they are nearly equal, and the first of these, green, is used.
  std::vector<ChannelPlace> channels;
  TransferReason transfer_reason = TransferReason::kUsual;
  bool is_whole_numbers = false;  // true if the file holds integers
  std::string one_channel = {};   // copied from the request

  bool is_map() const noexcept { return !channels.empty(); }
  std::size_t channel_count() const noexcept { return is_map() ? channels.size() : constants.size(); }
};

// A TextureSet is an open set. Each texel has one value of each parameter, or for colors one or three. A map
// is one part of a file. The set has all parts of its files. Parts without a parameter may have any size. A
// file is opened only once, even if it has several parameters. At least one parameter is a map.
struct TextureSet {
  std::vector<ImageReader> maps;
  std::map<Parameter, SetParameter> parameters;
  std::vector<Carried<SetParameter>> carried;
  // This is the opacity: the alpha of the file of diffuse or base color, if no parameter uses it.
  std::optional<ChannelPlace> coverage;
  std::optional<RoughnessEncoding> convention;

  // Returns null if the parameter is missing or a constant.
  const SetParameter* map_of(Parameter parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() || !found->second.is_map() ? nullptr : &found->second;
  }
  // Returns true if a parameter has this channel, even if the parameter is only passed through.
  bool holds(const ChannelPlace& place) const;
  // Returns the maps with channels of parameters or coverage.
  std::set<std::size_t> maps_of_material() const;
  // Returns the map of the first parameter that is a map. All maps have its size. Throws kUsage if no
  // parameter is a map.
  std::size_t first_map() const;
};

// Opens the files and finds the channels. Throws kInput if a file cannot be read, if a channel is missing, or
// if two maps differ in size and `resample` is not set. Throws kUsage for an unknown channel name and if no
// parameter is a map.
TextureSet open_texture_set(const TextureSetRequest& request);

// Throws kInput if the roughness map holds integers, is read as an exponent (`width`), and has no factor.
// Integers store 0 to 1, and exponents are larger.
void require_scale(const TextureSet& set, RoughnessEncoding width);

// Returns warnings about the set, one message each.
std::vector<std::string> remarks(const TextureSet& set);

}  // namespace remap
