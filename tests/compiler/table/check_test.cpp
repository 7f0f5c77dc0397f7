// This file tests checks of tables: each kind of finding, on a table with only that fault.
#include "table/check.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/shared_data.hpp"

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
