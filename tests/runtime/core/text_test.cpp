// This file tests numbers as text, and names that are similar.
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "remap/error.hpp"
#include "support/build_speed.hpp"
#include "support/error_of.hpp"

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
  CHECK(nearest_name("--out", std::vector<std::string>{"--fit", "--force", "--output"}) == "--output");
  CHECK(nearest_name("--out", std::vector<std::string>{"--fit"}).empty());
  CHECK(nearest_names("ggx", {"glb", "mitsuba/ward", "mitsuba/ggx"}, 5) ==
        std::vector<std::string>{"mitsuba/ggx"});
  CHECK(suggestion("renderman", names) == " (choose mitsuba/ward, mitsuba/ggx, cycles-5/ggx)");
}

TEST_CASE(
    "plain text: controls, marks of direction and what is no UTF-8 are refused, and written as escapes") {
  for (const std::string good : {"", "a b", "\xc3\xbc", "\xe2\x82\xac", "\xf0\x9f\x98\x80", "\\x1b"}) {
    CHECK(is_plain_text(good));
    CHECK(plain(good) == good);
  }
  const std::vector<std::pair<std::string, std::string>> bad = {{"a\nb", "a\\x0ab"},
                                                                {std::string(1, '\0'), "\\x00"},
                                                                {"\x1b[2J", "\\x1b[2J"},
                                                                {"\x7f", "\\x7f"},
                                                                {"\xc2\x9b", "\\u009b"},
                                                                {"\xe2\x80\xae", "\\u202e"},
                                                                {"\xe2\x81\xa6", "\\u2066"},
                                                                {"\xe2\x80\xa8", "\\u2028"},
                                                                {"\xd8\x9c", "\\u061c"},
                                                                {"\xff", "\\xff"},
                                                                {"\xc0\x80", "\\xc0\\x80"},
                                                                {"\xe2\x82", "\\xe2\\x82"},
                                                                {"\xed\xa0\x80", "\\xed\\xa0\\x80"}};
  for (const auto& [text, escaped] : bad) {
    CHECK_FALSE(is_plain_text(text));
    CHECK(plain(text) == escaped);
    CHECK(is_plain_text(plain(text)));
  }
}

TEST_CASE("plain text: a text without end is cut, and no character is cut in two") {
  CHECK(plain("abcdef", 6) == "abcdef");
  CHECK(plain("abcdefg", 6) == "abc...");
  CHECK(plain("ab\xc3\xbc\xc3\xbc\xc3\xbc", 6) == "ab...");
  CHECK(plain("\x1b\x1b\x1b", 8) == "\\x1b...");
  CHECK(plain(std::string(5'000'000, 'x')).size() == kLongestMessage);
}

TEST_CASE("parse JSON: nested deeper than 100 levels is refused, whatever the depth") {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  CHECK_NOTHROW(parse_json(nested(100), "x.json"));
  for (const std::size_t depth : {101u, 65'700u, 10'000'000u}) {
    CHECK_THROWS_WITH(parse_json(nested(depth), "x.json"),
                      "x.json: invalid JSON at line 1, column 101: nested deeper than 100 levels");
    CHECK_THROWS_WITH(parse_json("{\"a\": " + nested(depth) + "}", "x.json"), Catch::Contains("100 levels"));
  }
  CHECK_NOTHROW(parse_json("\"" + std::string(200, '[') + "\\\"" + std::string(200, '{') + "\"", "x.json"));
  CHECK_NOTHROW(parse_json("[" + std::string(300, ' ') + "[[]], [[]], {}]", "x.json"));
}

TEST_CASE("parse JSON: a message does not repeat a text without end") {
  const std::string message = error_of([] { parse_json("[\"" + std::string(1'000'000, 'x'), "x.json"); });
  CHECK((message.size() > 0 && message.size() < 400));
  CHECK_THROWS_WITH(parse_json(std::string(kLongestJson + 1, ' '), "x.json"),
                    "x.json: has 64 MB of JSON; at most 64 MB can be read");
}

TEST_CASE("JSON: the bytes of texts that are not UTF-8 are written beside them") {
  const Json lost = {
      {"path", "caf\xe9"}, {"inputs", Json::list({"a", "\xff", nullptr})}, {"name", "caf\xc3\xa9"}};
  CHECK(lost.dump() ==
        "{\"path\":\"caf\xef\xbf\xbd\",\"path_base64\":\"Y2Fm6Q==\",\"inputs\":[\"a\",\"\xef\xbf\xbd\",null],"
        "\"inputs_base64\":[\"YQ==\",\"/w==\",null],\"name\":\"caf\xc3\xa9\"}");
}

TEST_CASE("JSON: objects of many fields are read and written in seconds, in their order") {
  constexpr std::size_t kFields = 160'000;
  std::string text = "{";
  for (std::size_t i = 0; i < kFields; ++i) text += "\"k" + std::to_string(i) + "\":0,";
  const double seconds = seconds_of([&] {
    const Json json = parse_json(text + "\"k3\":1,\"last\":{\"k3\":2}}", "x.json");
    CHECK(json.size() == kFields + 1);
    CHECK(json.fields()->at(3).second.whole() == 1);
    CHECK(json.fields()->at(kFields - 1).first == "k" + std::to_string(kFields - 1));
    CHECK(json.find("last")->dump() == "{\"k3\":2}");
    CHECK(json.dump().size() == text.size() + std::string("\"last\":{\"k3\":2}}").size());
  });
  CHECK(seconds < (kSlowBuild ? 20.0 : 4.0));
}

TEST_CASE("text: parts between separators may be empty") {
  CHECK(parts_between("a,,b", ',') == std::vector<std::string>{"a", "", "b"});
  CHECK(parts_between("", ',') == std::vector<std::string>{""});
  CHECK(parts_between("a;", ';') == std::vector<std::string>{"a", ""});
}

TEST_CASE("JSON field: texts and names of fields hold no control characters") {
  for (const std::string bad : {"a\\nb", "a\\u0000b", "a\\u202eb", "a\\u0085b"}) {
    const auto json = parse_json("{\"text\": \"" + bad + "\", \"map\": {\"" + bad + "\": \"x\"}}", "x.json");
    const Field field(json, "x.json");
    CHECK_THROWS_WITH(field["text"].text(),
                      Catch::Contains("x.json: text: expected a text of one line without "
                                      "control characters, found "));
    CHECK_THROWS_WITH(field["map"].text_dictionary(), Catch::Contains("found the name \"a\\"));
  }
}
