// This file compares the conversion of buffers in memory with the converter applied to each texel.
#include "remap/convert_maps.hpp"

#include <cmath>
#include <cstring>
#include <numeric>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"
#include "support/noise.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr std::size_t kWidth = 61, kHeight = 37;

// A Buffer holds interleaved texels of roughness, red, green, blue and foreign values, with padded rows.
struct Buffer {
  explicit Buffer(std::size_t values_a_texel = 6) : texel(values_a_texel) {}

  std::size_t texel, row = kWidth * texel + 3;
  std::vector<float> values = std::vector<float>(row * kHeight, -7.0f);

  float& at(std::size_t x, std::size_t y, std::size_t c) { return values[y * row + x * texel + c]; }
  // If `flipped`, the first row is the last in memory.
  ChannelView channel(std::size_t c, bool flipped = false) {
    ChannelView view = float_channel(&at(0, flipped ? kHeight - 1 : 0, c), kWidth, texel);
    view.row_stride = static_cast<std::ptrdiff_t>(row * sizeof(float)) * (flipped ? -1 : 1);
    return view;
  }
};

Buffer noisy_buffer(std::size_t values_a_texel = 6) {
  Buffer buffer(values_a_texel);
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x)
      for (std::size_t c = 0; c < values_a_texel; ++c)
        buffer.at(x, y, c) = noise(static_cast<int>(x), static_cast<int>(y), static_cast<int>(c));
  return buffer;
}

MapConversion conversion(Buffer& from, Buffer& to, bool flipped = false) {
  MapConversion maps;
  maps.width = kWidth;
  maps.height = kHeight;
  maps.sources[Parameter::kRoughness].channels = {from.channel(0, flipped)};
  maps.targets[Parameter::kRoughness].channels = {to.channel(0, flipped)};
  for (std::size_t c = 1; c <= 3; ++c) {
    maps.sources[Parameter::kSpecular].channels.push_back(from.channel(c, flipped));
    maps.targets[Parameter::kSpecular].channels.push_back(to.channel(c, flipped));
  }
  return maps;
}

}  // namespace

TEST_CASE("convert_maps: strided, padded, flipped and shared buffers, on any number of threads") {
  const auto converter = make_interpreted_converter(example_fit());
  const bool in_place = GENERATE(false, true), flipped = GENERATE(false, true);
  const int threads = GENERATE(1, 3, 100);
  const std::size_t size = GENERATE(std::size_t{4}, std::size_t{6});
  Buffer from = noisy_buffer(size), copy = from, to(size);
  const MapStatistics statistics =
      convert_maps(*converter, conversion(from, in_place ? from : to, flipped), threads);
  Buffer& result = in_place ? from : to;
  CHECK(statistics.texel_count == kWidth * kHeight);
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x) {
      const auto expected = converted_texel(*converter, copy.at(x, y, 0),
                                            {copy.at(x, y, 1), copy.at(x, y, 2), copy.at(x, y, 3)});
      for (std::size_t c = 0; c < 4; ++c) REQUIRE(result.at(x, y, c) == expected[c]);
      for (std::size_t c = 4; c < size; ++c)
        REQUIRE(result.at(x, y, c) == (in_place ? copy.at(x, y, c) : -7.0f));
    }
  CHECK(result.values.back() == -7.0f);  // the padding has not changed
}

