#include "table/regression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "lower/interpreter.hpp"

namespace remap {
namespace {

constexpr double kSmallestSpread = 2e-4;  // a smaller spread of alpha is not visible
constexpr double kTimesScatter = 2.0;
constexpr std::size_t kFewestRows = 10;

}  // namespace

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

FitProgress part_of(const FitProgress& progress, double begin, double end) {
  if (!progress) return {};
  return [&progress, begin, end](double share) { progress(begin + (end - begin) * share); };
}

void require_variety(const std::vector<TableRow>& rows, const std::string& kind) {
  if (rows.size() < kFewestRows)
    throw input_error(kind + ": too few rows (" + std::to_string(rows.size()) + ", at least " +
                      std::to_string(kFewestRows) + " are required)");
  const auto require = [&](double TableRow::*input, const std::string& name) {
    const double first = rows.front().*input;
    if (std::all_of(rows.begin(), rows.end(), [&](const TableRow& row) { return row.*input == first; }))
      throw input_error(kind + ": " + name + " is " + number_text(first) +
                        " in every row (at least two values are required)");
  };
  require(&TableRow::alpha1, "alpha1");
  require(&TableRow::specular1, "specular1");
}

bool alpha_needs_specular(const std::vector<TableRow>& rows) {
  std::map<double, std::vector<const TableRow*>> by_alpha;
  for (const TableRow& row : rows) by_alpha[row.alpha1].push_back(&row);
  // At each alpha1, a straight line over specular is fitted. These are sums over all lines. `explained` is
  // what the lines explain, and `left` are their squared residuals.
  double explained = 0.0, left = 0.0, degrees = 0.0, count = 0.0;
  for (const auto& [alpha, group] : by_alpha) {
    if (group.size() < 3) continue;
    const auto size = static_cast<double>(group.size());
    double s = 0.0, a = 0.0;
    for (const TableRow* row : group) {
      s += row->specular1 / size;
      a += row->alpha2 / size;
    }
    double ss = 0.0, sa = 0.0, aa = 0.0;
    for (const TableRow* row : group) {
      ss += (row->specular1 - s) * (row->specular1 - s);
      sa += (row->specular1 - s) * (row->alpha2 - a);
      aa += (row->alpha2 - a) * (row->alpha2 - a);
    }
    if (ss <= 0.0) continue;
    explained += sa * sa / ss;
    left += std::max(0.0, aa - sa * sa / ss);
    degrees += size - 2.0;
    count += size;
  }
  if (count == 0.0 || degrees <= 0.0) return false;
  const double spread = std::sqrt(explained / count), scatter = std::sqrt(left / degrees);
  return spread > kSmallestSpread &&
         spread > kTimesScatter * scatter / std::sqrt(count / static_cast<double>(by_alpha.size()));
}

std::string fit_id(const std::string& id, const std::string& source_model, const std::string& target_model) {
  const std::string chosen = id.empty() ? converter_id(source_model, target_model) : id;
  if (!is_valid_id(chosen))
    throw usage_error("--id: '" + plain(chosen, 60) + "' is not valid (use " + kIdRule + ")");
  return chosen;
}

}  // namespace remap
