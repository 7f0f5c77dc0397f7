// This file tests the scanner against the JSON library, and edits that move no other byte.
#include "core/json_spans.hpp"

#include <optional>
#include <random>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "assets/document/text_edits.hpp"
#include "core/json_field.hpp"
#include "remap/error.hpp"
#include "support/error_of.hpp"

using namespace remap;

namespace {

bool is_scanned(const std::string& text) {
  try {
    (void)SpannedJson(text, "text");
    return true;
  } catch (const Error&) {
    return false;
  }
}

// Returns nothing if the library refuses a number because no double can hold it.
std::optional<bool> is_parsed(const std::string& text) {
  try {
    return !nlohmann::json::parse(text).is_discarded();
  } catch (const nlohmann::json::out_of_range&) {
    return std::nullopt;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

std::string failure_of(const std::string& text) {
  return error_of([&] { (void)SpannedJson(text, "a.gltf"); });
}

}  // namespace

TEST_CASE("The scanner takes the texts that the JSON library takes", "[assets]") {
  std::istringstream texts(
      "\n \n{}\n[]\nnull\ntrue\ntru\ntruee\n-\n-0\n01\n1.\n1.5\n.5\n1e5\n1E+5\n1e\n1e+\n-1.5e-3\n[1,]\n"
      "[,1]\n{\"a\"}\n{\"a\":}\n{\"a\":1,}\n{a:1}\n{\"a\":1}{\n\"a\n\"\\x\"\n\"\\u12\"\n\"\\u00e9\"\n"
      "\"\\ud83d\\ude00\"\n\"\\ud83d\"\n\"\\ude00\"\n\"\xc3\xa9\"\n\"\xc3\"\n\"\xc0\x80\"\n"
      "\"\xed\xa0\x80\"\n\"\xf4\x90\x80\x80\"\n\"\xf0\x9f\x98\x80\"\n\"\t\"\n[1 2]\n[1,2] x\n\"\\/\"\n"
      "{\"a\":1,\"a\":2}\n\xef\xbb\xbf{}\n\xef\xbb{}\nnul\n[\"\\\"]\n\"\x7f\"\n");
  for (std::string text; std::getline(texts, text);) {
    CAPTURE(text);
    CHECK(is_scanned(text) == is_parsed(text));
  }
}

TEST_CASE("The scanner and the JSON library agree on damaged texts", "[assets]") {
  const std::string whole =
      R"({"a": [1, -2.5e3, true, null, "x\u00e9\n"], "b\/": {"c": {}, "d": []}, "e": 9007199254740993})";
  std::mt19937 random(1);
  const std::string bytes = "{}[],:\"\\u0e19-+.tfn \xc3\xa9";
  std::size_t taken = 0;
  for (int i = 0; i < 10000; ++i) {
    std::string text = whole;
    for (std::size_t changes = random() % 3 + 1; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const char byte = bytes[random() % bytes.size()];
      if (random() % 3 == 0)
        text.erase(at, 1);
      else if (random() % 2 == 0)
        text.insert(at, 1, byte);
      else
        text[at] = byte;
    }
    CAPTURE(text);
    REQUIRE(is_scanned(text) == is_parsed(text).value_or(is_scanned(text)));
    taken += is_scanned(text);
  }
  CHECK(taken > 250);
}

TEST_CASE("Spans, keys and numbers of values", "[assets]") {
  const std::string text =
      "\xef\xbb\xbf{ \"a\\u0062\" : [1.50, 2e2] , \"ab\": \"x\\ud83d\\ude00\", \"n\":9007199254740993}";
  const SpannedJson json(text, "text");
  CHECK(json.root().find("ab").raw() == "\"x\\ud83d\\ude00\"");
  CHECK(json.root().find("ab").text() == "x\xf0\x9f\x98\x80");
  CHECK(json.root().children()[0].key() == "ab");
  CHECK(json.root().children()[0].children()[1].whole() == 200u);
  CHECK(json.root().children()[0].children()[0].raw() == "1.50");
  CHECK(json.root()["n"].raw() == "9007199254740993");
  CHECK_FALSE(json.root()["missing"]["deeper"]);
  CHECK(json.root().size() == 3);
}

TEST_CASE("Faults of a text are named by line and column", "[assets]") {
  CHECK(failure_of("{\n  \"a\": tru\n}") == "a.gltf: invalid JSON at line 2, column 8: expected a value");
  CHECK(failure_of("{\"a\": [1, 2") == "a.gltf: invalid JSON at line 1, column 12: the text ends too early");
  CHECK(failure_of(std::string(10000, '[')) ==
        "a.gltf: invalid JSON at line 1, column 101: nested deeper than 100 levels");
}

TEST_CASE("Edits move no other byte", "[assets]") {
  const std::string text = "{ \"a\" : 1.50 ,\n  \"b\" : [1, 2,3], \"c\":{}, \"b\": [ 4 ]\n}";
  const auto edited = [&](const auto& edit) {
    const SpannedJson json(text, "text");
    TextEdits edits(json);
    edit(json.root(), edits);
    return edits.result();
  };
  CHECK(edited([](SpanValue, TextEdits&) {}) == text);
  CHECK(edited([](SpanValue root, TextEdits& edits) { edits.set_member(root, "a", "2"); }) ==
        "{ \"a\" : 2 ,\n  \"b\" : [1, 2,3], \"c\":{}, \"b\": [ 4 ]\n}");
  CHECK(edited([](SpanValue root, TextEdits& edits) { edits.set_member(root, "d", "2"); }) ==
        "{ \"a\" : 1.50 ,\n  \"b\" : [1, 2,3], \"c\":{}, \"b\": [ 4 ], \"d\": 2\n}");
  CHECK(edited([](SpanValue root, TextEdits& edits) { edits.remove_members(root, "a"); }) ==
        "{ \"b\" : [1, 2,3], \"c\":{}, \"b\": [ 4 ]\n}");
  CHECK(edited([](SpanValue root, TextEdits& edits) { edits.remove_members(root, "b"); }) ==
        "{ \"a\" : 1.50, \"c\":{}\n}");
  CHECK(edited([](SpanValue root, TextEdits& edits) {
          edits.remove_members(root, "b");
          edits.remove_members(root, "a");
          edits.append_member(root["c"], "x", "null");
          edits.append_member(root, "y", "[]");
        }) == "{ \"c\":{\"x\":null}, \"y\": []\n}");
  CHECK(edited([](SpanValue root, TextEdits& edits) {
          for (const SpanValue& member : root.children()) edits.remove(member);
          edits.append_member(root, "y", "[]");
          edits.append_member(root, "z", "1");
        }) == "{ \"y\": [], \"z\": 1\n}");
  CHECK(edited([](SpanValue root, TextEdits& edits) {
          edits.remove(root.children()[1].children()[0]);
          edits.remove(root.children()[1].children()[2]);
          edits.append_entry(root.children()[1], "5");
          edits.append_entry(root["b"], "5");
        }) == "{ \"a\" : 1.50 ,\n  \"b\" : [2,5], \"c\":{}, \"b\": [ 4, 5 ]\n}");
}

TEST_CASE("Random edits give what the JSON library makes of the same changes", "[assets]") {
  std::mt19937 random(2);
  for (int run = 0; run < 2000; ++run) {
    std::string text = "{";
    const std::size_t count = random() % 5;
    for (std::size_t i = 0; i < count; ++i)
      text += (i == 0 ? "" : ",") + std::string(random() % 3, ' ') + "\"k" + std::to_string(i) + "\"" +
              std::string(random() % 2, '\n') + ":" + std::to_string(i) + std::string(random() % 2, ' ');
    text += std::string(random() % 3, '\t') + "}";
    const SpannedJson json(text, "text");
    TextEdits edits(json);
    Json expected = parse_json(text, "text");
    for (std::size_t i = 0; i < count; ++i) {
      const std::string key = "k" + std::to_string(i);
      if (random() % 3 == 0) {
        edits.remove_members(json.root(), key);
        expected.erase(key);
      } else if (random() % 3 == 0) {
        edits.set_member(json.root(), key, "[true]");
        expected[key] = Json::list({true});
      }
    }
    for (std::size_t i = random() % 3; i > 0; --i) {
      edits.append_member(json.root(), "n" + std::to_string(i), "\"x\"");
      expected["n" + std::to_string(i)] = "x";
    }
    CAPTURE(text, edits.result());
    REQUIRE(parse_json(edits.result(), "text").dump() == expected.dump());
  }
}
