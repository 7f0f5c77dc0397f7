// This file tests the converters that ship: it compares the figures on their cards with their tables. The
// recorded excess of a fit is used as long as the fit has not changed.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "build/build.hpp"
#include "build/fit_folder.hpp"
#include "build/report.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "fit/fit_table.hpp"
#include "lower/chain.hpp"
#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "support/campaign.hpp"
#include "support/temporary_folder.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

using namespace remap;

namespace {

const std::filesystem::path kFits = std::filesystem::path(REMAP_SOURCE_DIR) / "fits";

const std::vector<Fit>& shipped() {
  static const std::vector<Fit> fits = load_fits(kFits);
  return fits;
}

bool of_hub(const Fit& fit) {
  return fit.source.model.starts_with("mitsuba/") && fit.target.model.starts_with("mitsuba/");
}

bool is_in(const std::vector<std::string>& models, const std::string& model) {
  return std::find(models.begin(), models.end(), model) != models.end();
}

template <typename Visit>
void over_domain(const Fit& fit, const Visit& visit) {
  for (int i = 0; i <= 60; ++i)
    for (int j = 0; j <= 20; ++j) {
      const Range& alphas = fit.domain.alpha;
      const double alpha = alphas.min + (alphas.max - alphas.min) * i / 60.0;
      visit(alpha, fit.domain.specular.max * j / 20.0);
    }
}

}  // namespace

TEST_CASE("shipped: every ordered pair of the hub, and the models that are reached through it") {
  const std::vector<std::string> hub = {"mitsuba/ward",  "mitsuba/ward-duer", "mitsuba/ward-balanced",
                                        "mitsuba/phong", "mitsuba/beckmann",  "mitsuba/ggx",
                                        "mitsuba/as"};
  std::set<std::pair<std::string, std::string>> measured, others;
  for (const Fit& fit : shipped())
    (is_measured(fit) ? measured : others).insert({fit.source.model, fit.target.model});
  for (const std::string& source : hub)
    for (const std::string& target : hub)
      if (source != target) CHECK(measured.count({source, target}) == 1);
  // Every model that is not in the hub must have converters to and from the hub.
  std::set<std::string> real;
  for (const auto& [source, target] : measured) {
    if (!is_in(hub, source)) real.insert(source);
    if (!is_in(hub, target)) real.insert(target);
  }
  for (const std::string& model : real) {
    // Lobes of an exponent are only converted to GGX without Fresnel, and from there to other models
    // (docs/decisions/060).
    if (model.starts_with("legacy/") || model.starts_with("mujoco/")) {
      CHECK(measured.count({model, "mitsuba/ggx-plain"}) == 1);
      continue;
    }
    if (model == "mitsuba/ggx-plain") {
      CHECK(measured.count({model, "mitsuba/ggx"}) == 1);
      continue;
    }
    const auto joins = [&](const auto& pair) {
      return (pair.first == model && is_in(hub, pair.second)) ||
             (pair.second == model && is_in(hub, pair.first));
    };
    INFO(model);
    CHECK(std::count_if(measured.begin(), measured.end(), joins) >= 2);
  }
  for (const auto& pair :
       std::vector<std::pair<std::string, std::string>>{{"mitsuba/ward", "blender-internal-2.7/ward"},
                                                        {"blender-internal-2.7/ward", "mitsuba/ward"},
                                                        {"mitsuba/ggx", "cycles-2.7/ggx"},
                                                        {"cycles-2.7/ggx", "mitsuba/ggx"},
                                                        {"blender-internal-2.7/ward", "cycles-2.7/ggx"},
                                                        {"cycles-2.7/ggx", "blender-internal-2.7/ward"}})
    CHECK(others.count(pair) == 1);
}

