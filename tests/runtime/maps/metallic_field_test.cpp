// The field for cases with a known answer: constants, ramps, holes.
#include "maps/metallic_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

using namespace remap;

namespace {

constexpr float kSure = 0.05f, kGuess = 0.5f;

// `texel(x, y)` returns metallic and metallic_width.
template <typename Texel>
bool fill(MetallicField& field, std::size_t width, std::size_t height, const Texel& texel) {
  std::vector<float> metallic(width), metallic_width(width);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) std::tie(metallic[x], metallic_width[x]) = texel(x, y);
    field.add(0, y, width, metallic.data(), metallic_width.data(), nullptr);
  }
  return field.fill();
}

std::vector<float> row(const MetallicField& field, std::size_t y, std::size_t width) {
  std::vector<float> values(width);
  field.read(y, width, values.data());
  return values;
}

using Pair = std::pair<float, float>;

}  // namespace

TEST_CASE("metallic field: one reliable texel fills the field") {
  const auto width = GENERATE(as<std::size_t>{}, 1, 5, 77), height = GENERATE(as<std::size_t>{}, 1, 50);
  MetallicField field(width, height);
  REQUIRE(fill(field, width, height, [&](std::size_t x, std::size_t y) {
    return x == width / 2 && y == height / 2 ? Pair{0.75f, kSure} : Pair{0.1f, kGuess};
  }));
  for (std::size_t y = 0; y < height; ++y)
    for (const float value : row(field, y, width)) REQUIRE(value == Approx(0.75f));
}

TEST_CASE("metallic field: a ramp is preserved") {
  constexpr std::size_t kSize = 256;
  MetallicField field(kSize, kSize);
  REQUIRE(fill(field, kSize, kSize, [](std::size_t x, std::size_t) {
    return Pair{(static_cast<float>(x) + 0.5f) / kSize, kSure};
  }));
  const std::vector<float> values = row(field, 100, kSize);
  for (std::size_t x = 4; x < kSize - 4; ++x)
    REQUIRE(values[x] == Approx((static_cast<double>(x) + 0.5) / kSize).margin(1e-4));
}

TEST_CASE("metallic field: a hole between metal and plastic is filled smoothly") {
  constexpr std::size_t kSize = 256, kBegin = 64, kEnd = 192;
  MetallicField field(kSize, kSize);
  REQUIRE(fill(field, kSize, kSize, [](std::size_t x, std::size_t y) {
    const bool hole = x >= kBegin && x < kEnd;
    return hole ? Pair{static_cast<float>((x + y) % 2), kGuess} : Pair{x < kBegin ? 0.0f : 1.0f, kSure};
  }));
  const std::vector<float> values = row(field, 128, kSize);
  CHECK(values[kBegin - 8] == Approx(0.0f).margin(1e-6));
  CHECK(values[kEnd + 8] == Approx(1.0f).margin(1e-6));
  CHECK(values[kSize / 2] == Approx(0.5f).margin(0.1));
  for (std::size_t x = 1; x < kSize; ++x) {
    REQUIRE(values[x] >= values[x - 1] - 1e-6f);
    REQUIRE(values[x] - values[x - 1] < 0.2f);
  }
}

TEST_CASE("metallic field: a field without reliable texels is reported, and masked texels do not count") {
  constexpr std::size_t kSize = 16;
  const float kNan = std::numeric_limits<float>::quiet_NaN();
  MetallicField guesses(kSize, kSize);
  CHECK_FALSE(fill(guesses, kSize, kSize, [&](std::size_t x, std::size_t) {
    return Pair{0.5f, x % 2 == 0 ? kGuess : kNan};
  }));
  MetallicField field(kSize, 1);
  std::vector<float> metallic(kSize, 1.0f), sure(kSize, kSure), coverage(kSize, 0.0f);
  coverage[3] = 1.0f;
  metallic[3] = 0.25f;
  field.add(0, 0, kSize, metallic.data(), sure.data(), coverage.data());
  REQUIRE(field.fill());
  for (const float value : row(field, 0, kSize)) CHECK(value == Approx(0.25f));
}

TEST_CASE("metallic field: a map of any shape takes about a million cells") {
  constexpr std::size_t kWidth = 40000;
  MetallicField field(kWidth, 2);
  REQUIRE(fill(field, kWidth, 2, [](std::size_t, std::size_t) { return Pair{0.5f, kSure}; }));
  const std::vector<float> values = row(field, 1, kWidth);
  CHECK(*std::min_element(values.begin(), values.end()) == Approx(0.5f));
  CHECK(*std::max_element(values.begin(), values.end()) == Approx(0.5f));
}
