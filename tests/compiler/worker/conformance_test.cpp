// worker-check finds each fault of the fake worker, and none in a correct one.
#include "worker/conformance.hpp"

#include <algorithm>

#include <catch2/catch.hpp>

#include "compiler/worker/fake_session.hpp"

using namespace remapc;
using Catch::Matchers::Contains;
using Verdict = WorkerFinding::Verdict;

namespace {

std::vector<WorkerFinding> findings_of(const std::string& fault) {
  const FakeSession session;
  Worker worker(session.entry(fault), session.settings().limits, session.path("picture.f32"));
  return check_worker(worker, 32);
}

// Returns the results of all failed checks, `check: words`, a line each.
std::string wrong_words(const std::string& fault) {
  std::string text;
  for (const WorkerFinding& finding : findings_of(fault))
    if (finding.verdict == Verdict::kWrong) text += finding.check + ": " + finding.words + "\n";
  return text;
}

}  // namespace

TEST_CASE("worker check: a good worker passes every check") {
  const auto findings = findings_of("");
  CHECK(findings.size() >= 14);
  for (const WorkerFinding& finding : findings) {
    INFO(finding.check << ": " << finding.words);
    CHECK(finding.verdict == Verdict::kGood);
  }
}

TEST_CASE("worker check: each fault is explained") {
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

TEST_CASE("worker check: a worker that dies ends the checks with the failed request") {
  CHECK_THAT(wrong_words("die"),
             Contains("answer: worker fake, request fake/ggx") && Contains("died with signal 9"));
}
