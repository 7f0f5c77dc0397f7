// Short forms: their lines, their constants, and how rules are judged.
#include "study/short_forms.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/short_code.hpp"
#include "remap/error.hpp"
#include "study/exponent_ranking.hpp"
#include "study/form_rule.hpp"
#include "study/lobe_bank.hpp"
#include "study/simplex.hpp"

using namespace remap;

namespace {

SphereSampling small_sampling() {
  SphereSampling sampling;
  sampling.resolution = 16;
  sampling.samples = 64;
  return sampling;
}

ShortForm blinn_form() {
  return {"legacy_blinn_phong_to_mitsuba_ggx",
          "legacy/blinn-phong",
          "mitsuba/ggx",
          ShortKind::kExponent,
          ShortStrength::kLine,
          {1.7, 4.1, 6.3, 2.1, 1.0},
          {},
          {},
          {},
          {}};
}

}  // namespace

TEST_CASE("The lines of a form are its formulas", "[short]") {
  const ShortForm form = blinn_form();
  const auto lines = outputs_of(form);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0].value.value({{"n", 96.08}}) == Approx(std::pow(1.7 / (96.08 + 4.1), 0.25)));
  CHECK(lines[1].value.value({{"n", 96.08}, {"ks", 0.5}}) == Approx(6.3 * 0.5 / (96.08 + 2.1)));
  CHECK(lines[1].value.value({{"n", 1.0}, {"ks", 1.0}}) == 1.0);
  CHECK(lines[2].value.value({{"kd", 0.64}, {"f", 0.2}}) == Approx(0.8));
  CHECK(lines[2].value.value({{"kd", 0.0}, {"f", 1.0}}) == 0.0);  // a mirror divides by no 0
  CHECK(short_text(form) ==
        "roughness = (1.7 / (n + 4.1))^0.25; f0 = min(1, 6.3 ks / (n + 2.1)); base = min(1, kd / max(0.02, 1 "
        "- f))");
  ShortForm widths{
      "a_to_b", "a/b", "c/d", ShortKind::kWidths, ShortStrength::kOverSquare, {0.7, -0.2, 1.0, -0.5}, {},
      {},       {},    {}};
  CHECK(short_text(widths) ==
        "alpha = min(1, alpha (0.7 - 0.2 alpha)); specular = min(1, specular (1 / (1 - 0.5 alpha alpha)))");
}

TEST_CASE("Short forms are read as they are written", "[short]") {
  ShortForm form = blinn_form();
  form.figures = {5.64, 0.949, 0.13};
  form.compiled = ShortFigures{5.0, 0.95, 0.1};
  const std::string text = short_forms_json({form});
  const auto read = short_forms_of(text, "forms.json");
  REQUIRE(read.size() == 1);
  CHECK(short_forms_json(read) == text);
  std::string damaged = text;
  damaged.replace(damaged.find("2.1,"), 4, "");
  CHECK_THROWS_WITH(short_forms_of(damaged, "forms.json"), Catch::Matchers::Contains("forms.json"));
  CHECK_THROWS_WITH(short_forms_of("{}", "forms.json"), Catch::Matchers::Contains("format"));
}

TEST_CASE("The shipped forms have the code that is committed", "[short]") {
  const std::filesystem::path source = REMAP_SOURCE_DIR;
  const auto forms = short_forms_of(read_file(source / "fits" / kShortFormsName), "forms.json");
  CHECK(forms.size() == 48);
  for (const ShortForm& form : forms) {
    CAPTURE(form.id);
    CHECK(form.constants.size() <= 5);
    CHECK(form.figures.rmse < form.copied.rmse);
  }
}

TEST_CASE("A simplex finds the bottom of a valley", "[short]") {
  // Rosenbrock 1960.
  const auto best = simplex_search({-1.2, 1.0}, 0.2, 400, [](const std::vector<double>& x) {
    return 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
  });
  CHECK(best[0] == Approx(1.0).margin(1e-3));
  CHECK(best[1] == Approx(1.0).margin(1e-3));
}

TEST_CASE("Rules are judged by pictures", "[short][slow]") {
  LobeBank bank(builtin_environments(32), small_sampling());
  const LobePictures& ggx = bank.of("mitsuba/ggx");
  const RuleJudge judge(bank.lights(), ggx, ggx, width_materials("mitsuba/ggx", Half::kJudging));
  const auto same = judge
                        .by_rule([](const LobeMaterial& material) {
                          return LobeSurface{material.alpha, material.specular, material.diffuse, false};
                        })
                        .figures;
  CHECK(same.rmse < 1e-3);
  CHECK(same.relative < 1e-5);
  CHECK(same.ssim == Approx(1.0));
  const auto darker = judge
                          .by_rule([](const LobeMaterial& material) {
                            Rgb half = material.specular;
                            for (double& value : half) value *= 0.5;
                            return LobeSurface{material.alpha, half, material.diffuse, false};
                          })
                          .figures;
  CHECK(darker.rmse > 2.0);
  CHECK(darker.relative > 0.2);
}

TEST_CASE("The search of a form finds constants that beat copying", "[short][slow]") {
  ShortFormsOptions options;
  static_cast<SphereSampling&>(options) = small_sampling();
  auto lights = builtin_environments(32);
  options.choosing = {lights[0]};
  options.judging = {lights[1], lights[2]};
  options.pairs = {{"legacy/blinn-phong", "mitsuba/ggx"}};
  std::vector<ShortForm> found;
  study_short_forms(options, [&](const ShortForm& form) { found.push_back(form); });
  REQUIRE(found.size() == 1);
  CHECK(found.front().figures.rmse < 0.6 * found.front().copied.rmse);
  CHECK(found.front().figures.rmse < 1.4 * found.front().best.rmse);
  // Near the constants that separate code found under other lights: 1.7, 4.1, 6.3, 2.1.
  CHECK(found.front().constants[2] == Approx(6.3).epsilon(0.25));
}

TEST_CASE("Rules for exponents are those of their programs", "[short]") {
  const auto rules = exponent_rules();
  const auto roughness = [&](const char* name, double n, double luma) {
    const auto rule = std::ranges::find(rules, name, &ExponentRule::name);
    REQUIRE(rule != rules.end());
    return rule->roughness(n, luma);
  };
  // Their roughness at exponents 10, 50, 100 and 500, rounded, as their sources give it.
  const auto check = [&](const char* name, std::array<double, 4> expected) {
    CAPTURE(name);
    constexpr std::array kExponents = {10.0, 50.0, 100.0, 500.0};
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(roughness(name, kExponents[i], 1.0) == Approx(expected[i]).margin(0.0056));
  };
  check("obj2gltf", {0.99, 0.95, 0.90, 0.50});
  check("Blender OBJ", {0.90, 0.78, 0.68, 0.29});
  check("assimp, FBX import", {0.68, 0.29, 0.00, -1.24});
  check("ufbx", {0.68, 0.29, 0.00, 0.00});
  check("assimp, glTF export", {0.90, 0.78, 0.68, 0.29});
  check("FBX2glTF", {0.41, 0.20, 0.14, 0.06});
  check("trimesh, O3DE, Yocto/GL", {0.64, 0.44, 0.37, 0.25});
  check("Babylon", {0.56, 0.36, 0.27, 0.12});
  check("Maxon", {0.67, 0.44, 0.34, 0.10});
  CHECK(opengl_materials().size() == 24);
}
