// Numbers as text, and names that are near.
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"
#include "text/number_text.hpp"

using namespace remap;

TEST_CASE("number text: any double reads back as itself") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    REQUIRE(parse_number(number_text(value)) == value);
  }
}

TEST_CASE("float literal: reads back as itself and is always a float") {
  CHECK(float_literal(1.0f) == "1.0f");
  CHECK(float_literal(0.1f) == "0.1f");
  CHECK(float_literal(-1e-20f) == "-1e-20f");
  CHECK(float_literal(16777216.0f) == "16777216.0f");
  CHECK_THROWS_AS(float_literal(std::numeric_limits<float>::infinity()), Error);
  CHECK_THROWS_AS(float_literal(std::numeric_limits<float>::quiet_NaN()), Error);
}

TEST_CASE("parse number: the whole text or nothing") {
  CHECK(parse_number("+1e-3") == 1e-3);
  for (const std::string bad : {"", "1 ", " 1", "1,0", "0x1", "1e", "--1"})
    CHECK_FALSE(parse_number(bad).has_value());
}

TEST_CASE("rounded up: an error figure is never made smaller") {
  CHECK(rounded_up(0.00141, 2) == 0.0015);
  CHECK(rounded_up(0.0014, 2) == 0.0014);
  CHECK(rounded_up(0.07, 1) == 0.07);
  CHECK(rounded_up(-123.0, 2) == -130.0);
  CHECK(rounded_up(0.0, 2) == 0.0);
}

TEST_CASE("nearest name: a slip is forgiven, another word is not") {
  const std::vector<std::string> names = {"mitsuba/ward", "mitsuba/ggx", "cycles-5/ggx"};
  CHECK(nearest_name("mitsuba/wrad", names) == "mitsuba/ward");
  CHECK(nearest_name("mitsuba/gx", names) == "mitsuba/ggx");
  CHECK(nearest_name("renderman", names).empty());
  CHECK(suggestion("renderman", names) == " (choose mitsuba/ward, mitsuba/ggx, cycles-5/ggx)");
}
