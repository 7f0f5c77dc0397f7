// This file checks a table before it is fitted, because a regression would hide errors in the data.
#pragma once

#include <string>
#include <vector>

#include "table/table.hpp"

namespace remap {

enum class Severity {
  kNote,     // information
  kWarning,  // the fit will be less accurate
  kError,    // cannot be fitted
};

struct Finding {
  Severity severity = Severity::kNote;
  std::string kind;      // duplicate, contradiction, gap, non-monotone, jump, saturation, range, rows, light
  std::size_t line = 0;  // line in the file; 0 for the whole table
  std::string message;
};

// Returns all findings by severity, then by line. Checks only rows of status ok, except for saturation and
// range. check.cpp defines the threshold of each check. With `accept_light`, an error of light_remark()
// (table.hpp) becomes a warning.
std::vector<Finding> check_table(const Table& table, bool accept_light = false);

// Checks a table of named parameters. It finds values that are not finite, too few usable rows for the number
// of columns, source columns with a single value, repeated samples, and rows that are not fitted.
std::vector<Finding> check_table(const MaterialTable& table, bool accept_light = false);

std::string_view severity_name(Severity severity);

// Formats `name:line: severity: kind: message`, without the line if it is 0. `name` is the name of the table.
std::string finding_text(const std::string& name, const Finding& finding);

// If the table cannot be fitted, throws kInput with the first error and the number of further errors.
void require_fittable(const Table& table, bool accept_light = false);

}  // namespace remap
