#include "table/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

// Section 7 fits a quartic and the five coefficients of k. Each width gives one value, so fewer widths do not
// suffice.
constexpr std::size_t kFewestAlphas = 6;
constexpr std::size_t kFewestGridRows = 12;
// Rows of the same sample contradict each other if their targets differ by more than this. Alpha differs
// absolutely, specular relatively.
constexpr double kSameValue = 1e-6;
// A step of the grid is a gap if it is at least this many times as large as the median step.
constexpr double kGapFactor = 3.0;
// A value is a jump if it is this far from the line through its neighbours (figures 6, 8 and 10 of the paper
// show jumps of 10 % and more; smooth sweeps stay below 1 %).
constexpr double kJumpAlpha = 0.02;
constexpr double kJumpSlope = 0.05;
// Fewer random samples for each source column are too few to fit anything.
constexpr std::size_t kFewestRowsAColumn = 10;

using Rows = std::vector<const TableRow*>;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string sample_text(const TableRow& row) {
  return "alpha1 " + number_text(row.alpha1) + ", specular1 " + number_text(row.specular1);
}

using Findings = std::vector<Finding>;

// Adds the sample of line `line` that line `first` has already. `same` is true if the target values are
// equal, too.
void add_repeat(bool same, const std::string& sample, std::size_t line, std::size_t first,
                Findings& findings) {
  const std::string repeat = sample + " also appears in line " + std::to_string(first);
  if (same)
    findings.push_back({Severity::kWarning, "duplicate", line, repeat + "; it counts twice in a fit"});
  else
    findings.push_back({Severity::kError, "contradiction", line, repeat + " with other target values"});
}

void add_light(const Comments& comments, bool accept_light, Findings& findings) {
  LightMatch match = light_match(comments);
  match.accepted = match.accepted || accept_light;
  if (const std::string remark = light_remark(match); !remark.empty())
    findings.push_back({is_wrong_light(match) ? Severity::kError : Severity::kWarning, "light", 0, remark});
}

Findings sorted(Findings findings) {
  std::ranges::stable_sort(findings, [](const Finding& a, const Finding& b) {
    return a.severity != b.severity ? a.severity > b.severity : a.line < b.line;
  });
  return findings;
}

// A RowsByAlpha holds the usable rows of each width, by rising specular.
using RowsByAlpha = std::map<double, Rows>;

RowsByAlpha rows_by_alpha(const Table& table) {
  RowsByAlpha by_alpha;
  for (const TableRow& row : table.rows)
    if (row.status == RowStatus::kOk) by_alpha[row.alpha1].push_back(&row);
  for (auto& [alpha, rows] : by_alpha) std::ranges::stable_sort(rows, {}, &TableRow::specular1);
  return by_alpha;
}

void check_range(const TableRow& row, const std::string& name, double value, bool may_be_zero,
                 Findings& findings) {
  const std::string found = name + " is " + number_text(value);
  if (!std::isfinite(value) || value < 0.0 || (value == 0.0 && !may_be_zero))
    findings.push_back({Severity::kError, "range", row.line,
                        found + " (must be " + (may_be_zero ? "0 or more" : "above 0") + ")"});
  else if (value > 1.0)
    findings.push_back({Severity::kWarning, "range", row.line, found + "; physical values end at 1"});
}

void check_ranges(const Table& table, Findings& findings) {
  for (const TableRow& row : table.rows) {
    check_range(row, "alpha1", row.alpha1, false, findings);
    check_range(row, "specular1", row.specular1, true, findings);
    check_range(row, "alpha2", row.alpha2, false, findings);
    check_range(row, "specular2", row.specular2, true, findings);
    check_range(row, "diffuse1", row.diffuse1, true, findings);
    check_range(row, "diffuse2", row.diffuse2, true, findings);
  }
}

void check_row_count(const RowsByAlpha& by_alpha, Findings& findings) {
  std::size_t rows = 0;
  for (const auto& [alpha, group] : by_alpha) rows += group.size();
  if (by_alpha.size() < kFewestAlphas || rows < kFewestGridRows)
    findings.push_back({Severity::kError, "rows", 0,
                        counted(rows, "usable row") + " and " + counted(by_alpha.size(), "value") +
                            " of alpha1 (a fit needs at least " + std::to_string(kFewestGridRows) +
                            " rows and " + std::to_string(kFewestAlphas) + " values)"});
}

