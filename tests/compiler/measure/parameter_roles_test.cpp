// This file tests models with more parameters than a sweep has roles, against equation (2) of Sztrajman et
// al. 2019.
#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "measure/sweep_options.hpp"
#include "remap/error.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr double kDielectric = 0.04;  // F0 at the specular level 0.5

ModelDescription metallic() { return make_builtin_renderer()->model("mitsuba/ggx-metallic"); }

SweepOptions metallic_sweep(const ParameterRoles& roles, const std::vector<MappedTexel>& samples) {
  SweepOptions options = sweep_options("mitsuba/ggx-metallic", "mitsuba/ggx", "natural", samples, 96);
  options.source_roles = roles;
  return options;
}

}  // namespace

TEST_CASE("renderer: a metallic material is the diffuse and F0 of equation (2)") {
  const auto renderer = make_builtin_renderer();
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
        const Image found = renderer->render(
            {"mitsuba/" + shape + "-metallic",
             {{"roughness", {0.5}}, {"base_color", base}, {"metallic", {metal}}, {"specular", {level}}}},
            scene);
        const Image expected = renderer->render(
            {"mitsuba/" + shape, {{"alpha", {0.25}}, {"f0", f0}, {"diffuse", diffuse}}}, scene);
        REQUIRE(found.values.size() == expected.values.size());
        for (std::size_t i = 0; i < found.values.size(); ++i)
          REQUIRE(found.values[i] == Approx(expected.values[i]).epsilon(1e-6));
      }
  CHECK_THROWS_WITH(
      renderer->render(
          {"mitsuba/ggx-metallic",
           {{"roughness", {0.5}}, {"base_color", {0.5}}, {"metallic", {0.1, 0.2, 0.3}}, {"specular", {0.5}}}},
          scene),
      Contains("metallic has 3 values (give 1)"));
}

TEST_CASE("roles: the base color of a metal is F0") {
  const Table table =
      sweep(*make_builtin_renderer(), metallic_sweep({}, grid_samples({0.1, 0.6}, 3, {0, 1}, 3)));
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
  const Table table = sweep(*make_builtin_renderer(), options);
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
       sweep(*make_builtin_renderer(), metallic_sweep(roles, grid_samples({0.1, 0.6}, 3, {0, 1}, 3))).rows) {
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-5));
    CHECK(row.specular2 == Approx(0.08 * row.specular1).epsilon(1e-4));
  }
}

TEST_CASE("roles: a target takes roles as a source does") {
  SweepOptions options =
      sweep_options("mitsuba/ggx", "mitsuba/ggx-metallic", "natural", {{0.2, 0.3}, {0.4, 0.6}}, 96);
  // The target is a metal, so its base color is its F0, and it has no diffuse that would disturb the match.
  options.target_roles.fixed = {{"metallic", 1.0}};
  const Table table = sweep(*make_builtin_renderer(), options);
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
