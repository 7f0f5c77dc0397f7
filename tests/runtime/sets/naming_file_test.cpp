// This file tests files that extend the naming conventions, and the errors in such files.
#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "runtime/sets/set_session.hpp"

using namespace remap;

namespace {

std::string complaint(const std::string& text) {
  try {
    parse_naming(text, "names.json");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::kInput);
    return error.what();
  }
  return "none";
}

// Returns a file with one convention that has one rule.
std::string with_rule(const std::string& rule) {
  return R"({"habits": [{"name": "x", "rules": [)" + rule + "]}]}";
}

}  // namespace

TEST_CASE("naming file: its words extend the built-in ones and take precedence") {
  const Naming naming = parse_naming(R"({
    "habits": [{"name": "ours", "camel_case": true, "resolution": "after", "rules": [
      {"words": ["srgh"], "role": "roughness"},
      {"words": ["arm"], "channels": {"R": "alpha_width", "G": "other", "B": "metallic"}}]}],
    "ignored_words": ["graded"]})",
                                     "names.json");
  CHECK(naming.read("a_srgh_2k").at(0).habit == "ours");
  CHECK(naming.read("aSrgh_graded").at(0).stem == "a");
  CHECK(naming.read("a_arm_2k").at(0).habit == "ours");
  CHECK(naming.read("a_arm_2k").at(0).meaning.at(0) == ChannelMeaning{Channels::kRed, Role::kAlphaWidth});
  CHECK(naming.read("a_Roughness").at(0).habit == "Substance Painter");
  CHECK(built_in_naming().read("a_srgh").empty());
}

TEST_CASE("naming file: is used by a search for sets") {
  const SetSession session{"wall_matt.png", "wall_shine.png"};
  write_file(session.root() / "names.json", R"({"habits": [{"name": "ours", "rules": [
    {"words": ["matt"], "role": "roughness"}, {"words": ["shine"], "role": "specular"}]}]})");
  CHECK(session.find().sets.empty());
  const Naming naming = read_naming(session.root() / "names.json");
  const Discovery found = find_sets(session.root(), {}, naming);
  const FoundSet& set = set_at(found, "wall");
  CHECK(use_text(set, set.width) == "roughness of wall_matt.png");
  CHECK(use_text(set, set.specular) == "specular of wall_shine.png");
}

TEST_CASE("naming file: errors name the field and the expected value") {
  CHECK(complaint("[") != "none");
  CHECK(complaint("[]") == "names.json: expected an object, found []");
  CHECK(complaint("{}") == "names.json: has no field \"habits\"");
  CHECK(complaint(R"({"habits": []})") == "names.json: habits: expected a list of at least 1 entry, found []");
  CHECK(complaint(R"({"habit": []})") == "names.json: unknown field 'habit' (did you mean habits?)");
  CHECK(complaint(with_rule(R"({"words": ["a"], "role": "rougness"})")) ==
        "names.json: habits[0].rules[0].role: unknown role 'rougness' (did you mean roughness?)");
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"X": "roughness"}})"))
            .find("channels: unknown field 'X'") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": [], "role": "roughness"})")) ==
        "names.json: habits[0].rules[0].words: expected a list of at least 1 entry, found []");
  CHECK(complaint(with_rule(R"({"words": ["_"], "role": "roughness"})")) ==
        "names.json: habits[0].rules[0].words[0]: expected a word, found \"_\"");
  CHECK(complaint(with_rule(R"({"words": ["4K"], "role": "roughness"})")).find("neither a resolution") !=
        std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["PNG"], "role": "roughness"})")).find("nor a format") !=
        std::string::npos);
  CHECK(complaint(R"({"habits": [{"name": "", "rules": [{"words": ["a"], "role": "ior"}]}]})") ==
        "names.json: habits[0].name: expected a name, found \"\"");
  CHECK(complaint(
            R"({"habits": [{"name": "x", "resolution": "aftr",
      "rules": [{"words": ["a"], "role": "ior"}]}]})") ==
        "names.json: habits[0].resolution: unknown place of a resolution 'aftr' (did you mean after?)");
  CHECK(complaint(R"({"habits": [{"name": "x", "camel_case": 1,
                             "rules": [{"words": ["a"], "role": "ior"}]}]})") ==
        "names.json: habits[0].camel_case: expected true or false, found 1");
  CHECK(complaint(with_rule(R"({"words": ["a"], "ordinary": "no", "role": "ior"})")) ==
        "names.json: habits[0].rules[0].ordinary: expected true or false, found \"no\"");
}

TEST_CASE("naming file: a longer word of the built-in habits wins over its words") {
  const Naming naming = parse_naming(with_rule(R"({"words": ["color"], "role": "specular"})"), "names.json");
  CHECK(naming.read("a_Base_Color").at(0).meaning.at(0).role == Role::kBaseColor);
  CHECK(naming.read("a_Color").at(0).meaning.at(0).role == Role::kSpecular);
}

TEST_CASE("naming file: rules that contradict themselves are refused") {
  CHECK(complaint(with_rule(R"({"words": ["a"]})")).find("expected either \"role\" or \"channels\"") !=
        std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "role": "ior", "channels": {"R": "ior"}})"))
            .find("expected either \"role\" or \"channels\"") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"RGB": "specular", "R": "ior"}})"))
            .find("expected RGB or its channels one by one") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"R": "roughness", "A": "glossiness"}})"))
            .find("expected at most one of roughness, glossiness and alpha_width") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"R": "specular", "G": "specular"}})"))
            .find("expected specular at most once") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a_b"], "role": "ior"}, {"words": ["A-B"], "role": "height"})")) ==
        "names.json: habits[0]: two rules for the word 'ab' (keep one)");
  CHECK(complaint(with_rule(R"({"words": ["a_b", "aB"], "role": "ior"})")) == "none");
}

TEST_CASE("naming file: a missing file is an error") {
  CHECK_THROWS_AS(read_naming("no/such/names.json"), Error);
}
