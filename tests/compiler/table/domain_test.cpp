// This file tests the box of source parameters that a table covers, and tables with reversed roles.
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "table/regression.hpp"

using namespace remap;

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
