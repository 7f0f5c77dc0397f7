// This file tests fits of tables: which rows train, what is recorded, and names that are refused.
#include <cmath>

#include <catch2/catch.hpp>

#include "compiler/fit/made_table.hpp"
#include "fit/fit_table.hpp"
#include "lower/fit_file.hpp"
#include "table/regression.hpp"

using namespace remap;
using namespace made_table;

TEST_CASE("fit: the held-out rows judge and do not train") {
  Table table = table_of(kStraight);
  const RowSplit split = split_rows(table, table_domain(table), 3, 0.2);
  CHECK(split.training.size() == 120);
  CHECK(split.held_out.size() == 30);
  // Only the rows that seed 3 holds out are changed. The fit must stay the same, but its errors must change.
  for (TableRow& row : table.rows)
    for (const TableRow& clamped : split.held_out)
      if (row.line == clamped.line) row.specular2 += 0.01;
  const Fit fit = fit_of(table, 3);
  CHECK(slope_at(fit, 0.5) == Approx(0.7).epsilon(1e-7));
  CHECK(fit.specular_error.rms == Approx(0.01).epsilon(1e-4));
}

TEST_CASE("fit: rows that are not ok are left out and counted") {
  Table table = table_of(kStraight);
  for (std::size_t i = 0; i < 12; ++i) {
    table.rows[i].status = i < 6 ? RowStatus::kClamped : RowStatus::kUnstable;
    table.rows[i].specular2 = 0.123;
  }
  const Fit fit = fit_of(table);
  CHECK(fit.split.left_out == std::map<std::string, std::int64_t>{{"clamped", 6}, {"unstable", 6}});
  CHECK(fit.specular_error.max < 1e-8);
  CHECK(fit.domain.alpha.min > 0.09);
}

TEST_CASE("fit: the same seed gives the same bytes, another seed another split") {
  Table table = table_of(paper_form({1.04, -0.388, -0.332, 0.25}, {1.02, -0.4, 1.7, -1.1, 3.3, 0.0}));
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    table.rows[i].specular2 *= 1.0 + 1e-3 * std::sin(static_cast<double>(7 * i));
  CHECK(fit_to_json(fit_of(table, 5)) == fit_to_json(fit_of(table, 5)));
  CHECK(fit_to_json(fit_of(table, 5)) != fit_to_json(fit_of(table, 6)));
}

TEST_CASE("fit: a table that does not name its models is refused") {
  Table table = table_of(kStraight);
  table.target.model.clear();
  CHECK_THROWS_WITH(fit_of(table), Catch::Contains("--source and --target"));
}

TEST_CASE("fit: names that are invalid in generated code are refused") {
  Table table = table_of(kStraight);
  table.source.model = "a\"b";
  CHECK_THROWS_WITH(fit_of(table), Catch::Contains("letters, digits"));
  table.source.model = "a/b";
  table.target.specular = "two words";
  CHECK_THROWS_WITH(fit_of(table), Catch::Contains("'two words' of made/as"));
}

TEST_CASE("sha256: digests of the standard") {
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}
