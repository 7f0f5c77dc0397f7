// This file tests paths between models with the converters that ship: `texremap path`, `list` and `convert`,
// how far pictures differ, the model that `--to RENDERER` chooses, and models that are more similar.
#include <algorithm>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "core/number_text.hpp"
#include "remap/path.hpp"
#include "remap/shipped_converters.hpp"
#include "remap/workflow.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

const std::string kDiffer = "rendered pictures differ by ", kCloser = " matches the highlight more closely";
const std::string kId = "mitsuba_ward_to_mitsuba_as";

const ConverterInfo& ward_to_as() { return find_converter("mitsuba/ward", "mitsuba/as").info(); }
double ward_to_as_expected() { return expected_error(ward_to_as()); }

// Returns what texremap prints about a converter: `rendered pictures differ by 3.1 % (8.2 % with copied
// numbers)`.
std::string measured_text(const ConverterInfo& info) {
  const PictureDifference pictures = info.pictures.value();
  return kDiffer + fixed(pictures.converted, 1) + " % (" + fixed(pictures.copied.value(), 1) +
         " % with copied numbers)";
}

ProcessResult path(const std::string& from, const std::string& to, const Words& more = {}) {
  return require_success(Session().texremap("path --from " + from + " --to " + to + more));
}

// Converts numbers instead of maps.
ProcessResult convert(const std::string& from, const std::string& to, const Words& more = {}) {
  return require_success(Session().texremap("convert --from " + from + " --to " + to +
                                            " --roughness 0.3 --specular 0.04" + more));
}

nlohmann::json json_of(const ProcessResult& result) { return nlohmann::json::parse(result.output); }

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

TEST_CASE("texremap path: prints steps, the difference of pictures, domain and reason, also as JSON") {
  CHECK_THAT(path("mitsuba/ward", "mitsuba/as").output,
             Contains("mitsuba/ward -> mitsuba/as\n") && Contains("1  " + kId) &&
                 Contains("\n" + measured_text(ward_to_as()) + "\n") &&
                 Contains("covers alpha 0.01 to 1, specular 0 to ") && Contains("chosen because "));
  const auto json = json_of(path("mitsuba/ward", "mitsuba/as", "--json"));
  CHECK(json["models"] == nlohmann::json({"mitsuba/ward", "mitsuba/as"}));
  CHECK(json["path"] == nlohmann::json::array({kId}));
  CHECK(json["expected_error"].get<double>() == Approx(ward_to_as_expected()).margin(1e-9));
  CHECK(json["assumed_image_error"] == kAssumedImageError);
  REQUIRE(json["steps"].size() == 1);
  CHECK(json["steps"][0]["rms_error"]["image"] == ward_to_as().image_rms_error.value());
  CHECK(json["steps"][0]["domain"] == json["domain"]);
  CHECK(json["reason"].is_string());
  for (const auto& other : json["alternatives"]) CHECK(other["expected_error"] >= json["expected_error"]);
  CHECK(json["same_lobe"] == false);
  CHECK(json["pictures"]["is_estimate"] == false);
  CHECK(json["closer_model"].is_null());
}

TEST_CASE("texremap list: what each model reaches, how far pictures differ, and what is closer") {
  const Session session;
  CHECK_THAT(session.texremap("list --models").output,
             Contains("mitsuba/ward\n  takes    alpha and specular\n") &&
                 Contains("  reaches  mitsuba/as, ") &&
                 Contains(" %, in 2 steps; cycles-5/beckmann" + kCloser + "\n"));
  const auto models = session.json("list --models --json");
  const ConverterGraph graph = shipped_graph();
  REQUIRE(models.size() == graph.models().size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    CHECK(models[i]["model"] == graph.models()[i]);
    CHECK(models[i]["reaches"].size() == graph.reachable_from(graph.models()[i]).size());
  }
  CHECK_THAT(
      session.texremap("list --pairs").output,
      Contains("  note   " + measured_text(find_converter("mitsuba/ward", "mitsuba/ggx").info()) + "\n"));
  const auto pairs = session.json("list --pairs --json");
  REQUIRE(pairs.size() == shipped_converters().size());
  CHECK(pairs[0]["self_test"] == true);
  CHECK(pairs[0]["source"]["model"].is_string());
  for (const nlohmann::json& converter : pairs)
    if (converter["rms_error"].at("image").is_null()) {
      CHECK(converter["pictures"].is_null());
      CHECK(converter["closer_model"].is_null());
    }
}

