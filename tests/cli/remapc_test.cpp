// This file tests remapc and remap-study as a user runs them: a chain of commands, tables of sweeps and
// samples, fits between workflows, studies, and runs that are interrupted.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "converter/converter_data.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "support/test_image.hpp"

using namespace remap;
namespace fs = std::filesystem;

TEST_CASE("remapc: sweep, check, fit, emit, eval, list and show work in a row") {
  const Session session;
  ProcessResult result =
      require_success(session.remapc(session.sweep("t.csv", "mitsuba/as-ior", "mitsuba/beckmann-ior")));
  CHECK(session.content("t.csv").starts_with(kHeader));  // plain CSV without comments
  CHECK(session.content("t.csv.json").find("\"source\": \"mitsuba/as-ior\",\n") != std::string::npos);
  CHECK(result.errors.find("36 rows (3 clamped, 33 ok)") != std::string::npos);
  CHECK(session.remapc("check t.csv").exit_code == 0);
  require_success(session.remapc(session.fit("t.csv")));
  const std::string fit = session.path("fits/mitsuba_as_ior_to_mitsuba_beckmann_ior.json");
  CHECK(load_fit(fit).table.comments.at("objective") == "natural-2");
  require_success(session.remapc("emit --all --fits fits -o generated"));
  CHECK(fs::exists(session.path("generated/converters.json")));
  result = session.remapc("eval " + fit + " t.csv --json");
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("\"rows\": 36") != std::string::npos);
  CHECK(result.output.find("\"fitted_from_this_table\": true") != std::string::npos);
  CHECK(session.remapc("list --fits fits").output.find("parametric") != std::string::npos);
  result = session.remapc("show mitsuba_as_ior_to_mitsuba_beckmann_ior --fits fits");
  CHECK(result.output.find("mitsuba/beckmann-ior (alpha, f0)") != std::string::npos);
}

TEST_CASE("remapc eval --grid: prints what the interpreter gives over the domain, without a table") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  require_success(session.remapc(session.fit("t.csv")));
  const std::string path = session.path("fits/made_ward_to_made_as.json");
  const Fit fit = load_fit(path);
  std::string expected = "source_alpha,source_specular,target_alpha,target_f0\n";
  const Range widths = own_roughness_range(fit), speculars = specular_range(fit);
  for (const double width : {widths.min, (widths.min + widths.max) / 2.0, widths.max})
    for (const double specular : {speculars.min, (speculars.min + speculars.max) / 2.0, speculars.max}) {
      double out = 0.0;
      const double target = evaluate_texel(fit, width, {&specular, 1}, {&out, 1});
      for (const double value : {width, specular, target}) expected += number_text(value) + ",";
      expected += number_text(out) + "\n";
    }
  CHECK(session.remapc("eval " + path + " --grid 3").output == expected);
  const std::string file = session.path("new/grid.csv");
  CHECK(session.remapc("eval " + path + " --grid 3 -o " + file).output.empty());
  CHECK(read_file(file) == expected);
}

TEST_CASE("remapc: a result that exists is refused, and replaced with --force") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  require_success(session.remapc(session.fit("t.csv")));
  const std::string fit = session.path("fits/made_ward_to_made_as.json");
  require_success(session.remapc("emit " + fit + " -o ."));
  // emit only replaces files that are marked as generated
  require_success(session.remapc("emit " + fit + " -o ."));
  for (const std::string name :
       {"s.exr", "grid.csv", "p.png", "c.json", "plain.csv", "own/made_ward_to_made_as.hpp"})
    session.write(name, "mine");
  const auto check = [&](const Words& words, const std::string& name) {
    const std::string before = session.content(name);
    check_failure(session.remapc(words), 1, name + ": already exists (--force overwrites)");
    CHECK(session.content(name) == before);
    require_success(session.remapc(words + "--force"));
    CHECK((session.content(name) != before || name.starts_with("fits")));
  };
  check(session.fit("t.csv"), "fits/made_ward_to_made_as.json");
  check("emit " + fit + " -o own", "own/made_ward_to_made_as.hpp");
  check("eval " + fit + " --grid 3 -o grid.csv", "grid.csv");
  check("preview mitsuba_ward_to_mitsuba_ggx --resolution 16 -o p.png --fits " REMAP_SOURCE_DIR "/fits",
        "p.png");
  check("chain mitsuba_ward_to_mitsuba_ggx mitsuba_ggx_to_cycles_2_7_ggx --id c -o . --fits " REMAP_SOURCE_DIR
        "/fits",
        "c.json");
  check("export t.csv -o plain.csv", "plain.csv");
  check("render --model mitsuba/ggx --set alpha=0.3 --set f0=0.9 --resolution 8 -o s.exr", "s.exr");
}

