// Folds of rows, and figures of errors.
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "table/choice.hpp"
#include "table/split.hpp"

using namespace remap;

namespace {

Candidate candidate(std::size_t numbers, double alpha, double specular, double standard_error = 1e-4) {
  Candidate made;
  made.record.number_count = numbers;
  made.record.relative_alpha = {alpha, standard_error};
  made.record.relative_specular = {specular, standard_error};
  return made;
}

std::size_t choice(std::vector<Candidate> candidates) { return choose(&candidates); }

}  // namespace

TEST_CASE("folds: equal rows share a fold, folds are even, draws depend on the seed only") {
  std::vector<TableRow> once;
  for (int i = 0; i < 10; ++i)
    for (int j = 1; j <= 5; ++j)
      once.push_back({0.1 + 0.09 * i, 0.18 * j, 0.1 * i, 0.1 * j, 0.0, RowStatus::kOk, 0});
  std::vector<TableRow> rows = once;
  rows.insert(rows.end(), once.begin(), once.end());
  const auto folds = draw_folds(rows, 5, 7);
  std::array<int, 5> sizes{};
  for (std::size_t i = 0; i < once.size(); ++i) {
    CHECK(folds[i] == folds[i + once.size()]);
    ++sizes[folds[i]];
  }
  for (const int size : sizes) CHECK(size == 10);
  CHECK(folds == draw_folds(rows, 5, 7));
  CHECK(folds != draw_folds(rows, 5, 8));
  CHECK(draw_rows(rows, 30, 1).size() == 30);
}

TEST_CASE("choice: the simplest within one standard error of the best in both outputs is chosen") {
  CHECK(choice({candidate(9, 1e-3, 1e-3), candidate(20, 9e-4, 9e-4), candidate(400, 8.5e-4, 8.5e-4)}) == 0);
  CHECK(choice({candidate(9, 2e-3, 1e-3), candidate(20, 9e-4, 9e-4), candidate(400, 8.5e-4, 8.5e-4)}) == 1);
  CHECK(choice({candidate(9, 1e-3, 2e-3), candidate(20, 9e-4, 2e-3), candidate(400, 8.5e-4, 8.5e-4)}) == 2);
  // With a standard error of 1e-3, all candidates are equally good.
  CHECK(choice({candidate(9, 2e-3, 1e-3, 2e-3), candidate(400, 8.5e-4, 8.5e-4, 2e-3)}) == 0);
}

TEST_CASE("choice: if none is best in both outputs, the smallest worse error decides") {
  CHECK(choice({candidate(9, 1e-3, 1e-2), candidate(20, 3e-3, 1e-3), candidate(400, 9e-3, 9e-4)}) == 1);
}

TEST_CASE("choice: an excluded candidate is neither chosen nor a reference") {
  std::vector<Candidate> candidates = {candidate(9, 1e-3, 1e-3), candidate(400, 1e-6, 1e-6)};
  candidates[1].record.verdict = "excluded";
  CHECK(choose(&candidates) == 0);
  CHECK(candidates[0].record.verdict == "chosen");
  CHECK(choose(&candidates) == 2);  // all have verdicts now
}

TEST_CASE("choice: a candidate without finite errors, or that fails in a fold, is excluded") {
  std::vector<TableRow> rows;
  for (int i = 1; i <= 20; ++i) rows.push_back({0.05 * i, 0.5, 0.04 * i, 0.4});
  std::vector<Candidate> candidates(3);
  const auto slope = [](double value) { return Parametric{{{value}}, {{1, {0.8}}}}; };
  candidates[0].regression.again = [=](const std::vector<TableRow>&) { return slope(0.8); };
  candidates[1].regression.again = [=](const std::vector<TableRow>&) { return slope(NAN); };
  candidates[2].regression.again = [](const std::vector<TableRow>&) -> MappingKind {
    throw Error(ErrorKind::kNumeric, "why");
  };
  cross_validate(candidates, split_folds(rows, 4, 1), error_weight, 2);
  CHECK(candidates[0].record.alpha.max < 1e-15);
  CHECK(candidates[1].record.verdict == "errors are not finite");
  CHECK(candidates[2].record.verdict == "not fitted in a fold: why");
  CHECK(choose(&candidates) == 0);
}

TEST_CASE("error figures: root mean square, nearest-rank percentile, largest") {
  std::vector<double> errors(200, 0.0);
  errors[0] = -2.0;
  errors[1] = 1.0;
  errors[2] = 0.5;
  const ErrorFigures figures = error_figures(errors);
  CHECK(figures.max == 2.0);
  CHECK(figures.p99 == 0.5);
  CHECK(figures.rms == Approx(std::sqrt(5.25 / 200)));
}

TEST_CASE("error text: two digits, rounded up, in one style for large and small") {
  CHECK(error_text(0.0) == "0");
  CHECK(error_text(0.00072) == "7.2e-04");
  CHECK(error_text(0.0002) == "2.0e-04");
  CHECK(error_text(1.2301e-7) == "1.3e-07");
  CHECK(error_text(0.996) == "1.0e+00");
  CHECK(error_text(2.0) == "2.0e+00");
}
