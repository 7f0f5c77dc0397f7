// This file tests fit files: exact round trips, size limits, and every error with its place.
#include <cmath>

#include <catch2/catch.hpp>

#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "support/example_fit.hpp"
#include "support/replaced.hpp"

using namespace remap;

namespace {

Fit sample_fit() {
  Fit fit;
  fit.id = "a_b_to_c_d";
  fit.source = {"a/b", RoughnessEncoding::kAlpha, "specular"};
  fit.target = {"c/d", RoughnessEncoding::kExponent, "f0"};
  fit.domain = {{1.0 / 3.0 * 0.1, 0.99}, {0.0, 0.7}};
  fit.mapping =
      Parametric{{{1.0 / 3.0, -0.1, 1e-17, 0.25}, {0.5}},
                 {{0, {0.1, 0.0, 0.0, 0.0, 0.0, 1e-3}}, {1, {1.1, -0.5, 0.0, 1.0 / 7.0, 3.0, 0.0}}}};
  fit.method = {{"form", "paper"}, {"starts", "4"}};
  CandidateRecord candidate;
  candidate.name = "svr";
  candidate.number_count = 33;
  candidate.alpha = {1e-3, 2e-3, 1.0 / 7.0};
  candidate.relative_alpha = 0.01;
  candidate.verdict = "no better, and more numbers";
  fit.candidates = {candidate};
  fit.alpha_error = {1e-4, 2e-4, 3e-4};
  fit.specular_error = {4e-4, 5e-4, 6e-4};
  fit.split = {42, 0.2, 80, 20, {{"clamped", 3}}};
  fit.table = {"t.csv", "00ff", {{"objective", "natural"}}};
  fit.image_error = ErrorFigures{0.05, 0.1, 0.2};
  fit.ssim = {{0.1, 0.99}, {0.5, 0.97}};
  fit.remarks = {"one", "two"};
  fit.tool_version = "0.1.0";
  return fit;
}

Fit svr_fit() {
  Fit fit = sample_fit();
  const Scaling alpha{0.1, 1.0 / 3.0, 0.05}, specular{0.0, 2.0, 0.0}, output{0.5, 0.25, 0.0};
  fit.mapping = Svr{{{alpha}, output, 2.5, -0.125, {0.1, 0.7}, {1.0 / 9.0, -3.0}},
                    {{alpha, specular}, output, 1e-3, 0.0, {0.1, 0.2, 0.3, 0.4}, {5.0, 1e-300}}};
  return fit;
}

Fit mlp_fit() {
  Fit fit = sample_fit();
  const Scaling alpha{0.1, 1.0 / 3.0, 0.05}, specular{0.0, 2.0, 0.0}, output{0.5, 0.25, 0.0};
  const Network of_alpha{
      Activation::kSilu, {alpha}, {output}, {{1, {0.5, -1.0 / 3.0}, {0.1, 0.2}}, {2, {1.0, 2.0}, {0.3}}}};
  const Network of_both{Activation::kSilu, {alpha, specular}, {output}, {{2, {0.25, 1e-17}, {0.0}}}};
  fit.mapping = Mlp{of_alpha, of_both};
  return fit;
}

Fit compact_fit() {
  Fit fit = sample_fit();
  CompactForm form;
  form.pole = 0.3f;
  form.alpha = {{1.1f, -0.2f}, {0.05f}};
  form.specular = {{0.9f, 1e-7f, 0.25f}, {0.125f, 3.0f}};
  form.alpha_limit = 0.9f;
  form.specular_limit = 1.0f;
  form.hinge = {-0.5f, 0.25f, 0.5f, 0.1f};
  fit.mapping = form;
  fit.limits = {0.9, 1.0};
  fit.pictures = PictureErrors{5.5, 0.125};
  fit.copied_pictures = PictureErrors{9.0, 1.0 / 3.0};
  fit.candidates.front().pictures = PictureErrors{5.5, 0.1};
  return fit;
}

}  // namespace