// Packed planes of floats are read and written in place, unless this would change values that are still
// needed.
TEST_CASE("convert_maps: packed planes, apart, in place, exchanged and unaligned") {
  enum class Targets { kApart, kInPlace, kNextPlane, kReversed };
  const Targets targets =
      GENERATE(Targets::kApart, Targets::kInPlace, Targets::kNextPlane, Targets::kReversed);
  const std::size_t misplaced = GENERATE(std::size_t{0}, std::size_t{1});  // in bytes
  const BadTexels bad = GENERATE(BadTexels::kKeep, BadTexels::kClamp);
  const auto converter = make_lowered_converter(example_fit());
  constexpr std::size_t kPlane = kWidth * kHeight * sizeof(float);
  std::vector<std::byte> from(4 * kPlane + 64), to(4 * kPlane + 64);
  std::byte* const first = from.data() + misplaced;
  for (std::size_t i = 0; i < 4 * kWidth * kHeight; ++i) {
    const float value = i % 1001 == 5 ? NAN : i % 1003 == 7 ? -0.5f : noise(static_cast<int>(i), 0, 0);
    std::memcpy(first + i * sizeof value, &value, sizeof value);
  }
  const std::vector<std::byte> copy = from;

  const auto plane = [](auto* memory) {
    return BasicChannelView<std::remove_pointer_t<decltype(memory)>>{memory, PixelType::kFloat, sizeof(float),
                                                                     kWidth * sizeof(float)};
  };
  const auto target_plane = [&](std::size_t c) {
    if (targets == Targets::kNextPlane) return plane(first + (c + 1) % 4 * kPlane);
    if (targets == Targets::kReversed) return plane(first + (3 - c) * kPlane);
    return plane((targets == Targets::kApart ? to.data() + misplaced : first) + c * kPlane);
  };
  MapConversion maps;
  maps.width = kWidth;
  maps.height = kHeight;
  maps.bad_texels = bad;
  maps.value_statistics = true;
  for (std::size_t c = 0; c < 4; ++c) {
    const Parameter parameter = c == 0 ? Parameter::kRoughness : Parameter::kSpecular;
    maps.sources[parameter].channels.push_back(plane(first + c * kPlane));
    maps.targets[parameter].channels.push_back(target_plane(c));
  }
  const MapStatistics statistics = convert_maps(*converter, maps);

  // The same texels are now interleaved in memory. A texel is only the color, all four values, or all four
  // values and more.
  const std::size_t size = GENERATE(std::size_t{3}, std::size_t{4}, std::size_t{5});
  const std::size_t color =
      // the color comes with a plane of roughness, or each texel has its own roughness
      size == 3 ? kWidth * kHeight : 1;
  const auto place = [&](std::size_t i, std::size_t c) {
    return c == 0 ? (size == 3 ? i : size * i) : color + size * i + c - 1;
  };
  MapConversion strided = maps;
  std::vector<float> texels(5 * kWidth * kHeight), results(5 * kWidth * kHeight);
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t i = 0; i < kWidth * kHeight; ++i)
      std::memcpy(&texels[place(i, c)], copy.data() + misplaced + c * kPlane + i * sizeof(float),
                  sizeof(float));
    const Parameter parameter = c == 0 ? Parameter::kRoughness : Parameter::kSpecular;
    const std::size_t channel = c == 0 ? 0 : c - 1, step = place(1, c) - place(0, c);
    strided.sources[parameter].channels[channel] = float_channel(&texels[place(0, c)], kWidth, step);
    strided.targets[parameter].channels[channel] = float_channel(&results[place(0, c)], kWidth, step);
  }
  const MapStatistics expected = convert_maps(*converter, strided);
  CHECK(statistics.out_of_domain_count == expected.out_of_domain_count);
  CHECK(statistics.nan_count == expected.nan_count);
  CHECK(statistics.negative_count == expected.negative_count);
  for (const Parameter parameter : {Parameter::kRoughness, Parameter::kSpecular}) {
    CHECK(statistics.sources.at(parameter).histogram == expected.sources.at(parameter).histogram);
    CHECK(statistics.targets.at(parameter).histogram == expected.targets.at(parameter).histogram);
  }
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t y = 0; y < kHeight; ++y)
      for (std::size_t x = 0; x < kWidth; ++x)
        REQUIRE(std::memcmp(at(target_plane(c), x, y), &results[place(y * kWidth + x, c)], sizeof(float)) ==
                0);
}

