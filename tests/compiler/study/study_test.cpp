// This file tests studies. The reach study is tested on conversions whose excess is known. In the study of
// workflows, the least error is below every method, and the projection is close to it; it is exact for
// materials that metallic can represent. The metals of scripts/studies/conductors are compared with the
// database.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "compiler/report/scaled_fit.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "lower/fit_file.hpp"
#include "measure/sweep.hpp"
#include "remap/error.hpp"
#include "renderer/fresnel.hpp"
#include "study/reach.hpp"
#include "study/workflows.hpp"
#include "support/campaign.hpp"
#include "support/shared_data.hpp"
#include "support/skip.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

ReachOptions small_reach(Fit fit) {
  fit.table.comments["objective"] = "natural-1";
  ReachOptions options;
  options.fits = {std::move(fit)};
  options.materials = 6;
  options.alphas = {0.15, 0.9};
  options.resolution = 48;
  return options;
}

std::vector<ReachedMaterial> reach_of(const Fit& fit) {
  return study_reach(*make_builtin_renderer(), small_reach(fit)).front();
}

}  // namespace

TEST_CASE("reach: a model reaches itself, and the identity leaves nothing", "[study]") {
  for (const ReachedMaterial& material : reach_of(scaled_fit("mitsuba/ward", "mitsuba/ward", 1.0))) {
    CHECK(material.error < 1e-6);
    CHECK(material.least_error < 4e-3);  // the examined widths are a hundredth apart
    CHECK(material.least_alpha == Approx(material.alpha).epsilon(0.006));
    CHECK(material.least_specular == Approx(material.specular).epsilon(0.02));
  }
}

TEST_CASE("reach: a conversion that is off has the excess of its error", "[study]") {
  for (const ReachedMaterial& material : reach_of(scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.1))) {
    CHECK(material.target_alpha == Approx(1.1 * material.alpha));
    CHECK(material.excess() > 0.02);
    CHECK(material.excess() == Approx(material.error).margin(4e-3));
  }
}

TEST_CASE("reach: the least error is that of the sweep, which finds it another way", "[study]") {
  const std::vector<ReachedMaterial> materials = reach_of(scaled_fit("mitsuba/beckmann", "mitsuba/as", 1.0));
  SweepOptions sweep;
  sweep.source = "mitsuba/beckmann";
  sweep.target = "mitsuba/as";
  sweep.objective = objective_preset("natural-1");
  sweep.resolution = 48;
  for (const ReachedMaterial& material : materials)
    sweep.samples.push_back({material.alpha, material.specular});
  const Table table = run_sweep(*make_builtin_renderer(), sweep, {});
  for (std::size_t i = 0; i < materials.size(); ++i) {
    INFO(materials[i].alpha << " " << materials[i].specular);
    CHECK(materials[i].least_error == Approx(table.rows[i].error).margin(2e-4));
  }
}

TEST_CASE("reach: the table has a row for each material, and no thread changes it", "[study]") {
  ReachOptions options = small_reach(scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.1));
  const std::string csv = reach_csv(options, study_reach(*make_builtin_renderer(), options));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 3 + 36);  // comments and header
  CHECK_THAT(csv, Catch::Contains("\ntest,0.15,"));
  options.jobs = 1;
  CHECK(reach_csv(options, study_reach(*make_builtin_renderer(), options)) == csv);
}

TEST_CASE("reach: a fit of another table is refused", "[study]") {
  ReachOptions options = small_reach(scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.1));
  options.fits.front().table.comments.clear();
  CHECK_THROWS_WITH(study_reach(*make_builtin_renderer(), options),
                    Catch::Matchers::Contains("does not state an objective"));
}

namespace {

// Returns the record of a material in the database.
nlohmann::json record(const nlohmann::json& database, const std::string& name) {
  for (const nlohmann::json& item : database.at("data"))
    if (item.at("name") == name) return item;
  FAIL("the database has no " + name);
  return {};
}

bool is_linear_srgb(const nlohmann::json& index) { return index.at("colorSpace") == "srgb-linear"; }

nlohmann::json metals() {
  return nlohmann::json::parse(read_file(REMAP_SOURCE_DIR "/scripts/studies/metals.json")).at("metals");
}

}  // namespace

TEST_CASE("metals: named once, with a source, and physical") {
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
}

TEST_CASE("metals: values equal those of the database", "[needs]") {
  const auto path = shared_data("materials/physicallybased.json");
  if (path.empty()) return;
  const nlohmann::json database = nlohmann::json::parse(read_file(path));
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
}

