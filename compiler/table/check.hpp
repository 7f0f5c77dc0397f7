// Lints a table before it is fitted: a regression hides what is wrong with its data.
#pragma once

#include <string>
#include <vector>

#include "table/table.hpp"

namespace remapc {

enum class Severity {
  kNote,     // worth knowing
  kWarning,  // the fit will be worse for it
  kError,    // cannot be fitted
};

struct Finding {
  Severity severity = Severity::kNote;
  std::string kind;      // duplicate, contradiction, gap, non-monotone, jump, saturation, range, rows
  std::size_t line = 0;  // of the file, 0 where it concerns the whole table
  std::string message;
};

// Everything found, in the order of severity, then line. Only rows of status ok are judged, but for
// saturation and range. The thresholds stand beside each check in check.cpp.
std::vector<Finding> check_table(const Table& table);

std::string_view severity_name(Severity severity);

// `name:line: kind: message`, or without line; `name` is the table's.
std::string finding_text(const std::string& name, const Finding& finding);

// Throws kInput with the first error, and how many more there are, where the table cannot be fitted.
void require_fittable(const Table& table);

}  // namespace remapc
