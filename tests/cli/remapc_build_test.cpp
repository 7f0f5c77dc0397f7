// This file tests remapc build, chain, invert and fit --swap: fits from a manifest, and fits made from other
// fits.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"

using namespace remap;

namespace {

// Returns a manifest of a pair of small sweeps, a published formula, its inverse, and a chain of both. Fits
// of ward and ward-duer are compared by pictures, which takes nine seconds.
std::string manifest() {
  return R"({"format": "remap-manifest", "version": 1,
  "published": [{"id": "a_b_to_mitsuba_ward", "from": "nobody 2020",
    "source": {"model": "a/b", "roughness": "roughness", "specular": "specular"},
    "target": {"model": "mitsuba/ward", "roughness": "alpha", "specular": "specular"},
    "domain": {"alpha": [0.05, 0.6], "specular": [0, 0.5]}, "roughness": [0.9, 0.05],
    "slope": {"c0": 0.5, "c1": 0.3, "c2": 2, "c3": 0, "c4": 0, "c5": 0}, "remarks": ["As printed."]}],
  "sweeps": [{"models": ["mitsuba/ward", "mitsuba/ward-duer"], "objective": "natural", "resolution": 48,
    "alpha": [0.05, 0.6], "roughness_samples": 12, "specular_samples": 3, "seed": 1}],
  "inverses": [{"id": "mitsuba_ward_to_a_b", "of": "a_b_to_mitsuba_ward", "seed": 1}],
  "chains": [{"id": "a_b_to_mitsuba_ward_duer", "steps": ["a_b_to_mitsuba_ward", "mitsuba_ward_to_mitsuba_ward_duer"]}]})";
}

// Returns the same manifest, but its models have an index of refraction, so fits are not compared by
// pictures. Leaves out the inverse, because its 480 rows take longer to fit than all other rows.
nlohmann::json quick_manifest(int resolution = 48) {
  auto items = nlohmann::json::parse(manifest());
  items["published"][0]["id"] = "a_b_to_mitsuba_as_ior";
  items["published"][0]["target"]["model"] = "mitsuba/as-ior";
  items["published"][0]["target"]["specular"] = "f0";
  items["sweeps"][0]["models"] = {"mitsuba/as-ior", "mitsuba/ggx-ior"};
  items["sweeps"][0]["resolution"] = resolution;
  items["inverses"] = nlohmann::json::array();
  items["chains"][0] = {{"id", "a_b_to_mitsuba_ggx_ior"},
                        {"steps", {"a_b_to_mitsuba_as_ior", "mitsuba_as_ior_to_mitsuba_ggx_ior"}}};
  return items;
}

// Returns the same pairs as published formulas instead of sweeps, which are built in no time.
nlohmann::json published_manifest() {
  auto items = quick_manifest();
  items["sweeps"] = nlohmann::json::array();
  const nlohmann::json as = items["published"][0]["target"];
  for (const bool is_back : {false, true}) {
    nlohmann::json formula = items["published"][0], ggx = as;
    ggx["model"] = "mitsuba/ggx-ior";
    formula["source"] = is_back ? ggx : as;
    formula["target"] = is_back ? as : ggx;
    formula["id"] = is_back ? "mitsuba_ggx_ior_to_mitsuba_as_ior" : "mitsuba_as_ior_to_mitsuba_ggx_ior";
    items["published"].push_back(formula);
  }
  return items;
}

Words build_of(const Words& more = {}) { return "build --json --fits fits -o generated" + more; }

std::vector<std::string> built_ids(const ProcessResult& result) {
  require_success(result);
  std::vector<std::string> ids;
  const auto json = nlohmann::json::parse(result.output);
  for (const auto& item : json["built"]) ids.push_back(item["id"]);
  return ids;
}

void append(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::app) << text; }

}  // namespace

