#include "table/material_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::number_text;

// The fewest random samples for each source column from which something can be learned.
constexpr std::size_t kFewestRowsAColumn = 10;

class MaterialLinter {
 public:
  explicit MaterialLinter(const MaterialTable& table) : table_(table) {}

  std::vector<Finding> run() {
    check_values();
    check_row_count();
    check_columns();
    check_repeats();
    std::stable_sort(findings_.begin(), findings_.end(), [](const Finding& a, const Finding& b) {
      return a.severity != b.severity ? a.severity > b.severity : a.line < b.line;
    });
    return std::move(findings_);
  }

 private:
  void check_values() {
    const auto check = [&](const NamedRow& row, const std::vector<std::string>& columns,
                           const std::vector<double>& values) {
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (!std::isfinite(values[i]))
          findings_.push_back({Severity::kError, "range", row.line,
                               columns[i] + " is " + number_text(values[i]) + "; expected a finite number"});
    };
    for (const NamedRow& row : table_.rows) {
      check(row, table_.source_columns, row.source);
      check(row, table_.target_columns, row.target);
    }
  }

  void check_row_count() {
    const auto usable =
        static_cast<std::size_t>(std::count_if(table_.rows.begin(), table_.rows.end(),
                                               [](const NamedRow& r) { return r.status == RowStatus::kOk; }));
    const std::size_t fewest = kFewestRowsAColumn * table_.source_columns.size();
    if (usable < fewest)
      findings_.push_back({Severity::kError, "rows", 0,
                           std::to_string(usable) + " usable rows for " +
                               std::to_string(table_.source_columns.size()) +
                               " source columns; expected at least " + std::to_string(fewest)});
    if (usable != table_.rows.size())
      findings_.push_back({Severity::kNote, "saturation", 0,
                           std::to_string(table_.rows.size() - usable) + " of " +
                               std::to_string(table_.rows.size()) + " rows are not ok and are not fitted"});
  }

  void check_columns() {
    for (std::size_t i = 0; i < table_.source_columns.size(); ++i) {
      const double first = table_.rows.front().source[i];
      if (std::all_of(table_.rows.begin(), table_.rows.end(),
                      [&](const NamedRow& row) { return row.source[i] == first; }))
        findings_.push_back({Severity::kWarning, "gap", 0,
                             table_.source_columns[i] + " is " + number_text(first) +
                                 " in every row; a fit cannot learn its influence"});
    }
  }

  void check_repeats() {
    std::map<std::vector<double>, const NamedRow*> known;
    for (const NamedRow& row : table_.rows) {
      const auto [found, is_new] = known.emplace(row.source, &row);
      if (is_new) continue;
      const bool same = found->second->target == row.target;
      findings_.push_back({same ? Severity::kWarning : Severity::kError, same ? "duplicate" : "contradiction",
                           row.line,
                           "the sample also appears in line " + std::to_string(found->second->line) +
                               (same ? "; it counts twice in a fit" : " with other target values")});
    }
  }

  const MaterialTable& table_;
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> check_material_table(const MaterialTable& table) { return MaterialLinter(table).run(); }

}  // namespace remapc
