// This file tests conversions between workflows on files. It compares results with its own formulas and with
// the library in memory, and tests warnings about implausible maps.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "reference/workflow_conversion.hpp"
#include "remap/converter.hpp"
#include "remap/shipped_converters.hpp"
#include "support/skip.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kWorkflowSize = 40;

void write_colors(const Session& session, const std::string& name, const TexelFunction& texel,
                  OIIO::TypeDesc type = OIIO::TypeFloat, int size = kWorkflowSize) {
  session.map(name, kColor, texel, type, size);
}
void write_grey(const Session& session, const std::string& name, const TexelFunction& texel,
                OIIO::TypeDesc type = OIIO::TypeFloat, int size = kWorkflowSize) {
  session.map(name, kGrey, texel, type, size);
}

float base_color(int x, int y, int c) { return 0.05f + 0.9f * noise(x, y, c); }
float metallic(int x, int y, int) { return noise(x, y, 7); }
float roughness(int x, int y, int) { return 0.1f + 0.8f * noise(x, y, 9); }

// Writes b.exr, m.exr and r.exr of a metallic material, as floats.
void write_metallic(const Session& session) {
  write_colors(session, "b.exr", base_color);
  write_grey(session, "m.exr", metallic);
  write_grey(session, "r.exr", roughness);
}
// Writes d.exr, s.exr and r.exr of a specular material: half plastic, half metal.
void write_specular(const Session& session, float diffuse = 0.4f, float specular = 0.04f) {
  write_colors(session, "d.exr",
               [&](int x, int y, int c) { return y < 20 ? diffuse * noise(x, y, c) : 0.0f; });
  write_colors(session, "s.exr",
               [&](int x, int y, int c) { return y < 20 ? specular : 0.5f + 0.4f * noise(x, y, c); });
  write_grey(session, "r.exr", roughness);
}

ProcessResult convert(const Session& session, Words words) {
  return session.texremap(Words("convert") + words + "-o out");
}

Words metallic_words(const std::string& from, const std::string& to) {
  return "--from " + from + " --to " + to + " --base-color b.exr --metallic m.exr --roughness r.exr";
}
Words specular_words(const std::string& from, const std::string& to) {
  return "--from " + from + " --to " + to + " --diffuse d.exr --specular s.exr --roughness r.exr";
}

}  // namespace

TEST_CASE("texremap workflows: specular to metallic has the bits of the library, on any number of threads",
          "[needs][slow]") {
  const Session session;
  // The rows are plastic, then metal, then a material between the two, which the bias decides.
  const auto part = [](int y) { return y < 16 ? 0 : y < 28 ? 1 : 2; };
  write_colors(session, "d.exr", [&](int x, int y, int c) {
    return part(y) == 1 ? 0.0f : (part(y) == 0 ? 0.4f : 0.1f) * noise(x, y, c);
  });
  write_colors(session, "s.exr", [&](int x, int y, int c) {
    return part(y) == 0 ? 0.04f : part(y) == 1 ? 0.5f + 0.4f * noise(x, y, c) : 0.02f + 0.3f * noise(y, x, c);
  });
  write_grey(session, "r.exr", roughness);
  const std::string threads = GENERATE("1", "3");
  const std::string set = GENERATE("baseline", "avx2"), bias = GENERATE("clean", "noisy");
  if (set == "avx2" && !has_avx2()) return;
  const ProcessResult result = require_success(session.texremap_with(
      set, Words("convert") + specular_words("specular", "metallic") + "--threads " + threads +
               " --metallic-bias " + bias + " --diagnose checks --json -o out"));
  const TestImage d = session.image("d.exr"), s = session.image("s.exr"), r = session.image("r.exr"),
                  base = session.image("out/base_color.exr"), metal = session.image("out/metallic.exr"),
                  residual = session.image("checks/residual.exr"),
                  width = session.image("checks/metallic_uncertainty.exr");
  const WorkflowConversion conversion{{}, {}, Projection{bias == "clean" ? kCleanPrior : kNoisyPrior}};
  std::size_t guesses = 0;
  for (int y = 0; y < kWorkflowSize; ++y)
    for (int x = 0; x < kWorkflowSize; ++x) {
      const SpecularMaterial material{{d.at(x, y, 0), d.at(x, y, 1), d.at(x, y, 2)},
                                      {s.at(x, y, 0), s.at(x, y, 1), s.at(x, y, 2)},
                                      r.at(x, y, 0)};
      const MetallicMaterial expected = to_metallic(conversion, material);
      const MetallicDiagnosis diagnosis = diagnose(conversion, material, expected);
      for (int c = 0; c < 3; ++c)
        REQUIRE(base.at(x, y, c) == expected.base_color[static_cast<std::size_t>(c)]);
      REQUIRE(metal.at(x, y, 0) == expected.metallic);
      REQUIRE(residual.at(x, y, 0) == diagnosis.residual);
      REQUIRE(width.at(x, y, 0) == diagnosis.metallic_uncertainty);
      guesses += diagnosis.metallic_uncertainty > 0.2f;
    }
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["metallic_confidence"]["undetermined"] == guesses);
  CHECK(json["estimated_dielectric_f0"]["value"].get<double>() == Approx(0.04).margin(0.001));
}

