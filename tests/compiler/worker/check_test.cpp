// This file tests that adapters/check.py finds each fault of the fake worker, and no fault in a correct
// worker.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "compiler/worker/fake_session.hpp"
#include "support/process.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

ProcessResult check(const std::string& command) {
  return run({"/usr/bin/env", "python3", REMAP_SOURCE_DIR "/compiler/adapters/check.py", "--json",
              "--resolution", "24", command});
}

// Returns the results of all failed checks, `check: words`, one per line.
std::string wrong_words(const std::string& fault) {
  const FakeSession session;
  const ProcessResult result = check(session.command(fault));
  INFO(result.errors);
  CHECK(result.exit_code == 1);
  CHECK(session.nobody_is_left());
  std::string text;
  const nlohmann::json found = nlohmann::json::parse(result.output);
  for (const nlohmann::json& finding : found["findings"])
    if (finding["verdict"] == "wrong")
      text += finding["check"].get<std::string>() + ": " + finding["words"].get<std::string>() + "\n";
  return text;
}

}  // namespace

TEST_CASE("check.py: a good worker passes every check", "[slow]") {
  const FakeSession session;
  const ProcessResult result = check(session.command());
  INFO(result.output << result.errors);
  CHECK(result.exit_code == 0);
  const nlohmann::json found = nlohmann::json::parse(result.output);
  CHECK(found["renderer"] == "Fake 1");
  CHECK(found["wrong"] == 0);
  CHECK(found["findings"].size() >= 14);
  for (const nlohmann::json& finding : found["findings"]) {
    CHECK(finding["model"] == "fake/ggx");
    CHECK(finding["verdict"] == "good");
  }
}

TEST_CASE("check.py: a worker that shows maps passes, and maps and light in wrong places are found",
          "[slow]") {
  const FakeSession session;
  const ProcessResult result = check(session.command("textures"));
  INFO(result.output << result.errors);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("light front"));
  CHECK_THAT(wrong_words("textures-flipped"), Contains("map top: the top of a map is not at the top"));
  CHECK_THAT(wrong_words("textures-behind"), Contains("light front: the +z of an environment"));
}

TEST_CASE("check.py: the example passes") {
  CHECK(check("python3 " REMAP_SOURCE_DIR "/examples/lambert_worker.py").exit_code == 0);
}

TEST_CASE("check.py: each fault is explained", "[slow]") {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"bright", "light scale: diffuse light is 3.142 times as strong as it should be (pi)"},
      {"no-square", "inverse square: a light twice as far is 1 times as bright"},
      {"gamma", "linearity: half the diffuse gives 0.73"},
      {"eight-bit", "precision: values have 8 bits"},
      {"grey-background", "background: pixels outside the sphere are up to 0.0"},
      {"mirrored", "orientation: a light at +60 degrees lights the left of the picture"},
      {"transposed", "rows and columns are exchanged"},
      {"shifted", "symmetry: under a headlight the upper and lower halves differ"},
      {"jitter", "pixel centres: pixels differ by"},
      {"unrepeatable", "repeatability: the same request gives pictures that differ"},
      {"noise", "noise: another seed gives a picture that differs"},
      {"channels", "color: channel 0 differs"},
      {"inverted", "width: highlights do not widen"},
  };
  for (const auto& [fault, words] : faults) {
    INFO(fault);
    CHECK_THAT(wrong_words(fault), Contains(words));
  }
}

TEST_CASE("check.py: a worker that dies, answers nonsense or refuses is named with what it said", "[slow]") {
  CHECK_THAT(wrong_words("die"), Contains("answer: died with signal 9; last lines of its log: rendering"));
  CHECK_THAT(wrong_words("garbage"), Contains("this is not the answer to request 2: 'Saved: picture.exr'"));
  CHECK_THAT(wrong_words("refuse"), Contains("answer: no licence left"));
  CHECK_THAT(wrong_words("nan"), Contains("must be finite"));
  CHECK_THAT(wrong_words("short"), Contains("values, not 576"));
}
