// This file tests checks of tables (each kind of finding, on a table with only that fault), the box of
// source parameters that a table covers, tables with reversed roles, and the rule about the light of two
// renderers.
#include "table/check.hpp"

#include <cmath>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/shared_data.hpp"
#include "table/regression.hpp"
#include "table/table.hpp"

using namespace remap;

namespace {

// Returns a table without faults: 10 widths x 5 speculars, with the line numbers of a file.
Table sound_table() {
  Table table;
  table.name = "t.csv";
  std::size_t line = 2;
  for (int i = 1; i <= 10; ++i)
    for (int j = 1; j <= 5; ++j)
      table.rows.push_back(
          {0.1 * i, 0.2 * j, 0.08 * i, 0.2 * j * (0.9 - 0.05 * i), 0.0, RowStatus::kOk, line++});
  return table;
}

std::vector<Finding> of_kind(const Table& table, const std::string& kind) {
  std::vector<Finding> found;
  for (const Finding& finding : check_table(table))
    if (finding.kind == kind) found.push_back(finding);
  return found;
}

}  // namespace

TEST_CASE("check: a table without faults has no findings") { CHECK(check_table(sound_table()).empty()); }

TEST_CASE("check: the published table can be fitted", "[needs]") {
  const auto path = shared_data("tables/mitsuba-ward2mitsuba-as.csv");
  if (path.empty()) return;
  const Table table = read_table(path, column_map("sztrajman-2019"));
  CHECK_NOTHROW(require_fittable(table));
}

TEST_CASE("check: a repeated row is a warning, a contradicting one an error") {
  Table table = sound_table();
  TableRow copy = table.rows[7];
  copy.line = 99;
  table.rows.push_back(copy);
  const auto duplicates = of_kind(table, "duplicate");
  REQUIRE(duplicates.size() == 1);
  CHECK(duplicates[0].line == 99);
  CHECK(duplicates[0].severity == Severity::kWarning);
  CHECK(duplicates[0].message.find("line 9") != std::string::npos);
  table.rows.back().alpha2 += 0.01;
  const auto contradictions = of_kind(table, "contradiction");
  REQUIRE(contradictions.size() == 1);
  CHECK(contradictions[0].severity == Severity::kError);
  CHECK_THROWS_WITH(require_fittable(table), Catch::StartsWith("t.csv:99: contradiction"));
}

TEST_CASE("check: a gap in the widths is reported with its ends") {
  Table table = sound_table();
  std::erase_if(table.rows, [](const TableRow& row) { return row.alpha1 > 0.35 && row.alpha1 < 0.75; });
  const auto gaps = of_kind(table, "gap");
  REQUIRE(gaps.size() == 1);
  CHECK(gaps[0].message.find("0.8") != std::string::npos);
}

TEST_CASE("check: a roughness curve that falls cannot be fitted") {
  Table table = sound_table();
  for (TableRow& row : table.rows)
    if (row.alpha1 > 0.65 && row.alpha1 < 0.75) row.alpha2 = 0.4;
  const auto found = of_kind(table, "non-monotone");
  REQUIRE(found.size() == 1);
  CHECK(found[0].severity == Severity::kError);
  CHECK(found[0].message.find("0.7") != std::string::npos);
}

TEST_CASE("check: jumps as in figures 6, 8 and 10 are reported with their row") {
  Table table = sound_table();
  table.rows[12].specular2 *= 1.2;  // the third of the five speculars at the third width
  const auto found = of_kind(table, "jump");
  REQUIRE_FALSE(found.empty());
  bool named = false;
  for (const Finding& finding : found) named = named || finding.line == table.rows[12].line;
  CHECK(named);
  Table roughness = sound_table();
  roughness.rows[22].alpha2 += 0.05;
  CHECK_FALSE(of_kind(roughness, "jump").empty());
}

TEST_CASE("check: clamped rows and constant values are reported as saturation") {
  Table table = sound_table();
  for (TableRow& row : table.rows) {
    if (row.specular1 > 0.5) row.specular2 = 0.3;
    if (row.alpha1 > 0.95) row.status = RowStatus::kClamped;
  }
  const auto found = of_kind(table, "saturation");
  REQUIRE(found.size() >= 2);
  CHECK(found.back().message.find("5 of 50 rows are clamped") != std::string::npos);
}

TEST_CASE("check: rows at the limits that a sweep recorded are answers, not saturation") {
  Table table = sound_table();
  for (TableRow& row : table.rows)
    if (row.alpha1 > 0.85) {
      row.alpha2 = 0.7;
      row.status = RowStatus::kClamped;
    }
  CHECK(of_kind(table, "saturation").size() == 1);
  table.comments = {{kAlphaLimitComment, "0.7"}, {kSpecularLimitComment, "1"}};
  find_limits(&table);
  CHECK(of_kind(table, "saturation").empty());
}