TEST_CASE("texremap workflows: Ward with diffuse and specular becomes glTF in one pass") {
  const Session session;
  write_specular(session);
  Words words = specular_words("specular:mitsuba/ward", "gltf");
  const ProcessResult result = require_success(convert(session, words + "--layout orm"));
  const TestImage d = session.image("d.exr"), s = session.image("s.exr"), r = session.image("r.exr"),
                  base = session.image("out/base_color.exr"), orm = session.image("out/orm.exr");
  const Converter& brdf = find_converter("mitsuba/ward", "mitsuba/ggx");
  WorkflowConversion conversion{{}, {}, Projection{kCleanPrior}};
  conversion.specular.width = conversion.metallic.width = RoughnessEncoding::kAlpha;
  conversion.metallic.diffuse = DiffuseConvention::kScaled;
  // The specular workflow around Ward's model does not define its diffuse. It gets glTF's meaning: diffuse
  // only gets the light that specular does not reflect.
  CHECK_THAT(result.errors, Contains("assuming scaled diffuse for mitsuba/ward, as in gltf"));
  for (int y = 0; y < kWorkflowSize; y += 3)
    for (int x = 0; x < kWorkflowSize; ++x) {
      const float alpha = r.at(x, y, 0);
      const std::array<float, 3> given = {s.at(x, y, 0), s.at(x, y, 1), s.at(x, y, 2)};
      const float left = 1.0f - std::clamp(*std::max_element(given.begin(), given.end()), 0.0f, 1.0f);
      SpecularMaterial material{{d.at(x, y, 0) * left, d.at(x, y, 1) * left, d.at(x, y, 2) * left}, {}, 0.0f};
      const std::array<const float*, 3> in = {&given[0], &given[1], &given[2]};
      const std::array<float*, 3> out = {&material.specular[0], &material.specular[1], &material.specular[2]};
      brdf.convert(1, &alpha, in, &material.width, out);
      const MetallicMaterial expected = to_metallic(conversion, material);
      for (int c = 0; c < 3; ++c)
        REQUIRE(base.at(x, y, c) == expected.base_color[static_cast<std::size_t>(c)]);
      REQUIRE(orm.at(x, y, 2) == expected.metallic);
      REQUIRE(orm.at(x, y, 1) == Approx(std::sqrt(material.width)).margin(1e-6));
    }
}

TEST_CASE("texremap workflows: metallic to metallic of another BRDF keeps the files") {
  const Session session;
  write_metallic(session);
  require_success(convert(session, metallic_words("gltf", "cycles-5/principled")));
  CHECK(session.result_count() == 3);
  const TestImage before = session.image("m.exr"), after = session.image("out/m.exr");
  double sum = 0.0;
  for (std::size_t i = 0; i < before.values.size(); ++i)
    sum += std::abs(static_cast<double>(before.values[i] - after.values[i]));
  CHECK(sum / static_cast<double>(before.values.size()) < 0.05);
}

