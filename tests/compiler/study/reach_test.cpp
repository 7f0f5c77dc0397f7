// This file tests the reach study on conversions whose excess is known.
#include "study/reach.hpp"

#include <catch2/catch.hpp>

#include "compiler/report/scaled_fit.hpp"
#include "lower/fit_file.hpp"
#include "measure/sweep.hpp"
#include "support/campaign.hpp"

using namespace remap;

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
