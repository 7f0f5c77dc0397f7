// This file prints the outcome of a set or an asset, as lines for people.
#pragma once

#include <map>
#include <string>

#include "texremap/plan/convert_plan.hpp"
#include "texremap/run/job_report.hpp"

namespace remap {

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

}  // namespace remap