TEST_CASE("texremap workflows: alpha of diffuse is kept, and transparent texels do not count") {
  const Session session;
  write_specular(session);
  session.make("d.exr", test_spec(kWorkflowSize, kWorkflowSize, {"R", "G", "B", "A"}, OIIO::TypeFloat),
               [](int x, int, int c) { return x < 10 ? (c == 3 ? 0.0f : 5.0f) : 0.3f; });
  const ProcessResult result =
      require_success(convert(session, specular_words("specular", "metallic") + "--json"));
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["masked"] == 10 * kWorkflowSize);
  CHECK(json["above_one"] == 0);
  CHECK(json["metallic_confidence"]["texels"] == 30 * kWorkflowSize);
  const TestImage base = session.image("out/base_color.exr");
  REQUIRE(base.spec.nchannels == 4);
  for (int x = 0; x < kWorkflowSize; ++x) REQUIRE(base.at(x, 3, 3) == (x < 10 ? 0.0f : 0.3f));
}

TEST_CASE("texremap workflows: a metal mask chooses between ambiguous answers") {
  const Session session;
  // This blend is dark: metallic 0.69 with base color 0.04 gives the same picture as metallic 0 with 0.0125.
  write_colors(session, "d.exr", [](int, int, int) { return 0.0125f; });
  write_colors(session, "s.exr", [](int, int, int) { return 0.04f; });
  write_grey(session, "r.exr", [](int, int, int) { return 0.5f; });
  write_grey(session, "mask.exr", [](int x, int, int) { return x < 20 ? 1.0f : 0.0f; });
  require_success(convert(session, specular_words("specular", "metallic") + "--input metal_mask=mask.exr"));
  const TestImage metal = session.image("out/metallic.exr");
  CHECK(metal.at(3, 3, 0) > 0.65f);
  CHECK(metal.at(30, 3, 0) < 0.01f);

  // In a folder, each set has its own mask.
  std::filesystem::create_directories(session.path("in"));
  constexpr std::array<std::array<const char*, 2>, 4> kNames = {{{"d.exr", "a_diffuse.exr"},
                                                                 {"s.exr", "a_specular.exr"},
                                                                 {"r.exr", "a_roughness.exr"},
                                                                 {"mask.exr", "a_mine.exr"}}};
  for (const auto& [from, to] : kNames)
    std::filesystem::rename(session.path(from), session.path(std::string("in/") + to));
  require_success(
      session.texremap("convert in --from specular --to metallic --input metal_mask=*_mine.exr -o folder"));
  CHECK(session.image("folder/a_metallic.exr").at(3, 3, 0) == metal.at(3, 3, 0));
}

TEST_CASE("texremap workflows: implausible maps give a warning with the reason", "[slow]") {
  const Session session;
  const auto warned = [&](const Words& words, const std::string& message) {
    const ProcessResult result = require_success(convert(session, words + "--force"));
    CHECK_THAT(result.errors, Contains(message));
  };
  const Words words = specular_words("specular", "metallic");
  write_specular(session, 0.4f, 0.2195f);  // sRGB stores an F0 of 0.04 like this
  warned(words, "like F0 0.04 stored in sRGB (use --color-space specular=srgb");
  write_specular(session, 0.4f, 0.0f);
  write_colors(session, "s.exr", [](int, int, int) { return 0.0f; });
  warned(words, "specular, read as linear, is black everywhere (dielectrics have a linear F0 of 0.04)");
  write_colors(session, "s.exr", [](int, int, int) { return 1.0f; });
  warned(words, "specular, read as linear, is white everywhere");
  write_specular(session, 8.0f);
  warned(words, "texels clamped to 1, instead of reflecting more light");
  write_specular(session);
  warned(words,
         "assuming plain diffuse for specular and metallic (otherwise, use "
         "--from scaled:specular");
  warned(words, "dielectric F0 estimated from the maps: 0.04");
  write_metallic(session);
  write_colors(session, "b.exr", [](int, int, int) { return 0.0f; });
  warned(metallic_words("metallic", "specular"), "base_color, read as linear, is black everywhere");
}

TEST_CASE("texremap workflows: the estimated F0 of the maps is used on request") {
  const Session session;
  write_specular(session, 0.5f, 0.055f);
  const ProcessResult result = require_success(
      convert(session, specular_words("specular", "metallic") + "--dielectric-f0 estimate --json"));
  CHECK(nlohmann::json::parse(result.output)["metallic_confidence"]["rms_residual"] < 0.002);
  CHECK_THAT(result.errors, Contains("estimated from the maps: 0.055; 0.055 is used"));
  const TestImage metal = session.image("out/metallic.exr");
  CHECK(metal.at(5, 5, 0) < 0.01f);
}