TEST_CASE("shipped: fits are of their tables") {
  for (const Fit& fit : shipped()) {
    if (!is_measured(fit)) continue;
    INFO(fit.id);
    CHECK(fit.split.held_out_rows >= (of_hub(fit) ? 20 : 15));
    const std::string bytes = read_file(kFits / "tables" / fit.table.name);
    CHECK(sha256(bytes) == fit.table.sha256);
    const Table table = parse_table(bytes, fit.table.name);
    CHECK(table_domain(table) == fit.domain);
    for (const TableRow& row : table.rows)
      if (is_inside(row, fit.domain)) CHECK(has_answer(row));
  }
}

// These errors are measured with lights and materials that were not used for the fit.
TEST_CASE("shipped: pictures are nearer to the source's than those of copied numbers") {
  int judged = 0;
  for (const Fit& fit : shipped()) {
    if (!fit.pictures) continue;
    INFO(fit.id);
    ++judged;
    CHECK(fit.pictures->rmse < fit.copied_pictures->rmse);
    CHECK(fit.pictures->relative <= fit.copied_pictures->relative);
  }
  CHECK(judged >= 42);
}

// Some renderers have no pictures of both models, so these fits are compared with the rows of their tables. A
// difference of one part in fifty is invisible on spheres of these renderers.
TEST_CASE("shipped: fits without pictures follow the rows of their tables") {
  for (const Fit& fit : shipped()) {
    if (!is_measured(fit) || fit.pictures) continue;
    INFO(fit.id);
    const Table table = read_table(kFits / "tables" / fit.table.name);
    double largest = 0.0;
    for (const TableRow& row : table.rows)
      if (is_inside(row, fit.domain)) largest = std::max(largest, row.specular2);
    const Residuals residuals = residuals_of(rows_inside(answer_rows(table), fit.domain), fit);
    CHECK(error_figures(residuals.alpha).rms <= 0.02);
    CHECK(error_figures(residuals.specular).rms <= 0.02 * largest);
    CHECK(fit.alpha_error.rms <= 0.02);
    CHECK(fit.specular_error.rms <= 0.02 * largest);
  }
}

TEST_CASE(
    "shipped: inside its domain a converter gives valid parameters of the target, and rises up to its limits",
    "[slow]") {
  for (const Fit& fit : shipped()) {
    INFO(fit.id);
    const double specular_slack = fit.has_errors() ? 2.0 * fit.specular_error.max + 1e-3 : 1e-3;
    int below_limits = 0;
    over_domain(fit, [&](double alpha, double specular) {
      const MappedTexel texel = evaluate_fit(fit, alpha, specular);
      CHECK(texel.alpha > 0.0);
      CHECK(texel.alpha <= 1.0);
      CHECK(texel.specular <= fit.limits.specular.value_or(1.0 + specular_slack));
      if (alpha * 1.01 > fit.domain.alpha.max || !is_inside(fit, alpha * 1.01, specular + 0.01)) return;
      ++below_limits;
      INFO(alpha << " " << specular);
      CHECK(evaluate_fit(fit, alpha * 1.01, specular).alpha >= texel.alpha - 1e-3);
      const double brighter = evaluate_fit(fit, alpha, specular + 0.01).specular;
      if (texel.specular == fit.limits.specular)
        CHECK(brighter == texel.specular);
      else if (texel.specular > 0.0)
        CHECK(brighter >= texel.specular - 1e-4);
    });
    CHECK(below_limits > 0);
  }
}

TEST_CASE("shipped: converters of the hub cover every width and specular") {
  for (const Fit& fit : shipped())
    if (of_hub(fit) && is_measured(fit)) {
      INFO(fit.id);
      CHECK(fit.domain == Domain{{0.01, 1.0}, {0.0, 1.0}});
    }
}

