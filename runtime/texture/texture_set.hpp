// The maps that describe one material: which channels of which files hold what a converter asks for.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "convert/material_rows.hpp"
#include "model/convention.hpp"
#include "texture/image_io.hpp"
#include "texture/transfer.hpp"

namespace remap {

// Linear values without a map: one, or one each for red, green and blue.
using ConstantValues = std::vector<float>;

// A file, and the channels of it by name; none: those that hold color, or the only one.
struct MapName {
  std::filesystem::path file;
  std::vector<std::string> channels;
};

// One parameter as a caller names it.
struct ParameterRequest {
  std::variant<MapName, ConstantValues> source;
  std::vector<float> factors;        // of the linear values: none, one, or one a channel
  std::optional<Transfer> transfer;  // of the stored values; none: as the file says
};

// `0.5` and `0.9,0.6,0.2` are constants; `maps.png:G` and `maps.exr:R,G,B` channels of a file, unless there
// is a file of that whole name; anything else is a file. Throws kUsage, naming `option`, for a list of
// numbers that is neither one nor three long or that holds a negative or infinite one.
std::variant<MapName, ConstantValues> parameter_source(std::string_view option, std::string_view text);

// One or three finite factors from 0; throws as above.
std::vector<float> parse_factors(std::string_view option, std::string_view text);

// A parameter that is not converted, and has its place in a layout.
struct CarriedRequest {
  std::string name;  // `occlusion`, `metallic`
  ParameterRequest parameter;
};

struct TextureSetRequest {
  std::map<Parameter, ParameterRequest> parameters;
  std::vector<CarriedRequest> carried;            // of one channel each
  std::optional<RoughnessConvention> convention;  // of the map of the width; none: the model's own
  bool resample = false;  // maps of other sizes, to the largest width and height among them
};

// Where the values of a channel lie: in a map of the set.
struct ChannelPlace {
  std::size_t map = 0;
  std::size_t channel = 0;  // index into its layout's channels
  bool operator==(const ChannelPlace&) const = default;
};

// One parameter of an open set.
struct SetParameter {
  std::vector<ChannelPlace>
      channels;  // empty: constant. Of what is no color: copies of one value where several
  ConstantValues constants;
  std::vector<float> factors;
  Transfer transfer = Transfer::kLinear;
  bool transfer_is_guessed = false;

  bool is_map() const noexcept { return !channels.empty(); }
  std::size_t channel_count() const noexcept { return is_map() ? channels.size() : constants.size(); }
};

struct CarriedParameter {
  std::string name;
  SetParameter parameter;  // one channel or one constant
};

// An open set: every texel has one value of each parameter, colors one or three. A map is one part of a
// file; all parts of a file are there, and those that hold no parameter may be of any size. A file that is
// named twice is opened once. At least one of the parameters is a map.
struct TextureSet {
  std::vector<ImageReader> maps;
  std::map<Parameter, SetParameter> parameters;
  std::vector<CarriedParameter> carried;
  // The alpha of diffuse or base color, where the file has one that is no parameter: how much of a texel is
  // surface.
  std::optional<ChannelPlace> coverage;
  std::optional<RoughnessConvention> convention;

  // Null where the set has no such parameter, or a constant.
  const SetParameter* map_of(Parameter parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() || !found->second.is_map() ? nullptr : &found->second;
  }
  // A map of the size of the set: that of the first parameter that has one.
  std::size_t first_map() const;
};

// Opens the files and finds the channels. Throws kInput where a file cannot be read, where a channel is
// missing, and where two maps do not cover the same texels and are not to be resampled; kUsage for the name
// of a channel that a file does not have and where no parameter is a map.
TextureSet open_texture_set(const TextureSetRequest& request);

// What a person should know about the set before trusting the result; one message each, without place.
std::vector<std::string> remarks(const TextureSet& set);

}  // namespace remap
