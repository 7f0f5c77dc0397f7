// This file tests models with more parameters than a sweep has roles, and random materials of many
// parameters, against equations (2) and (3) of Sztrajman et al. 2019.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "measure/sweep.hpp"
#include "measure/sweep_options.hpp"
#include "remap/error.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr double kDielectric = 0.04;  // F0 at the specular level 0.5

ModelDescription metallic() { return builtin_renderer().model("mitsuba/ggx-metallic"); }

SweepOptions metallic_sweep(const ParameterRoles& roles, const std::vector<MappedTexel>& samples) {
  SweepOptions options = sweep_options("mitsuba/ggx-metallic", "mitsuba/ggx", "natural", samples, 96);
  options.source_roles = roles;
  return options;
}

}  // namespace

TEST_CASE("renderer: a metallic material is the diffuse and F0 of equation (2)") {
  const std::vector<double> base = {0.9, 0.5, 0.1};
  const Scene scene{48, 1, {50.0, 3.0}};
  for (const std::string shape : {"ggx", "beckmann", "as"})
    for (const double metal : {0.0, 0.3, 1.0})
      for (const double level : {0.375, 0.5, 1.0}) {  // 0.375 gives the paper's 0.03
        std::vector<double> diffuse, f0;
        for (const double albedo : base) {
          diffuse.push_back(albedo * (1.0 - metal));
          f0.push_back(0.08 * level + metal * (albedo - 0.08 * level));
        }
        const Image found = builtin_renderer().render(
            {"mitsuba/" + shape + "-metallic",
             {{"roughness", {0.5}}, {"base_color", base}, {"metallic", {metal}}, {"specular", {level}}}},
            scene);
        const Image expected = builtin_renderer().render(
            {"mitsuba/" + shape, {{"alpha", {0.25}}, {"f0", f0}, {"diffuse", diffuse}}}, scene);
        REQUIRE(found.values.size() == expected.values.size());
        for (std::size_t i = 0; i < found.values.size(); ++i)
          REQUIRE(found.values[i] == Approx(expected.values[i]).epsilon(1e-6));
      }
  CHECK_THROWS_WITH(
      builtin_renderer().render(
          {"mitsuba/ggx-metallic",
           {{"roughness", {0.5}}, {"base_color", {0.5}}, {"metallic", {0.1, 0.2, 0.3}}, {"specular", {0.5}}}},
          scene),
      Contains("metallic has 3 values (give 1)"));
}

TEST_CASE("roles: the base color of a metal is F0") {
  const Table table = sweep(builtin_renderer(), metallic_sweep({}, grid_samples({0.1, 0.6}, 3, {0, 1}, 3)));
  CHECK(comment(table, "source_roughness") == "roughness");
  CHECK(comment(table, "source_specular") == "base_color");
  CHECK(comment(table, "source_fixed") == "metallic=1,specular=0.5");
  for (const TableRow& row : table.rows) {
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-5));
    CHECK(row.specular2 == Approx(row.specular1).epsilon(1e-5));
  }
}

TEST_CASE("roles: metallic as the specular, with diffuse matched at once, is equation (2)") {
  constexpr double kAlbedo = 0.8;
  ParameterRoles roles;
  roles.specular = "metallic";
  roles.fixed = {{"base_color", kAlbedo}};
  SweepOptions options = metallic_sweep(roles, {{0.1, 0.3}, {0.1, 0.9}, {0.3, 0.5}, {0.5, 0.7}});
  options.stages = 1;
  const Table table = sweep(builtin_renderer(), options);
  CHECK(comment(table, "source_specular") == "metallic");
  CHECK(comment(table, "source_fixed") == "base_color=0.8,specular=0.5");
  for (const TableRow& row : table.rows) {
    const double metal = row.specular1;
    INFO("alpha " << row.alpha1 << " metallic " << metal);
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-4));
    CHECK(row.specular2 == Approx(kDielectric + metal * (kAlbedo - kDielectric)).epsilon(1e-4));
    CHECK(row.diffuse2 == Approx(kAlbedo * (1.0 - metal)).epsilon(1e-4));
    CHECK(row.status == RowStatus::kOk);
  }
}

