// Converts maps in memory. texremap uses it for each band of its files; a program can call it on its own
// buffers (examples/outside_project/convert_buffers.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "remap/channel_view.hpp"
#include "remap/convention.hpp"
#include "remap/converter.hpp"
#include "remap/map_statistics.hpp"
#include "remap/transfer.hpp"

namespace remap {

// The values of one source parameter: channels of a map, or constants.
struct SourceParameter : ParameterValues {
  std::vector<ConstChannelView> channels;
  float grey_tolerance = 0.0f;             // largest difference between copies of one value
  std::string name;                        // file or buffer, for messages
  std::vector<std::string> channel_names;  // one per channel, for messages
};

// The channels that receive a target parameter. Without channels the parameter is not stored.
struct TargetParameter {
  std::vector<ChannelView> channels;
  Transfer transfer = Transfer::kLinear;
};

// The treatment of invalid values: NaN, infinite and negative ones.
enum class BadTexels {
  kKeep,   // NaN and infinity stay if the pixel type can hold them; negative roughness becomes the lowest of
           // the domain, negative specular 0
  kClamp,  // every value is clamped to the domain, NaN to its lowest value
  kFail,   // the first invalid value ends the conversion
};

struct MapTreatment {
  std::optional<RoughnessConvention> target_convention;  // of the results; by default that of the model
  BadTexels bad_texels = BadTexels::kKeep;
  bool dither = false;               // add noise of half a step to 8-bit integers, equal in every run
  bool value_statistics = false;     // fill in ranges and histograms
  bool metallic_statistics = false;  // fill in the reliability of metallic, which takes time
};

struct MapConversion : MapTreatment {
  std::size_t width = 0;
  std::size_t height = 0;
  // Every source of the converter, and optional ones. Colors have 1 or 3 channels or constants. Other
  // parameters have one, or several equal channels, of which the first is used: kInput names the first texel
  // where they differ by more than the tolerance.
  std::map<Parameter, SourceParameter> sources;
  // The targets to store. They may share the memory of the sources. Colors have as many channels as the
  // converter makes, or three for grey. Every channel of another parameter receives its value.
  std::map<Parameter, TargetParameter> targets;
  // Opacity. Texels with coverage 0 or less are converted like all others, but are left out of the
  // statistics.
  std::optional<ConstChannelView> coverage;
  std::optional<RoughnessConvention> source_convention;  // of the roughness; by default that of the model
  std::optional<ChannelView> mask;                       // receives 1 for texels outside the domain, else 0
  std::size_t first_row = 0;  // position of row 0 in the whole map, for positions and dithering
};

// Converts every texel. The results equal those of Converter::convert for each texel, for any number
// of threads. Throws kInput if the channels of a parameter other than a color differ and, with
// BadTexels::kFail, for the first invalid texel; kUsage if channels do not match the converter.
MapStatistics convert_maps(const Converter& converter, const MapConversion& maps, int thread_count = 1);

// Copies a channel: bit for bit between equal pixel types, else as floats. Returns the number of values that
// an integer pixel type clipped.
std::size_t copy_channel(const ConstChannelView& from, const ChannelView& to, std::size_t width,
                         std::size_t height);

}  // namespace remap