TEST_CASE("remapc list: a folder without fits says so") {
  const Session session;
  session.write("empty/readme.txt", "");
  const ProcessResult result = session.remapc("list --fits empty");
  CHECK(result.exit_code == 0);
  CHECK(result.errors.find("no fits (*.json) in this folder") != std::string::npos);
}

TEST_CASE("remapc sweep: killed or interrupted it leaves nothing under the final name") {
  const Session session;
  for (const int signal : {SIGKILL, SIGTERM}) {
    auto arguments = session.sweep("broken.csv");
    arguments[6] = "512";  // large enough to run for seconds
    arguments[8] = "400";
    Process process = session.start(REMAPC_PROGRAM + arguments);
    while (process.is_running() && !process.catches(SIGTERM))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.send(signal);
    const ProcessResult result = process.wait();
    CAPTURE(signal, result.signal, result.exit_code, result.errors);
    CHECK((signal == SIGKILL ? result.signal == SIGKILL : result.exit_code == 1));
    CHECK_FALSE(fs::exists(session.path("broken.csv")));
  }
}

TEST_CASE("remapc render: writes an EXR that OpenImageIO's own tools read") {
  const Session session;
  const ProcessResult result = require_success(session.remapc(
      "render --model mitsuba/ggx --set alpha=0.3 --set f0=0.9,0.6,0.2 --light 45 --resolution 32 -o s.exr"));
  const ProcessResult info = session.run("/usr/bin/oiiotool --info -v s.exr");
  CHECK(info.output.find("32 x   32, 3 channel, float openexr") != std::string::npos);
  CHECK(info.output.find("remap:model: \"mitsuba/ggx\"") != std::string::npos);
}

TEST_CASE("remapc sweep: stages and diffuse give columns that check and fit accept", "[slow]") {
  const Session session;
  for (const std::string stages : {"1", "2", "3"}) {
    auto arguments = session.sweep("t" + stages + ".csv");
    arguments += "--stages " + stages + " --diffuse 0.25";
    const ProcessResult result = require_success(session.remapc(arguments));
    const std::string made = session.content("t" + stages + ".csv.json");
    CHECK(made.find("\"stages\": \"" + stages + "\"") != std::string::npos);
    CHECK(made.find("\"irradiance_scale\": \"1\"") != std::string::npos);
    CHECK(session.content("t" + stages + ".csv")
              .starts_with("alpha1,specular1,alpha2,specular2,diffuse1,diffuse2,error,status\n"));
  }
  CHECK(session.remapc("check t2.csv").exit_code == 0);
  CHECK(session.remapc(session.fit("t2.csv") + "--source made/ward --target made/as").exit_code == 0);
}

TEST_CASE("remapc sweep: models with an index are swept in F0") {
  const Session session;
  const ProcessResult result =
      require_success(session.remapc("sweep --source mitsuba/as-ior --target mitsuba/ggx-ior --resolution 48 "
                                     "--roughness-samples 3 --specular-samples 3 -o t.csv"));
  const std::string table = session.content("t.csv.json");
  CHECK(table.find("\"source_specular\": \"ior\"") != std::string::npos);
  CHECK(table.find("\"target_specular_law\": \"ior\"") != std::string::npos);
  CHECK(table.find("\"target_specular_column\": \"f0\"") != std::string::npos);
  CHECK(table.find("3 specular 0 to 0.36\"") != std::string::npos);
}

TEST_CASE("remapc sample: a table of named columns that check reads and fit --swap inverts", "[slow]") {
  const Session session;
  const ProcessResult result = require_success(session.remapc(Words(
      "sample --source mitsuba/ggx-metallic --target mitsuba/ggx --vary metallic --range roughness=0.4,0.9 "
      "--resolution 32 --count 50 --seed 7 --json -o " +
      session.path("t.csv"))));
  CHECK(result.output.find("\"rows\": 50") != std::string::npos);
  CHECK(result.output.find("\"base_color_g1\"") != std::string::npos);
  CHECK(session.remapc("check t.csv").exit_code == 0);
}

TEST_CASE("remapc sweep: roles and fixed values of parameters are given on the command line") {
  const Session session;
  const ProcessResult result = require_success(
      session.remapc(Words("sweep --source mitsuba/ggx-metallic --target mitsuba/ggx --resolution 32 "
                           "--roughness-samples 2 --specular-samples 2 --source-specular metallic "
                           "--source-set base_color=0.8 -o " +
                           session.path("t.csv"))));
  const std::string table = session.content("t.csv.json");
  CHECK(
      table.find("\"source_specular\": \"metallic\",\n  \"source_fixed\": \"base_color=0.8,specular=0.5\"") !=
      std::string::npos);
}