TEST_CASE("roles: the specular level of a black dielectric is a share of 8 %") {
  ParameterRoles roles;
  roles.specular = "specular";
  roles.fixed = {{"base_color", 0.0}, {"metallic", 0.0}};
  for (const TableRow& row :
       sweep(builtin_renderer(), metallic_sweep(roles, grid_samples({0.1, 0.6}, 3, {0, 1}, 3))).rows) {
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-5));
    CHECK(row.specular2 == Approx(0.08 * row.specular1).epsilon(1e-4));
  }
}

TEST_CASE("roles: a target takes roles as a source does") {
  SweepOptions options =
      sweep_options("mitsuba/ggx", "mitsuba/ggx-metallic", "natural", {{0.2, 0.3}, {0.4, 0.6}}, 96);
  // The target is a metal, so its base color is its F0, and it has no diffuse that would disturb the match.
  options.target_roles.fixed = {{"metallic", 1.0}};
  const Table table = sweep(builtin_renderer(), options);
  CHECK(comment(table, "target_fixed") == "metallic=1,specular=0.5");
  for (const TableRow& row : table.rows) CHECK(row.specular2 == Approx(row.specular1).epsilon(1e-5));
}

TEST_CASE("roles: another parameter with another convention can be the roughness") {
  const ModelDescription metal = metallic();
  ParameterRoles roles;
  roles.roughness = "metallic";
  roles.convention = RoughnessEncoding::kGlossiness;
  roles.fixed = {{"roughness", 0.5}};
  const ModelDescription cast = recast(metal, roles);
  CHECK(cast.parameter(ParameterRole::kRoughness).name == "metallic");
  CHECK(cast.roughness == RoughnessEncoding::kGlossiness);
  CHECK(cast.alpha == Range{0.0, 1.0});
  CHECK(fixed_text(cast) == "roughness=0.5,specular=0.5");
  CHECK(fixed_text(recast(metal, {})) == fixed_text(metal));
}

TEST_CASE("roles: invalid roles are refused with the parameter") {
  const ModelDescription metal = metallic();
  const auto refused = [&](const ParameterRoles& roles, const std::string& message) {
    CHECK_THROWS_WITH(recast(metal, roles), Contains(message));
  };
  ParameterRoles roles;
  roles.specular = "metalic";
  refused(roles, "has no parameter metalic (did you mean metallic?)");
  roles.specular = "metallic";
  refused(roles, "base_color no longer has a role and needs a value (add base_color=VALUE");
  roles.fixed = {{"metallic", 0.5}, {"base_color", 0.5}};
  refused(roles, "metallic is the specular of this sweep and cannot be fixed");
  roles.fixed = {{"base_color", 1.5}};
  refused(roles, "base_color = 1.5 is out of range (0 to 1)");
  roles = {};
  roles.roughness = "base_color";
  roles.fixed = {{"roughness", 0.5}};
  refused(roles, "has no parameter for specular");
}

namespace {

MaterialSampleOptions random_options(const std::string& source, const std::string& target,
                                     std::size_t count) {
  MaterialSampleOptions options;
  options.source = source;
  options.target = target;
  options.objective = objective_preset("natural");
  options.resolution = 64;
  options.count = count;
  options.seed = 7;
  options.ranges = {{source == "mitsuba/ggx" ? "alpha" : "roughness", {0.4, 0.9}}};
  return options;
}

MaterialTable sampled(const MaterialSampleOptions& options, unsigned jobs = 0) {
  SweepExecution execution;
  execution.jobs = jobs;
  return run_material_sample(builtin_renderer(), options, execution);
}

double at(const MaterialTable& table, const NamedRow& row, const std::string& column) {
  for (std::size_t i = 0; i < table.source_columns.size(); ++i)
    if (table.source_columns[i] == column) return row.source[i];
  for (std::size_t i = 0; i < table.target_columns.size(); ++i)
    if (table.target_columns[i] == column) return row.target[i];
  FAIL("no column " << column);
  return 0.0;
}

}  // namespace

