// This file compares pixel types with Imath's half and with integer arithmetic.
#include <Imath/half.h>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

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
