#include "table/folds.hpp"

#include <algorithm>

#include "table/split.hpp"

namespace remap {

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
