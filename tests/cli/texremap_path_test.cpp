// This file tests `texremap path`, and paths in `convert` and `list`, with the converters that are compiled
// in.
#include <algorithm>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"
#include "core/number_text.hpp"
#include "remap/path.hpp"
#include "remap/shipped_converters.hpp"
#include "remap/workflow.hpp"
#include "support/skip.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

const std::string kId = "mitsuba_ward_to_mitsuba_as";

// Returns what texremap prints about the converter: `rendered pictures differ by 3.1 % (8.2 % with copied
// numbers)`.
std::string ward_to_as_difference() {
  const PictureDifference pictures = find_converter("mitsuba/ward", "mitsuba/as").info().pictures.value();
  return "rendered pictures differ by " + fixed(pictures.converted, 1) + " % (" +
         fixed(pictures.copied.value(), 1) + " % with copied numbers)\n";
}

double ward_to_as_expected() { return expected_error(find_converter("mitsuba/ward", "mitsuba/as").info()); }

Words path_words(const std::string& from, const std::string& to, const Words& more = {}) {
  return "path --from " + from + " --to " + to + more;
}

// Returns the first path of two steps, with the model between them, or empty names if there is none.
PathRequest detour() {
  for (const auto& first : shipped_converters())
    for (const auto& second : shipped_converters()) {
      const ConverterInfo &a = first->info(), &b = second->info();
      if (a.target == b.source && a.source.model != b.target.model)
        return {a.source.model, b.target.model, {a.target.model}};
    }
  return {};
}

}  // namespace

TEST_CASE("texremap path: prints steps, the difference of pictures, domain and reason") {
  const Session session;
  const ProcessResult result = session.texremap(path_words("mitsuba/ward", "mitsuba/as"));
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("mitsuba/ward -> mitsuba/as\n") && Contains("1  " + kId) &&
                                Contains("\n" + ward_to_as_difference()) &&
                                Contains("covers alpha 0.01 to 1, specular 0 to ") &&
                                Contains("chosen because "));
}

TEST_CASE("texremap path: --json holds what the text says") {
  const Session session;
  const auto json =
      nlohmann::json::parse(session.texremap(path_words("mitsuba/ward", "mitsuba/as", "--json")).output);
  CHECK(json["models"] == nlohmann::json({"mitsuba/ward", "mitsuba/as"}));
  CHECK(json["path"] == nlohmann::json::array({kId}));
  CHECK(json["expected_error"].get<double>() == Approx(ward_to_as_expected()).margin(1e-9));
  CHECK(json["assumed_image_error"] == kAssumedImageError);
  REQUIRE(json["steps"].size() == 1);
  CHECK(json["steps"][0]["rms_error"]["image"] ==
        find_converter("mitsuba/ward", "mitsuba/as").info().image_rms_error.value());
  CHECK(json["steps"][0]["domain"] == json["domain"]);
  CHECK(json["reason"].is_string());
  for (const auto& other : json["alternatives"]) CHECK(other["expected_error"] >= json["expected_error"]);
}

TEST_CASE("texremap list: --models shows what each model reaches") {
  const Session session;
  CHECK(nlohmann::json::parse(session.texremap("list --pairs --json").output)[0]["rms_error"].contains(
      "image"));
  CHECK_THAT(
      session.texremap("list --models").output,
      Contains("mitsuba/ward\n  takes    alpha and specular\n") && Contains("  reaches  mitsuba/as, "));
  const auto models = nlohmann::json::parse(session.texremap("list --models --json").output);
  const ConverterGraph graph = shipped_graph();
  REQUIRE(models.size() == graph.models().size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    CHECK(models[i]["model"] == graph.models()[i]);
    CHECK(models[i]["reaches"].size() == graph.reachable_from(graph.models()[i]).size());
  }
}

TEST_CASE("texremap convert: says which path it took, in JSON and in metadata") {
  const Session session;
  session.write_pair("exr", 16);
  const ProcessResult result = require_success(session.convert("r.exr", "s.exr", "--json"));
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["path"] == nlohmann::json::array({kId}));
  CHECK(json["expected_error"].get<double>() == Approx(ward_to_as_expected()).margin(1e-9));
  CHECK_THAT(result.errors, Contains(" s by " + kId + ": "));
  CHECK(session.image("out/r.exr").spec.get_string_attribute("remap:converter") == kId);
}

