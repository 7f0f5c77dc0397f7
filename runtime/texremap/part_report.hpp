// The lines of `convert --json` for many sets or assets. The report of a part of a conversion is the same
// lines, with one about the part before them:
//
//   {"part": {"index": 12, "count": 400, "manifest": "HASH", "sets": 100000, "version": "1.2.0",
//    "conversion": "HASH", "converter": "...", "options": "...", "host": "node7", "note": "Slurm: ..."}}
#pragma once

#include <filesystem>

#include "core/json.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/journal.hpp"
#include "texremap/manifest.hpp"
#include "texremap/part.hpp"

namespace remap {

// What a run says of an entry, it says as soon as the entry is finished: a killed run has told what it did.
// The report of a part is there when the part is finished.
class RunLines {
 public:
  explicit RunLines(const ConvertOptions& options) : options_(options) {}
  // Prints the line, if they were asked for.
  void tell(const Json& line);
  // Writes the report, if the run is of a part. Throws kOutput.
  void finish() const;

 private:
  const ConvertOptions& options_;
  std::string report_;
};

// `sets` are those of the whole manifest.
Json part_json(const GivenPart& part, const ManifestHead& manifest, const ConversionNote& conversion);

// Where the report of a part of the conversion to `output` lies.
std::filesystem::path report_of(const std::filesystem::path& output, const Part& part);

// What merge_reports() makes of the reports in an output folder.
struct MergedReport {
  ListedKind kind = ListedKind::kSets;
  std::size_t part_count = 0, entry_count = 0;  // as the manifest has them
  std::size_t converted = 0, done_before = 0, failed = 0, left_out = 0, texels = 0;
  double processor_seconds = 0.0;
  std::uintmax_t bytes_read = 0, bytes_written = 0;
  std::vector<std::string> failures;  // of sets or assets, each with its reason
  // Parts that are missing or do not belong together, sets or assets that occur twice.
  std::vector<std::string> problems;
};

// Reads the reports of all parts in the order of the parts, and hands on each line about a set, an asset, or
// what is left out. Throws kInput if the folder holds no report.
MergedReport merge_reports(const std::filesystem::path& output,
                           const std::function<void(std::string_view)>& take);

}  // namespace remap
