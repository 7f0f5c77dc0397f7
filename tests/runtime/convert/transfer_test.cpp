// This file tests the curve of sRGB against its formula in long doubles.
#include "convert/transfer.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace remap;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

long double exact_linear(long double stored) {
  return stored <= 0.04045L ? stored / 12.92L : std::pow((stored + 0.055L) / 1.055L, 2.4L);
}
long double exact_srgb(long double linear) {
  return linear <= 0.0031308L ? 12.92L * linear : 1.055L * std::pow(linear, 1.0L / 2.4L) - 0.055L;
}

float to_linear(float value) {
  to_linear(Transfer::kSrgb, {&value, 1});
  return value;
}
float from_linear(float value) {
  from_linear(Transfer::kSrgb, {&value, 1});
  return value;
}

int level_of(float linear, std::size_t* clipped = nullptr) {
  std::byte level{};
  const std::size_t count = store_linear(Transfer::kSrgb, PixelType::kUint8, &linear, 1, &level, 1);
  if (clipped != nullptr) *clipped = count;
  return std::to_integer<int>(level);
}
int exact_level(float linear) {
  return static_cast<int>(std::floor(exact_srgb(static_cast<long double>(linear)) * 255.0L + 0.5L));
}

// Returns true if `value` is within 0.51 units in the last place of `exact`.
bool is_near(float value, long double exact) {
  const float next = std::nextafter(value, kInfinity);
  const long double unit = static_cast<long double>(next) - static_cast<long double>(value);
  return std::fabs(static_cast<long double>(value) - exact) <= 0.51L * unit;
}

// Calls `use` for floats of every exponent up to that of 2^40.
template <typename Use>
void for_sample(Use use) {
  for (std::uint32_t bits = 0; bits < std::bit_cast<std::uint32_t>(0x1p40f); bits += 10007)
    use(std::bit_cast<float>(bits));
}

}  // namespace

TEST_CASE("transfer: sRGB is invertible and continuous") {
  for (float value = -0.5f; value < 2.0f; value += 0.00711f) {
    CHECK(from_linear(to_linear(value)) == Approx(value).margin(1e-6));
  }
  // By Stokes et al. 1996 and the table of IEC 61966-2-1, 188 of 255 is about half.
  CHECK(to_linear(188.0f / 255.0f) == Approx(0.5029).margin(1e-4));
}

TEST_CASE("transfer: invalid roughness is clamped") {
  float width = -0.5f;
  change_convention(RoughnessEncoding::kRoughness, RoughnessEncoding::kAlpha, {&width, 1});
  CHECK(width == 0.0f);
  width = 3.0f;
  change_convention(RoughnessEncoding::kGlossiness, RoughnessEncoding::kAlpha, {&width, 1});
  CHECK(width == 0.0f);
  width = NAN;
  change_convention(RoughnessEncoding::kGlossiness, RoughnessEncoding::kAlpha, {&width, 1});
  CHECK(std::isnan(width));
  width = 0.0f;
  change_convention(RoughnessEncoding::kAlpha, RoughnessEncoding::kExponent, {&width, 1});
  CHECK(std::isinf(width));
}

TEST_CASE("transfer: values of 8 and 16 bits and halves are decoded to the nearest float") {
  const auto check = [](float stored) {
    const auto exact = static_cast<float>(exact_linear(std::fabs(static_cast<long double>(stored))));
    REQUIRE(to_linear(stored) == std::copysign(exact, stored));
  };
  for (int i = 0; i < 256; ++i) check(static_cast<float>(i) / 255.0f);
  for (int i = 0; i < 65536; ++i) check(static_cast<float>(i) / 65535.0f);
  for (int i = 0; i < 65536; ++i)
    if (const float value = half_to_float(static_cast<std::uint16_t>(i)); std::isfinite(value)) check(value);
}