TEST_CASE("texremap convert: a path of several steps writes what they give one after another") {
  const PathRequest request = detour();
  REQUIRE_FALSE(request.source.empty());
  const Session session;
  session.write_pair("exr", 16);
  const ProcessResult result =
      session.texremap("convert --from " + request.source + " --via " + request.via.front() + " --to " +
                       request.target + " --roughness r.exr --specular s.exr -o out --json");
  REQUIRE(result.exit_code == 0);
  const ConverterPath path = shipped_graph().find_paths(request).front();
  std::string ids, models = request.source;
  for (const Converter* step : path.steps) {
    ids += (ids.empty() ? "" : " ") + step->info().id;
    models += " -> " + step->info().target.model;
  }
  CHECK(nlohmann::json::parse(result.output)["path"].size() == path.steps.size());
  CHECK_THAT(result.errors, Contains(models + ": "));
  const TestImage r = session.image("r.exr"), s = session.image("s.exr"), r_out = session.image("out/r.exr"),
                  s_out = session.image("out/s.exr");
  CHECK(r_out.spec.get_string_attribute("remap:converter") == ids);
  for (int x = 0; x < 16; ++x) {
    float width = r.at(x, 5, 0);
    std::array<float, 3> texel = {s.at(x, 5, 0), s.at(x, 5, 1), s.at(x, 5, 2)};
    const std::array<const float*, 3> in = {&texel[0], &texel[1], &texel[2]};
    const std::array<float*, 3> out = {&texel[0], &texel[1], &texel[2]};
    for (const Converter* step : path.steps) step->convert(1, &width, in, &width, out);
    CHECK(r_out.at(x, 5, 0) == as_stored(width, OIIO::TypeHalf));
    for (int c = 0; c < 3; ++c)
      CHECK(s_out.at(x, 5, c) == as_stored(texel[static_cast<std::size_t>(c)], OIIO::TypeHalf));
  }
}

TEST_CASE("texremap convert: from one real renderer to another, through the hub") {
  const std::string from = "cycles-5/ggx", to = "threejs-r187/standard-metal";
  const std::vector<std::string> models = shipped_graph().models();
  if (std::find(models.begin(), models.end(), from) == models.end()) return;
  const Session session;
  const OIIO::ImageSpec spec = test_spec(16, 16, {"Y"}, OIIO::TypeFloat);
  session.make("r.exr", spec, [](int x, int, int) { return 0.2f + 0.03f * static_cast<float>(x); });
  session.make("s.exr", spec, [](int, int, int) { return 0.5f; });
  const ProcessResult result = require_success(session.texremap(
      "convert --from " + from + " --to " + to + " --roughness r.exr --specular s.exr -o out --json"));
  CHECK(nlohmann::json::parse(result.output)["path"] ==
        nlohmann::json({"cycles_5_ggx_to_mitsuba_ggx", "mitsuba_ggx_to_threejs_r187_standard_metal"}));
  const TestImage r = session.image("out/r.exr"), s = session.image("out/s.exr");
  // All three models are GGX with alpha = roughness^2. They differ in masking, multiple scattering and the
  // Fresnel rise at the rim. Only Three.js has this rise. It is visible on rough surfaces, where it reduces
  // specular.
  for (int x = 0; x < 16; ++x) {
    const float source = 0.2f + 0.03f * static_cast<float>(x);
    INFO("roughness " << source);
    CHECK(r.at(x, 5, 0) == Approx(source).margin(source < 0.45f ? 0.005 : 0.02));
    CHECK(s.at(x, 5, 0) == Approx(0.5).margin(source < 0.4f ? 0.02 : 0.1));
  }
}

TEST_CASE("texremap: names that people use stand for models, in every command") {
  const Session session;
  for (const ModelAlias& alias : model_aliases()) {
    INFO(alias.name);
    const bool is_exponent = alias.model.starts_with("legacy/") || alias.model.starts_with("mujoco/");
    REQUIRE((find_workflow_model(alias.model) != nullptr) != is_exponent);
    CHECK(find_workflow_model(alias.name) == nullptr);
    CHECK(find_alias(alias.name) == &alias);
  }
  CHECK(find_alias("Unity")->model == "gltf");
  CHECK(find_alias("THREE.JS")->model == "threejs/standard");
  CHECK(find_alias("Spec_Gloss")->model == "gltf-specgloss");
  CHECK(find_alias("unit") == nullptr);

  const auto path = [&](const std::string& from, const std::string& to) {
    return require_success(session.texremap(path_words(from, to))).output;
  };
  const std::string plain = path("gltf", "cycles-5/principled");
  CHECK(path("GLTF", "cycles-5/principled") == plain);
  const std::string named = path("unity", "Blender");
  CHECK_THAT(named, Contains("unity uses the model gltf (") &&
                        Contains("blender uses the model cycles-5/principled ("));
  CHECK(named.ends_with(plain));
  const std::string values = " --roughness 0.5 --base-color 0.8,0.4,0.2 --metallic 1 --json";
  const nlohmann::json a = nlohmann::json::parse(
      require_success(session.texremap("convert --from unity --to threejs" + values)).output);
  const nlohmann::json b = nlohmann::json::parse(
      require_success(session.texremap("convert --from gltf --to threejs/standard" + values)).output);
  CHECK(a["values"] == b["values"]);
  CHECK_THAT(require_success(session.texremap("list --workflows")).output,
             Contains("  also     arnold: ") && Contains("metal-rough: "));
  CHECK(require_success(session.texremap("help convert")).output ==
        require_success(session.texremap("convert --help")).output);
  CHECK(require_success(session.texremap("version")).output ==
        require_success(session.texremap("--version")).output);
}