namespace {

// Returns `count` of the 60 materials of `scripts/studies/materials --count 20 --alphas 0.15,0.5 --seed 3`,
// evenly from its groups.
WorkflowsOptions small_study(std::size_t count) {
  WorkflowsOptions options;
  const std::string file = REMAP_SOURCE_DIR "/tests/compiler/study/materials.csv";
  read_materials(read_file(file), file, &options);
  const std::vector<StudyMaterial> all = std::exchange(options.materials, {});
  for (std::size_t i = 0; i < count; ++i) options.materials.push_back(all[i * all.size() / count]);
  options.environments = builtin_environments(64);
  for (Environment& environment : options.environments)
    environment = exposed(environment, 1.0 / mean_luminance(environment));
  options.resolution = 32;
  options.samples = 128;
  return options;
}

std::size_t place_of(const WorkflowComparison& comparison, const std::string& method) {
  const auto found = std::ranges::find(comparison.methods, method, &WorkflowMethod::name);
  REQUIRE(found != comparison.methods.end());
  return static_cast<std::size_t>(found - comparison.methods.begin());
}

// Returns the mean RMSE of a method over materials and environments.
double mean_rmse(const WorkflowComparison& comparison, std::size_t method) {
  double sum = 0.0, count = 0.0;
  for (const WorkflowPictures& pictures : comparison.pictures[method])
    for (std::size_t light = 0; light + 1 < pictures.rmse.size(); ++light) {
      sum += pictures.rmse[light];
      count += 1.0;
    }
  return sum / count;
}

}  // namespace

TEST_CASE("study workflows: floor, projection, equation (3), in this order, in both conventions", "[slow]") {
  const WorkflowsOptions options = small_study(60);
  const auto result = study_workflows(options);
  REQUIRE(result.size() == 2);
  for (const WorkflowComparison& comparison : result) {
    INFO(comparison.convention);
    const double floor = mean_rmse(comparison, place_of(comparison, kLeastErrorMethod));
    const double projection = mean_rmse(comparison, place_of(comparison, "projection"));
    for (std::size_t m = 0; m + 1 < comparison.methods.size(); ++m) {
      INFO(comparison.methods[m].name);
      CHECK(floor <= mean_rmse(comparison, m));
      if (comparison.methods[m].name == "projection") continue;
      CHECK(projection < mean_rmse(comparison, m));
    }
    CHECK(projection < 1.2 * floor);  // this is 6 % under lights like those that chose the weights
  }
  const WorkflowComparison& plain = result.front();
  CHECK(mean_rmse(plain, place_of(plain, "equation (3), weighted, 0.03")) <
        mean_rmse(plain, place_of(plain, "equation (3), mean, 0.03")));
}

TEST_CASE("study workflows: metallic materials come back, and their pictures are the same", "[slow]") {
  WorkflowsOptions options = small_study(1);
  options.materials.clear();
  const MetallicReflection reflection{0.04, 1.0};
  for (const double metallic : {0.0, 0.4, 1.0})
    options.materials.push_back(
        {"family", "family", reflectances_of({{0.7, 0.4, 0.2}, metallic}, reflection), 0});
  const auto result = study_workflows(options);
  const WorkflowComparison& plain = result.front();
  const auto& projected = plain.pictures[place_of(plain, "projection")];
  const auto& best = plain.pictures[place_of(plain, kLeastErrorMethod)];
  CHECK(projected[0].surface.metallic == Approx(0.0).margin(1e-3));
  CHECK(projected[1].surface.metallic == Approx(0.4).margin(1e-3));
  CHECK(projected[2].surface.metallic == Approx(1.0).margin(1e-3));
  for (const WorkflowPictures& pictures : projected)
    for (std::size_t light = 0; light < pictures.rmse.size(); ++light) {
      CHECK(pictures.rmse[light] < 0.02);
      CHECK(pictures.ssim[light] > 0.9999);
    }
  // The search finds these materials from their pictures, or starts from the projection, which is exact for
  // them.
  for (std::size_t i = 0; i < best.size(); ++i)
    CHECK(best[i].surface.metallic == Approx(projected[i].surface.metallic).margin(0.02));
}