TEST_CASE("transfer: the table of 8 bits holds what the curve gives") {
  for (int i = 0; i < 256; ++i) {
    const std::byte level{static_cast<unsigned char>(i)};
    float value = 0.0f;
    load_linear(Transfer::kSrgb, PixelType::kUint8, &level, 1, 1, &value);
    REQUIRE(value == to_linear(static_cast<float>(i) / 255.0f));
    REQUIRE(level_of(value) == i);
  }
}

TEST_CASE("transfer: every float is within .51 units in the last place of the curve") {
  for_sample([](float value) {
    const auto exact = static_cast<long double>(value);
    REQUIRE(is_near(to_linear(value), exact_linear(exact)));
    REQUIRE(is_near(from_linear(value), exact_srgb(exact)));
  });
}

TEST_CASE("transfer: the curve is odd; infinity and NaN stay") {
  for (const float value : {1e-40f, 0.001f, 0.3f, 1.0f, 5.0f, 3e38f}) {
    CHECK(to_linear(-value) == -to_linear(value));
    CHECK(from_linear(-value) == -from_linear(value));
  }
  CHECK(std::signbit(to_linear(-0.0f)));
  CHECK(std::signbit(from_linear(-0.0f)));
  for (const float value : {kInfinity, -kInfinity}) {
    CHECK(to_linear(value) == value);
    CHECK(from_linear(value) == value);
  }
  CHECK(to_linear(3e38f) == kInfinity);
  CHECK(std::isnan(to_linear(NAN)));
  CHECK(std::isnan(from_linear(NAN)));
}

TEST_CASE("transfer: every float becomes the nearest level of 8 bits") {
  constexpr std::uint32_t kNear = 300;
  for (int level = 1; level < 256; ++level) {
    const auto between = static_cast<float>(exact_linear((static_cast<long double>(level) - 0.5L) / 255.0L));
    const auto middle = std::bit_cast<std::uint32_t>(between);
    for (std::uint32_t bits = middle - kNear; bits <= middle + kNear; ++bits)
      REQUIRE(level_of(std::bit_cast<float>(bits)) == exact_level(std::bit_cast<float>(bits)));
  }
  for_sample([](float value) {
    if (value <= 1.0f) REQUIRE(level_of(value) == exact_level(value));
  });
}

TEST_CASE("transfer: what 8 bits cannot hold is clipped and counted") {
  std::size_t clipped = 0;
  const auto check = [&clipped](float value, int level, std::size_t count) {
    CHECK(level_of(value, &clipped) == level);
    CHECK(clipped == count);
  };
  check(0.0f, 0, 0);
  check(-0.0f, 0, 0);
  check(1.0f, 255, 0);
  check(std::nextafter(1.0f, 2.0f), 255, 1);
  check(kInfinity, 255, 1);
  check(-1e-40f, 0, 1);
  check(-kInfinity, 0, 1);
  check(NAN, 0, 1);
}

TEST_CASE("transfer: results have the same bits everywhere") {
  std::uint64_t hash = 0xcbf29ce484222325;  // start of FNV-1a
  for_sample([&hash](float value) {
    for (const float result : {to_linear(value), from_linear(value)})
      hash = (hash ^ std::bit_cast<std::uint32_t>(result)) * 0x100000001b3;
  });
  CHECK(hash == 0x19546667e0f64bdc);
}

TEST_CASE("transfer: rows of every pixel type are stored as values are") {
  std::vector<float> values(1300);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) / 1200.0f - 0.02f;
  for (const auto& [type, name] : kPixelTypes) {
    if (type == PixelType::kUint8) continue;
    CAPTURE(name);
    const std::size_t stride = byte_count(type) + 3;
    std::vector<std::byte> row(values.size() * stride), expected = row;
    const std::size_t clipped =
        store_linear(Transfer::kSrgb, type, values.data(), values.size(), row.data(), stride);
    std::vector<float> encoded = values;
    from_linear(Transfer::kSrgb, encoded);
    CHECK(store_values(type, encoded.data(), encoded.size(), expected.data(), stride) == clipped);
    CHECK(row == expected);
  }
}