TEST_CASE("material sample: six parameters of a metallic material give the F0 and diffuse of equation (2)") {
  MaterialSampleOptions options = random_options("mitsuba/ggx-metallic", "mitsuba/ggx", 12);
  options.varied = {"metallic", "specular"};
  const MaterialTable table = sampled(options);
  CHECK(table.source_columns == std::vector<std::string>{"roughness1", "base_color_r1", "base_color_g1",
                                                         "base_color_b1", "metallic1", "specular1"});
  CHECK(table.target_columns == std::vector<std::string>{"alpha2", "f0_r2", "f0_g2", "f0_b2", "diffuse_r2",
                                                         "diffuse_g2", "diffuse_b2"});
  for (const NamedRow& row : table.rows) {
    INFO(material_table_text({table.name, {}, table.source_columns, table.target_columns, {row}}));
    const double metal = at(table, row, "metallic1"), least = 0.08 * at(table, row, "specular1");
    CHECK(row.status == RowStatus::kOk);
    CHECK(row.error < 1e-4);
    CHECK(at(table, row, "alpha2") == Approx(std::pow(at(table, row, "roughness1"), 2)).epsilon(1e-4));
    for (const std::string channel : {"_r", "_g", "_b"}) {
      const double base = at(table, row, "base_color" + channel + "1");
      CHECK(at(table, row, "diffuse" + channel + "2") == Approx(base * (1.0 - metal)).margin(1e-4));
      CHECK(at(table, row, "f0" + channel + "2") == Approx(least + metal * (base - least)).margin(1e-4));
    }
  }
}

TEST_CASE("material sample: the way back finds base color and metallic, by renders") {
  MaterialSampleOptions options = random_options("mitsuba/ggx", "mitsuba/ggx-metallic", 4);
  options.resolution = 32;
  options.searched = {"metallic"};
  options.grey = true;
  // This F0 is at least that of bright dielectrics, so that equation (3) has a root between 0 and 1.
  options.ranges["f0"] = {0.05, 0.3};
  options.ranges["diffuse"] = {0.4, 0.8};
  const MaterialTable table = sampled(options);
  CHECK(table.target_columns == std::vector<std::string>{"roughness2", "base_color2", "metallic2"});
  for (const NamedRow& row : table.rows) {
    const double f0 = at(table, row, "f01"), diffuse = at(table, row, "diffuse1");
    const double sum = f0 + diffuse;
    const double base = 0.5 * sum * (1.0 + std::sqrt(1.0 - 4.0 * 0.04 * diffuse / (sum * sum)));
    INFO("f0 " << f0 << " diffuse " << diffuse);
    CHECK(row.status == RowStatus::kOk);
    CHECK(at(table, row, "base_color2") == Approx(base).margin(1e-3));
    CHECK(at(table, row, "metallic2") == Approx((f0 - 0.04) / (base - 0.04)).margin(1e-3));
  }
}

TEST_CASE("material sample: the same seed gives the same table for any number of jobs, and more rows go on",
          "[slow]") {
  const MaterialSampleOptions options = random_options("mitsuba/ggx-metallic", "mitsuba/ggx", 5);
  const std::string table = material_table_text(sampled(options, 1));
  CHECK(material_table_text(sampled(options, 2)) == table);
  MaterialSampleOptions more = options;
  more.count = 7;
  const MaterialTable longer = sampled(more);
  const MaterialTable back = parse_material_table(table, "t");
  for (std::size_t i = 0; i < back.rows.size(); ++i) {
    CHECK(longer.rows[i].source == back.rows[i].source);
    CHECK(longer.rows[i].target == back.rows[i].target);
  }
  more.seed = 8;
  CHECK(sampled(more).rows[0].source != back.rows[0].source);
  const auto seed =
      std::find(back.comments.begin(), back.comments.end(), std::pair<std::string, std::string>("seed", "7"));
  CHECK(seed != back.comments.end());
}

TEST_CASE("material sample: a parameter that cannot vary is refused") {
  const auto refused = [](const MaterialSampleOptions& options, const std::string& message) {
    CHECK_THROWS_WITH(sampled(options), Contains(message));
  };
  MaterialSampleOptions options = random_options("mitsuba/ggx-metallic", "mitsuba/ggx", 1);
  options.varied = {"metalic"};
  refused(options, "has no parameter metalic (did you mean metallic?)");
  options.varied = {"base_color"};
  refused(options, "base_color is the specular and varies anyway");
  options.varied = {};
  options.ranges["metallic"] = {0.0, 0.5};
  refused(options, "metallic has a range but does not vary");
  options.ranges = {{"base_color", {0.5, 1.5}}};
  refused(options, "base_color: the range 0.5 to 1.5 is not within 0 to 1");
  options.ranges = {};
  options.searched = {"f0"};
  refused(options, "f0 is the specular");
}
