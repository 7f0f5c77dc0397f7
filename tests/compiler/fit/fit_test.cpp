// This file tests fits of tables: which rows train, what is recorded, names that are refused, and what
// every kind of fit must do. A fit follows a surface between its rows, with any number of threads, and
// reports its progress. An unusual table gives finite values or an error.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <string>

#include <catch2/catch.hpp>

#include "compiler/fit/made_table.hpp"
#include "fit/fit_table.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
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

namespace {

using Rows = std::vector<TableRow>;

MappedTexel surface(double alpha, double specular) {
  return {alpha * (1.0 - 0.3 * alpha), specular * (0.6 + 0.4 * std::exp(-3.0 * alpha))};
}

Rows rows_of(int widths = 8, int speculars = 5) {
  Rows rows;
  for (int i = 0; i < widths; ++i)
    for (int j = 0; j < speculars; ++j) {
      const double a = 0.05 + 0.95 * i / std::max(1, widths - 1),
                   s = 0.05 + 0.9 * j / std::max(1, speculars - 1);
      rows.push_back(
          {a, s, surface(a, s).alpha, surface(a, s).specular, 0.0, RowStatus::kOk, rows.size() + 2});
    }
  return rows;
}

// Returns the rows after `change` was applied to each of them.
Rows changed(const std::function<void(TableRow&)>& change, Rows rows = rows_of()) {
  std::for_each(rows.begin(), rows.end(), change);
  return rows;
}
Rows with_row(std::size_t row, double specular2) {
  Rows rows = rows_of();
  rows[row].specular2 = specular2;
  return rows;
}
Rows twice(Rows rows) {
  const Rows once = rows;
  rows.insert(rows.end(), once.begin(), once.end());
  return rows;
}

Regression fitted(std::string_view kind, const Rows& rows, unsigned jobs = 0,
                  const FitProgress& progress = {}) {
  FitOptions options;
  options.kind = kind;
  options.jobs = jobs;
  options.mlp.hidden = {5};
  options.mlp.starts = 2;
  return fit_kind(rows, Domain{{0.05, 1.0}, {0.0, 0.95}}, options, progress);
}

// Returns the largest error of both outputs at the rows `truth`.
double largest_error(const MappingKind& mapping, const Rows& truth) {
  double largest = 0.0;
  for (const TableRow& row : truth) {
    const MappedTexel found = evaluate_mapping(mapping, row.alpha1, row.specular1);
    if (!std::isfinite(found.alpha + found.specular)) return INFINITY;
    largest =
        std::max({largest, std::fabs(found.alpha - row.alpha2), std::fabs(found.specular - row.specular2)});
  }
  return largest;
}

}  // namespace

TEST_CASE("fit kinds: a smooth surface is followed between the rows, on any number of threads", "[slow]") {
  for (const std::string_view kind : kFitKinds) {
    INFO(kind);
    const Regression one = fitted(kind, rows_of(), 1), many = fitted(kind, rows_of(), 3);
    CHECK(many.mapping == one.mapping);
    CHECK(many.method == one.method);
    // Support vectors need more rows (svr_test) and a longer search to be as accurate.
    CHECK(largest_error(one.mapping, rows_of(23, 11)) < (kind == "svr" ? 1.5e-2 : 4e-3));
  }
}

TEST_CASE("fit kinds: progress rises to 1, and what it throws ends the fit", "[slow]") {
  for (const std::string_view kind : kFitKinds) {
    if (kind == "parametric") continue;  // too fast to report progress
    INFO(kind);
    std::mutex mutex;
    std::vector<double> shares;
    fitted(kind, rows_of(), 2, [&](double share) {
      const std::lock_guard lock(mutex);
      shares.push_back(share);
    });
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.back() == 1.0);
    for (const double limit : {0.0, 0.5}) {
      int calls_after = 0;
      bool has_thrown = false;
      const auto stop = [&](double share) {
        const std::lock_guard lock(mutex);
        calls_after += has_thrown;
        has_thrown = has_thrown || share >= limit;
        if (has_thrown) throw Error(ErrorKind::kInterrupted, "enough");
      };
      CHECK_THROWS_WITH(fitted(kind, rows_of(), 2, stop), "enough");
      // threads of other kinds may still have called it
      if (kind == "mlp") CHECK(calls_after == 0);
    }
  }
}

TEST_CASE("fit kinds: unusual tables give finite values, or are refused", "[slow]") {
  struct UnusualTable {
    std::string what;
    Rows rows;
    std::string refused_by, because;
  };
  const std::string all = "parametric svr mlp";
  const UnusualTable tables[] = {
      {"no row", {}, all, "(0, at least "},
      {"nine rows", rows_of(3, 3), all, "too few "},
      {"one alpha", rows_of(1, 12), all, "alpha1 "},
      {"one specular", rows_of(12, 1), "svr mlp", "specular1 is 0.05 in every row"},
      {"two alphas", rows_of(2, 12), "parametric", "too few distinct alpha1 (2,"},
      {"black", changed([](TableRow& row) { row.specular2 = 0.0; }), "parametric",
       "k(alpha) is not positive"},
      {"constants", changed([](TableRow& row) { row.alpha2 = row.specular2 = 0.25; }), "parametric",
       "does not increase"},
      {"differences of rounding",
       changed([](TableRow& row) { row.specular2 = 0.25 + 1e-16 * row.specular2; }), "", ""},
      {"an outlier of 1e6", with_row(17, 1e6), "parametric", "k(alpha) is not positive"},
      {"not a number", with_row(3, std::numeric_limits<double>::quiet_NaN()), "svr mlp", ""},
      {"duplicates", twice(rows_of()), "", ""},
  };
  for (const UnusualTable& table : tables)
    for (const std::string_view kind : kFitKinds) {
      // Ceres would log pages of text
      if (table.what == "not a number" && kind == "parametric") continue;
      INFO(table.what << ", " << kind);
      if (table.refused_by.find(kind) != std::string::npos)
        CHECK_THROWS_WITH(fitted(kind, table.rows), Catch::Contains(table.because));
      else
        CHECK(std::isfinite(largest_error(fitted(kind, table.rows).mapping, table.rows)));
    }
}