TEST_CASE("shipped: a ramp of 1e-4 in alpha or specular jumps nowhere by more than 2e-3",
          "[slow][campaign]") {
  constexpr double kStep = 1e-4, kMost = 2e-3;
  const int lines = campaign_length(40) + 1;
  for (const Fit& fit : shipped()) {
    if (!of_hub(fit) || !is_measured(fit)) continue;
    MappedTexel worst;
    for (int line = 0; line < lines; ++line) {
      const double share = (line + 0.5) / lines, alpha = 0.01 + 0.99 * share;
      MappedTexel by_alpha = evaluate_fit(fit, 0.01, share), by_specular = evaluate_fit(fit, alpha, 0.0);
      for (double moving = 0.01; moving <= 1.0; moving += kStep) {
        const MappedTexel wider = evaluate_fit(fit, moving, share);
        worst.alpha = std::max(worst.alpha, std::fabs(wider.alpha - by_alpha.alpha));
        worst.specular = std::max(worst.specular, std::fabs(wider.specular - by_alpha.specular));
        by_alpha = wider;
      }
      // Steps are finer below 0.01, where there is hardly any light and forms change fast.
      for (double moving = 0.0; moving <= 1.0; moving += moving < 0.01 ? 0.05 * kStep : kStep) {
        const MappedTexel brighter = evaluate_fit(fit, alpha, moving);
        worst.alpha = std::max(worst.alpha, std::fabs(brighter.alpha - by_specular.alpha));
        worst.specular = std::max(worst.specular, std::fabs(brighter.specular - by_specular.specular));
        by_specular = brighter;
      }
    }
    INFO(fit.id);
    CHECK(worst.alpha <= kMost);
    CHECK(worst.specular <= kMost);
  }
}

TEST_CASE("shipped: chains agree with their steps", "[slow]") {
  const std::vector<std::vector<std::string>> chains = {
      {"blender_internal_2_7_ward_to_cycles_2_7_ggx", "blender_internal_2_7_ward_to_mitsuba_ward",
       "mitsuba_ward_to_mitsuba_ggx", "mitsuba_ggx_to_cycles_2_7_ggx"},
      {"cycles_2_7_ggx_to_blender_internal_2_7_ward", "cycles_2_7_ggx_to_mitsuba_ggx",
       "mitsuba_ggx_to_mitsuba_ward", "mitsuba_ward_to_blender_internal_2_7_ward"}};
  for (const std::vector<std::string>& chain : chains) {
    INFO(chain.front());
    const Fit fit = find_fit(chain.front(), kFits);
    std::vector<Fit> steps;
    for (std::size_t i = 1; i < chain.size(); ++i) steps.push_back(find_fit(chain[i], kFits));
    Fit composed = composed_fit(steps, fit.id);
    add_converter(&composed);
    CHECK(composed == fit);
    const ChainDifference difference = difference_from_steps(fit, steps);
    CHECK(difference.alpha < 2e-2);
    CHECK(difference.grey_specular < 2e-2);
    CHECK(difference.color_specular < 3e-2);
  }
}

TEST_CASE("shipped: figure 18 there and back") {
  const Fit there = find_fit("blender_internal_2_7_ward_to_cycles_2_7_ggx", kFits),
            back = find_fit("cycles_2_7_ggx_to_blender_internal_2_7_ward", kFits);
  // Ward and GGX differ in shape, so each direction has its own match and the round trip is not exact.
  for (const double alpha : {0.1, 0.2, 0.3}) {
    const MappedTexel far = evaluate_mapping(there.mapping, alpha, 0.1);
    const MappedTexel home = evaluate_mapping(back.mapping, far.alpha, far.specular);
    CHECK(home.alpha == Approx(alpha).epsilon(0.35));
    CHECK(home.specular == Approx(0.1).epsilon(0.35));
  }
}

