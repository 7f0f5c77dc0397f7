// This file tests remapc on fits between workflows: which commands accept them, and which refuse them.
#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "converter/converter_data.hpp"

using namespace remap;

namespace {

const std::string kManifest =
    R"({"format": "remap-manifest", "version": 1, "published": [], "sweeps": [], "inverses": [], "chains": [],
  "workflows": [{"id": "painted_to_metal",
    "source": {"model": "painted", "workflow": "specular", "diffuse": "plain", "roughness": "glossiness"},
    "target": {"model": "metal", "workflow": "metallic", "dielectric_f0": 0.05, "diffuse": "plain", "roughness": "alpha"},
    "mapping": {"kind": "workflow", "formula": "projection", "prior": 1e-5}, "remarks": ["Mine."]}]})";

const std::string kBuild = "build --json --fits fits -o generated";

}  // namespace

TEST_CASE("remapc with fits of workflows: build, list, show and emit take them", "[slow]") {
  const Session session;
  session.write("fits/manifest.json", kManifest);
  const ProcessResult built = require_success(session.remapc(kBuild));
  CHECK(nlohmann::json::parse(built.output)["built"][0]["id"] == "painted_to_metal");
  CHECK(nlohmann::json::parse(session.remapc(kBuild).output)["built"].empty());
  CHECK(session.content("fits/README.md").find("painted_to_metal.json) | 0.05") != std::string::npos);
  CHECK(converters_from_json(session.content("generated/converters.json"), "").empty());
  const std::string fits = session.path("fits");
  CHECK(session.remapc("emit --all --check --fits " + fits + " -o generated").exit_code == 0);
  const auto list = nlohmann::json::parse(session.remapc("list --json --fits " + fits).output);
  CHECK(list[0]["kind"] == "workflow");
  CHECK(list[0]["formula"] == "projection");
  CHECK(session.remapc("list --fits " + fits).output.find("whole materials") != std::string::npos);
  const std::string card = session.remapc("show painted_to_metal --fits " + fits).output;
  for (const std::string part :
       {"F0 of a dielectric 0.05", "base_color RGB", "glossiness", "prior 1e-05", "Mine."})
    CHECK(card.find(part) != std::string::npos);
  CHECK(session.remapc("show painted_to_metal --json --fits " + fits).output ==
        session.content("fits/painted_to_metal.json"));
}

TEST_CASE("remapc fit of random metallic materials: a network of whole materials", "[slow]") {
  const Session session;
  const std::string table = session.path("metallic.csv");
  require_success(
      session.remapc("sample --source mitsuba/ggx-metallic --vary metallic --target mitsuba/ggx --resolution "
                     "16 --count 60 -o " +
                     table));
  const ProcessResult fitted =
      require_success(session.remapc("fit " + table + " --swap --layers 8 --id back --json -o fits"));
  CHECK(nlohmann::json::parse(fitted.output)["kind"] == "mlp");
  const std::string card = session.remapc("show back --fits fits").output;
  for (const std::string part :
       {"a network of 6 x 8 x 4 (relu)", "F0 of a dielectric 0.04", "metallic     rms"})
    CHECK(card.find(part) != std::string::npos);
  require_success(session.remapc("emit back --fits fits -o generated"));
  CHECK(session.content("generated/back.hpp").find("material_network") != std::string::npos);
}

TEST_CASE(
    "remapc build of a network: fit and header from samples that are not kept, and nothing when it is run "
    "again",
    "[slow]") {
  const Session session;
  const auto manifest = [](const std::string& f0) {
    return R"({"format": "remap-manifest", "version": 1, "published": [], "sweeps": [], "inverses": [], "chains": [],
  "networks": [{"id": "learned",
    "source": {"model": "painted", "workflow": "specular", "diffuse": "plain", "roughness": "glossiness"},
    "target": {"model": "metal", "workflow": "metallic", "dielectric_f0": )" +
           f0 + R"(, "diffuse": "plain", "roughness": "alpha"},
    "samples": {"metallic": "mitsuba/ggx-metallic", "specular": "mitsuba/ggx", "fixed": {"specular": 0.375},
                "vary": ["metallic"], "count": 60, "resolution": 16},
    "hidden": [4], "activation": "relu", "seed": 3, "remarks": ["Mine."]}]})";
  };
  session.write("fits/manifest.json", manifest("0.03"));
  const ProcessResult built = require_success(session.remapc(kBuild));
  CHECK_FALSE(std::filesystem::exists(session.path("fits/tables/learned.csv")));
  // `remapc sample` makes the samples that the fit records.
  require_success(session.remapc(
      "sample --source mitsuba/ggx-metallic --source-set specular=0.375 --vary metallic --target mitsuba/ggx "
      "--objective natural-1 --resolution 16 --count 60 --seed 3 -o samples.csv"));
  require_success(session.remapc("fit samples.csv --swap --layers 4 --seed 3 --id again -o mine"));
  const auto table_of = [&](const std::string& fit) {
    return nlohmann::json::parse(session.content(fit))["training"]["table"]["sha256"];
  };
  CHECK(table_of("fits/learned.json") == table_of("mine/again.json"));
  CHECK(session.content("generated/learned.hpp").find("Materials of painted (specular workflow)") !=
        std::string::npos);
  CHECK(nlohmann::json::parse(session.remapc(kBuild).output)["built"].empty());
  session.write("fits/manifest.json", manifest("0.04"));
  check_failure(session.remapc(kBuild), 1, "dielectric F0 is 0.03 in the samples and 0.04 in the manifest");
}
