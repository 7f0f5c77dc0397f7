// This file tests random materials of many parameters against equations (2) and (3) of Sztrajman et al. 2019.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "measure/sweep.hpp"
#include "remap/error.hpp"

using namespace remap;
using Catch::Matchers::Contains;

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
  return run_material_sample(*make_builtin_renderer(), options, execution);
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
