// The study of workflows on small pictures: the least error is below every method, the projection next to it,
// and exact for materials that metallic can represent; measured materials if their files are available.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "study/workflows_report.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

WorkflowsOptions small_study(std::size_t group_count = 6) {
  WorkflowsOptions options;
  options.alphas = {0.15, 0.5};
  options.materials = study_materials({{}, group_count, options.alphas.size(), 3}).materials;
  options.environments = builtin_environments(64);
  for (Environment& environment : options.environments)
    environment = exposed(environment, 1.0 / mean_luminance(environment));
  options.resolution = 32;
  options.samples = 128;
  return options;
}

std::size_t place_of(const WorkflowComparison& comparison, const std::string& method) {
  const auto found = std::find(comparison.methods.begin(), comparison.methods.end(), method);
  REQUIRE(found != comparison.methods.end());
  return static_cast<std::size_t>(found - comparison.methods.begin());
}

WorkflowFigures figures(const WorkflowsOptions& options, const WorkflowComparison& comparison,
                        const std::string& method) {
  return figures_of(options, comparison, place_of(comparison, method));
}

}  // namespace

TEST_CASE("study workflows: floor, projection, equation (3), in this order, in both conventions", "[slow]") {
  const WorkflowsOptions options = small_study(20);
  const WorkflowsResult result = study_workflows(options);
  REQUIRE(result.comparisons.size() == 2);
  for (const WorkflowComparison& comparison : result.comparisons) {
    INFO(comparison.convention);
    const WorkflowFigures floor = figures(options, comparison, kLeastErrorMethod);
    const WorkflowFigures projection = figures(options, comparison, "projection");
    for (std::size_t m = 0; m + 1 < comparison.methods.size(); ++m) {
      INFO(comparison.methods[m]);
      CHECK(floor.rmse <= figures_of(options, comparison, m).rmse);
      if (comparison.methods[m] == "projection") continue;
      CHECK(projection.rmse < figures_of(options, comparison, m).rmse);
    }
    CHECK(projection.rmse < 1.2 * floor.rmse);  // 6 % under lights like those that its weights were fitted to
  }
  const WorkflowComparison& plain = result.comparisons.front();
  CHECK(figures(options, plain, "equation (3), weighted, 0.03").rmse <
        figures(options, plain, "equation (3), mean, 0.03").rmse);
}

TEST_CASE("study workflows: metallic materials come back, and their pictures are the same", "[slow]") {
  WorkflowsOptions options = small_study(1);
  options.materials.clear();
  const MetallicReflection reflection{0.04, 1.0};
  for (const double metallic : {0.0, 0.4, 1.0})
    options.materials.push_back(
        {"family", MaterialGroup::kRandom, reflectances_of({{0.7, 0.4, 0.2}, metallic}, reflection), 0});
  const WorkflowsResult result = study_workflows(options);
  const WorkflowComparison& plain = result.comparisons.front();
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
  // The least error finds them by pictures, or starts from the projection.
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
  // White diffuse is white at the nearest point under a headlight.
  const std::vector<float>& white = lit.basis(0, lit.headlight()).diffuse;
  CHECK(*std::max_element(white.begin(), white.end()) == Approx(1.0).epsilon(0.01));
}

TEST_CASE(
    "study workflows: on materials of the family the projection is exact, and the others have their known "
    "errors") {
  const std::vector<FamilyLine> lines = study_family({}, 4000, 1, 0);
  const auto line = [&](const std::string& method) {
    const auto found = std::find_if(lines.begin(), lines.end(),
                                    [&](const FamilyLine& each) { return each.method == method; });
    REQUIRE(found != lines.end());
    return *found;
  };
  const FamilyLine projection = line("projection");
  CHECK(projection.errors[0].metallic < 0.005);
  CHECK(projection.errors[1].metallic < 0.005);
  CHECK(projection.errors[1].base_color < 0.0015);
  for (const FamilyLine& other : lines) {
    if (other.method.starts_with("projection")) continue;
    INFO(other.method);
    CHECK(other.errors[1].base_color > projection.errors[1].base_color);
  }
  CHECK(line("equation (3), mean, 0.04").errors[0].metallic == Approx(0.035).epsilon(0.15));
  CHECK(line("Khronos, plain").errors[0].metallic == Approx(0.092).epsilon(0.1));
  CHECK(line("Khronos, glTF").errors[0].metallic < 0.02);
  CHECK_THROWS_WITH(study_family({}, 0, 1, 0), Contains("--family-count must be at least 1"));
}

TEST_CASE("study workflows: tables, sheets and the same figures for any number of jobs", "[slow]") {
  WorkflowsOptions options = small_study(2);
  options.sheets = true;
  const WorkflowsResult result = study_workflows(options);
  CHECK(result.sheets.size() == options.environments.size());
  CHECK(result.sheet_materials.size() == 6);
  const StudyReport report = workflows_report(options, result, study_family({}, 100, 1, 1), {});
  const std::string& csv = report.tables[0].second;
  const std::size_t rows = options.materials.size() *
                           (result.comparisons[0].methods.size() + result.comparisons[1].methods.size());
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == rows + 6);
  CHECK_THAT(report.summary,
             Contains("above the least that any base color and metallic reach") && !Contains("nan"));
  CHECK_THAT(report.tables[1].second, Contains("plain,projection,paint,"));
  CHECK_THAT(report.plots[0].second, Contains("1 - SSIM"));
  options.jobs = 1;
  CHECK(workflows_report(options, study_workflows(options), {}, {}).tables[0].second == csv);
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
  CHECK_THROWS_WITH(study_materials({{}, 0, 1, 1}), Contains("at least one material per group"));
}

TEST_CASE("study workflows: groups without a file are left out, and a bad file is named") {
  const MaterialSet drawn = study_materials({{}, 3, 2, 1});
  CHECK(drawn.materials.size() == 9);
  CHECK(drawn.remarks.size() == 2);
  const TemporaryFolder folder;
  write_file(folder.path() / "ngan_ward.fit",
             "# comment\nred = Aggregate(Lambertian(albedo = [0.1, x, 0]))\n");
  CHECK_THROWS_WITH(study_materials({folder.path(), 3, 2, 1}),
                    Contains("ngan_ward.fit:2: cannot find two albedos"));
  for (const StudyMaterial& material : drawn.materials)
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK((material.surface.diffuse[c] >= 0.0 && material.surface.diffuse[c] <= 1.0));
      CHECK((material.surface.f0[c] >= 0.0 && material.surface.f0[c] <= 1.0));
    }
}

TEST_CASE("study workflows: measured materials are read", "[needs]") {
  const auto path = shared_data("materials/physicallybased.json");
  if (path.empty()) return;
  const MaterialSet set = study_materials({path.parent_path(), 40, 5, 1});
  CHECK(set.remarks.empty());
  CHECK(set.materials.size() == 200);
  const auto is_metal = [](const StudyMaterial& material) {
    return material.group == MaterialGroup::kMeasured && material.surface.diffuse == Rgb{};
  };
  CHECK(std::count_if(set.materials.begin(), set.materials.end(), is_metal) > 5);
}
