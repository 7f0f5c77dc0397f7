#include "table/regression.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr double kSmallestSpread = 2e-4;  // a smaller spread of alpha is not visible
constexpr double kTimesScatter = 2.0;
constexpr std::size_t kFewestRows = 10;

}  // namespace

FitProgress part_of(const FitProgress& progress, double begin, double end) {
  if (!progress) return {};
  return [&progress, begin, end](double share) { progress(begin + (end - begin) * share); };
}

double error_weight(double value) {
  constexpr double kLeastValue = 0.02;
  return 1.0 / std::max(value, kLeastValue);
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