TEST_CASE("texremap convert: says which path it took, in JSON and in metadata") {
  const Session session;
  session.write_pair("exr", 16);
  const ProcessResult result = require_success(session.convert("r.exr", "s.exr", "--json"));
  const auto json = json_of(result);
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
  const ProcessResult result = require_success(
      session.texremap("convert --from " + request.source + " --via " + request.via.front() + " --to " +
                       request.target + " --roughness r.exr --specular s.exr -o out --json"));
  const ConverterPath path = shipped_graph().find_paths(request).front();
  std::string ids, models = request.source;
  for (const Converter* step : path.steps) {
    ids += (ids.empty() ? "" : " ") + step->info().id;
    models += " -> " + step->info().target.model;
  }
  CHECK(json_of(result)["path"].size() == path.steps.size());
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
  const Session session;
  const auto ramp = [](int x, int, int) { return 0.2f + 0.03f * static_cast<float>(x); };
  session.map("r.exr", kGrey, ramp, OIIO::TypeFloat, 16);
  session.flat("s.exr", {0.5f}, OIIO::TypeFloat, 16);
  const auto json = session.json(
      "convert --from cycles-5/ggx --to threejs-r187/standard-metal --roughness r.exr --specular s.exr -o "
      "out "
      "--json");
  CHECK(json["path"] ==
        nlohmann::json({"cycles_5_ggx_to_mitsuba_ggx", "mitsuba_ggx_to_threejs_r187_standard_metal"}));
  const TestImage r = session.image("out/r.exr"), s = session.image("out/s.exr");
  // All three models are GGX with alpha = roughness^2. They differ in masking, multiple scattering and the
  // Fresnel rise at the rim. Only Three.js has this rise. It is visible on rough surfaces, where it reduces
  // specular.
  for (int x = 0; x < 16; ++x) {
    const float source = ramp(x, 0, 0);
    INFO("roughness " << source);
    CHECK(r.at(x, 5, 0) == Approx(source).margin(source < 0.45f ? 0.005 : 0.02));
    CHECK(s.at(x, 5, 0) == Approx(0.5).margin(source < 0.4f ? 0.02 : 0.1));
  }
}

TEST_CASE("texremap convert: a note in one line says how far pictures differ and which model is closer") {
  const ProcessResult result = convert("mitsuba/ward", "cycles-5/ggx");
  CHECK_THAT(result.errors,
             Catch::StartsWith("texremap: note: mitsuba/ward to cycles-5/ggx: " + kDiffer + "about ") &&
                 Catch::EndsWith(" %; cycles-5/beckmann" + kCloser + "\n"));
  CHECK(count_of(result.errors, "\n") == 1);
  CHECK(count_of(result.output, "\n") == 2);
  const ProcessResult quiet = convert("mitsuba/ward", "cycles-5/ggx", "--quiet");
  CHECK(quiet.errors.empty());
  CHECK(quiet.output == result.output);
  CHECK(convert("mitsuba/ward", "mitsuba/as").errors ==
        "texremap: note: mitsuba/ward to mitsuba/as: " + measured_text(ward_to_as()) + "\n");

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
  const ProcessResult copied = convert("mitsuba3/ggx", "mitsuba/ggx");
  CHECK(copied.output == "alpha 0.3\nf0 0.04\n");
  CHECK(copied.errors == "texremap: note: mitsuba3/ggx to mitsuba/ggx" + equal + "numbers are copied\n");
  const ProcessResult encoded = convert("mitsuba/ggx", "cycles-3.4/ggx");
  CHECK(encoded.output == "roughness 0.547723\ncolor 0.04\n");
  CHECK(encoded.errors ==
        "texremap: note: mitsuba/ggx to cycles-3.4/ggx" + equal + "only the encoding of roughness changes\n");
  CHECK(json_of(convert("mitsuba3/ggx", "mitsuba/ggx", "--json"))["same_lobe"] == true);
}

