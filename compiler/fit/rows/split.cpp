#include "fit/rows/split.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>

#include "remap/error.hpp"
#include "text/number_text.hpp"

namespace remapc {

std::vector<std::size_t> seeded_order(std::size_t count, std::uint64_t seed) {
  // A Fisher-Yates shuffle, because std::shuffle differs between standard libraries.
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

void require_held_out_share(double fraction) {
  if (!(fraction >= 0.0 && fraction <= 0.9))
    throw remap::Error(remap::ErrorKind::kUsage,
                       "held-out share: " + remap::number_text(fraction) + " is out of range (0 to 0.9)");
}

std::size_t held_out_count(double fraction, std::size_t rows) {
  return static_cast<std::size_t>(std::lround(fraction * static_cast<double>(rows)));
}

RowSplit split_rows(const Table& table, const remap::Domain& domain, std::uint64_t seed,
                    double held_out_fraction) {
  require_held_out_share(held_out_fraction);
  RowSplit split;
  std::vector<const TableRow*> usable;
  for (const TableRow& row : table.rows) {
    if (row.status != RowStatus::kOk)
      ++split.record.left_out[std::string(status_name(row.status))];
    else if (!is_inside(row, domain))
      ++split.record.left_out["beyond the domain"];
    else
      usable.push_back(&row);
  }
  std::vector<std::size_t> order = seeded_order(usable.size(), seed);
  const std::size_t count = held_out_count(held_out_fraction, usable.size());
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
  std::sort(order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    (i < count ? split.held_out : split.training).push_back(*usable[order[i]]);
  split.record.seed = seed;
  split.record.held_out_fraction = held_out_fraction;
  split.record.trained_rows = static_cast<std::int64_t>(split.training.size());
  split.record.held_out_rows = static_cast<std::int64_t>(split.held_out.size());
  return split;
}

remap::ErrorFigures error_figures(std::vector<double> errors) {
  if (errors.empty()) return {};
  double sum = 0.0;
  for (double& error : errors) {
    error = std::fabs(error);
    sum += error * error;
  }
  std::sort(errors.begin(), errors.end());
  const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(errors.size())));
  return {std::sqrt(sum / static_cast<double>(errors.size())), errors[rank - 1], errors.back()};
}

std::string error_text(double error) {
  if (error == 0.0) return "0";
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), remap::rounded_up(error, 2),
                                 std::chars_format::scientific, 1)
                       .ptr;
  return std::string(buffer.data(), end);
}

}  // namespace remapc