void check_repeats(const RowsByAlpha& by_alpha, Findings& findings) {
  for (const auto& [alpha, rows] : by_alpha) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const TableRow &first = *rows[i - 1], &second = *rows[i];
      if (first.specular1 != second.specular1) continue;
      const bool same =
          std::fabs(first.alpha2 - second.alpha2) <= kSameValue &&
          std::fabs(first.specular2 - second.specular2) <= kSameValue * std::fabs(first.specular2);
      add_repeat(same, sample_text(second), second.line, first.line, findings);
    }
  }
}

void check_gaps(const RowsByAlpha& by_alpha, Findings& findings) {
  std::vector<double> steps;
  for (auto it = by_alpha.begin(); it != by_alpha.end() && std::next(it) != by_alpha.end(); ++it)
    steps.push_back(std::next(it)->first - it->first);
  if (steps.size() < 3) return;
  const double usual = median(steps);
  for (auto it = by_alpha.begin(); std::next(it) != by_alpha.end(); ++it) {
    const double step = std::next(it)->first - it->first;
    if (step > kGapFactor * usual)
      findings.push_back({Severity::kWarning, "gap", std::next(it)->second.front()->line,
                          "no alpha1 between " + number_text(it->first) + " and " +
                              number_text(std::next(it)->first) + "; the usual step is " +
                              number_text(usual)});
  }
}

// Checks that alpha2 of each width, averaged over specular, rises with alpha1.
void check_monotone(const RowsByAlpha& by_alpha, Findings& findings) {
  double previous = 0.0;
  double previous_alpha = 0.0;
  for (const auto& [alpha, rows] : by_alpha) {
    double sum = 0.0;
    for (const TableRow* row : rows) sum += row->alpha2;
    const double mean = sum / static_cast<double>(rows.size());
    if (mean <= previous)
      findings.push_back({Severity::kError, "non-monotone", rows.front()->line,
                          (mean < previous ? "alpha2 falls from " + number_text(previous)
                                           : "alpha2 stays at " + number_text(previous)) +
                              " between alpha1 " + number_text(previous_alpha) + " and " +
                              number_text(alpha) + (mean < previous ? ", to " + number_text(mean) : "") +
                              ", but must rise"});
    previous = mean;
    previous_alpha = alpha;
  }
}

// Compares, along specular at one width, the middle of three values with the line through the outer two.
void check_jumps(const RowsByAlpha& by_alpha, Findings& findings) {
  for (const auto& [alpha, rows] : by_alpha) {
    for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
      const TableRow &a = *rows[i - 1], &b = *rows[i], &c = *rows[i + 1];
      if (!(c.specular1 > a.specular1) || !(a.specular1 > 0.0)) continue;
      const double t = (b.specular1 - a.specular1) / (c.specular1 - a.specular1);
      const double alpha_step = b.alpha2 - (a.alpha2 + t * (c.alpha2 - a.alpha2));
      const double expected = a.specular2 + t * (c.specular2 - a.specular2);
      const double specular_step = b.specular2 - expected;
      const bool jump = std::fabs(alpha_step) > kJumpAlpha * alpha ||
                        std::fabs(specular_step) > kJumpSlope * std::max(std::fabs(expected), 0.01);
      if (jump)
        findings.push_back({Severity::kWarning, "jump", b.line,
                            sample_text(b) + ": alpha2 differs from its neighbours by " +
                                number_text(std::round(alpha_step * 1e5) / 1e5) + ", specular2 by " +
                                number_text(std::round(specular_step * 1e5) / 1e5)});
    }
  }
}

void check_saturation(const Table& table, const RowsByAlpha& by_alpha, Findings& findings) {
  std::map<RowStatus, std::vector<std::size_t>> lines;
  for (const TableRow& row : table.rows)
    if (!has_answer(row)) lines[row.status].push_back(row.line);
  for (const auto& [status, where] : lines) {
    const std::string message = std::to_string(where.size()) + " of " + std::to_string(table.rows.size()) +
                                " rows are " + std::string(status_name(status)) +
                                " and are not fitted; this is the first";
    findings.push_back({Severity::kNote, "saturation", where.front(), message});
  }
  for (const auto& [alpha, rows] : by_alpha) {
    std::size_t run = 1;
    for (std::size_t i = 1; i <= rows.size(); ++i) {
      const bool stuck = i < rows.size() && rows[i]->specular1 > rows[i - 1]->specular1 &&
                         rows[i]->specular2 > 0.0 && rows[i]->specular2 == rows[i - 1]->specular2;
      if (stuck) {
        ++run;
        continue;
      }
      if (run >= 3)
        findings.push_back({Severity::kWarning, "saturation", rows[i - run]->line,
                            "specular2 stays at " + number_text(rows[i - 1]->specular2) + " over " +
                                std::to_string(run) + " rows of alpha1 " + number_text(alpha)});
      run = 1;
    }
  }
}