TEST_CASE(
    "texremap workflows: two sets of one name, with maps of different names, are written side by side") {
  const Session session;
  for (const std::string set : {"", "wood_"}) {
    write_colors(session, "in/wood/" + set + "basecolor.png", base_color, OIIO::TypeUInt8);
    write_grey(session, "in/wood/" + set + "metallic.png", metallic, OIIO::TypeUInt8);
    write_grey(session, "in/wood/" + set + "roughness.png", roughness, OIIO::TypeUInt8);
  }
  require_success(convert(session, "in --recursive --from gltf --to metallic:mitsuba/ward"));
}

TEST_CASE("texremap workflows: occlusion packed with metallic becomes a separate file") {
  const Session session;
  write_colors(session, "sets/box_base_color.png", base_color, OIIO::TypeUInt8);
  write_colors(
      session, "sets/box_orm.png",
      [](int x, int, int c) { return c == 0 ? static_cast<float>(x) / 255.0f : 0.5f; }, OIIO::TypeUInt8);
  require_success(convert(session, "sets --from gltf --to gltf-specgloss"));
  const TestImage occlusion = session.image("out/box_occlusion.png");
  for (int x = 0; x < kWorkflowSize; ++x) REQUIRE(occlusion.at(x, 5, 0) == static_cast<float>(x) / 255.0f);
}

TEST_CASE("texremap workflows: list and path show them", "[slow]") {
  const Session session;
  const ProcessResult list = require_success(session.texremap("list --workflows --json"));
  const auto models = nlohmann::json::parse(list.output);
  CHECK(models.size() == 8);
  CHECK(models[0]["model"] == "gltf");
  CHECK(models[0]["dielectric_f0"] == 0.04);
  const ProcessResult path = require_success(session.texremap("path --from mitsuba/ward --to gltf"));
  CHECK_THAT(path.output, Contains("roughness and specular from mitsuba/ward to mitsuba/ggx") &&
                              Contains("to base color and metallic by projection") &&
                              Contains("mitsuba_ward_to_mitsuba_ggx"));
  require_success(session.texremap("path --from gltf-specgloss --to gltf --json"));
}

TEST_CASE("texremap: exporters of exponents have lobes that exist, and whole numbers have a scale") {
  const Session session;
  write_metallic(session);
  const std::string command = "convert --from gltf --base-color b.exr --metallic m.exr --roughness r.exr ";
  REQUIRE(session.texremap(command + "--to mtl -o floats").exit_code == 0);
  const TestImage exponents = session.image("floats/exponent.exr"),
                  specular = session.image("floats/specular.exr"),
                  diffuse = session.image("floats/diffuse.exr");
  const TestImage base = session.image("b.exr"), metal = session.image("m.exr"),
                  rough = session.image("r.exr");
  std::size_t compared = 0;
  for (int y = 0; y < kWorkflowSize; ++y)
    for (int x = 0; x < kWorkflowSize; ++x) {
      const float n = exponents.at(x, y, 0), m = metal.at(x, y, 0),
                  fourth = std::pow(rough.at(x, y, 0), 4.0f);
      float most = 0.0f;
      for (int c = 0; c < 3; ++c) {
        const float f0 = 0.04f * (1.0f - m) + base.at(x, y, c) * m, ks = specular.at(x, y, c);
        most = std::max(most, 0.225f * f0 / fourth);
        CHECK(ks >= 0.0f);
        CHECK(ks <= 1.0f);
      }
      CHECK(diffuse.at(x, y, 0) <= base.at(x, y, 0) * (1.0f - m) + 1e-5f);
      // The short formula of importers was fitted to other pictures and does not limit Ks. Where Ks is small,
      // alpha is within 15 % of this formula. Elsewhere the lobe is wider.
      if (most < 0.5f && fourth < 0.1f) {
        CHECK(n == Approx(1.52f / fourth).epsilon(0.3));
        ++compared;
      }
      if (most > 2.0f) CHECK(n < 1.3f * 1.52f / fourth);
    }
  CHECK(compared > 20);

  const std::string whole = command + "--to mtl --format png --type uint16 ";
  CHECK_THAT(session.texremap(whole + "-o none").last_error(),
             Contains("would contain integers, but its roughness is an exponent"));
  CHECK_FALSE(std::filesystem::exists(session.path("none")));
  REQUIRE(session.texremap(whole + "--output-encoding exponent=1000 -o whole").exit_code == 0);
  const TestImage stored = session.image("whole/exponent.png");
  for (int i = 0; i < kWorkflowSize; ++i)
    CHECK(stored.at(i, i, 0) * 1000.0f ==
          Approx(exponents.at(i, i, 0)).margin(0.5 * 1000.0 / 65535.0 + 1e-3));
  const std::string back =
      "convert --from mtl --to gltf --roughness whole/exponent.png --specular whole/specular.png "
      "--diffuse whole/diffuse.png ";
  CHECK_THAT(session.texremap(back + "-o back").last_error(), Contains("--factor roughness=NUMBER"));
  CHECK(session.texremap(back + "--factor roughness=1000 -o back").exit_code == 0);
  CHECK_THAT(session.texremap(command + "--to unity --output-encoding exponent=128 -o none").last_error(),
             Contains("--output-encoding exponent cannot be used with --layout unity"));
}

