// The report of `texremap convert` about a finished conversion, as text lines and as JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/system.hpp"
#include "remap/path.hpp"
#include "texremap/conversion_jobs.hpp"
#include "texremap/plan_table.hpp"
#include "texture/material_survey.hpp"
#include "texture/texture_pass.hpp"

namespace remap {

// The converter of a run, and the workflows around it.
struct ChosenConverter : BuiltConversion {
  WorkflowChoice workflow;
};

// The text that results carry as `remap:converter`: the ids of the steps, and the formula of a workflow.
std::string converter_ids(const ChosenConverter& chosen);

// The color space in which maps of a color are read or written, and why: the user's word, the file's (its
// tag, or for a result the map that it follows), or the usual one.
struct ColorNote {
  Parameter color;
  bool is_written;
  Transfer transfer;
  TransferReason reason;
  auto operator<=>(const ColorNote&) const = default;
};
using ColorNotes = std::map<ColorNote, std::size_t>;  // with the number of maps

// The outcome of one set with all its tiles.
struct JobReport {
  struct Result {
    std::filesystem::path path;
    std::vector<Parameter> parameters;  // that the file holds
    bool mask = false;
  };
  std::string name;                // empty for the one set of a command line
  std::vector<std::string> tiles;  // converted tiles; empty where the set has no tiles
  std::vector<std::filesystem::path> inputs;
  std::vector<Result> results;                     // the planned ones in a dry run and after a failure
  std::vector<std::filesystem::path> copies;       // files that are not converted; also planned ones
  std::vector<std::filesystem::path> left_behind;  // maps of the set that are neither read nor copied
  Transfer specular_transfer = Transfer::kLinear;
  ColorNotes colors;                         // of whole numbers, and of what a file or the user says
  std::optional<DielectricF0> estimated_f0;  // only from a specular to a metallic workflow
  std::vector<std::string> warnings;
  std::vector<PlannedRole> plan;  // of a dry run; of tiles, that of the first
  std::optional<std::string> failure;
  int failure_code = 0;                                    // errno of the call that failed, or 0
  bool was_done = false;                                   // by the earlier run that this one resumes
  bool has_8_bits = false, has_compression_level = false;  // a result does
  MapStatistics statistics;
  double seconds = 0.0;           // sum over all tiles, even where tiles ran in parallel
  std::uintmax_t bytes_read = 0;  // sizes of the files on disk
  std::uintmax_t bytes_written = 0;

  // Adds the report of the next tile of the set.
  JobReport& operator+=(const JobReport& other);
};

// All members, for another process (packed_values.hpp).
template <typename Archive>
void fields(Archive& archive, JobReport::Result& result) {
  archive(result.path, result.parameters, result.mask);
}
template <typename Archive>
void fields(Archive& archive, MapStatistics& statistics) {
  archive(statistics.texel_count, statistics.out_of_domain_count, statistics.nan_count,
          statistics.infinite_count, statistics.negative_count, statistics.clipped_count,
          statistics.masked_count, statistics.above_one_count, statistics.first_bad, statistics.sources,
          statistics.targets, statistics.tints, statistics.metallic);
}
template <typename Archive>
void fields(Archive& archive, PlannedRole& role) {
  archive(role.role, role.input, role.encoding, role.happens, role.output);
}
template <typename Archive>
void fields(Archive& archive, JobReport& report) {
  archive(report.name, report.tiles, report.inputs, report.results, report.copies, report.left_behind,
          report.specular_transfer, report.colors, report.estimated_f0, report.warnings, report.plan,
          report.failure, report.failure_code, report.was_done, report.has_8_bits,
          report.has_compression_level, report.statistics, report.seconds, report.bytes_read,
          report.bytes_written);
}

// The outcome of the whole run.
struct Outcome {
  const ChosenConverter& chosen;
  const JobList& list;
  std::vector<JobReport> reports;  // one per set
  bool dry_run = false;
  bool histograms = false;  // in the JSON
  bool is_json = false;
  double seconds = 0.0;
  ResourceUse used;  // threads waited for the rest of seconds x threads

  ColorNotes colors() const;         // of all sets
  std::size_t failed_count() const;  // failed sets and the failures among `list.left_out`
  // The errno of the first set whose failure may pass when the run is repeated; 0 without one.
  int passing_failure() const;
};

class WarningKinds;

// What is told of each set.
struct Told {
  Told();
  bool failures_only = false;              // for --quiet
  bool verbose = false;                    // also what cannot be seen in pictures, and every warning
  std::shared_ptr<WarningKinds> warnings;  // of a folder that were printed
};

// Prints a line about each set that is not converted. With `failures_only`, as for --quiet, this prints
// what failed and nothing else.
void print_left_out(const std::string& program, const JobList& list, bool failures_only);
// Prints the lines about one set to standard error.
void print_job(const std::string& program, const Outcome& outcome, const JobReport& report, const Told& told);
// Prints one line about the color spaces of the run: `color: specular read as srgb, base_color written as
// srgb`; nothing where all colors are floating-point numbers that nobody spoke of.
void print_colors(const std::string& program, const Outcome& outcome);
// Prints the line about the whole run: sets, texels, time.
void print_summary(const std::string& program, const Outcome& outcome, const Told& told);
// The report on one set that is no folder, as one object.
void print_json(const Outcome& outcome);
// The report on a folder, an object a line: `{"conversion": ...}` first, `{"set": ...}` for each set as it is
// finished, `{"left_out": ...}` before them for each that is not converted, `{"summary": ...}` last.
using TakeLine = std::function<void(const Json& line)>;
void tell_start(const Outcome& outcome, const TakeLine& take);
void tell_set(const Outcome& outcome, const JobReport& report, const TakeLine& take);
void tell_end(const Outcome& outcome, const TakeLine& take);

// The result of a conversion of numbers, without maps.
struct ConvertedValues {
  struct Value {
    std::string name;
    std::vector<float> channels;
    bool is_scalar = false;  // JSON shows a number, not a list
  };
  std::vector<Value> values;
  bool in_domain = true;
};
void print_values(const ChosenConverter& chosen, const ConvertedValues& values, bool json);

}  // namespace remap