TEST_CASE("convert_maps: the mask marks each texel that the converter counts as outside") {
  const auto converter = make_interpreted_converter(example_fit());
  Buffer from = noisy_buffer(), to;
  for (std::size_t x = 3; x < kWidth; x += 7) from.at(x, x % kHeight, 0) = 2.0f;
  for (std::size_t x = 0; x < kWidth; ++x) from.at(x, 8, 2) = 100.0f;  // damages a whole row
  MapConversion maps = conversion(from, to);
  std::vector<float> mask(kWidth * kHeight, 0.5f);
  maps.mask = float_channel(mask.data(), kWidth);
  const MapStatistics statistics = convert_maps(*converter, maps, 2);
  std::size_t marked = 0;
  for (std::size_t y = 0; y < kHeight; ++y)
    for (std::size_t x = 0; x < kWidth; ++x) {
      std::size_t outside = 0;
      converted_texel(*converter, from.at(x, y, 0), {from.at(x, y, 1), from.at(x, y, 2), from.at(x, y, 3)},
                      &outside);
      REQUIRE(mask[y * kWidth + x] == static_cast<float>(outside));
      marked += outside;
    }
  CHECK(marked > kWidth);
  CHECK(marked < kWidth * kHeight);
  CHECK(statistics.out_of_domain_count == marked);
}

TEST_CASE("convert_maps: statistics cover all values, for any number of threads") {
  const auto converter = make_interpreted_converter(example_fit());
  Buffer from = noisy_buffer(), to;
  from.at(50, 20, 2) = NAN;
  from.at(3, 21, 0) = -1.0f;
  from.at(4, 36, 3) = INFINITY;
  MapConversion maps = conversion(from, to);
  maps.value_statistics = true;
  maps.first_row = 1000;
  const MapStatistics one = convert_maps(*converter, maps, 1), many = convert_maps(*converter, maps, 5);
  for (const MapStatistics& statistics : {one, many}) {
    CHECK(statistics.nan_count == 1);
    CHECK(statistics.negative_count == 1);
    CHECK(statistics.infinite_count == 1);
    REQUIRE(statistics.first_bad.has_value());
    CHECK(statistics.first_bad->x == 50);
    CHECK(statistics.first_bad->y == 1020);
    CHECK(statistics.sources.at(Parameter::kRoughness).min == -1.0f);
    CHECK(statistics.sources.at(Parameter::kSpecular).finite_count == 3 * kWidth * kHeight - 2);
    CHECK(statistics.sources.at(Parameter::kSpecular).max < 1.0f);
    const auto& bins = statistics.sources.at(Parameter::kSpecular).histogram;
    CHECK(std::accumulate(bins.begin(), bins.end(), std::size_t{0}) == 3 * kWidth * kHeight - 1);
    CHECK(bins == one.sources.at(Parameter::kSpecular).histogram);
    CHECK(statistics.targets.at(Parameter::kRoughness).max == one.targets.at(Parameter::kRoughness).max);
  }
  // The noise is uniform, so all bins have about the same count.
  for (const std::size_t count : one.sources.at(Parameter::kSpecular).histogram)
    CHECK(static_cast<double>(count) == Approx(3.0 * kWidth * kHeight / 32.0).epsilon(0.3));
}

TEST_CASE("convert_maps: every encoding of roughness gives the same result") {
  const auto converter = make_interpreted_converter(example_fit());
  const RoughnessEncoding own = converter->info().source.roughness,
                          target = converter->info().target.roughness;
  for (const std::string& name : convention_names()) {
    INFO(name);
    const RoughnessEncoding encoding = *encoding_from_name(name);
    float width = static_cast<float>(from_alpha(encoding, 0.25)), result = 0.0f;
    MapConversion maps;
    maps.width = maps.height = 1;
    maps.sources[Parameter::kRoughness].constants = {width};
    maps.sources[Parameter::kSpecular].constants = {0.3f};
    maps.targets[Parameter::kRoughness].channels = {float_channel(&result, 1)};
    maps.source_convention = maps.target_convention = encoding;
    convert_maps(*converter, maps);
    const float expected =
        converted_texel(*converter, static_cast<float>(from_alpha(own, 0.25)), {0.3f, 0.3f, 0.3f})[0];
    CHECK(to_alpha(encoding, static_cast<double>(result)) ==
          Approx(to_alpha(target, static_cast<double>(expected))).epsilon(1e-5));
  }
}

