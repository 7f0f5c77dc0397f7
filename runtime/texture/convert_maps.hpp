// The conversion of maps that lie in memory, without any file: what texremap runs on each band of its files,
// and what a program calls on buffers of its own (examples/convert_buffers.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "convert/material_converter.hpp"
#include "model/convention.hpp"
#include "texture/channel_view.hpp"
#include "texture/map_statistics.hpp"
#include "texture/transfer.hpp"

namespace remap {

// Where the values of one parameter come from: a channel each, or a constant each where there is no map.
struct SourceParameter {
  std::vector<ConstChannelView> channels;
  std::vector<float> constants;            // linear; used where `channels` is empty
  std::vector<float> factors;              // of the linear values; none, one, or one a channel
  Transfer transfer = Transfer::kLinear;   // of the stored values
  float grey_tolerance = 0.0f;             // how far copies of one value may be apart
  std::string name;                        // for messages: a file, a buffer
  std::vector<std::string> channel_names;  // for messages; as many as channels
};

// Where they go to. No channels: the parameter is not wanted.
struct TargetParameter {
  std::vector<ChannelView> channels;
  Transfer transfer = Transfer::kLinear;
};

// What to do with values that no material has: NaN, infinite and negative ones.
enum class BadTexels {
  kKeep,   // NaN and infinity stay, where the pixel type can hold them; widths below the covered range are
           // held at its edge, specular below 0 at 0
  kClamp,  // NaN and negative values become the lowest that the converter covers, infinity the highest
  kFail,   // the first one ends the conversion
};

struct MapConversion {
  std::size_t width = 0;
  std::size_t height = 0;
  // Every source of the converter, and what it takes beside. Colors: 1 or 3 channels or constants. Others:
  // one, or copies of one value, which is required: kInput names the first texel where they differ by more
  // than the tolerance; the first channel counts.
  std::map<Parameter, SourceParameter> sources;
  // What is wanted of the converter's targets; may be the sources' own memory. Colors: as many channels as
  // the converter gives, or three for grey. Others: every channel gets the value.
  std::map<Parameter, TargetParameter> targets;
  // Coverage: texels where it is 0 or less are converted as the others are, but are of no surface, and their
  // values count in no statistics.
  std::optional<ConstChannelView> coverage;
  // Of the widths in the maps; the model's own where there is none.
  std::optional<RoughnessConvention> source_convention;
  std::optional<RoughnessConvention> target_convention;
  std::optional<ChannelView> mask;  // gets 1 for texels out of domain, else 0
  BadTexels bad_texels = BadTexels::kKeep;
  bool dither = false;               // values for 8-bit integers: noise of half a step, the same in every run
  bool value_statistics = false;     // fill in ranges and histograms
  bool metallic_statistics = false;  // and how far metallic can be trusted, which takes its time
  std::size_t first_row = 0;         // position of row 0 in the whole map: for positions and dithering
};

// Converts every texel. The results are those of MaterialConverter::convert texel by texel, whatever the
// thread count. Throws kInput where a parameter that is no color has several channels that differ and, asked
// to, for the first bad texel; kUsage where the channels do not fit together.
MapStatistics convert_maps(const MaterialConverter& converter, const MapConversion& maps,
                           int thread_count = 1);
// Of width and specular alone.
MapStatistics convert_maps(const Converter& converter, const MapConversion& maps, int thread_count = 1);

// Copies a channel of another map: bit for bit where the pixel types are the same, else by way of floats.
// Returns how many values an integer pixel type cut to its range.
std::size_t copy_channel(const ConstChannelView& from, const ChannelView& to, std::size_t width,
                         std::size_t height);

}  // namespace remap
