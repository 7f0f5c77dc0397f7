// This file prints the output of `texremap convert`: text to standard error, and JSON to standard output and
// into the report of a part (part_report.hpp). It also writes the report page, one HTML file that shows
// materials.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/system.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "texremap/report/job_text.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// A Reporter prints the outcome. For a single set or asset, JSON is one object. For several, JSON is one
// object per line, printed as soon as it is known. The lines are `{"part": ...}` for a part of a manifest,
// `{"conversion": ...}`, `{"skipped": ...}` for each entry that is not converted, `{"set": ...}` or
// `{"asset": ...}`, and at the end `{"summary": ...}`.
class Reporter {
 public:
  // Prints what was assumed and what is skipped. `plan` must outlive this object.
  explicit Reporter(const ConvertPlan& plan);
  // Prints a set or asset as soon as it is finished. Only one thread at a time may call it.
  void add(const JobReport& report);
  // Prints the summary of all sets or assets. Throws kInput if one of them failed, and kOutput if the report
  // of a part cannot be written.
  void finish(std::vector<JobReport> reports);

 private:
  void write(const Json& line);

  const ConvertPlan& plan_;
  const Stopwatch stopwatch_;
  WarningKinds warnings_;
  std::string lines_;  // lines for the report of a part
};

// Converts the numbers of a plan without maps, and prints them. Throws kUsage for a factor without an
// exponent.
void print_converted_numbers(const ConvertPlan& plan);

// Writes `plan.report`, about a finished conversion or a dry run (docs/report.md). It shows the first 16
// materials. One material has maps of at most 1024 texels a side, more materials have smaller ones. What
// cannot be shown becomes a note. If nothing can be shown, it prints a warning and writes nothing. Throws
// kOutput.
void write_report_page(const ConvertPlan& plan, const std::vector<JobReport>& reports);

}  // namespace remap