TEST_CASE("convert_maps: dithering keeps the mean and is the same in every run and in every band") {
  const auto converter = make_interpreted_converter(example_fit());
  constexpr std::size_t kSide = 256;
  std::vector<std::uint8_t> whole(kSide * kSide), parts(kSide * kSide), plain(kSide * kSide);
  const auto run = [&](std::vector<std::uint8_t>& result, std::size_t first, std::size_t rows, bool dither) {
    MapConversion maps;
    maps.width = kSide;
    maps.height = rows;
    maps.first_row = first;
    maps.dither = dither;
    maps.sources[Parameter::kRoughness].constants = {0.3f};
    maps.sources[Parameter::kSpecular].constants = {0.3f};
    maps.targets[Parameter::kSpecular].channels = {{reinterpret_cast<std::byte*>(&result[first * kSide]),
                                                    PixelType::kUint8, 1,
                                                    static_cast<std::ptrdiff_t>(kSide)}};
    convert_maps(*converter, maps);
  };
  run(whole, 0, kSide, true);
  run(plain, 0, kSide, false);
  for (std::size_t first = 0; first < kSide; first += 64) run(parts, first, 64, true);
  CHECK(whole == parts);
  const double exact = 255.0 * static_cast<double>(converted_texel(*converter, 0.3f, {0.3f, 0.3f, 0.3f})[1]);
  const auto mean = [](const std::vector<std::uint8_t>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  CHECK(mean(whole) == Approx(exact).margin(0.01));
  CHECK(std::fabs(mean(plain) - exact) > 0.05);  // otherwise the previous check would prove nothing
}

TEST_CASE("convert_maps: channels that do not match the converter are refused") {
  const auto converter = make_interpreted_converter(example_fit());
  Buffer from = noisy_buffer(), to;
  const auto refused = [&](auto change, const std::string& message) {
    MapConversion maps = conversion(from, to);
    change(maps);
    CHECK_THROWS_WITH(convert_maps(*converter, maps), Contains(message));
  };
  refused([](MapConversion& maps) { maps.sources[Parameter::kRoughness].channels.clear(); },
          "roughness has no channel");
  refused([](MapConversion& maps) { maps.sources[Parameter::kSpecular].channels.pop_back(); },
          "specular has 2 channels");
  refused([](MapConversion& maps) { maps.targets[Parameter::kSpecular].channels.pop_back(); },
          "but the converter makes 3");
  refused(
      [](MapConversion& maps) {
        maps.sources[Parameter::kSpecular].factors = {1.0f, 2.0f};
      },
      "more factors than channels");
}

TEST_CASE("copy_channel: equal types keep bits, other types keep values") {
  const std::vector<std::uint32_t> bits = {0, 0x7fc12345u, 0xffffffffu, 1};  // a NaN with a payload
  std::vector<std::uint32_t> copy(4);
  const auto* first = reinterpret_cast<const std::byte*>(bits.data());
  copy_channel({first, PixelType::kFloat, 4, 8},
               {reinterpret_cast<std::byte*>(copy.data()), PixelType::kFloat, 4, 8}, 2, 2);
  CHECK(copy == bits);
  const std::vector<float> values = {0.5f, 1.5f, -1.0f, 0.25f};
  std::vector<std::uint8_t> bytes(4);
  const std::size_t clipped =
      copy_channel(float_channel(values.data(), 4),
                   {reinterpret_cast<std::byte*>(bytes.data()), PixelType::kUint8, 1, 4}, 4, 1);
  CHECK(bytes == std::vector<std::uint8_t>{128, 255, 0, 64});
  CHECK(clipped == 2);
}
