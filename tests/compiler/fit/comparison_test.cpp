// The choice among regressions: what it chooses, that it is deterministic, and what it does with bad tables.
#include "fit/comparison.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "fit/baselines.hpp"
#include "fit/edge.hpp"
#include "fit/fit_table.hpp"
#include "lower/fit_file.hpp"
#include "remap/error.hpp"

using namespace remap;

namespace {

using Surface = std::function<MappedTexel(double alpha, double specular)>;

Table table_of(const Surface& surface, int widths = 20, int speculars = 5) {
  Table table;
  table.name = "made.csv";
  table.source = {"mitsuba/ward", RoughnessConvention::kAlpha, "specular"};
  table.target = {"mitsuba/as", RoughnessConvention::kAlpha, "f0"};
  std::size_t line = 2;
  for (int i = 0; i < widths; ++i) {
    for (int j = 1; j <= speculars; ++j) {
      const double alpha = 0.02 + 0.98 * i / (widths - 1), specular = 0.9 * j / speculars;
      const MappedTexel texel = surface(alpha, specular);
      table.rows.push_back({alpha, specular, texel.alpha, texel.specular, 0.0, RowStatus::kOk, line++});
    }
  }
  return table;
}

const Parametric kPaper{{{1.04, -0.388, -0.332, 0.25}}, {{1, {1.02, -0.4, 1.7, -1.1, 3.3, 0.0}}}};

MappedTexel paper_surface(double alpha, double specular) { return evaluate_mapping(kPaper, alpha, specular); }

// A bump in specular that sums of low powers cannot follow.
MappedTexel bumpy_surface(double alpha, double specular) {
  const double bump = std::exp(-40.0 * ((alpha - 0.5) * (alpha - 0.5) + (specular - 0.5) * (specular - 0.5)));
  return {0.9 * alpha + 0.01 * bump, 0.8 * specular + 0.03 * bump};
}

// A small network, so that the test is quick.
FitOptions quick_options(unsigned jobs = 0) {
  FitOptions options;
  options.regression.jobs = jobs;
  options.regression.mlp.hidden = {6};
  options.regression.mlp.starts = 1;
  return options;
}

Fit fit_of(const Table& table, const FitOptions& options) {
  return fit_table(table, table_text(table), options).fit;
}

}  // namespace

TEST_CASE("comparison: auto chooses the form of the paper for a table made from it", "[slow]") {
  const Fit fit = fit_of(table_of(paper_surface), quick_options());
  REQUIRE(fit.method.count("form") == 1);
  CHECK(fit.method.at("form") == "paper");
  REQUIRE(fit.candidates.size() == 2);  // no svr and no mlp: these are near enough
  CHECK(fit.candidates[0].verdict == "chosen");
  CHECK(fit.candidates[0].chroma_shift < 1e-12);
  CHECK(fit.candidates[1].name == "series");
  for (const CandidateRecord& one : fit.candidates) CHECK(one.edge_alpha_rms > 0.0);
}

TEST_CASE("comparison: auto chooses a richer form if the table needs it", "[slow]") {
  const Fit fit = fit_of(table_of(bumpy_surface, 18, 8), quick_options());
  CHECK(kind_name(fit.mapping) != "parametric");
  CHECK(fit.candidates.size() == 5);     // all kinds
  CHECK(fit.specular_error.rms < 4e-3);  // the bump is 0.03 high
}

TEST_CASE("comparison: the same seed gives the same bytes for any number of jobs", "[slow]") {
  const Table table = table_of(bumpy_surface, 12, 5);
  const std::string one = fit_to_json(fit_of(table, quick_options(1)));
  CHECK(one == fit_to_json(fit_of(table, quick_options(2))));
  CHECK(one == fit_to_json(fit_of(table, quick_options(2))));
  const Fit read = fit_from_json(one, "memory");
  CHECK(fit_to_json(read) == one);
  CHECK(read.candidates.size() == 5);
}

TEST_CASE("comparison: an interruption ends it") {
  const Table table = table_of(paper_surface, 10, 3);
  CHECK_THROWS_WITH(fit_table(table, "", quick_options(),
                              [](double share) {
                                if (share > 0.1) throw Error(ErrorKind::kInterrupted, "enough");
                              }),
                    "enough");
}

TEST_CASE("comparison: tables with one specular, with duplicates and with outliers are fitted", "[slow]") {
  // With one specular value, regressors of two inputs are underdetermined.
  const Table flat = table_of(paper_surface, 20, 1);
  const Fit of_flat = fit_of(flat, quick_options());
  CHECK(of_flat.specular_error.rms < 1e-3);

  Table doubled = table_of(paper_surface, 12, 4);
  const std::vector<TableRow> once = doubled.rows;
  doubled.rows.insert(doubled.rows.end(), once.begin(), once.end());
  CHECK(fit_of(doubled, quick_options()).specular_error.rms < 1e-3);

  Table spoilt = table_of(paper_surface, 16, 6);
  spoilt.rows[40].specular2 *= 1.5;
  const Fit of_spoilt = fit_of(spoilt, quick_options());
  // The outlier is not followed: other rows move by no more than one of 96 rows can cause.
  CHECK(evaluate_mapping(of_spoilt.mapping, 0.8, 0.45).specular ==
        Approx(paper_surface(0.8, 0.45).specular).epsilon(0.05));
}