TEST_CASE("study workflows: a picture is its reflectances times the basis") {
  const std::vector<Environment> sky = {builtin_environments(64).front()};
  const std::vector<double> alphas = {0.3};
  const LitReflectances lit(sky, alphas, {24, 256, 1, {}});
  const RadiancePyramid pyramid(sky);
  const std::vector<SphereMaterial> material = {{{Brdf::kGgx, Fresnel::kSchlick}, 0.3, 0.35, 0.25}};
  const SpherePictures direct = render_spheres(pyramid, material, {24, 256, 1, {}});
  const std::vector<float> expected = direct.radiance(0, 0);
  const std::vector<float> combined = lit.radiance(0, 0, {{0.25, 0.25, 0.25}, {0.35, 0.35, 0.35}});
  REQUIRE(expected.size() == combined.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    CHECK(combined[i] == Approx(expected[i]).epsilon(1e-4).margin(1e-6));
  // The closest point of a white diffuse sphere is white under a headlight.
  const std::vector<float>& white = lit.basis(0, lit.headlight()).diffuse;
  CHECK(*std::max_element(white.begin(), white.end()) == Approx(1.0).epsilon(0.01));
}

TEST_CASE(
    "study workflows: on materials of the family the projection is exact, and the others have their known "
    "errors") {
  const std::vector<RoundTripErrors> trips = study_round_trips({}, 4000, 1, 0);
  const auto trip = [&](const std::string& method, FamilyKind kind) {
    const auto found = std::ranges::find_if(
        trips, [&](const RoundTripErrors& each) { return each.method == method && each.family == kind; });
    REQUIRE(found != trips.end());
    return *found;
  };
  const RoundTripErrors projection = trip("projection", FamilyKind::kStored);
  CHECK(trip("projection", FamilyKind::kExact).metallic < 0.005);
  CHECK(projection.metallic < 0.005);
  CHECK(projection.base_color < 0.0015);
  for (const RoundTripErrors& other : trips) {
    if (other.method.starts_with("projection") || other.family != FamilyKind::kStored) continue;
    INFO(other.method);
    CHECK(other.base_color > projection.base_color);
  }
  CHECK(trip("equation (3), mean, 0.04", FamilyKind::kExact).metallic == Approx(0.035).epsilon(0.15));
  CHECK(trip("Khronos, plain", FamilyKind::kExact).metallic == Approx(0.092).epsilon(0.1));
  CHECK(trip("Khronos, glTF", FamilyKind::kExact).metallic < 0.02);
  CHECK_THROWS_WITH(study_round_trips({}, 0, 1, 0), Contains("--family-count must be at least 1"));
}

TEST_CASE("study workflows: tables, sheets and the same figures for any number of jobs", "[slow]") {
  WorkflowsOptions options = small_study(6);
  std::vector<Image> sheets;
  const auto result = study_workflows(options, &sheets);
  CHECK(sheets.size() == options.environments.size());
  const std::string csv = workflows_csv(options, result);
  const std::size_t methods = result[0].methods.size() + result[1].methods.size();
  // There are three environments and the headlight, 5 comments and the header.
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == 6 * methods * 4 + 6);
  CHECK_THAT(csv, Contains(",headlight,") && !Contains("nan"));
  options.jobs = 1;
  CHECK(workflows_csv(options, study_workflows(options)) == csv);
  const std::string trips = round_trips_csv(study_round_trips({}, 100, 1, 1), 100, 1);
  CHECK_THAT(trips, Contains("# seed: 1\n") && Contains("\n\"projection, glTF\",\"authored, 8-bit\","));
}

TEST_CASE("study workflows: invalid options are refused") {
  WorkflowsOptions options = small_study(1);
  options.alphas.pop_back();
  options.materials.front().alpha = 1;
  CHECK_THROWS_WITH(study_workflows(options), Contains("alpha index 1 is out of range (1 alphas)"));
  options = small_study(1);
  options.alphas[0] = 0.0;
  CHECK_THROWS_WITH(study_workflows(options), Contains("is out of range (0.01 to 1)"));
  options.materials.clear();
  CHECK_THROWS_WITH(study_workflows(options), Contains("at least one material, one alpha"));
  options = small_study(1);
  options.environments.front().name = "headlight";
  CHECK_THROWS_WITH(study_workflows(options), Contains("the name headlight means the light at the camera"));
}

TEST_CASE("study workflows: materials are read from a table, and a bad cell is named") {
  const std::string header = "material,group,alpha,diffuse_r,diffuse_g,diffuse_b,f0_r,f0_g,f0_b\n";
  WorkflowsOptions options;
  read_materials(
      header + "red,paint,0.5,0.9,0.1,0,0.04,0.04,0.05\nblue,paint,0.2,0,0,1,1,1,1\ngreen,,0.5,0,1,0,0,0,0\n",
      "m.csv", &options);
  CHECK(options.alphas == std::vector<double>{0.5, 0.2});
  REQUIRE(options.materials.size() == 3);
  CHECK(options.materials[0].name == "red");
  CHECK(options.materials[0].group == "paint");
  CHECK(options.materials[0].surface.diffuse == Rgb{0.9, 0.1, 0.0});
  CHECK(options.materials[0].surface.f0 == Rgb{0.04, 0.04, 0.05});
  CHECK(options.materials[1].alpha == 1);
  CHECK(options.materials[2].alpha == 0);
  const auto fails = [&](const std::string& text, const std::string& message) {
    CHECK_THROWS_WITH(read_materials(text, "m.csv", &options), Contains(message));
  };
  fails("material,group\na,b\n", "m.csv:1:1: the column alpha is missing (scripts/studies/materials writes");
  fails(header + "red,paint,0,0,0,0,0,0,0\n", "m.csv:2:11: alpha: 0 is out of range (0.01 to 1)");
  fails(header + "red,paint,1,0,2,0,0,0,0\n", "m.csv:2:15: diffuse_g: 2 is out of range (0 to 1)");
  fails(header + "red,paint,1,0,0,0,0,0,x\n", "f0_b is \"x\" (must be a number)");
}
