// The outcome of a set or an asset, as lines for people.
#pragma once

#include <map>
#include <string>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

// The kinds of warnings of a folder: what they say after the name of a file.
class WarningKinds {
 public:
  // Whether the warning is one of the first of its kind, and its kind one of the first kinds.
  bool is_new(const std::string& warning);
  // How many were not.
  std::size_t repeated() const;

 private:
  static constexpr std::size_t kShownKinds = 20, kShownOfKind = 3;
  std::map<std::string, std::size_t> counts_;
  std::size_t unshown_ = 0;
};

// The id of a single converter, or the models of a path, and the workflows around them.
std::string converter_text(const ChosenConverter& chosen);

// Prints the lines about one set or asset to standard error; of a dry run also the table of a set to standard
// output.
void print_job(const ConvertPlan& plan, const JobReport& report, WarningKinds& warnings);

// Prints one line about the color spaces of the run: `color: specular read as srgb, base_color written as
// srgb`; nothing where all colors are floating-point numbers that nobody spoke of.
void print_colors(const ColorNotes& colors, bool has_several);

}  // namespace remap