TEST_CASE("remapc build: makes the items of the manifest, and none twice", "[slow]") {
  const Session session;
  session.write("fits/manifest.json", manifest());
  const ProcessResult first = session.remapc(build_of());
  CHECK(built_ids(first) == std::vector<std::string>{"a_b_to_mitsuba_ward", "a_b_to_mitsuba_ward_duer",
                                                     "mitsuba_ward_duer_to_mitsuba_ward",
                                                     "mitsuba_ward_to_a_b",
                                                     "mitsuba_ward_to_mitsuba_ward_duer"});
  // The stages add up to at most the whole. Only the table of a sweep needs pictures.
  const auto made = nlohmann::json::parse(first.output)["built"];
  for (const auto& item : made) {
    const auto& seconds = item["seconds"];
    CHECK(seconds["pictures"] <= seconds["sweep"]);
    CHECK(seconds["sweep"].get<double>() + seconds["fit"].get<double>() + seconds["lowering"].get<double>() <=
          seconds["all"].get<double>());
    CHECK(seconds["lowering"] > 0.0);
    const std::string id = item["id"];
    CHECK((item["pictures"] > 0) ==
          (id.starts_with("mitsuba") && id.find("_to_mitsuba") != std::string::npos));
  }
  CHECK(built_ids(session.remapc(build_of())).empty());
  CHECK(session.remapc(build_of("--check")).exit_code == 0);
  const Words emit = "emit --all --check --fits fits -o generated";
  CHECK(session.remapc(emit).exit_code == 0);
  const std::string report = session.content("fits/README.md");
  // The compared pair comes before the published pair, whose heading has the mark (!).
  const std::size_t measured = report.find("| mitsuba/ward, mitsuba/ward-duer | [");
  const std::size_t published = report.find("[a/b to mitsuba/ward](a_b_to_mitsuba_ward.json)");
  CHECK(report.find("## Never compared **(!)**") < published);
  CHECK(measured < published);
  CHECK(published != std::string::npos);
  CHECK(report.find("marks 3 of 5 converters") != std::string::npos);
  const std::string figures = session.content("fits/converters.csv");
  CHECK(figures.starts_with("converter,kind,source,target,warning,image_error,"));
  CHECK(std::count(figures.begin(), figures.end(), '\n') == 6);
  CHECK(figures.find("\na_b_to_mitsuba_ward,parametric,a/b,mitsuba/ward,pictures never compared,,") !=
        std::string::npos);
  CHECK(figures.find("Published in nobody 2020. As printed.\n") != std::string::npos);
  CHECK(figures.find(",Composed of a_b_to_mitsuba_ward; then") != std::string::npos);  // cells have no commas
  const ProcessResult card = session.remapc("show mitsuba_ward_to_mitsuba_ward_duer --fits fits");
  CHECK(card.output.find("Round trip through mitsuba_ward_duer_to_mitsuba_ward\n  alpha   changes by") !=
        std::string::npos);
}

TEST_CASE("remapc build: only what changed is made again", "[slow]") {
  const std::string id = "mitsuba_as_ior_to_mitsuba_ggx_ior", header = "generated/" + id + ".hpp";
  const Session session;
  session.write("fits/manifest.json", quick_manifest().dump());
  CHECK(built_ids(session.remapc(build_of())).size() == 4);

  // If a header was edited, only this header is made again.
  append(session.path(header), "// mine\n");
  const ProcessResult check = session.remapc(build_of("--check"));
  CHECK(check.exit_code == 1);
  CHECK(check.output.find("was changed after the last build") != std::string::npos);
  const std::string fit = session.content("fits/" + id + ".json");
  const ProcessResult again = session.remapc(build_of());
  CHECK(built_ids(again) == std::vector<std::string>{id});
  CHECK_FALSE(nlohmann::json::parse(again.output)["built"][0]["fit"].get<bool>());
  CHECK(session.content("fits/" + id + ".json") == fit);

  // A deleted fit is made again from its table, with the same bytes.
  std::filesystem::remove(session.path("fits/" + id + ".json"));
  CHECK(built_ids(session.remapc(build_of())).size() == 1);
  CHECK(session.content("fits/" + id + ".json") == fit);

  // If the recipe of the sweeps changes, both pairs are made again. So is the chain that uses one of them.
  session.write("fits/manifest.json", quick_manifest(56).dump());
  CHECK(built_ids(session.remapc(build_of())) ==
        std::vector<std::string>{"a_b_to_mitsuba_ggx_ior", id, "mitsuba_ggx_ior_to_mitsuba_as_ior"});
}

TEST_CASE("remapc build: converters.json that is not of the last build is made again", "[slow]") {
  const Session session;
  auto items = quick_manifest();
  items["chains"] = items["sweeps"] = nlohmann::json::array();
  session.write("fits/manifest.json", items.dump());
  session.write("t.csv", made_table(14, 4));
  require_success(session.remapc(session.fit("t.csv")));  // the manifest has no item for this fit
  const std::string list = session.path("generated/converters.json"), id = "a_b_to_mitsuba_as_ior";
  const auto is_current = [&] {
    return session.remapc("emit --all --check --fits fits -o generated").output.find("converters.json") ==
           std::string::npos;
  };
  CHECK(built_ids(session.remapc(build_of())) == std::vector<std::string>{id});
  const std::string text = read_file(list);
  CHECK(text.find("made_ward_to_made_as") != std::string::npos);
  CHECK(is_current());

  // If the file was changed by hand, it is made again.
  append(list, "\n");
  const ProcessResult check = session.remapc(build_of("--check"));
  CHECK(check.exit_code == 1);
  CHECK(check.output.find("converters.json: is out of date with the fits") != std::string::npos);
  CHECK(built_ids(session.remapc(build_of())).empty());
  CHECK(read_file(list) == text);

  // If a converter is made again with the same recipe, the file does not change. If the recipe changes, the
  // file does, too.
  std::filesystem::remove(session.path("generated/" + id + ".hpp"));
  CHECK(built_ids(session.remapc(build_of())) == std::vector<std::string>{id});
  CHECK(read_file(list) == text);
  items["published"][0]["slope"]["c0"] = 0.6;
  session.write("fits/manifest.json", items.dump());
  CHECK(built_ids(session.remapc(build_of())) == std::vector<std::string>{id});
  CHECK(read_file(list) != text);
  CHECK(is_current());
}

