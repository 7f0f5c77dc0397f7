// This file tests what texremap prints about how similar a target can look to its source, with the converters
// that ship: how far pictures differ, the model that `--to RENDERER` chooses, and models that are more
// similar.
#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"
#include "core/number_text.hpp"
#include "lower/fit_file.hpp"
#include "remap/path.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

const std::string kDiffer = "rendered pictures differ by ", kCloser = " matches the highlight more closely";

ProcessResult path(const std::string& from, const std::string& to, const Words& more = {}) {
  const Session session;
  return session.texremap("path --from " + from + " --to " + to + more);
}

// Converts numbers instead of maps.
ProcessResult convert(const std::string& from, const std::string& to, const Words& more = {}) {
  const Session session;
  return session.texremap("convert --from " + from + " --to " + to + " --roughness 0.3 --specular 0.04" +
                          more);
}

nlohmann::json json_of(const ProcessResult& result) {
  require_success(result);
  return nlohmann::json::parse(result.output);
}

// Returns the text that the pictures recorded in a fit give.
std::string measured_text(const std::string& id) {
  const Fit fit = load_fit(REMAP_SOURCE_DIR "/fits/" + id + ".json");
  const auto percent = [](double rmse) { return fixed(rmse, 1) + " %"; };
  return kDiffer + percent(fit.pictures.value().rmse) + " (" + percent(fit.copied_pictures.value().rmse) +
         " with copied numbers)";
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("texremap convert: a note in one line says how far pictures differ and which model is closer") {
  const ProcessResult result = require_success(convert("mitsuba/ward", "cycles-5/ggx"));
  CHECK_THAT(result.errors,
             Catch::StartsWith("texremap: note: mitsuba/ward to cycles-5/ggx: " + kDiffer + "about ") &&
                 Catch::EndsWith(" %; cycles-5/beckmann" + kCloser + "\n"));
  CHECK(line_count(result.errors) == 1);
  CHECK(line_count(result.output) == 2);
  const ProcessResult quiet = convert("mitsuba/ward", "cycles-5/ggx", "--quiet");
  CHECK(quiet.errors.empty());
  CHECK(quiet.output == result.output);
}

TEST_CASE("texremap convert: measured pictures stand beside those of copied numbers") {
  CHECK(convert("mitsuba/ward", "mitsuba/as").errors ==
        "texremap: note: mitsuba/ward to mitsuba/as: " + measured_text("mitsuba_ward_to_mitsuba_as") + "\n");
}

TEST_CASE("texremap convert: --json says how far pictures differ, and which model is closer") {
  const nlohmann::json json = json_of(convert("mitsuba/ward", "cycles-5/ggx", "--json"));
  CHECK(json["pictures"]["is_estimate"] == true);
  CHECK(json["pictures"]["copied"].is_null());
  CHECK(json["closer_model"]["model"] == "cycles-5/beckmann");
  CHECK(json["closer_model"]["path"] == json_of(path("mitsuba/ward", "cycles-5/beckmann", "--json"))["path"]);
  CHECK(json["closer_model"]["expected_error"].get<double>() <=
        kCloserShare * json["expected_error"].get<double>());
  CHECK(json["closest_of"].is_null());
}

TEST_CASE("texremap convert: numbers are copied between equal lobes, and a note says so") {
  const std::string equal = ": both models have the same lobe, so that ";
  const ProcessResult copied = require_success(convert("mitsuba3/ggx", "mitsuba/ggx"));
  CHECK(copied.output == "alpha 0.3\nf0 0.04\n");
  CHECK(copied.errors == "texremap: note: mitsuba3/ggx to mitsuba/ggx" + equal + "numbers are copied\n");
  const ProcessResult encoded = require_success(convert("mitsuba/ggx", "cycles-3.4/ggx"));
  CHECK(encoded.output == "roughness 0.547723\ncolor 0.04\n");
  CHECK(encoded.errors ==
        "texremap: note: mitsuba/ggx to cycles-3.4/ggx" + equal + "only the encoding of roughness changes\n");
  CHECK(json_of(convert("mitsuba3/ggx", "mitsuba/ggx", "--json"))["same_lobe"] == true);
  CHECK(json_of(path("mitsuba/ward", "mitsuba/as", "--json"))["same_lobe"] == false);
}

TEST_CASE("texremap: what nobody sees is not remarked on") {
  CHECK(require_success(convert("mitsuba/ggx", "cycles-5/ggx")).errors.empty());
  CHECK(require_success(convert("mitsuba/beckmann", "mitsuba/as")).errors.empty());
  CHECK_THAT(require_success(path("mitsuba/ggx", "cycles-5/ggx")).output, !Contains("note: "));
  const nlohmann::json json = json_of(path("mitsuba/ward", "mitsuba/as", "--json"));
  CHECK(json["pictures"]["is_estimate"] == false);
  CHECK(json["closer_model"].is_null());
}

TEST_CASE("texremap convert: --to RENDERER takes the closest of its models and says which") {
  const ProcessResult result = require_success(convert("mitsuba/ward", "cycles-5")),
                      named = convert("mitsuba/ward", "cycles-5/beckmann");
  CHECK(result.output == named.output);
  CHECK(result.errors ==
        "texremap: note: cycles-5/beckmann is the closest model of cycles-5\n" + named.errors);
  CHECK(convert("mitsuba/ward", "cycles-5", "--quiet").errors.empty());
  const nlohmann::json json = json_of(convert("mitsuba/ward", "cycles-5", "--json"));
  CHECK(json["closest_of"] == "cycles-5");
  CHECK(json["target"] == "cycles-5/beckmann");
}

TEST_CASE("texremap path: --to RENDERER is a part of the plan") {
  const ProcessResult result = require_success(path("mitsuba/ward", "cycles-5"));
  CHECK(result.output.starts_with("cycles-5/beckmann is the closest model of cycles-5\nmitsuba/ward -> "));
  CHECK_THAT(path("mitsuba/ward", "cycles-5/ggx").output, Contains("note: cycles-5/beckmann" + kCloser));
  const nlohmann::json json = json_of(path("mitsuba/ward", "cycles-5", "--json"));
  CHECK(json["closest_of"] == "cycles-5");
  CHECK(json["models"].back() == "cycles-5/beckmann");
  CHECK(json_of(path("cycles-5/ggx", "mitsuba", "--json"))["models"].back() == "mitsuba/ggx");
}

TEST_CASE("texremap: a workflow is compared with the models of its own renderer") {
  const ProcessResult gltf = path("mitsuba/ward", "gltf"),
                      principled = path("mitsuba/ward", "cycles-5/principled");
  CHECK_THAT(gltf.output, !Contains(kCloser));
  CHECK_THAT(principled.output, Contains("cycles-5/beckmann" + kCloser));
  const ProcessResult own = require_success(path("gltf", "mitsuba"));
  CHECK(own.output.starts_with("mitsuba/ggx is the closest model of mitsuba\ngltf: "));
}

TEST_CASE("texremap convert: a fit is judged by its own pictures") {
  const Session session;
  const ProcessResult result = require_success(session.texremap("convert --converters " REMAP_SOURCE_DIR
                                                                "/fits/mitsuba_ward_to_mitsuba_ggx.json"
                                                                " --roughness 0.3 --specular 0.04"));
  CHECK_THAT(result.errors, Contains(measured_text("mitsuba_ward_to_mitsuba_ggx")) && !Contains(kCloser));
}

TEST_CASE("texremap list: says how far pictures differ and names what is closer") {
  const Session session;
  CHECK_THAT(session.texremap("list --pairs").output,
             Contains("  note   " + measured_text("mitsuba_ward_to_mitsuba_ggx") + "\n"));
  CHECK_THAT(session.texremap("list --models").output,
             Contains(" %, in 2 steps; cycles-5/beckmann" + kCloser + "\n"));
  for (const nlohmann::json& converter : json_of(session.texremap("list --pairs --json")))
    if (converter["rms_error"]["image"].is_null()) {
      CHECK(converter["pictures"].is_null());
      CHECK(converter["closer_model"].is_null());
    }
}

TEST_CASE("texremap list: every closer model is one of the same renderer, at least twice as close") {
  const Session session;
  std::size_t closer_count = 0;
  for (const nlohmann::json& source : json_of(session.texremap("list --models --json")))
    for (const nlohmann::json& reached : source["reaches"]) {
      const nlohmann::json& closer = reached["closer_model"];
      if (closer.is_null()) continue;
      ++closer_count;
      const std::string model = reached["model"], other = closer["model"];
      INFO(source["model"] << " to " << model << ": " << other);
      CHECK(model != other);
      CHECK(model.substr(0, model.find('/')) == other.substr(0, other.find('/')));
      CHECK(2.0 * closer["expected_error"].get<double>() <= reached["expected_error"].get<double>());
      const auto same = std::find_if(source["reaches"].begin(), source["reaches"].end(),
                                     [&](const nlohmann::json& entry) { return entry["model"] == other; });
      REQUIRE(same != source["reaches"].end());
      CHECK((*same)["expected_error"] == closer["expected_error"]);
    }
  CHECK(closer_count > 0);
}