TEST_CASE("check: invalid values are errors, unphysical ones warnings") {
  for (const double bad : {-0.1, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    Table table = sound_table();
    table.rows[3].specular2 = bad;
    const auto found = of_kind(table, "range");
    REQUIRE(found.size() == 1);
    CHECK(found[0].severity == Severity::kError);
    CHECK(found[0].line == table.rows[3].line);
  }
  Table zero = sound_table();
  zero.rows[3].alpha2 = 0.0;
  CHECK(of_kind(zero, "range").size() == 1);
  Table bright = sound_table();
  bright.rows[4].specular2 = 1.4;
  REQUIRE_FALSE(of_kind(bright, "range").empty());
  CHECK(of_kind(bright, "range")[0].severity == Severity::kWarning);
}

TEST_CASE("check: diffuse out of range is reported") {
  Table table = sound_table();
  table.has_diffuse = true;
  table.rows[3].diffuse2 = -0.1;
  table.rows[4].diffuse2 = 1.2;
  const auto findings = of_kind(table, "range");
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].message.find("diffuse2 is -0.1 (must be 0 or more)") != std::string::npos);
  CHECK(findings[1].severity == Severity::kWarning);
}

TEST_CASE("check: too few rows or widths cannot be fitted") {
  Table table = sound_table();
  table.rows.resize(10);
  CHECK_THROWS_WITH(require_fittable(table), Catch::Contains("10 usable rows and 2 values of alpha1"));
}

namespace {

constexpr int kAlphas = 20, kSpeculars = 10;

// Makes a grid over alpha 0.05 to 1 and specular 0.1 to 1. `status_of` sets the status of each row.
template <typename StatusOf>
Table grid(const StatusOf& status_of) {
  Table table;
  table.name = "t.csv";
  table.source.model = "a/b";
  table.target.model = "c/d";
  for (int i = 1; i <= kAlphas; ++i)
    for (int j = 1; j <= kSpeculars; ++j) {
      const double alpha = static_cast<double>(i) / kAlphas, specular = static_cast<double>(j) / kSpeculars;
      table.rows.push_back(
          {alpha, specular, 0.5 * alpha, 2.0 * specular, 0.01, status_of(alpha, specular), 0});
    }
  return table;
}

RowStatus clamped_where(bool condition) { return condition ? RowStatus::kClamped : RowStatus::kOk; }

}  // namespace

TEST_CASE("domain: without clamped rows, it is the box of all rows") {
  const Domain domain = table_domain(grid([](double, double) { return RowStatus::kOk; }));
  CHECK(domain.alpha == Range{0.05, 1.0});
  CHECK(domain.specular == Range{0.0, 1.0});
}

TEST_CASE("domain: a width that the target cannot reach ends it, whatever the specular") {
  const Domain domain = table_domain(grid([](double alpha, double) { return clamped_where(alpha > 0.71); }));
  CHECK(domain.alpha == Range{0.05, 0.7});
  CHECK(domain.specular == Range{0.0, 1.0});
}

TEST_CASE("domain: if the target's specular exceeds its bound, widths count more than specular") {
  // This is like Beckmann to Ward: specular2 = (1 + 2 alpha) specular1 must stay within 1.
  const Table table =
      grid([](double alpha, double specular) { return clamped_where((1.0 + 2.0 * alpha) * specular > 1.0); });
  const Domain domain = table_domain(table);
  CHECK(domain.alpha == Range{0.05, 1.0});
  CHECK(domain.specular.max == Approx(0.3));
  for (const TableRow& row : table.rows) {
    const bool inside = is_inside(row, domain);
    CHECK((!inside || row.status == RowStatus::kOk));
  }
}

TEST_CASE("domain: unstable and flat rows are gaps and do not limit it") {
  const Domain domain = table_domain(grid([](double alpha, double specular) {
    if (alpha == 0.5 && specular == 0.5) return RowStatus::kUnstable;
    return alpha == 0.25 ? RowStatus::kFlat : RowStatus::kOk;
  }));
  CHECK(domain.alpha == Range{0.05, 1.0});
  CHECK(domain.specular.max == 1.0);
}

TEST_CASE("domain: scattered rows are covered if their neighbours in width reach as far") {
  std::mt19937_64 random(7);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Table table;
  for (int i = 0; i < 4000; ++i) {
    const double alpha = 0.05 + 0.95 * uniform(), specular = uniform();
    table.rows.push_back({alpha, specular, alpha, specular, 0.0, clamped_where(alpha > 0.8), 0});
  }
  const Domain domain = table_domain(table);
  CHECK(domain.alpha.max < 0.8);
  CHECK(domain.alpha.max > 0.75);
  CHECK(domain.specular.max > 0.98);
  for (const TableRow& row : table.rows)
    if (row.status == RowStatus::kClamped) CHECK_FALSE(is_inside(row, domain));
}