TEST_CASE("texremap: exponents go to whole materials, and whole numbers need a scale") {
  const Session session;
  // Separate code repeats the short formula of the lobe: alpha^2 = 1.7 / (n + 4), F0 = 6.3 Ks / (n + 2). Kd
  // is kept, minus the F0 that the core of glTF adds.
  const auto json = nlohmann::json::parse(
      require_success(
          session.texremap(
              "convert --from mtl --to gltf --roughness 96.08 --specular 0.5 --diffuse 0.64 --json"))
          .output);
  CHECK(json["values"]["roughness"].get<double>() == Approx(0.361).margin(0.03));
  CHECK(json["values"]["metallic"].get<double>() == 0.0);
  CHECK(json["values"]["base_color"][0].get<double>() == Approx(0.65).margin(0.03));
  session.make("ns.png", test_spec(4, 4, {"Y"}, OIIO::TypeUInt8), noise);
  const std::string command =
      "convert --from opengl --to mitsuba/ggx-plain --roughness ns.png --specular 0.5 -o out";
  CHECK_THAT(session.texremap(command).last_error(),
             Contains("contains integers, which texremap cannot read as exponents"));
  CHECK(session.texremap(command + " --factor roughness=128").exit_code == 0);
}

TEST_CASE("reports: 11 without a highlight a surface is rough in metallic workflows, from every source") {
  const Session session;
  for (const std::string source : {"radiance/plastic --roughness 0", "mujoco --roughness 64",
                                   "mtl --roughness 1000", "gltf-specgloss --glossiness 1"}) {
    const ProcessResult numbers = require_success(
        session.texremap("convert --from " + source + " --to gltf --specular 0 --diffuse 0.7"));
    INFO(source << ": " << numbers.output);
    CHECK_THAT(numbers.output, Contains("roughness 1\n"));
    CHECK_THAT(numbers.output, Contains("base_color 0.71"));
    CHECK_THAT(numbers.output, Contains("metallic 0\n"));
  }
  // The first texel has no highlight. The F0 of the second is three quarters of the limit below which the
  // width rises. The third is a dielectric, which keeps its width.
  const std::vector<float> f0 = {0.0f, 0.00075f, 0.04f};
  write_colors(
      session, "d.exr", [](int, int, int) { return 0.5f; }, OIIO::TypeFloat, 3);
  write_colors(
      session, "s.exr", [&](int x, int, int) { return f0[static_cast<std::size_t>(x)]; }, OIIO::TypeFloat, 3);
  write_grey(
      session, "r.exr", [](int, int, int) { return 0.2f; }, OIIO::TypeFloat, 3);
  require_success(convert(session, specular_words("specular", "gltf")));
  const TestImage rough = session.image("out/roughness.exr");
  CHECK(rough.at(0, 0, 0) == 1.0f);
  CHECK(rough.at(1, 0, 0) == Approx(0.4f));
  CHECK(rough.at(2, 0, 0) == 0.2f);
}
