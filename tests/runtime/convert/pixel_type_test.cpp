// This file tests numbers of files: pixel types against Imath's half and integer arithmetic, and the curve
// of sRGB against its formula in long doubles.
#include <Imath/half.h>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "convert/transfer.hpp"
#include "remap/pixels.hpp"

using namespace remap;

namespace {

float stored_and_loaded(PixelType type, float value) {
  std::array<std::byte, 8> bytes{};
  store_values(type, &value, 1, bytes.data(), byte_count(type));
  float result = 0.0f;
  load_values(type, bytes.data(), byte_count(type), 1, &result);
  return result;
}

template <typename Integer>
void check_every_value_returns(PixelType type) {
  for (std::uint32_t i = 0; i <= std::numeric_limits<Integer>::max(); ++i) {
    const auto stored = static_cast<Integer>(i);
    std::array<std::byte, sizeof(Integer)> bytes;
    std::memcpy(bytes.data(), &stored, sizeof stored);
    float value = 0.0f;
    load_values(type, bytes.data(), sizeof stored, 1, &value);
    REQUIRE(value == static_cast<float>(static_cast<double>(i) / std::numeric_limits<Integer>::max()));
    Integer back = 0;
    CHECK(store_values(type, &value, 1, reinterpret_cast<std::byte*>(&back), sizeof back) == 0);
    REQUIRE(back == stored);
  }
}

void check_half(float value) {
  const std::uint16_t bits = float_to_half(value);
  if (std::isnan(value))
    REQUIRE(Imath::half(Imath::half::FromBits, bits).isNan());
  else
    REQUIRE(bits == Imath::half(value).bits());
}

}  // namespace

TEST_CASE("pixel type: every half converts to float as in Imath, and back") {
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const auto stored = static_cast<std::uint16_t>(bits);
    const float expected = static_cast<float>(Imath::half(Imath::half::FromBits, stored));
    const float value = half_to_float(stored);
    if (std::isnan(expected)) {
      REQUIRE(std::isnan(value));
      continue;
    }
    REQUIRE(std::bit_cast<std::uint32_t>(value) == std::bit_cast<std::uint32_t>(expected));
    REQUIRE(float_to_half(value) == stored);
  }
}

TEST_CASE("pixel type: floats are rounded to half as Imath rounds them", "[slow]") {
  std::mt19937 random(1);
  for (int i = 0; i < 2'000'000; ++i) check_half(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
  // Tests the value exactly between two half floats, and one unit to either side. Ties round to even.
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
    const float low = half_to_float(static_cast<std::uint16_t>(bits));
    const float high = bits + 1 == 0x7c00 ? 65536.0f : half_to_float(static_cast<std::uint16_t>(bits + 1));
    const float middle = (low + high) / 2.0f;
    for (const float value : {middle, std::nextafter(middle, 0.0f), std::nextafter(middle, 1e6f)}) {
      check_half(value);
      check_half(-value);
    }
  }
}

TEST_CASE("pixel type: every uint8 and uint16 converts to value / largest, and back") {
  check_every_value_returns<std::uint8_t>(PixelType::kUint8);
  check_every_value_returns<std::uint16_t>(PixelType::kUint16);
}

TEST_CASE("pixel type: integers clip values outside their range and count them") {
  const std::array<float, 7> values = {-0.1f, 0.0f, 0.5f, 1.0f, 1.5f, NAN, INFINITY};
  std::array<std::uint8_t, 7> stored{};
  const std::size_t clipped = store_values(PixelType::kUint8, values.data(), values.size(),
                                           reinterpret_cast<std::byte*>(stored.data()), 1);
  CHECK(clipped == 4);
  CHECK(stored == std::array<std::uint8_t, 7>{0, 0, 128, 255, 255, 0, 255});
  CHECK(stored_and_loaded(PixelType::kInt16, -1.0f) == -1.0f);
  CHECK(stored_and_loaded(PixelType::kInt8, -2.0f) == -1.0f);
  CHECK(stored_and_loaded(PixelType::kUint32, 1.0f) == 1.0f);
  CHECK(stored_and_loaded(PixelType::kInt32, -0.25f) == Approx(-0.25f));
}

TEST_CASE("pixel type: float and double keep every bit and clip nothing") {
  for (const float value : {-3.0f, 0.1f, 1e30f, INFINITY, std::numeric_limits<float>::denorm_min()}) {
    CHECK(stored_and_loaded(PixelType::kFloat, value) == value);
    CHECK(stored_and_loaded(PixelType::kDouble, value) == value);
  }
  std::array<std::byte, 4> bytes{};
  const float large = 7.0f;
  CHECK(store_values(PixelType::kFloat, &large, 1, bytes.data(), 4) == 0);
}

TEST_CASE("pixel type: values are read at their stride, and other bytes are unchanged") {
  std::array<std::uint8_t, 9> texels = {10, 20, 30, 40, 50, 60, 70, 80, 90};
  std::array<float, 3> green{};
  auto* bytes = reinterpret_cast<std::byte*>(texels.data());
  load_values(PixelType::kUint8, bytes + 1, 3, 3, green.data());
  CHECK(green[2] == 80.0f / 255.0f);
  green = {0.0f, 0.0f, 0.0f};
  store_values(PixelType::kUint8, green.data(), 3, bytes + 1, 3);
  CHECK(texels == std::array<std::uint8_t, 9>{10, 0, 30, 40, 0, 60, 70, 0, 90});
}

TEST_CASE("pixel type: every name is recognised") {
  for (const std::string name :
       {"uint8", "uint16", "uint", "int8", "int16", "int", "half", "float", "double"})
    CHECK(name_of(kPixelTypes, value_named(kPixelTypes, name).value()) == name);
  CHECK_FALSE(value_named(kPixelTypes, "float16").has_value());
}

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
