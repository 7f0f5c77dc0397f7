// This file tests files of analytic fits: round trips, and errors that state where and what is wrong.
#include <catch2/catch.hpp>

#include "lower/fit_file.hpp"
#include "remap/error.hpp"
#include "support/replaced.hpp"

using namespace remap;

namespace {

WorkflowFit example(const WorkflowFormula& formula) {
  WorkflowFit fit{"a_to_b", {}, {}, {"A remark."}, "0.1"};
  fit.conversion.specular = {"a", DiffuseConvention::kScaled, RoughnessEncoding::kGlossiness};
  fit.conversion.metallic = {"b", 0.05, DiffuseConvention::kScaled, RoughnessEncoding::kAlpha};
  fit.conversion.formula = formula;
  return fit;
}

}  // namespace

TEST_CASE("workflow fit: every formula returns from its file") {
  for (const WorkflowFormula& formula :
       {WorkflowFormula{ClosedFormula::kEquation2}, WorkflowFormula{Projection{1e-5}},
        WorkflowFormula{ClosedFormula::kEquation3}, WorkflowFormula{ClosedFormula::kEquation3ByAlbedo},
        WorkflowFormula{ClosedFormula::kKhronos}}) {
    const WorkflowFit fit = example(formula);
    const AnyFit read = any_fit_from_json(fit_to_json(fit), "x");
    REQUIRE(std::holds_alternative<WorkflowFit>(read));
    CHECK(std::get<WorkflowFit>(read) == fit);
    CHECK(fit_id(read) == "a_to_b");
  }
}

TEST_CASE("workflow fit: a file that is wrong is refused with the place") {
  const std::string good = fit_to_json(example(Projection{1e-5}));
  const auto refuses = [&](const std::string& part, const std::string& other, const std::string& message) {
    CHECK_THROWS_WITH(any_fit_from_json(replaced(good, part, other), "f.json"),
                      Catch::StartsWith("f.json") && Catch::Contains(message));
  };
  refuses("\"projection\"", "\"guess\"", ".formula: expected equation-2, projection");
  refuses("\"prior\"", "\"prio\"", "has no field \"prior\"");
  refuses("1e-05", "-1", "prior -1 is out of range (0");
  refuses("0.05", "1.5", "dielectric F0 1.5 is out of range (0 to 0.9");
  refuses("\"scaled\"", "\"linear\"", "source.diffuse: expected plain or scaled, found \"linear\"");
  refuses("\"workflow\": \"specular\"", "\"workflow\": \"metallic\"", "expected \"specular\" on this side");
  refuses("\"glossiness\"", "\"exponent\"", "choose roughness, glossiness or alpha");
  refuses("\"a_to_b\"", "\"a to b\"", "expected at most 128 letters");
  refuses("\"version\": 4", "\"version\": 9", "format version 9");
}

TEST_CASE("workflow fit: where width and specular are expected the error says what can be done") {
  CHECK_THROWS_WITH(
      fit_from_json(fit_to_json(example(ClosedFormula::kEquation2)), "f.json"),
      Catch::StartsWith("f.json: converts whole materials") && Catch::Contains("remapc list, show and emit"));
}
