// This file converts maps in memory. texremap uses it for each band of its files. A program can call it on
// its own buffers (examples/outside_project/convert_buffers.cpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "remap/pixels.hpp"

namespace remap {

// These statistics of maps are collected row by row.

// A ParameterStatistics describes one parameter over all channels of its map. Values are linear, in the
// encoding of the map. All members are 0 if they were not requested.
struct ParameterStatistics {
  static constexpr std::size_t kBins = 32;
  float min = 0.0f;  // of the finite values; 0 if there are none
  float max = 0.0f;
  std::size_t finite_count = 0;
  std::array<std::size_t, kBins>
      histogram{};  // equal parts of [0, 1]; values outside count in the first or last

  ParameterStatistics& operator+=(const ParameterStatistics& other) noexcept;
};

struct TexelPosition {
  std::size_t x = 0;
  std::size_t y = 0;
};

// An IssueStatistics describes the texels with one MetallicIssue.
struct IssueStatistics {
  std::size_t count = 0;
  std::optional<TexelPosition> first;  // the first such texel in row order

  // Adds the statistics of rows below.
  IssueStatistics& operator+=(const IssueStatistics& other) noexcept;
};

// A MetallicStatistics describes how reliable metallic is, over all covered texels without NaN. All members
// are 0 if they were not requested or if the converter cannot diagnose (Converter::has_diagnostics).
struct MetallicStatistics {
  std::size_t texel_count = 0;
  // This is the sum of squared residuals in units of 2^-40. As an integer it does not depend on order.
  std::uint64_t residual_squares = 0;
  float largest_residual = 0.0f;
  IssueStatistics undetermined, dark, ambiguous, clamped;

  double rms_residual() const noexcept;
  MetallicStatistics& operator+=(const MetallicStatistics& other) noexcept;
};

// A MapStatistics describes a conversion. A texel counts once in each member that applies to it.
struct MapStatistics {
  std::size_t texel_count = 0;
  std::size_t out_of_domain_count = 0;     // texels outside the domain of the converter
  std::size_t nan_count = 0;               // texels with a NaN in any source
  std::size_t infinite_count = 0;          // texels with an infinity in any source
  std::size_t negative_count = 0;          // texels with a value below 0 in any source
  std::size_t clipped_count = 0;           // values, not texels, that an integer pixel type clipped
  std::size_t masked_count = 0;            // texels with coverage 0 or less
  std::size_t above_one_count = 0;         // texels with a finite source above 1, except roughness
  std::optional<TexelPosition> first_bad;  // the first with NaN, infinity or a negative value, in row order
  std::map<Parameter, ParameterStatistics> sources, targets;
  // Holds the parameters whose copies of one value differ, with the largest difference.
  std::map<Parameter, float> tints;
  MetallicStatistics metallic;

  // Adds the statistics of rows below.
  MapStatistics& operator+=(const MapStatistics& other);
};

ParameterStatistics statistics_of(std::span<const float> values);

// Describes the texels of a row from `first` on, which have the diagnosed `residual` and `issues`. `coverage`
// may be null.
MetallicStatistics statistics_of(TexelPosition first, std::span<const float> residual, const float* issues,
                                 const float* coverage);

// A SourceParameter holds the values of one source parameter: channels of a map, or constants.
struct SourceParameter : ParameterValues {
  std::vector<ConstChannelView> channels;
  float grey_tolerance = 0.0f;             // largest permitted difference between copies of one value
  std::string name;                        // file or buffer, for messages
  std::string one_channel;                 // what the user types for one of its channels, for messages
  std::vector<std::string> channel_names;  // one per channel, for messages
};

// A TargetParameter holds the channels that receive a target parameter. If there are none, the parameter is
// not stored.
struct TargetParameter {
  std::vector<ChannelView> channels;
  Transfer transfer = Transfer::kLinear;
};

// A BadTexels value decides the treatment of invalid values: NaN, infinite and negative ones.
enum class BadTexels {
  kKeep,   // NaN and infinity stay if the pixel type can hold them; negative roughness becomes the lowest of
           // the domain, negative specular 0
  kClamp,  // every value is clamped to the domain, NaN to its lowest value
  kFail,   // the first invalid value ends the conversion
};

// These are the words for BadTexels.
inline constexpr NamedValues<BadTexels, 3> kBadTexels = {
    {{BadTexels::kKeep, "keep"}, {BadTexels::kClamp, "clamp"}, {BadTexels::kFail, "fail"}}};

struct MapTreatment {
  std::optional<RoughnessEncoding> target_convention;  // encoding of results; by default the model's own
  float target_roughness_factor = 1.0f;                // roughness is the stored value times this factor
  BadTexels bad_texels = BadTexels::kKeep;
  bool dither = false;               // add noise of half a step to 8-bit integers, the same in every run
  bool value_statistics = false;     // fill in ranges and histograms
  bool metallic_statistics = false;  // fill in the reliability of metallic, which takes time
};

struct MapConversion : MapTreatment {
  std::size_t width = 0;
  std::size_t height = 0;
  // Holds all required sources of the converter, and some of its optional sources. Colors have 1 or 3
  // channels or constants. Other parameters have one channel, or several equal channels, of which the first
  // is used. If the channels differ by more than the tolerance, kInput reports the first such texel.
  std::map<Parameter, SourceParameter> sources;
  // These targets are stored. They may share the memory of the sources. A color has as many channels as the
  // converter makes; a grey one may also have three. Other parameters are stored in all of their channels.
  std::map<Parameter, TargetParameter> targets;
  // Holds the opacity. Texels with coverage 0 or less are converted, too, but do not count in statistics.
  std::optional<ConstChannelView> coverage;
  std::optional<RoughnessEncoding> source_convention;  // encoding of roughness; by default the model's own
  std::optional<ChannelView> mask;                     // 1 for texels outside the domain, 0 for others
  std::size_t first_row = 0;  // position of row 0 in the whole map, which positions and dithering need
};

// Converts every texel. The results equal those of Converter::convert for each texel, for any number of
// threads. Throws kUsage if channels do not match the converter. Throws kInput if the channels of a parameter
// other than a color differ, and for the first invalid texel with BadTexels::kFail.
MapStatistics convert_maps(const Converter& converter, const MapConversion& maps, int thread_count = 1);

// Copies a channel. If both have the same pixel type, copies bit for bit, otherwise as floats. Returns the
// number of values that an integer pixel type clipped.
std::size_t copy_channel(const ConstChannelView& from, const ChannelView& to, std::size_t width,
                         std::size_t height);

}  // namespace remap