TEST_CASE("fit file: what is written is read back bit for bit, of every kind") {
  for (const Fit& fit : {sample_fit(), svr_fit(), mlp_fit(), compact_fit()}) {
    const std::string json = fit_to_json(fit);
    CHECK(fit_from_json(json, "x.json") == fit);
    CHECK(fit_to_json(fit_from_json(json, "x.json")) == json);
  }
}

TEST_CASE("fit file: the converter is read back bit for bit; one of another mapping is refused") {
  const auto read = [](const std::string& text) { return fit_from_json(text, "x.json"); };
  for (Fit fit : {example_fit(), compact_fit()}) {
    const std::string unlowered = fit_to_json(fit);
    CHECK_THROWS_WITH(read(replaced(unlowered, "\"converter\"", "\"converted\"")),
                      Catch::Contains("holds no converter") && Catch::Contains("run remapc fit again"));
    add_converter(&fit);
    const std::string json = fit_to_json(fit);
    CHECK(read(json) == fit);
    CHECK(read(json).converter->form == fit.converter->form);
    Fit other = fit;
    other.domain.alpha.max *= 0.99;
    other.converter.reset();
    add_converter(&other);
    CHECK_NOTHROW(read(fit_to_json(other)));
    other.converter = fit.converter;
    other.mapping = Parametric{{{0.9, 0.05}}, {{1, {0.8, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
    CHECK_THROWS_WITH(read(fit_to_json(other)), Catch::Contains("x.json: converter: does not belong"));
    other = fit;
    other.id = "another_fit";
    CHECK_THROWS_WITH(read(fit_to_json(other)), Catch::Contains("x.json: converter: does not belong"));
  }
}

TEST_CASE("fit file: complaints about support vectors and networks name the field") {
  const auto read = [](const std::string& text) { return fit_from_json(text, "x.json"); };
  const std::string svr = fit_to_json(svr_fit()), mlp = fit_to_json(mlp_fit());
  CHECK_THROWS_WITH(read(replaced(svr, "\"gamma\": 2.5", "\"gamma\": -2.5")),
                    Catch::Contains("x.json: mapping.alpha.gamma"));
  CHECK_THROWS_WITH(read(replaced(svr, "\"pole\": 0.05", "\"pole\": -0.05")),
                    Catch::Contains("x.json: mapping.alpha.inputs"));
  CHECK_THROWS_WITH(read(replaced(mlp, "\"silu\"", "\"sine\"")), Catch::Contains("x.json: mapping"));
  CHECK_THROWS_WITH(read(replaced(mlp, "\"weights\"", "\"wights\"")),
                    Catch::Contains("has no field \"weights\""));
}

TEST_CASE("fit file: complaints about forms and limits name the field") {
  const auto read = [](const std::string& text) { return fit_from_json(text, "x.json"); };
  const std::string compact = fit_to_json(compact_fit());
  CHECK_THROWS_WITH(read(replaced(compact, "\"pole\": 0.3", "\"pole\": 0.0")),
                    Catch::Contains("x.json: mapping.pole: expected a number above 0"));
  CHECK_THROWS_WITH(read(replaced(compact, "\"specular_limit\": 1.0", "\"specular_limit\": -1.0")),
                    Catch::Contains("x.json: mapping.specular_limit: expected a number above 0"));
  CHECK_THROWS_WITH(read(replaced(compact, "\"limits\"", "\"limit\"")), Catch::Contains("limits"));
}

TEST_CASE("fit file: complaints name the file and the field") {
  const std::string json = fit_to_json(sample_fit());
  const auto read = [](const std::string& text) { return fit_from_json(text, "x.json"); };
  CHECK_THROWS_WITH(read("{"), Catch::StartsWith("x.json: invalid JSON"));
  CHECK_THROWS_WITH(read("[]"), Catch::StartsWith("x.json: expected "));
  CHECK_THROWS_WITH(read(replaced(json, "remap-fit", "other")), Catch::Contains("not a fit file"));
  CHECK_THROWS_WITH(read(replaced(json, "\"version\": 4", "\"version\": 2")),
                    Catch::Contains("format version 2, but this program reads version 4"));
  CHECK_THROWS_WITH(read(replaced(json, "\"seed\"", "\"sed\"")), "x.json: split: has no field \"seed\"");
  CHECK_THROWS_WITH(read(replaced(json, "\"a_b_to_c_d\"", "\"a b\"")),
                    Catch::StartsWith("x.json: id: expected at most 128 letters"));
  CHECK_THROWS_WITH(read(replaced(json, "\"exponent\"", "\"sharpness\"")),
                    Catch::Contains("x.json: target.roughness"));
  CHECK_THROWS_WITH(read(replaced(json, "\"parametric\"", "\"magic\"")),
                    Catch::Contains("x.json: mapping.kind"));
  CHECK_THROWS_WITH(read(replaced(json, "\"ramp\": -0.5", "\"ramp\": \"x\"")),
                    Catch::Contains("expected a number"));
  CHECK_THROWS_WITH(read(replaced(json, "\"ramp_rate\": 0.0", "\"ramp_rate\": -1.0")),
                    Catch::Contains("a rate from 0"));
  CHECK_THROWS_WITH(read(replaced(json, "\"a/b\"", "\"a\\\"; b\"")),
                    Catch::Contains("letters, digits and _ - . /"));
  CHECK_THROWS_WITH(read(replaced(json, "\"f0\"", "\"alpha\"")), Catch::Contains("names no width"));
  CHECK_THROWS_WITH(read(replaced(json, "\"natural\"", "\"a\\nint b;\"")),
                    Catch::Contains("a text of one line"));
  CHECK_THROWS_WITH(read(replaced(json, "0.99", "0.001")), Catch::Contains("min < max"));
}

TEST_CASE("fit file: numbers that are not finite are never written") {
  Fit fit = sample_fit();
  std::get<Parametric>(fit.mapping).specular[1].factor.ramp = NAN;
  CHECK_THROWS_WITH(fit_to_json(fit), Catch::Contains("not finite"));
}

TEST_CASE("id: models become an identifier") {
  CHECK(converter_id("mitsuba/ward", "cycles-5/ggx") == "mitsuba_ward_to_cycles_5_ggx");
  CHECK(converter_id("threejs-r187/standard", "a//b") == "threejs_r187_standard_to_a_b");
  CHECK(is_valid_id("mitsuba_ward_to_mitsuba_as"));
  for (const std::string bad : {"", "1a", "a-b", "int", "_a", "a__b", "a b"}) CHECK_FALSE(is_valid_id(bad));
}

TEST_CASE("fit file: ids that C++ or a file system uses itself are refused, and a long one is not repeated") {
  const std::string json = fit_to_json(sample_fit());
  const auto read = [&](const std::string& id) {
    return fit_from_json(replaced(json, "\"a_b_to_c_d\"", "\"" + id + "\""), "x.json");
  };
  for (const std::string bad : {"std", "std2", "posix", "remap", "linux", "unix", "NULL", "namespace",
                                "co_await", "_a", "a__b", "9a", "a b", "a-b", ""})
    CHECK_THROWS_WITH(read(bad), Catch::StartsWith("x.json: id: expected " + std::string(kIdRule)));
  for (const std::string good : {"standard", "std_to_a", "posixy", "a"}) CHECK(read(good).id == good);
  CHECK(read(std::string(kLongestName, 'a')).id.size() == kLongestName);
  for (const std::size_t length : {kLongestName + 1, std::size_t{100'000}}) try {
      read(std::string(length, 'a'));
      FAIL("accepted");
    } catch (const Error& error) {
      CHECK(std::string(error.what()).size() < 250);
    }
}

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

namespace {

// Returns the message of oversize() for a fit with this mapping. Checks that writing this fit fails with the
// same message, or succeeds if there is none.
std::string refusal(const MappingKind& mapping) {
  Fit fit = example_fit();
  fit.mapping = mapping;
  const std::string fault = oversize(fit);
  if (fault.empty())
    CHECK(fit_from_json(fit_to_json(fit), "x.json") == fit);
  else
    CHECK_THROWS_WITH(fit_to_json(fit), fit.id + ": " + fault);
  return fault;
}

Parametric parametric(std::size_t rows, std::size_t columns, std::size_t terms) {
  return {std::vector<std::vector<double>>(rows, std::vector<double>(columns, 0.01)),
          std::vector<SpecularTerm>(terms)};
}

Svr svr(std::size_t vectors) {
  const KernelExpansion expansion{
      {{}}, {}, 1.0, 0.0, std::vector<double>(vectors, 0.5), std::vector<double>(vectors, 0.1)};
  return {expansion, expansion};
}

Mlp mlp(std::size_t layers, std::size_t units) {
  Network network{Activation::kTanh, {{}}, {{}}, {}};
  for (std::size_t i = 0, width = 1; i < layers; ++i) {
    const std::size_t own = i + 1 < layers ? units : 1;
    network.layers.push_back({width, std::vector<double>(width * own, 0.1), std::vector<double>(own, 0.1)});
    width = own;
  }
  return {network, network};
}

}  // namespace

TEST_CASE("limits: a fit at its limit is written and read, one beyond it is refused with both numbers") {
  CHECK(refusal(parametric(kMostSpecularPowers, kMostAlphaPowers, kMostTerms)).empty());
  CHECK(refusal(parametric(17, 1, 1)) ==
        "has 17 powers of specular in its roughness; at most 16 are possible");
  CHECK(refusal(parametric(1000, 1000, 1)).starts_with("has 1000 powers of specular"));
  CHECK(refusal(parametric(1, 100'000, 1)) ==
        "has 100000 powers of alpha in its roughness; at most 32 are possible");
  CHECK(refusal(parametric(1, 1, 65)) == "has 65 terms of specular; at most 64 are possible");
  CHECK(refusal(svr(kMostVectors)).empty());
  CHECK(refusal(svr(4097)) == "has 4097 support vectors; at most 4096 are possible");
  CHECK(refusal(mlp(kMostLayers, 60)).empty());
  CHECK(refusal(mlp(3000, 1)) == "has 3000 layers; at most 6 are possible");
  CHECK(refusal(mlp(3, 150)) == "has 23105 numbers in a network; at most 20000 are possible");
  CompactForm form;
  form.alpha.resize(16, {1.0f});
  CHECK(refusal(form).empty());
  form.alpha.resize(17, {1.0f});
  CHECK(refusal(form) == "has 17 powers of t; at most 16 are possible");
  form.alpha = {std::vector<float>(33, 1.0f)};
  CHECK(refusal(form) == "has 33 powers of alpha; at most 32 are possible");
}

TEST_CASE("limits: domains") {
  Fit fit = example_fit();
  fit.domain.specular.max = kLargestDomain;
  CHECK(oversize(fit).empty());
  fit.domain.alpha.max = 1e308;
  CHECK(oversize(fit) == "has a domain to 1e+308; at most 1000 is possible");
}

TEST_CASE("limits: remarks and other lines of a fit file") {
  Fit fit = example_fit();
  const auto message = [&] {
    try {
      fit_from_json(fit_to_json(fit), "x.json");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  fit.remarks = {std::string(10'001, 'x')};
  CHECK(message() == "x.json: remarks[0]: has a text of 10001 bytes, but at most 10000 can be read");
  fit.remarks.assign(1001, "x");
  CHECK(message() == "x.json: remarks: has 1001 entries, but at most 1000 can be read");
  fit = example_fit();
  for (int i = 0; i <= 1000; ++i) fit.method[std::to_string(i)] = "x";
  CHECK(message() == "x.json: method: has 1001 entries, but at most 1000 can be read");
}
