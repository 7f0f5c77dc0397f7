// What `texremap convert` says while it runs and at its end: text to standard error, JSON to standard output
// and into the report of a part (part_report.hpp).
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/stopwatch.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "texremap/report/job_text.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// JSON is one object for a single set or asset. For several it is an object a line, each as soon as it is
// known: `{"part": ...}` of a part of a manifest, `{"conversion": ...}`, `{"skipped": ...}` for each entry
// that is not converted, `{"set": ...}` or `{"asset": ...}`, and `{"summary": ...}` last.
class Reporter {
 public:
  // `plan` must outlive it. Prints what was assumed and what is left out.
  explicit Reporter(const ConvertPlan& plan);
  // Called with each set or asset as it is finished, by one thread at a time.
  void add(const JobReport& report);
  // Prints the summary of all of them. Throws kInput where something failed; kOutput if the report of a part
  // cannot be written.
  void finish(std::vector<JobReport> reports);

 private:
  void write(const Json& line);

  const ConvertPlan& plan_;
  const Stopwatch stopwatch_;
  WarningKinds warnings_;
  std::string lines_;  // of the report of a part
};

// Converts the numbers of a plan without maps, and prints them. Throws kUsage for a factor without an
// exponent.
void print_converted_numbers(const ConvertPlan& plan);

}  // namespace remap
