// The study of dielectrics: the lists of materials against the database, and properties of a small study.
#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "renderer/fresnel.hpp"
#include "report/gnuplot.hpp"
#include "study/dielectrics_study.hpp"
#include "study/materials.hpp"
#include "support/shared_data.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"
#include "system/files.hpp"

using namespace remapc;

namespace {

// The record of a material in the database.
nlohmann::json record(const nlohmann::json& database, const std::string& name) {
  for (const nlohmann::json& item : database.at("data"))
    if (item.at("name") == name) return item;
  FAIL("the database has no " + name);
  return {};
}

bool is_linear_srgb(const nlohmann::json& index) { return index.at("colorSpace") == "srgb-linear"; }

// The metals of scripts/studies/conductors.
nlohmann::json metals() {
  return nlohmann::json::parse(remap::read_file(REMAP_SOURCE_DIR "/scripts/studies/metals.json"))
      .at("metals");
}

// The table of this file name.
std::string text_of(const StudyReport& report, const std::string& name) {
  const auto found = std::find_if(report.tables.begin(), report.tables.end(),
                                  [&](const auto& table) { return table.first == name; });
  REQUIRE(found != report.tables.end());
  return found->second;
}

std::size_t line_count(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

// The text is the table: tables are written so that doubles read back.
void check_written(const std::string& text, const Table& table) {
  const Table written = parse_table(text, "table.csv");
  REQUIRE(written.rows.size() == table.rows.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    CHECK(written.rows[i].alpha2 == table.rows[i].alpha2);
    CHECK(written.rows[i].specular2 == table.rows[i].specular2);
    CHECK(written.rows[i].status == table.rows[i].status);
  }
}

// What gnuplot draws, where it is installed.
void check_plot(const std::string& script) {
  if (!remap::has_program("gnuplot")) return;
  const remap::TemporaryFolder folder;
  write_svg(folder.path() / "plot.svg", script);
  CHECK_THAT(remap::read_file(folder.path() / "plot.svg"), Catch::Contains("</svg>"));
}

}  // namespace

TEST_CASE("materials: named once, with a source, and physical") {
  std::set<std::string> names;
  for (const nlohmann::json& metal : metals()) {
    CHECK(names.insert(metal["name"]).second);
    CHECK(metal["source"].get<std::string>().size() > 3);
    for (std::size_t c = 0; c < 3; ++c) {
      const double f0 = normal_reflectance({metal["eta"][c], metal["k"][c]});
      CHECK(f0 > 0.1);
      CHECK(f0 <= 1.0);
    }
  }
  CHECK(names.size() == 30);
  for (const Dielectric& material : measured_dielectrics()) {
    CHECK(names.insert(material.name).second);
    CHECK(std::string(material.source).size() > 3);
    CHECK(material.ior > 1.0);
    CHECK(material.ior < 2.5);
  }
}

TEST_CASE("materials: values equal those of the database", "[needs]") {
  const auto path = remap::shared_data("materials/physicallybased.json");
  if (path.empty()) return;
  const nlohmann::json database = nlohmann::json::parse(remap::read_file(path));
  for (const nlohmann::json& metal : metals()) {
    const auto item = record(database, metal["name"]);
    const auto& indices = item.at("complexIor");
    CHECK(std::count_if(indices.begin(), indices.end(), is_linear_srgb) == 1);
    for (const nlohmann::json& index : indices) {
      if (!is_linear_srgb(index)) continue;
      CHECK(index.at("n") == metal["eta"]);
      CHECK(index.at("k") == metal["k"]);
    }
  }
  for (const Dielectric& material : measured_dielectrics())
    CHECK(record(database, material.name).at("ior").get<double>() == material.ior);
}

TEST_CASE("dielectrics: two stages are smooth and stable, three never worse", "[needs][slow]") {
  const auto renderer = make_builtin_renderer();
  StudyOptions options;
  options.resolution = 32;
  options.alphas = {0.3};
  const DielectricsStudy study = study_dielectrics(*renderer, options, 0.3);
  REQUIRE(study.curves.size() == 3);
  const DielectricCurve& two = study.curves[1];
  CHECK(two.stages == 2);
  CHECK_FALSE(two.jumps());
  CHECK(two.second_difference < 0.01);
  CHECK(two.unstable == 0);
  CHECK(study.curves[2].mean_error <= two.mean_error);
  CHECK(study.error_gain >= 0.0);
  CHECK_FALSE(study.trials.empty());
  for (const auto& table : study.stages) CHECK(table.has_diffuse);
  const StudyReport report = dielectrics_report(study);
  for (std::size_t i = 0; i < study.stages.size(); ++i)
    check_written(text_of(report, "stages" + std::to_string(i + 1) + ".csv"), study.stages[i]);
  CHECK(line_count(text_of(report, "guesses.csv")) == study.trials.size() + 1);
  check_plot(report.plot_script);
  CHECK(report.summary.find("nan") == std::string::npos);
}
