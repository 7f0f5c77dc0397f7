// The report of a part of a conversion: the lines of `convert --json`, with a line about the part before
// them.
//
//   {"part": {"index": 12, "count": 400, "manifest": "HASH", "sets": 100000, "version": "1.2.0",
//    "conversion": "HASH", "converter": "...", "options": "...", "host": "node7", "note": "Slurm: ..."}}
#pragma once

#include <filesystem>

#include "core/json.hpp"
#include "texremap/journal.hpp"
#include "texremap/manifest.hpp"
#include "texremap/part.hpp"

namespace remap {

// `sets` are those of the whole manifest.
Json part_json(const GivenPart& part, const ManifestHead& manifest, const ConversionNote& conversion);

// Where the report of a part of the conversion to `output` lies.
std::filesystem::path report_of(const std::filesystem::path& output, const Part& part);

// What merge_reports() makes of the reports in an output folder.
struct MergedReport {
  std::size_t part_count = 0, set_count = 0;  // as the manifest has them
  std::size_t converted = 0, done_before = 0, failed = 0, left_out = 0, texels = 0;
  double processor_seconds = 0.0;
  std::uintmax_t bytes_read = 0, bytes_written = 0;
  std::vector<std::string> failures;  // of sets, each with its reason
  std::vector<std::string>
      problems;  // parts that are missing or do not belong together, sets that occur twice
};

// Reads the reports of all parts in the order of the parts, and hands on each line about a set or about what
// is left out. Throws kInput if the folder holds no report.
MergedReport merge_reports(const std::filesystem::path& output,
                           const std::function<void(std::string_view)>& take);

}  // namespace remap
