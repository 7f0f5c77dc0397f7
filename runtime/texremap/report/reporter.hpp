// This file prints the output of `texremap convert`: text to standard error, and JSON to standard output and
// into the report of a part (part_report.hpp). It also writes the report page, one HTML file that shows
// materials.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "core/system.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// An Outcome holds the reports, the time and the use of resources of a whole run.
struct Outcome {
  const ConvertPlan& plan;
  std::vector<JobReport> reports;
  double seconds = 0.0;
  ResourceUse used;

  ColorNotes colors() const;         // color spaces of all sets
  std::size_t failed_count() const;  // failed entries, and failures among the skipped entries
};

// Returns `converted`, `planned`, `done before` or `failed`.
std::string_view state_text(const ConvertPlan& plan, const JobReport& report);

// Returns converter and path for texture sets, and the target for assets.
Json conversion_json(const ConvertPlan& plan);
// Returns the JSON object for a set or an asset.
Json job_json(const ConvertPlan& plan, const JobReport& report);
Json summary_json(const Outcome& outcome);
// Returns colors, instruction set, time and memory.
Json run_json(const Outcome& outcome);

// A WarningKinds groups the warnings of a folder by their text after the file name.
class WarningKinds {
 public:
  // Returns true if the warning is one of the first of its kind, and its kind is one of the first kinds.
  bool is_new(const std::string& warning);
  // Returns how many warnings were not new.
  std::size_t repeated() const;

 private:
  static constexpr std::size_t kShownKinds = 20, kShownOfKind = 3;
  std::map<std::string, std::size_t> counts_;
  std::size_t unshown_ = 0;
};

// Returns the id of a single converter, or the models of a path, and the workflows around them.
std::string converter_text(const BuiltConversion& chosen);

// Prints the lines about one set or asset to standard error. A dry run also prints the table of a set to
// standard output.
void print_job(const ConvertPlan& plan, const JobReport& report, WarningKinds& warnings);

// Prints one line about the color spaces of the run: `color: specular read as srgb, base_color written as
// srgb`. Prints nothing if all colors are floating-point numbers and the user chose no color space.
void print_colors(const ColorNotes& colors, bool has_several);

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
