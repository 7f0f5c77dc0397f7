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
#include "texture/pixel_type.hpp"
#include "texture/transfer.hpp"

namespace remap {

// One channel of a map in memory. The value of texel (x, y) lies at first + y row_stride + x texel_stride and
// need not be aligned. Strides are in bytes; a negative row stride is an image that begins at its bottom.
template <typename Byte>
struct BasicChannelView {
  Byte* first = nullptr;
  PixelType type = PixelType::kFloat;
  std::ptrdiff_t texel_stride = 0;
  std::ptrdiff_t row_stride = 0;

  operator BasicChannelView<const Byte>() const noexcept  // what can be written can be read
      requires(!std::is_const_v<Byte>) {
    return {first, type, texel_stride, row_stride};
  }
};
using ChannelView = BasicChannelView<std::byte>;
using ConstChannelView = BasicChannelView<const std::byte>;

// A channel of packed rows of `width` texels of floats with `values_a_texel` values each, `first` being its
// value in the first texel.
ChannelView float_channel(float* first, std::size_t width, std::size_t values_a_texel = 1) noexcept;
ConstChannelView float_channel(const float* first, std::size_t width,
                               std::size_t values_a_texel = 1) noexcept;

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
  // Every source of the converter, and what it takes beside. Colours: 1 or 3 channels or constants. Others:
  // one, or copies of one value, which is required: kInput names the first texel where they differ by more
  // than the tolerance; the first channel counts.
  std::map<Parameter, SourceParameter> sources;
  // What is wanted of the converter's targets; may be the sources' own memory. Colours: as many channels as
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

// The values of one parameter, as the map has them (linear, in the encoding of the map), all channels
// together. All 0 where they were not asked for.
struct ParameterStatistics {
  static constexpr std::size_t kBins = 32;
  float min = 0.0f;  // of finite values; both 0 where there is none
  float max = 0.0f;
  std::size_t finite_count = 0;
  std::array<std::size_t, kBins> histogram{};  // [0, 1] in equal parts; values beyond count in the outermost

  ParameterStatistics& operator+=(const ParameterStatistics& other) noexcept;
};

struct TexelPosition {
  std::size_t x = 0;
  std::size_t y = 0;
};

// Texels with one Doubt.
struct DoubtStatistics {
  std::size_t count = 0;
  std::optional<TexelPosition> first;  // row by row

  // `other`: of rows below.
  DoubtStatistics& operator+=(const DoubtStatistics& other) noexcept;
};

// How far metallic can be trusted, over the texels that are covered and hold no NaN. All 0 where that was not
// asked for, or the converter cannot say it (MaterialConverter::can_diagnose).
struct MetallicStatistics {
  std::size_t texel_count = 0;
  // Sum of squared residuals in whole units of 2^-40: the same in any order.
  std::uint64_t residual_squares = 0;
  float largest_residual = 0.0f;
  DoubtStatistics guess, dark, two_answers, clamped;

  double rms_residual() const noexcept;
  MetallicStatistics& operator+=(const MetallicStatistics& other) noexcept;
};

// What was met on the way. Texels count once in each line that applies to them.
struct MapStatistics {
  std::size_t texel_count = 0;
  std::size_t out_of_domain_count = 0;     // texels, as the converter counts them
  std::size_t nan_count = 0;               // texels with a NaN in any source
  std::size_t infinite_count = 0;          // texels with an infinity there
  std::size_t negative_count = 0;          // texels with a value below 0 there
  std::size_t clipped_count = 0;           // values, not texels, that an integer pixel type cut to its range
  std::size_t masked_count = 0;            // texels that coverage takes out
  std::size_t above_one_count = 0;         // texels with a finite source above 1 that is no width
  std::optional<TexelPosition> first_bad;  // the first, row by row, of those with NaN, infinity or below 0
  std::map<Parameter, ParameterStatistics> sources, targets;
  MetallicStatistics metallic;

  // `other`: of rows below.
  MapStatistics& operator+=(const MapStatistics& other);
};

// Converts every texel. The results are those of MaterialConverter::convert texel by texel, whatever the
// thread count. Throws kInput where a parameter that is no colour has several channels that differ and, asked
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
