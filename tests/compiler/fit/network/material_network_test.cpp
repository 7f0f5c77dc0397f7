// This file tests networks from the specular to the metallic workflow: the check of the rows, the fit, and
// invalid tables.
#include <cmath>

#include <catch2/catch.hpp>

#include "fit/network/fit_network.hpp"
#include "lower/fit_file.hpp"
#include "remap/error.hpp"
#include "runtime/stages/materials.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

// Returns rows of equation (2), as remapc sample writes them.
MaterialTable family_table(std::size_t count, double f0) {
  MaterialTable table;
  table.name = "family.csv";
  table.comments = {{"source", "mitsuba/ggx-metallic"},
                    {"source_roughness", "roughness"},
                    {"target", "mitsuba/ggx"},
                    {"target_roughness", "alpha"}};
  table.source_columns = {"roughness1", "base_color_r1", "base_color_g1", "base_color_b1", "metallic1"};
  table.target_columns = {"alpha2", "f0_r2", "f0_g2", "f0_b2", "diffuse_r2", "diffuse_g2", "diffuse_b2"};
  std::mt19937 random(2);
  for (std::size_t i = 0; i < count; ++i) {
    const MetallicMaterial metal = workflow_test::random_metallic(random);
    const SpecularMaterial specular = to_specular(workflow_test::plain(ClosedFormula::kEquation2, f0), metal);
    NamedRow row;
    row.source = {0.5, metal.base_color[0], metal.base_color[1], metal.base_color[2], metal.metallic};
    row.target = {0.25,
                  specular.specular[0],
                  specular.specular[1],
                  specular.specular[2],
                  specular.diffuse[0],
                  specular.diffuse[1],
                  specular.diffuse[2]};
    table.rows.push_back(row);
  }
  table.rows[3].status = RowStatus::kUnstable;
  return table;
}

MaterialNetworkOptions quick_material_options() {
  MaterialNetworkOptions options;
  options.id = "back";
  options.hidden = {24};
  options.held_out_fraction = 0.2;
  return options;
}

}  // namespace

TEST_CASE("material network: learns the way back, says how well, and returns from its file", "[slow]") {
  const WorkflowFit fit = fit_material_network(family_table(1000, 0.03), "bytes", quick_material_options());
  CHECK(fit.id == "back");
  CHECK(fit.conversion.source_model() == "mitsuba/ggx");
  CHECK(fit.conversion.target_model() == "mitsuba/ggx-metallic");
  CHECK(std::string(material_kind(fit)) == "mlp");
  // The F0 comes from the dielectrics of the table. Tables that contradict equation (2) are refused below.
  CHECK_THAT(fit_to_json(fit), Contains("\"dielectric_f0\": 0.03"));
  REQUIRE(fit.training);
  CHECK(fit.training->metallic.rms < 0.08);
  CHECK(fit.training->base_color.rms < 0.03);
  CHECK(fit.training->split.held_out_rows == 200);
  CHECK(fit.training->split.trained_rows == 799);
  CHECK(fit.training->split.left_out.at("unstable") == 1);
  const MetallicMaterial dielectric =
      to_metallic(fit.conversion, {{0.6f, 0.4f, 0.3f}, {0.03f, 0.03f, 0.03f}, 0.25f});
  CHECK(dielectric.metallic < 0.15f);
  CHECK(dielectric.base_color[0] == Approx(0.6).margin(0.1));
  CHECK(dielectric.width == Approx(0.5));
  const AnyFit read = any_fit_from_json(fit_to_json(fit), "x");
  REQUIRE(std::holds_alternative<WorkflowFit>(read));
  CHECK(std::get<WorkflowFit>(read) == fit);
  CHECK_THROWS_WITH(fit_from_json(fit_to_json(fit), "x"), Contains("converts whole materials"));
  CHECK(fit_material_network(family_table(1000, 0.03), "bytes", quick_material_options()) == fit);
}

TEST_CASE("material network: tables of other columns, or not of equation (2), are refused") {
  MaterialTable table = family_table(200, 0.04);
  table.target_columns[1] = "specular_r2";
  CHECK_THROWS_WITH(fit_material_network(table, "", quick_material_options()),
                    Contains("missing column f0_r2"));
  table = family_table(200, 0.04);
  for (NamedRow& row : table.rows) row.target[4] *= 0.9;
  CHECK_THROWS_WITH(fit_material_network(table, "", quick_material_options()),
                    Contains("differ from equation (2)"));
  table = family_table(200, 0.04);
  for (NamedRow& row : table.rows) row.status = RowStatus::kFlat;
  CHECK_THROWS_WITH(fit_material_network(table, "", quick_material_options()),
                    Contains("no row has status ok"));
  MaterialNetworkOptions options = quick_material_options();
  options.id = "a b";
  CHECK_THROWS_WITH(fit_material_network(family_table(200, 0.04), "", options), Contains("is not valid"));
}