TEST_CASE("domain: a table without usable rows has none") {
  CHECK_THROWS_WITH(table_domain(grid([](double, double) { return RowStatus::kClamped; })),
                    Catch::Contains("t.csv") && Catch::Contains("status ok"));
}

TEST_CASE("swapped: parameters and models are exchanged, unusable rows removed") {
  const Table table = swapped(grid([](double alpha, double) { return clamped_where(alpha > 0.71); }));
  CHECK(table.source.model == "c/d");
  CHECK(table.target.model == "a/b");
  CHECK(table.rows.size() == 14 * kSpeculars);
  CHECK(table.rows.front().alpha1 == Approx(0.025));
  CHECK(table.rows.front().specular1 == Approx(0.2));
  CHECK(table.rows.front().alpha2 == Approx(0.05));
  CHECK(table.rows.front().specular2 == Approx(0.1));
  CHECK(table.comments.back() == std::pair<std::string, std::string>{"roles", "swapped"});
}

TEST_CASE("swapped: widths that differ by rounding are one column") {
  const Table given = grid([](double, double) { return RowStatus::kOk; });
  Table rounded = given;
  for (TableRow& row : rounded.rows) row.alpha2 *= 1.0 + 5e-11 * row.specular1;
  const auto widths = [](const Table& table) {
    std::set<double> found;
    for (const TableRow& row : table.rows) found.insert(row.alpha1);
    return found.size();
  };
  REQUIRE(widths(given) < 100);
  CHECK(widths(swapped(rounded)) == widths(given));
  for (TableRow& row : rounded.rows) row.alpha2 *= 1.0 + 1e-6 * row.specular1;
  CHECK(widths(swapped(rounded)) == rounded.rows.size());
}

TEST_CASE("light: nothing is said within 1 %, a remark beyond it, an error beyond 5 % that nobody accepted") {
  for (const LightMatch& same : {LightMatch{}, LightMatch{1.009, 0.009}, LightMatch{0.991, 0.0}})
    CHECK(light_remark(same).empty());
  for (const LightMatch& said : {LightMatch{1.011, 0.0}, LightMatch{1.0, 0.011}, LightMatch{1.049, 0.3},
                                 LightMatch{0.951, 0.3}, LightMatch{1.3, 0.03, true}}) {
    CHECK_FALSE(light_remark(said).empty());
    CHECK_FALSE(is_wrong_light(said));
    CHECK_NOTHROW(require_light(said, "t.csv"));
  }
  for (const LightMatch& wrong : {LightMatch{1.051, 0.0}, LightMatch{0.949, 0.0}, LightMatch{1.3, 0.03}}) {
    CHECK_FALSE(light_remark(wrong).empty());
    CHECK(is_wrong_light(wrong));
    CHECK_THROWS_WITH(
        require_light(wrong, "t.csv"),
        Catch::StartsWith("t.csv: diffuse matches only if the light of the source is multiplied"));
  }
  CHECK(light_remark({1.1863, 0.031}) ==
        "diffuse matches only if the light of the source is multiplied by 1.186 (the diffuse pictures differ "
        "by 3.1 % after that). Therefore, specular2 is 19 % larger, which is right only if the two renderers "
        "have different light (check the diffuse of both models; --no-irradiance-matching keeps the light "
        "unchanged, --accept-light continues anyway)");
}

TEST_CASE("light: a table is checked by what its comments record") {
  std::string rows;
  for (const char* alpha : {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"})
    for (const char* specular : {"0.2", "0.4"})
      rows += std::string(alpha) + "," + specular + "," + alpha + "," + specular + "\n";
  const auto findings = [&](const std::string& comments, bool accept_light) {
    const Table table = parse_table(comments + "alpha1,specular1,alpha2,specular2\n" + rows, "t.csv");
    return check_table(table, accept_light);
  };
  const std::string rescaled = "# irradiance_scale: 1.262\n# diffuse_error: 0.03\n";
  CHECK(findings("# irradiance_scale: 1\n# diffuse_error: 1e-07\n", false).empty());
  REQUIRE(findings(rescaled, false).size() == 1);
  CHECK(findings(rescaled, false)[0].kind == "light");
  CHECK(findings(rescaled, false)[0].severity == Severity::kError);
  CHECK(findings(rescaled, true)[0].severity == Severity::kWarning);
  CHECK(findings(rescaled + "# light_accepted: yes\n", false)[0].severity == Severity::kWarning);
}
