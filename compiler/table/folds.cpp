#include "table/folds.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "table/split.hpp"

namespace remap {

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

}  // namespace remap