TEST_CASE("texremap: what nobody sees is not remarked on") {
  CHECK(convert("mitsuba/ggx", "cycles-5/ggx").errors.empty());
  CHECK(convert("mitsuba/beckmann", "mitsuba/as").errors.empty());
  CHECK_THAT(path("mitsuba/ggx", "cycles-5/ggx").output, !Contains("note: "));
}

TEST_CASE("texremap: --to RENDERER takes the closest of its models and says which") {
  const ProcessResult result = convert("mitsuba/ward", "cycles-5"),
                      named = convert("mitsuba/ward", "cycles-5/beckmann");
  CHECK(result.output == named.output);
  CHECK(result.errors ==
        "texremap: note: cycles-5/beckmann is the closest model of cycles-5\n" + named.errors);
  CHECK(convert("mitsuba/ward", "cycles-5", "--quiet").errors.empty());
  const nlohmann::json json = json_of(convert("mitsuba/ward", "cycles-5", "--json"));
  CHECK(json["closest_of"] == "cycles-5");
  CHECK(json["target"] == "cycles-5/beckmann");

  CHECK(path("mitsuba/ward", "cycles-5")
            .output.starts_with("cycles-5/beckmann is the closest model of cycles-5\nmitsuba/ward -> "));
  CHECK_THAT(path("mitsuba/ward", "cycles-5/ggx").output, Contains("note: cycles-5/beckmann" + kCloser));
  const nlohmann::json plan = json_of(path("mitsuba/ward", "cycles-5", "--json"));
  CHECK(plan["closest_of"] == "cycles-5");
  CHECK(plan["models"].back() == "cycles-5/beckmann");
  CHECK(json_of(path("cycles-5/ggx", "mitsuba", "--json"))["models"].back() == "mitsuba/ggx");
}

TEST_CASE("texremap: a workflow is compared with the models of its own renderer, a fit by its own pictures") {
  CHECK_THAT(path("mitsuba/ward", "gltf").output, !Contains(kCloser));
  CHECK_THAT(path("mitsuba/ward", "cycles-5/principled").output, Contains("cycles-5/beckmann" + kCloser));
  CHECK(path("gltf", "mitsuba").output.starts_with("mitsuba/ggx is the closest model of mitsuba\ngltf: "));
  const ProcessResult result = require_success(
      Session().texremap("convert --converters " REMAP_SOURCE_DIR
                         "/fits/mitsuba_ward_to_mitsuba_ggx.json --roughness 0.3 --specular 0.04"));
  CHECK_THAT(result.errors, Contains(measured_text(find_converter("mitsuba/ward", "mitsuba/ggx").info())) &&
                                !Contains(kCloser));
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

  const std::string plain = path("gltf", "cycles-5/principled").output;
  CHECK(path("GLTF", "cycles-5/principled").output == plain);
  const std::string named = path("unity", "Blender").output;
  CHECK_THAT(named, Contains("unity uses the model gltf (") &&
                        Contains("blender uses the model cycles-5/principled ("));
  CHECK(named.ends_with(plain));
  const std::string values = " --roughness 0.5 --base-color 0.8,0.4,0.2 --metallic 1 --json";
  CHECK(session.json("convert --from unity --to threejs" + values)["values"] ==
        session.json("convert --from gltf --to threejs/standard" + values)["values"]);
  CHECK_THAT(require_success(session.texremap("list --workflows")).output,
             Contains("  also     arnold: ") && Contains("metal-rough: "));
  const std::string version = require_success(session.texremap("--version")).output;
  CHECK(version.starts_with("texremap "));
  CHECK(require_success(session.texremap("version")).output == version);
  CHECK(require_success(session.texremap("help convert")).output ==
        require_success(session.texremap("convert --help")).output);
}
