// This file reads and writes reports of the parts of a conversion. They are the lines of `convert --json`
// (reporter.hpp), after one line about the part:
//
//   {"part": {"index": 12, "count": 400, "manifest": "HASH", "sets": 100000, "version": "1.2.0",
//    "conversion": "HASH", "converter": "...", "options": "...", "host": "node7", "note": "Slurm: ..."}}
#pragma once

#include <filesystem>

#include "core/json.hpp"
#include "texremap/options/part.hpp"
#include "texremap/plan/converter_text.hpp"
#include "texremap/plan/manifest.hpp"

namespace remap {

// Returns the first line of a report. `manifest` describes the whole manifest, not only the part.
Json part_json(const Part& part, const ManifestHead& manifest, const ConversionNote& conversion);

// Writes the report of a finished part of the conversion to `output`. Throws kOutput.
void write_part_report(const std::filesystem::path& output, const Part& part, const std::string& lines);

// A MergedReport is one report of all parts.
struct MergedReport {
  ListedKind kind = ListedKind::kSets;
  std::size_t part_count = 0, entry_count = 0;  // numbers from the manifest
  std::size_t converted = 0, done_before = 0, failed = 0, skipped = 0, texels = 0;
  double processor_seconds = 0.0;
  std::uintmax_t bytes_read = 0, bytes_written = 0;
  std::vector<std::string> failures;  // failed sets or assets, each with its reason
  // Lists parts that are missing or do not belong together, and sets or assets that occur twice.
  std::vector<std::string> problems;
};

// Reads the reports of all parts in the order of the parts. Passes on each line about a set, an asset, or a
// skipped entry. Throws kInput if the folder holds no report.
MergedReport merge_reports(const std::filesystem::path& output,
                           const std::function<void(std::string_view)>& take);

}  // namespace remap
