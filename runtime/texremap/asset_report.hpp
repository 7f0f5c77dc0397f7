// What `texremap convert` says of assets.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "assets/asset.hpp"
#include "core/json.hpp"
#include "core/system.hpp"

namespace remap {

struct AssetReport {
  std::filesystem::path input, output;
  bool is_written = false;  // or would be, in a dry run
  bool was_done = false;    // by an earlier run
  std::vector<AssetMaterial> materials;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> copies, images;  // images: new ones in files of their own
  std::string failure;                                // of the whole file; empty for none
  int failure_code = 0;                               // errno of a call that failed
  double seconds = 0.0;

  std::size_t count(MaterialState state) const { return count_of(materials, state); }
  std::size_t failed_count() const { return count(MaterialState::kFailed); }
  bool has_failed() const { return !failure.empty() || failed_count() > 0; }
};

// All members, for another process (packed_values.hpp).
template <typename Archive>
void fields(Archive& archive, MaterialFactor& factor) {
  archive(factor.name, factor.values);
}
template <typename Archive>
void fields(Archive& archive, AssetMaterial& material) {
  archive(material.index, material.name, material.state, material.factors, material.residual,
          material.becomes, material.warnings, material.failure);
}
template <typename Archive>
void fields(Archive& archive, AssetReport& report) {
  archive(report.input, report.output, report.is_written, report.was_done, report.materials, report.warnings,
          report.copies, report.images, report.failure, report.failure_code, report.seconds);
}

// Prints warnings, failures and a summary to standard error; in a dry run each material, too.
void print_asset(const AssetReport& report, bool dry_run, bool failures_only);

Json asset_json(const AssetReport& report, bool dry_run);

// Of a run with several assets. `problems`: files and folders that could not be read.
struct AssetSummary {
  std::size_t asset_count = 0, written = 0, done_before = 0, failed = 0;
  std::size_t materials = 0;  // converted
  std::vector<std::string> problems;
  double seconds = 0.0;
  ResourceUse used;
};
AssetSummary summary_of(const std::vector<AssetReport>& reports);
std::string summary_text(const AssetSummary& summary, bool dry_run);
Json summary_json(const AssetSummary& summary);

}  // namespace remap