TEST_CASE("shipped: the published formulas, as corrected") {
  const Fit as = find_fit("mitsuba_ward_to_mitsuba_as_sztrajman_2019", kFits);
  CHECK(evaluate_mapping(as.mapping, 1.0, 1.0).alpha == Approx(1.04 - 0.388 - 0.332 + 0.25).epsilon(1e-12));
  CHECK(evaluate_mapping(as.mapping, 0.5, 1.0).specular ==
        Approx(-512.13 + 512.75 * std::exp(-0.00057 * 0.5) + 0.398 * std::exp(-3.12 * 0.25)).epsilon(1e-9));
  const Fit ggx = find_fit("mitsuba_ward_to_mitsuba_ggx_sztrajman_2019", kFits);
  CHECK(evaluate_mapping(ggx.mapping, 1.0, 1.0).alpha == Approx(0.579).epsilon(1e-9));
  const Fit cycles = find_fit("cycles_2_7_ggx_to_mitsuba_as", kFits);
  CHECK(evaluate_mapping(cycles.mapping, 0.02, 0.5).specular ==
        Approx(0.5 *
               (-0.067 + 1.43 * std::exp(-0.692 * 0.02) - 0.547 * std::exp(-6.4 * 0.0004) + 0.0002 / 0.02))
            .epsilon(1e-9));
  for (const Fit& fit : {as, ggx, cycles}) {
    REQUIRE(fit.remarks.size() >= 2);
    CHECK(fit.remarks[0].find("Sztrajman et al. 2019") != std::string::npos);
    CHECK(std::any_of(fit.remarks.begin(), fit.remarks.end(),
                      [](const std::string& remark) { return remark.starts_with("Erratum: "); }));
  }
}

TEST_CASE("shipped: the fits are those of the manifest, and the report is up to date") {
  const BuildFolders folders{kFits, std::filesystem::path(REMAP_SOURCE_DIR) / "generated"};
  CHECK(stale(load_manifest(kFits), folders).empty());
  const std::vector<EmittedFile> files = report(load_fit_folder(kFits));
  for (const EmittedFile& file : files) {
    INFO(file.name);
    CHECK((read_file(kFits / file.name) == file.text));
  }
}

TEST_CASE("shipped tables: the manifest accepts the light of those that need it, and of no other") {
  std::size_t accepted = 0;
  for (const ManifestItem& item : load_manifest(kFits)) {
    const std::filesystem::path path = kFits / "tables" / (item.id + ".csv");
    if (!std::filesystem::exists(path)) {
      CHECK_FALSE(item.accept_light);
      continue;
    }
    const std::string text = read_file(path);
    LightMatch match = light_match(parse_csv(text, item.id).comments);
    match.accepted = false;
    INFO(item.id);
    CHECK(item.accept_light == is_wrong_light(match));
    accepted += item.accept_light ? 1 : 0;
  }
  CHECK(accepted == 2);
}

TEST_CASE("reach records: are kept for fits that have not changed since") {
  const TemporaryFolder folder;
  CHECK(read_reach(folder.path()).empty());
  for (const std::string id : {"a_to_b", "b_to_a"}) write_file(folder.path() / (id + ".json"), id);
  ReachRecords records;
  records["a_to_b"] = {file_sha256(folder.path() / "a_to_b.json"), 144, 1.25e-4, 0.0123, 0.5, 0.75};
  records["b_to_a"] = {file_sha256(folder.path() / "b_to_a.json"), 144, -2e-5, 0.004, 1.0, 0.04};
  write_reach(folder.path(), records);
  const ReachRecords again = current_reach(folder.path());
  REQUIRE(again.size() == 2);
  CHECK(again.at("a_to_b").fit == records["a_to_b"].fit);
  CHECK(again.at("a_to_b").materials == 144);
  CHECK(again.at("a_to_b").mean_excess == 1.25e-4);
  CHECK(again.at("a_to_b").largest_excess == 0.0123);
  CHECK(again.at("b_to_a").alpha == 1.0);
  CHECK(again.at("b_to_a").specular == 0.04);
  write_file(folder.path() / "a_to_b.json", "another fit");
  CHECK(current_reach(folder.path()).size() == 1);
  CHECK(read_reach(folder.path()).size() == 2);
  write_file(folder.path() / kReachName, "converter,fit\na,b\n");
  CHECK_THROWS_AS(read_reach(folder.path()), Error);
}
