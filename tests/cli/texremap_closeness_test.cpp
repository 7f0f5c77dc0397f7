// What texremap says of how closely a target can look like its source, with the converters that ship: the
// model that `--to RENDERER` takes, closer models, and matches that look different.
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

const std::string kDifferent = "will look different from", kCloser = "would look closer";

ProcessResult path(const std::string& from, const std::string& to, const Words& more = {}) {
  const Session session;
  return session.texremap("path --from " + from + " --to " + to + more);
}

// Converts numbers.
ProcessResult convert(const std::string& from, const std::string& to, const Words& more = {}) {
  const Session session;
  return session.texremap("convert --from " + from + " --to " + to + " --roughness 0.3 --specular 0.04" +
                          more);
}

nlohmann::json json_of(const ProcessResult& result) {
  require_success(result);
  return nlohmann::json::parse(result.output);
}

std::string error_text(const std::string& from, const std::string& to) {
  return "expected error " +
         number_text(rounded_up(shipped_graph().find_paths({from, to, {}}).front().expected_error, 3));
}

// The mean over the spheres that the fit holds.
std::string ssim_text_of(const std::string& id) {
  const Fit fit = load_fit(std::string(REMAP_SOURCE_DIR) + "/fits/" + id + ".json");
  double sum = 0.0;
  for (const SphereSimilarity& sphere : fit.image_similarity->ssim) sum += sphere.ssim;
  return "SSIM " + number_text(rounded(sum / static_cast<double>(fit.image_similarity->ssim.size()), 3));
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("texremap convert: notes in one line that the match looks different and which model is closer") {
  const ProcessResult result = require_success(convert("mitsuba/ward", "cycles-5/ggx"));
  CHECK(result.errors == "texremap: note: cycles-5/ggx will look different from mitsuba/ward (" +
                             error_text("mitsuba/ward", "cycles-5/ggx") + ", " +
                             ssim_text_of("mitsuba_ward_to_mitsuba_ggx") +
                             " in the worst step); cycles-5/beckmann would look closer (" +
                             error_text("mitsuba/ward", "cycles-5/beckmann") + ")\n");
  CHECK(line_count(result.output) == 2);
  const ProcessResult quiet = convert("mitsuba/ward", "cycles-5/ggx", "--quiet");
  CHECK(quiet.errors.empty());
  CHECK(quiet.output == result.output);
}

TEST_CASE("texremap convert: --json says how close the target is, and which model is closer") {
  const nlohmann::json json = json_of(convert("mitsuba/ward", "cycles-5/ggx", "--json"));
  CHECK(json["looks_different"] == true);
  CHECK("SSIM " + number_text(json["worst_step_ssim"].get<double>()) ==
        ssim_text_of("mitsuba_ward_to_mitsuba_ggx"));
  CHECK(json["closer_model"]["model"] == "cycles-5/beckmann");
  CHECK(json["closer_model"]["path"] == json_of(path("mitsuba/ward", "cycles-5/beckmann", "--json"))["path"]);
  CHECK(json["closer_model"]["expected_error"].get<double>() <=
        kCloserShare * json["expected_error"].get<double>());
  CHECK(json["closest_of"].is_null());
}

TEST_CASE("texremap: a good match is not remarked on") {
  const ProcessResult converted = require_success(convert("mitsuba/ward", "mitsuba/as"));
  CHECK(converted.errors.empty());
  const ProcessResult printed = require_success(path("mitsuba/ggx", "cycles-5/ggx"));
  CHECK_THAT(printed.output, !Contains("note: "));
  const nlohmann::json json = json_of(path("mitsuba/ward", "mitsuba/as", "--json"));
  CHECK(json["looks_different"] == false);
  CHECK(json["closer_model"].is_null());
}

TEST_CASE("texremap convert: --to RENDERER takes the closest of its models and says which") {
  const ProcessResult result = require_success(convert("mitsuba/ward", "cycles-5")),
                      named = convert("mitsuba/ward", "cycles-5/beckmann");
  CHECK(result.output == named.output);
  CHECK(result.errors == "texremap: note: cycles-5/beckmann is the closest model of cycles-5 (" +
                             error_text("mitsuba/ward", "cycles-5/beckmann") + ")\n");
  CHECK(convert("mitsuba/ward", "cycles-5", "--quiet").errors.empty());
  const nlohmann::json json = json_of(convert("mitsuba/ward", "cycles-5", "--json"));
  CHECK(json["closest_of"] == "cycles-5");
  CHECK(json["target"] == "cycles-5/beckmann");
}

TEST_CASE("texremap path: --to RENDERER is a part of the plan") {
  const ProcessResult result = require_success(path("mitsuba/ward", "cycles-5"));
  CHECK(result.output.starts_with("cycles-5/beckmann is the closest model of cycles-5 (" +
                                  error_text("mitsuba/ward", "cycles-5/beckmann") + ")\nmitsuba/ward -> "));
  CHECK_THAT(path("mitsuba/ward", "cycles-5/ggx").output,
             Contains("note: cycles-5/ggx " + kDifferent) && Contains("; cycles-5/beckmann " + kCloser));
  const nlohmann::json json = json_of(path("mitsuba/ward", "cycles-5", "--json"));
  CHECK(json["closest_of"] == "cycles-5");
  CHECK(json["models"].back() == "cycles-5/beckmann");
  CHECK(json_of(path("cycles-5/ggx", "mitsuba", "--json"))["models"].back() == "mitsuba/ggx");
}

TEST_CASE("texremap path: --to RENDERER takes no model of dielectrics alone") {
  for (const std::string renderer : {"cycles-5", "mitsuba3", "threejs-r187"}) {
    const nlohmann::json json = json_of(path("mitsuba/ggx", renderer, "--json"));
    INFO(renderer << ": " << json["models"].back());
    CHECK(json["domain"]["specular"][1] >= 0.5);
  }
}

TEST_CASE("texremap path: --to RENDERER with --via chooses among the paths that lead there") {
  const nlohmann::json json = json_of(path("mitsuba/ward", "cycles-5", "--via mitsuba/ggx --json"));
  CHECK(json["models"][1] == "mitsuba/ggx");
  CHECK_THAT(json["models"].back().get<std::string>(), !Contains("beckmann"));
}

TEST_CASE("texremap: a workflow is compared with the models of its own renderer") {
  const ProcessResult gltf = path("mitsuba/ward", "gltf"),
                      principled = path("mitsuba/ward", "cycles-5/principled");
  CHECK_THAT(gltf.output, Contains("mitsuba/ggx " + kDifferent) && !Contains(kCloser));
  CHECK_THAT(principled.output,
             Contains("cycles-5/principled-metal " + kDifferent) && Contains("cycles-5/beckmann " + kCloser));
  const ProcessResult own = require_success(path("gltf", "mitsuba"));
  CHECK(own.output.starts_with("mitsuba/ggx is the closest model of mitsuba (expected error 0)\ngltf: "));
}

TEST_CASE("texremap convert: --fit is judged by its own pictures") {
  const Session session;
  const ProcessResult result = require_success(session.texremap("convert --fit " REMAP_SOURCE_DIR
                                                                "/fits/mitsuba_ward_to_mitsuba_ggx.json"
                                                                " --roughness 0.3 --specular 0.04"));
  CHECK_THAT(result.errors, Contains("mitsuba/ggx " + kDifferent) && !Contains(kCloser));
}

TEST_CASE("texremap list: marks what looks different and names what is closer") {
  const Session session;
  CHECK_THAT(session.texremap({"list"}).output,
             Contains("  note   mitsuba/ggx will look different from mitsuba/ward (" +
                      error_text("mitsuba/ward", "mitsuba/ggx") + ", " +
                      ssim_text_of("mitsuba_ward_to_mitsuba_ggx") + "); "));
  CHECK_THAT(session.texremap("list --models").output,
             Contains("cycles-5/ggx, " + error_text("mitsuba/ward", "cycles-5/ggx") +
                      ", in 2 steps, will look different, cycles-5/beckmann would look closer\n"));
  for (const nlohmann::json& converter : json_of(session.texremap("list --json")))
    if (converter["rms_error"]["image"].is_null()) {
      CHECK(converter["looks_different"] == false);
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