TEST_CASE("remapc build: a table that was changed after its fit is reported") {
  const Session session;
  session.write("fits/manifest.json", kEmptyManifest);
  session.write("fits/tables/t.csv", made_table(14, 4));
  require_success(session.remapc(session.fit("fits/tables/t.csv")));
  CHECK(session.remapc(build_of("--check")).output.find("out of date with the fits") != std::string::npos);
  CHECK(built_ids(session.remapc(build_of())).empty());
  CHECK(session.remapc(build_of("--check")).exit_code == 0);
  append(session.path("fits/tables/t.csv"), "0.5,0.5,0.4,0.4,0,ok\n");
  const ProcessResult check = session.remapc(build_of("--check"));
  CHECK(check.exit_code == 1);
  CHECK(check.output.find("t.csv was changed after the fit") != std::string::npos);
}

TEST_CASE("remapc build: items that left the manifest are reported, and removed on request", "[slow]") {
  const std::string published = "a_b_to_mitsuba_as_ior";
  const std::vector<std::string> swept = {"mitsuba_as_ior_to_mitsuba_ggx_ior",
                                          "mitsuba_ggx_ior_to_mitsuba_as_ior"};
  const Session session;
  auto items = quick_manifest();
  items["chains"] = nlohmann::json::array();
  session.write("fits/manifest.json", items.dump());
  require_success(session.remapc(build_of()));
  items["published"] = items["sweeps"] = nlohmann::json::array();
  session.write("fits/manifest.json", items.dump());
  const ProcessResult check = session.remapc(build_of("--check"));
  CHECK(check.exit_code == 1);
  for (const std::string& id : swept)
    CHECK(check.output.find(id + ": no longer in the manifest (`remapc build --prune`") != std::string::npos);

  // Vanished items are reported until they are removed. Files that were changed by hand stay.
  for (int i = 0; i < 2; ++i) {
    const auto report = nlohmann::json::parse(session.remapc(build_of()).output);
    CHECK(report["vanished"].size() == 3);
    CHECK(report["pruned"].empty());
  }
  for (const std::string& id : swept) CHECK(session.content("fits/README.md").find(id) != std::string::npos);
  append(session.path("generated/" + published + ".hpp"), "// mine\n");
  const auto pruned = nlohmann::json::parse(session.remapc(build_of("--prune")).output);
  CHECK(pruned["pruned"] == swept);
  CHECK(pruned["vanished"] == std::vector<std::string>{published});
  for (const std::string& id : swept) {
    for (const std::string& file :
         {"fits/" + id + ".json", "fits/tables/" + id + ".csv", "generated/" + id + ".hpp"})
      CHECK_FALSE(std::filesystem::exists(session.path(file)));
    CHECK(session.content("fits/README.md").find(id + ".json") == std::string::npos);
    CHECK(session.content("generated/converters.json").find("\"" + id + "\"") == std::string::npos);
  }
}

TEST_CASE("remapc build: items that fail do not stop the others, and all are named", "[slow]") {
  const Session session;
  auto items = quick_manifest();
  items["sweeps"][0]["models"] = {"mitsuba/as-ior", "mitsuba/ggx-ior", "mitsuba/wart"};
  session.write("fits/manifest.json", items.dump());
  const ProcessResult failed = session.remapc(build_of());
  CHECK(failed.exit_code == 2);
  CHECK_THAT(failed.last_error(), Catch::Matchers::Contains("4 of 8 items failed") &&
                                      Catch::Matchers::Contains("mitsuba_as_ior_to_mitsuba_wart: ") &&
                                      Catch::Matchers::Contains("mitsuba_wart_to_mitsuba_ggx_ior: "));
  const auto report = nlohmann::json::parse(failed.output);
  CHECK(report["failed"].size() == 4);
  CHECK(report["failed"][0]["id"] == "mitsuba_as_ior_to_mitsuba_wart");
  CHECK(report["built"].size() == 4);
  CHECK(std::filesystem::exists(session.path("generated/a_b_to_mitsuba_ggx_ior.hpp")));
  CHECK_FALSE(std::filesystem::exists(session.path("generated/converters.json")));
  session.write("fits/manifest.json", quick_manifest().dump());
  CHECK(built_ids(session.remapc(build_of())).empty());
}