TEST_CASE("comparison: tables that cannot be fitted fail with the reason") {
  const Table one_width = table_of(
      [](double, double specular) {
        return MappedTexel{0.3, 0.5 * specular};
      },
      20, 4);
  CHECK_THROWS_WITH(fit_of(one_width, quick_options()), Catch::Contains("alpha2 stays at 0.3"));
  Table constant = table_of(paper_surface);
  for (TableRow& row : constant.rows) row.alpha1 = 0.5;
  CHECK_THROWS_AS(fit_of(constant, quick_options()), Error);
  Table dark = table_of(paper_surface);
  for (TableRow& row : dark.rows) row.specular1 = 0.0;
  CHECK_THROWS_AS(fit_of(dark, quick_options()), Error);
}

TEST_CASE("edge: the outermost widths and the largest speculars are left out") {
  const Table table = table_of(paper_surface, 20, 5);
  const EdgeRows edge = edge_rows(table.rows);
  CHECK(edge.inner.size() == 18 * 4);
  CHECK(edge.outer.size() == 100 - 18 * 4);
  CHECK(edge_rows(table_of(paper_surface, 7, 5).rows).outer.empty());
  const EdgeErrors errors = edge_errors(kPaper, covered_domain(edge.inner), edge.outer);
  CHECK(errors.raw_alpha_rms < 1e-12);
  CHECK(errors.raw_specular_rms < 1e-12);
  CHECK(errors.alpha_rms > 1e-3);  // the domain rule holds alpha at the last row but one
}

TEST_CASE("edge: chroma shifts by the closed form, and faults are reported") {
  const Domain domain{{0.1, 1.0}, {0.0, 1.0}};
  CHECK(look_beyond(kPaper, domain).chroma_shift < 1e-12);
  // specular2 = s - 0.5 s^2: of (1, 0.1, 0.1) the first is 0.5, beyond it 0.375.
  const Parametric bent{{{1.0}}, {{1, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}}, {2, {-0.5, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  const double inside = 0.5 / (0.5 + 2 * 0.095), beyond = 0.375 / (0.375 + 2 * (0.15 - 0.01125));
  CHECK(look_beyond(bent, domain).chroma_shift == Approx(inside - beyond));
  CHECK(look_beyond(bent, domain).fault.empty());
  const Parametric negative{{{1.0}},
                            {{1, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}}, {2, {-0.8, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  CHECK(look_beyond(negative, domain).fault.empty());  // at 1.5, where the domain rule holds
  CHECK(look_beyond(negative, {{0.1, 1.0}, {0.0, 1.5}}).fault.find("specular1 1.5") != std::string::npos);
}

TEST_CASE("baselines: formulas give the numbers of their sources, or the reason why they do not apply") {
  using Convention = RoughnessConvention;
  const auto find = [](const std::vector<Baseline>& all, const std::string& name) {
    for (const Baseline& baseline : all)
      if (baseline.name == name) return baseline;
    FAIL(name);
    return all[0];
  };
  const auto of =
      baselines({"a/phong", Convention::kExponent, "specular"}, {"b/ggx", Convention::kRoughness, "f0"});
  const double alpha = to_alpha(Convention::kExponent, 100.0);
  // Ns = 100 becomes roughness 0.14 in one tool and 0.90 in another.
  CHECK(std::sqrt(find(of, "FBX2glTF").map(alpha, 0.5).alpha) == Approx(std::sqrt(2.0 / 102.0)));
  CHECK(std::sqrt(find(of, "obj2gltf").map(alpha, 0.5).alpha) == Approx(0.9));
  CHECK(std::sqrt(find(of, "Blender OBJ").map(alpha, 0.5).alpha) == Approx(1.0 - std::sqrt(0.1)));
  CHECK(std::sqrt(find(of, "assimp").map(alpha, 0.5).alpha) == Approx(1.0 - std::sqrt(0.1) * 0.5));
  CHECK(find(of, "Yocto").map(alpha, 0.5).alpha == Approx(alpha));
  CHECK(find(of, "exponent").map(alpha, 0.5).alpha == Approx(alpha));
  CHECK(find(of, "copy").map(alpha, 0.5).specular == 0.5);
  CHECK_FALSE(find(of, "pbrt-v3").map);
  CHECK(find(of, "copy number").why_not == "a/phong has exponent");

  const auto widths = baselines({"a/x", Convention::kRoughness, "f0"}, {"b/y", Convention::kAlpha, "f0"});
  CHECK(find(widths, "copy number").map(0.25, 0.5).alpha == Approx(0.5));
  // pbrt-v3: roughness 1 gives 1.62142.
  CHECK(find(widths, "pbrt-v3").map(1.0, 0.5).alpha == Approx(1.62142));
  CHECK(find(widths, "FBX2glTF").why_not == "a/x has roughness, not an exponent");
}
