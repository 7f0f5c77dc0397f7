#include "texremap/run/job_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/report_text.hpp"

namespace remap {

JobReport JobReport::of(const Job& job) {
  JobReport report;
  report.name = job.name;
  if (!job.tile.empty()) report.tiles = {job.tile};
  if (const auto* asset = std::get_if<AssetWork>(&job.work)) report.inputs = {asset->input};
  return report;
}

JobReport& JobReport::operator+=(const JobReport& other) {
  const auto append = [](auto& all, const auto& more) {
    for (const auto& entry : more)
      if (std::find(all.begin(), all.end(), entry) == all.end()) all.push_back(entry);
  };
  append(tiles, other.tiles);
  append(inputs, other.inputs);
  append(copies, other.copies);
  append(left_behind, other.left_behind);
  append(warnings, other.warnings);
  results.insert(results.end(), other.results.begin(), other.results.end());
  was_done = was_done && other.was_done;
  has_compression_level = has_compression_level || other.has_compression_level;
  if (other.failure) failure = failure ? *failure + "; " + *other.failure : other.failure;
  if (!is_retryable(failure_code)) failure_code = other.failure_code;
  for (const auto& [note, count] : other.colors) colors[note] += count;
  if (plan.empty()) plan = other.plan;
  if (!estimated_f0) estimated_f0 = other.estimated_f0;
  statistics += other.statistics;
  seconds += other.seconds;
  bytes_read += other.bytes_read;
  bytes_written += other.bytes_written;
  return *this;
}

double used_f0(const DielectricF0& estimated) { return std::round(estimated.f0 * 1e4) / 1e4; }

std::optional<std::string> JobReport::failure_text() const {
  const std::size_t failed = count(MaterialState::kFailed);
  if (failure || failed == 0) return failure;
  const std::size_t all = materials.size() - count(MaterialState::kUntouched);
  return (failed == all ? "" : std::to_string(failed) + " of ") + counted(all, "material") + " failed";
}

}  // namespace remap