TEST_CASE("remapc preview: writes pictures and figures of a committed fit", "[slow]") {
  const Session session;
  const ProcessResult result =
      require_success(session.remapc("preview mitsuba_ward_to_mitsuba_ggx --fits " REMAP_SOURCE_DIR "/fits"
                                     " --alpha 0.2,0.5 --resolution 32 --json -o p.png"));
  CHECK(result.output.find("\"light\": \"studio\"") != std::string::npos);
  CHECK(result.output.find("\"shape\": \"torus\"") == std::string::npos);
  const TestImage labelled = read_image(session.path("p.png"));
  require_success(session.remapc("preview mitsuba_ward_to_mitsuba_ggx --fits " REMAP_SOURCE_DIR "/fits"
                                 " --alpha 0.2,0.5 --resolution 32 --no-labels -o bare.png"));
  const TestImage bare = read_image(session.path("bare.png"));
  constexpr int kCell = 32 + 2 * 1;  // a picture with its margin
  CHECK(bare.spec.width == 3 * kCell);
  CHECK(bare.spec.height == 2 * kCell);
  CHECK(labelled.spec.width > bare.spec.width);
  CHECK(labelled.spec.height > bare.spec.height);
}

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

namespace {

// Returns the arguments of a study of two pairs that takes a second.
Words small_study(const Words& more = {}, const std::string& fits = REMAP_SOURCE_DIR "/fits") {
  return "environments --pair mitsuba/ward:mitsuba/as --pair mitsuba/beckmann:mitsuba/ggx --alphas 0.2,0.5 "
         "--resolution 16 --samples 64 --fits " +
         fits + more;
}

// Returns the difference between the brightest and the darkest value of a picture.
float contrast(const std::string& path) {
  const TestImage image = read_image(path);
  const auto [darkest, brightest] = std::minmax_element(image.values.begin(), image.values.end());
  return *brightest - *darkest;
}

}  // namespace

TEST_CASE("remap-study environments: writes its comparisons and pictures", "[needs][slow]") {
  const Session session;
  // The second pair has no fit.
  const std::string fit = "mitsuba_ward_to_mitsuba_as.json";
  session.write("fits/" + fit, read_file(std::filesystem::path(REMAP_SOURCE_DIR "/fits") / fit));
  const ProcessResult result =
      require_success(session.study(small_study("-o study --pictures --least-error", session.path("fits"))));
  CHECK(result.output.empty());
  // There are the header and the rows: 11 pairs of models and methods, 2 alphas, 3 environments.
  CHECK(count_of(session.content("study/environments.csv"), "\n") == 1 + 11 * 2 * 3);
  CHECK_THAT(session.content("study/environments.csv.json"), Catch::Contains("\"resolution\": \"16\""));
  for (const std::string name : {"sky", "overcast", "studio"})
    CHECK(contrast(session.path("study/spheres_" + name + ".png")) > 0.5f);
  check_failure(session.study(small_study("-o study")), 1,
                "study/environments.csv: already exists (--force overwrites)", "remap-study");
  require_success(session.study(small_study("-o study --force")));
}

TEST_CASE("remap-study environments: prints its comparisons after their settings", "[slow]") {
  const Session session;
  const ProcessResult result = require_success(session.study(small_study()));
  CHECK(result.output.find("# tool: remap-study ") == 0);
  CHECK_THAT(result.output,
             Catch::Contains("\n# resolution: 16\n") && Catch::Contains("\nsource,target,alpha,"));
  // There are 6 comments, the header, and the rows: 10 pairs of models and methods, 2 alphas, 3 environments.
  CHECK(count_of(result.output, "\n") == 7 + 10 * 2 * 3);
  CHECK(session.file_count() == 0);
}

TEST_CASE("remap-study workflows: writes comparisons, round trips and pictures", "[needs][slow]") {
  const Session session;
  session.write("materials.csv",
                "material,group,alpha,diffuse_r,diffuse_g,diffuse_b,f0_r,f0_g,f0_b\n"
                "red,paint,0.2,0.9,0.1,0,0.04,0.04,0.05\nblue,metal,0.5,0,0,0,0.3,0.3,0.9\n");
  session.write("none/remark.txt", "");
  const Words small = "workflows materials.csv --samples 64 --resolution 16 --fits none --family-count 50";
  const ProcessResult result = require_success(session.study(small + "-o study --pictures"));
  CHECK(result.output.empty());
  // There are the header and the rows: 2 materials by 7 plain methods and 5 of glTF, under three environments
  // and the headlight.
  const std::string csv = session.content("study/workflows.csv");
  CHECK(count_of(csv, "\n") == 1 + 2 * (7 + 5) * 4);
  // Every method has three families. Khronos' solver and both means are in both conventions.
  CHECK(count_of(session.content("study/workflows_round_trips.csv"), "\n") == 1 + (6 + 4) * 3);
  CHECK(contrast(session.path("study/workflows_sky.png")) > 0.5f);
  const ProcessResult printed = require_success(session.study(small));
  CHECK(printed.output.substr(printed.output.find("convention,")) == csv);
}