void check_values(const MaterialTable& table, Findings& findings) {
  const auto check = [&](const NamedRow& row, const std::vector<std::string>& columns,
                         const std::vector<double>& values) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (!std::isfinite(values[i]))
        findings.push_back({Severity::kError, "range", row.line,
                            columns[i] + " is " + number_text(values[i]) + " (must be finite)"});
  };
  for (const NamedRow& row : table.rows) {
    check(row, table.source_columns, row.source);
    check(row, table.target_columns, row.target);
  }
}

void check_row_count(const MaterialTable& table, Findings& findings) {
  const auto usable =
      static_cast<std::size_t>(std::ranges::count(table.rows, RowStatus::kOk, &NamedRow::status));
  const std::size_t fewest = kFewestRowsAColumn * table.source_columns.size();
  if (usable < fewest)
    findings.push_back({Severity::kError, "rows", 0,
                        std::to_string(usable) + " usable rows for " +
                            std::to_string(table.source_columns.size()) + " source columns (at least " +
                            std::to_string(fewest) + " are needed)"});
  if (usable != table.rows.size())
    findings.push_back({Severity::kNote, "saturation", 0,
                        std::to_string(table.rows.size() - usable) + " of " +
                            std::to_string(table.rows.size()) + " rows are not ok and are not fitted"});
}

void check_columns(const MaterialTable& table, Findings& findings) {
  for (std::size_t i = 0; i < table.source_columns.size(); ++i) {
    const double first = table.rows.front().source[i];
    if (std::ranges::all_of(table.rows, [&](const NamedRow& row) { return row.source[i] == first; }))
      findings.push_back({Severity::kWarning, "gap", 0,
                          table.source_columns[i] + " is " + number_text(first) +
                              " in every row; a fit cannot learn its influence"});
  }
}

void check_repeats(const MaterialTable& table, Findings& findings) {
  std::map<std::vector<double>, const NamedRow*> known;
  for (const NamedRow& row : table.rows) {
    const auto [found, is_new] = known.emplace(row.source, &row);
    if (is_new) continue;
    add_repeat(found->second->target == row.target, "the sample", row.line, found->second->line, findings);
  }
}

std::string place_of(const std::string& name, const Finding& finding) {
  return finding.line == 0 ? name : name + ":" + std::to_string(finding.line);
}

}  // namespace

std::vector<Finding> check_table(const Table& table, bool accept_light) {
  const RowsByAlpha by_alpha = rows_by_alpha(table);
  Findings findings;
  check_ranges(table, findings);
  check_row_count(by_alpha, findings);
  check_repeats(by_alpha, findings);
  check_gaps(by_alpha, findings);
  check_monotone(by_alpha, findings);
  check_jumps(by_alpha, findings);
  check_saturation(table, by_alpha, findings);
  add_light(table.comments, accept_light, findings);
  return sorted(std::move(findings));
}

std::vector<Finding> check_table(const MaterialTable& table, bool accept_light) {
  Findings findings;
  check_values(table, findings);
  check_row_count(table, findings);
  check_columns(table, findings);
  check_repeats(table, findings);
  add_light(table.comments, accept_light, findings);
  return sorted(std::move(findings));
}

std::string_view severity_name(Severity severity) {
  constexpr std::array<std::string_view, 3> kNames = {"note", "warning", "error"};
  return kNames[static_cast<std::size_t>(severity)];
}

std::string finding_text(const std::string& name, const Finding& finding) {
  return place_of(name, finding) + ": " + std::string(severity_name(finding.severity)) + ": " + finding.kind +
         ": " + finding.message;
}

void require_fittable(const Table& table, bool accept_light) {
  const std::vector<Finding> findings = check_table(table, accept_light);
  const auto errors = std::ranges::count(findings, Severity::kError, &Finding::severity);
  if (errors == 0) return;
  const Finding& first = findings.front();
  const std::string more =
      errors == 1 ? "" : " (" + std::to_string(errors - 1) + " more errors: run remapc check)";
  throw input_error(place_of(table.name, first) + ": " + first.kind + ": " + first.message + more);
}

}  // namespace remap
