#include "table/split.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "lower/interpreter.hpp"

namespace remap {

std::vector<std::size_t> seeded_order(std::size_t count, std::uint64_t seed) {
  // This is a Fisher-Yates shuffle, because std::shuffle differs between standard libraries.
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

Split split_record(std::uint64_t seed, double fraction, std::size_t rows) {
  if (!(fraction >= 0.0 && fraction <= 0.9))
    throw usage_error("--held-out: " + number_text(fraction) + " is out of range (0 to 0.9)");
  Split record;
  record.seed = seed;
  record.held_out_fraction = fraction;
  record.held_out_rows = std::lround(fraction * static_cast<double>(rows));
  record.trained_rows = static_cast<std::int64_t>(rows) - record.held_out_rows;
  return record;
}

RowSplit split_rows(const Table& table, const Domain& domain, std::uint64_t seed, double held_out_fraction) {
  std::vector<const TableRow*> usable;
  std::map<std::string, std::int64_t> left_out;
  for (const TableRow& row : table.rows) {
    if (!has_answer(row))
      ++left_out[std::string(status_name(row.status))];
    else if (!is_inside(row, domain))
      ++left_out["beyond the domain"];
    else
      usable.push_back(&row);
  }
  RowSplit split;
  split.record = split_record(seed, held_out_fraction, usable.size());
  split.record.left_out = std::move(left_out);
  std::vector<std::size_t> order = seeded_order(usable.size(), seed);
  const auto count = static_cast<std::size_t>(split.record.held_out_rows);
  std::sort(order.begin(), order.begin() + split.record.held_out_rows);
  std::sort(order.begin() + split.record.held_out_rows, order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    (i < count ? split.held_out : split.training).push_back(*usable[order[i]]);
  return split;
}

Residuals residuals_of(const std::vector<TableRow>& rows,
                       const std::function<MappedTexel(double alpha, double specular)>& map) {
  Residuals errors;
  for (const TableRow& row : rows) {
    const MappedTexel texel = map(row.alpha1, row.specular1);
    errors.alpha.push_back(texel.alpha - row.alpha2);
    errors.specular.push_back(texel.specular - row.specular2);
  }
  return errors;
}

std::vector<TableRow> inside_rows(const std::vector<TableRow>& rows) {
  std::vector<TableRow> inside;
  for (const TableRow& row : rows)
    if (row.status == RowStatus::kOk) inside.push_back(row);
  return inside;
}

Residuals residuals_of(const std::vector<TableRow>& rows, const Fit& fit) {
  return residuals_of(rows,
                      [&](double alpha, double specular) { return evaluate_fit(fit, alpha, specular); });
}

Residuals residuals_of(const std::vector<TableRow>& rows, const MappingKind& mapping) {
  return residuals_of(
      rows, [&](double alpha, double specular) { return evaluate_mapping(mapping, alpha, specular); });
}

ErrorFigures error_figures(std::vector<double> errors) {
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
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded_up(error, 2),
                                 std::chars_format::scientific, 1)
                       .ptr;
  return std::string(buffer.data(), end);
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
