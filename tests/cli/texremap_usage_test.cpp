// This file tests what texremap prints, and how it handles unusual inputs.
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"
#include "lower/fit_file.hpp"
#include "remap/shipped_converters.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("texremap: version and list answer on standard output", "[slow]") {
  const Session session;
  CHECK(session.texremap("--version").output.starts_with("texremap "));
  CHECK_THAT(session.texremap("list --pairs").output, Contains("mitsuba_ward_to_mitsuba_as"));
  const auto json = nlohmann::json::parse(session.texremap("list --pairs --json").output);
  REQUIRE(json.size() == shipped_converters().size());
  CHECK(json[0]["self_test"] == true);
  CHECK(json[0]["source"]["model"].is_string());
}

TEST_CASE("texremap: --quiet prints nothing") {
  const Session session;
  session.write_pair("jpg", 64, OIIO::TypeUInt8);
  const ProcessResult result = session.convert("r.jpg", "s.jpg", "--quiet");
  CHECK(result.exit_code == 0);
  CHECK(result.errors.empty());
  CHECK(result.output.empty());
}

TEST_CASE("texremap: a fit as --converters names its models") {
  const Session session;
  session.write_pair("exr");
  const Fit fit = lowered_fit(example_fit());
  write_file(session.path("fit.json"), fit_to_json(fit));
  require_success(
      session.texremap("convert --converters fit.json --roughness r.exr --specular s.exr -o out"));
  const TestImage in = session.image("r.exr"), out = session.image("out/r.exr");
  CHECK(out.spec.get_string_attribute("remap:converter") == fit.id);
  const auto converter = make_lowered_converter(fit);
  for (int x = 0; x < 64; ++x) {
    const float roughness = in.at(x, 1, 0), specular = 0.0f;
    float expected = 0.0f, ignored = 0.0f;
    const std::array<const float*, 1> specular_in = {&specular};
    const std::array<float*, 1> specular_out = {&ignored};
    converter->convert(1, &roughness, specular_in, &expected, specular_out);
    CHECK(out.at(x, 1, 0) == as_stored(expected, OIIO::TypeHalf));
  }
}

TEST_CASE("texremap: --converters replaces the shipped converters by those of a fit, a folder or a list",
          "[slow]") {
  const Session session;
  const Fit fit = lowered_fit(example_fit());
  std::filesystem::create_directory(session.path("fits"));
  write_file(session.path("fits/fit.json"), fit_to_json(fit));
  // every folder of fits has this file, which is not a fit
  write_file(session.path("fits/manifest.json"), "{}");
  const auto list = [&](const std::string& path) {
    const ProcessResult result =
        require_success(session.texremap("list --pairs --converters " + path + " --json"));
    return result.output;
  };
  const std::string of_fit = list("fits/fit.json");
  CHECK_THAT(of_fit, Catch::Contains(fit.id));
  CHECK_THAT(of_fit, !Catch::Contains("mitsuba_ward_to_mitsuba_as"));
  CHECK(list("fits") == of_fit);
  CHECK(list(REMAP_SOURCE_DIR "/generated/converters.json") ==
        session.texremap("list --pairs --json").output);

  const Words numbers =
      "convert --from " + fit.source.model + " --to " + fit.target.model + " --roughness 0.25 --specular 0.3";
  CHECK(session.texremap(numbers).exit_code == 2);
  require_success(session.texremap(numbers + "--converters fits"));
}

TEST_CASE("texremap: a fit without a converter is refused with what to run") {
  const Session session;
  const auto refused = [&](const std::string& json) {
    write_file(session.path("fit.json"), json);
    const ProcessResult result =
        session.texremap("convert --converters fit.json --roughness 0.25 --specular 0.3");
    CHECK(result.exit_code == 1);
    return result.errors;
  };
  std::string json = fit_to_json(example_fit());
  CHECK_THAT(refused(json), Contains("could not be lowered") && Contains("remapc fit --lower"));
  const std::string section = ",\n  \"converter\": null";
  json.erase(json.find(section), section.size());
  CHECK_THAT(refused(json), Contains("holds no converter") && Contains("run remapc fit again"));
}

TEST_CASE("texremap: every instruction set writes the same files", "[slow]") {
  const Session session;
  session.write_pair("exr");
  std::vector<std::string> written;
  for (const InstructionSet set : instruction_sets()) {
    const std::string name(instruction_set_name(set));
    const ProcessResult result =
        session.texremap_with(name, kConversion + " --roughness r.exr --specular s.exr --force --json");
    REQUIRE(result.exit_code == 0);
    CHECK(nlohmann::json::parse(result.output)["instructions"] == name);
    written.push_back(session.content("out/r.exr") + session.content("out/s.exr"));
    CHECK(written.back() == written.front());
  }
}