TEST_CASE("remapc build: an interrupted build continues where it stopped", "[slow]") {
  const Session session;
  session.write("fits/manifest.json", quick_manifest(200).dump());
  Process process = session.start(REMAPC_PROGRAM + build_of("--jobs 1"));
  while (process.is_running() && !std::filesystem::exists(session.path("fits/manifest.lock")))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  process.send(SIGINT);
  const ProcessResult cut = process.wait();
  INFO(cut.errors);
  CHECK(cut.exit_code == 1);
  CHECK(cut.last_error().find("interrupted") != std::string::npos);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(session.path("fits")))
    CHECK(entry.path().filename().string().front() != '.');
  built_ids(session.remapc(build_of()));
  CHECK(session.remapc(build_of("--check")).exit_code == 0);
}

TEST_CASE("remapc fit --swap: the table's target becomes the source") {
  const Session session;
  session.write("t.csv", made_table(24, 6));
  require_success(session.remapc(session.fit("t.csv", "swapped") + "--swap"));
  const auto swapped = nlohmann::json::parse(session.content("swapped/made_as_to_made_ward.json"));
  CHECK(swapped["source"]["specular"] == "f0");
  CHECK(swapped["table"]["comments"]["roles"] == "swapped");
}

TEST_CASE("remapc invert: the inverse says what it is of, and how near it is", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(24, 6));
  require_success(session.remapc(session.fit("t.csv")));
  const ProcessResult inverted =
      require_success(session.remapc("invert fits/made_ward_to_made_as.json -o inverse --json"));
  const auto json = nlohmann::json::parse(inverted.output);
  CHECK(json["inverse_of"] == "made_ward_to_made_as");
  CHECK(json["alpha_error"]["max"].get<double>() < 1e-2);
}

TEST_CASE("remapc chain: composes one fit") {
  const Session session;
  session.write("fits/manifest.json", published_manifest().dump());
  require_success(session.remapc(build_of()));
  const ProcessResult made = require_success(session.remapc(
      "chain a_b_to_mitsuba_as_ior mitsuba_as_ior_to_mitsuba_ggx_ior --fits fits -o mine --json"));
  CHECK(session.content("mine/a_b_to_mitsuba_ggx_ior.json") ==
        session.content("fits/a_b_to_mitsuba_ggx_ior.json"));
  const ProcessResult shown = session.remapc("show mine/a_b_to_mitsuba_ggx_ior.json");
  CHECK(shown.output.find("Composed of a_b_to_mitsuba_as_ior, then") != std::string::npos);
  CHECK(session.remapc("emit mine/a_b_to_mitsuba_ggx_ior.json -o mine").exit_code == 0);
  CHECK(made.output.find("colored") != std::string::npos);
}

TEST_CASE("remapc build: tables of real renderers are reused without the renderer", "[slow]") {
  const Session session;
  session.write("fits/manifest.json",
                R"({"format": "remap-manifest", "version": 1, "published": [], "inverses": [], "chains": [],
  "sweeps": [{"pairs": [["fake/ggx", "mitsuba/ggx"]], "objective": "natural", "resolution": 48,
    "alpha": [0.05, 0.6], "roughness_samples": 12, "specular_samples": 3, "seed": 1}]})");
  CHECK(built_ids(session.remapc(build_of("--no-cache --worker fake=" REMAP_FAKE_WORKER))) ==
        std::vector<std::string>{"fake_ggx_to_mitsuba_ggx", "mitsuba_ggx_to_fake_ggx"});
  const std::string table = session.content("fits/tables/fake_ggx_to_mitsuba_ggx.csv");

  // A missing worker does not make items out of date, and --force then reuses the tables. A changed table is
  // an error.
  const Words elsewhere = "--worker fake=/nowhere/to-be-found";
  CHECK(built_ids(session.remapc(build_of(elsewhere))).empty());
  const Words forced = elsewhere + "--force";
  const ProcessResult again = session.remapc(build_of(forced));
  REQUIRE(built_ids(again).size() == 2);
  CHECK(session.content("fits/tables/fake_ggx_to_mitsuba_ggx.csv") == table);
  const auto built = nlohmann::json::parse(again.output)["built"];
  CHECK(built[0]["table"] == false);
  CHECK_THAT(built[0]["kept_table"].get<std::string>(), Catch::Matchers::Contains("fake"));
  append(session.path("fits/tables/fake_ggx_to_mitsuba_ggx.csv"), "# changed\n");
  const ProcessResult refused = session.remapc(build_of(forced));
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.last_error(), Catch::Matchers::Contains("fake_ggx_to_mitsuba_ggx: worker fake"));
}
