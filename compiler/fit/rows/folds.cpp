#include "fit/rows/folds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "fit/rows/split.hpp"

namespace remapc {

std::vector<std::size_t> draw_folds(const std::vector<TableRow>& rows, std::size_t fold_count,
                                    std::uint64_t seed) {
  std::map<std::pair<double, double>, std::size_t> samples;
  for (const TableRow& row : rows) samples.try_emplace({row.alpha1, row.specular1}, samples.size());
  const std::vector<std::size_t> order = seeded_order(samples.size(), seed);
  std::vector<std::size_t> fold_of_row;
  fold_of_row.reserve(rows.size());
  for (const TableRow& row : rows)
    fold_of_row.push_back(order[samples.at({row.alpha1, row.specular1})] % fold_count);
  return fold_of_row;
}

std::vector<Fold> split_folds(const std::vector<TableRow>& rows, std::size_t fold_count, std::uint64_t seed) {
  const std::vector<std::size_t> fold_of_row = draw_folds(rows, fold_count, seed);
  std::vector<Fold> folds(fold_count);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t f = 0; f < fold_count; ++f)
      (fold_of_row[i] == f ? folds[f].judging : folds[f].training).push_back(rows[i]);
  return folds;
}

std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed) {
  if (rows.size() <= count) return rows;
  std::vector<std::size_t> order = seeded_order(rows.size(), seed);
  order.resize(count);
  std::sort(order.begin(), order.end());
  std::vector<TableRow> drawn;
  for (const std::size_t i : order) drawn.push_back(rows[i]);
  return drawn;
}

CrossValidated cross_validated(const std::vector<std::vector<double>>& errors_of_folds) {
  double total = 0.0, count = 0.0;
  std::vector<double> figures;  // root mean square of each fold
  for (const std::vector<double>& errors : errors_of_folds) {
    if (errors.empty()) continue;
    const double square = std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0);
    const auto size = static_cast<double>(errors.size());
    total += square;
    count += size;
    figures.push_back(std::sqrt(square / size));
  }
  if (figures.empty()) return {};
  const auto folds = static_cast<double>(figures.size());
  const double mean = std::accumulate(figures.begin(), figures.end(), 0.0) / folds;
  double variance = 0.0;
  for (const double figure : figures) variance += (figure - mean) * (figure - mean);
  const double error = folds < 2.0 ? 0.0 : std::sqrt(variance / (folds - 1.0) / folds);
  return {std::sqrt(total / count), error};
}

double error_bound(const std::vector<CrossValidated>& scores) {
  double best = 1e300, bound = 1e300;
  for (const CrossValidated& score : scores) {
    if (!(score.rms < best)) continue;
    best = score.rms;
    bound = best + std::max(score.standard_error, kNegligibleError);
  }
  return bound;
}

}  // namespace remapc
