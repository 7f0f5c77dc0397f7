#include "texremap/run/run_jobs.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <functional>
#include <mutex>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "command_line/progress.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/packed_values.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/run/job_processes.hpp"
#include "texture/image_library.hpp"

namespace remap {

// Calls `work`. If it fails with a code of a short failure (core/errors.hpp), calls it up to three times
// again, with growing pauses. Returns the messages of the failures before the success. If all calls fail,
// throws the last failure. An interruption ends the pause.
std::vector<std::string> with_retries(const std::function<void()>& work);

namespace {

// Each job adds this much to the progress line, whatever its size.
constexpr std::size_t kJobProgress = 1000;

// A RunProgress is the progress line of the whole run.
class RunProgress {
 public:
  RunProgress(const ConvertPlan& plan)
      : plan_(plan),
        line_(text(), plan.list.jobs.size() * kJobProgress, !plan.quiet),
        shown_(plan.list.jobs.size(), 0) {}

  void advance(std::size_t job, double share) {
    const auto now = static_cast<std::size_t>(share * kJobProgress);
    line_.advance(now - shown_[job]);
    shown_[job] = now;
  }
  void hide() { line_.hide(); }
  void finish(std::size_t job, std::size_t texels) {
    advance(job, 1.0);
    ++done_;
    texels_ += texels;
    line_.relabel(text());
  }

 private:
  std::string text() const {
    return std::to_string(done_) + " of " + counted(plan_.list.jobs.size(), noun_of(plan_.list.kind)) +
           (texels_ < 1'000'000 ? "" : ", " + std::to_string(texels_ / 1'000'000) + " million texels");
  }
  const ConvertPlan& plan_;
  std::size_t done_ = 0;
  std::size_t texels_ = 0;
  Progress line_;                   // declared after the counts, because its first text uses them
  std::vector<std::size_t> shown_;  // progress of each job
};

// A MergedReports merges the reports of a set's tiles, which follow one another. It passes each set on when
// its last job is finished. An asset is a set of one job.
class MergedReports {
 public:
  MergedReports(const std::vector<Job>& jobs, std::function<void(const JobReport&)> finished)
      : finished_(std::move(finished)), set_of_(jobs.size()) {
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      const bool continues = i > 0 && !jobs[i].tile.empty() && jobs[i].name == jobs[i - 1].name;
      if (!continues) sets_.emplace_back();
      sets_.back().emplace_back();
      set_of_[i] = {sets_.size() - 1, sets_.back().size() - 1};
    }
    for (const auto& set : sets_) unfinished_.push_back(set.size());
  }

  void finish(std::size_t job, JobReport report) {
    const std::lock_guard lock(mutex_);
    const auto [number, place] = set_of_[job];
    std::vector<JobReport>& set = sets_[number];
    set[place] = std::move(report);
    if (--unfinished_[number] > 0) return;
    for (std::size_t i = 1; i < set.size(); ++i) set.front() += set[i];
    set.resize(1);
    finished_(set.front());
  }

  std::vector<JobReport> all() {
    std::vector<JobReport> reports;
    for (std::vector<JobReport>& set : sets_) reports.push_back(std::move(set.front()));
    return reports;
  }

 private:
  const std::function<void(const JobReport&)> finished_;
  std::mutex mutex_;
  std::vector<std::vector<JobReport>> sets_;                 // the reports of each set's jobs
  std::vector<std::size_t> unfinished_;                      // number of unfinished jobs of each set
  std::vector<std::pair<std::size_t, std::size_t>> set_of_;  // index of the set, and of the job in it
};

// Returns the place for messages: the name of the set or asset, or the first map if the set has no name.
std::string place_of(const Job& job) {
  if (!job.name.empty()) return display_path(job.name);
  for (const auto& [parameter, asked] : std::get<SetWork>(job.work).request.parameters)
    if (const auto* map = std::get_if<MapName>(&asked.source)) return display_path(map->file);
  return "the set";
}

// Does a job. If there are several, a failure becomes part of the report.
JobReport report_of(const JobWorker& worker, const OutputFolder& folder, const ConvertPlan& plan,
                    const Job& job, const std::function<void(double)>& advance) {
  JobReport report;
  const auto run = [&] {
    report = JobReport::of(job);
    if (interruption()) throw Error(ErrorKind::kInterrupted, "interrupted", EINTR);
    if (!job.refusal.empty()) throw output_error(job.refusal);
    require_as_listed(job.listed);
    try {
      worker(job, advance, report);
    } catch (const std::bad_alloc&) {
      throw input_error((report.inputs.empty() ? place_of(job) : report.inputs.front().string()) +
                        ": out of memory (use fewer --threads)");
    }
  };
  try {
    for (const std::string& trouble : with_retries(run))
      report.warnings.push_back("tried again after " + trouble);
  } catch (const Error& error) {
    if (!plan.list.has_several) throw;
    if (error.kind() == ErrorKind::kInterrupted)
      throw Error(error.kind(),
                  "interrupted: finished " + noun_of(plan.list.kind) + "s are complete" +
                      (folder.has_journal() ? " (the same command converts the others)" : ""),
                  plan.part ? EINTR : 0);
    report.failure = error.what();
    report.failure_code = error.system_code();
    report.tiles.clear();
  }
  return report;
}

}  // namespace

std::vector<JobReport> run_jobs(const ConvertPlan& plan,
                                const std::function<void(const JobReport&)>& finished) {
  const std::vector<Job>& jobs = plan.list.jobs;
  const auto threads = static_cast<std::size_t>(plan.threads);
  const std::size_t at_once = std::clamp<std::size_t>(jobs.size(), 1, threads);
  const int threads_a_job = static_cast<int>(threads / at_once);
  set_image_limits(threads_a_job, plan.memory_bytes / at_once);
  OutputFolder folder(plan);
  const JobWorker worker =
      plan.sets() != nullptr ? set_worker(plan, folder, threads_a_job) : asset_worker(plan, folder);
  RunProgress line(plan);
  MergedReports reports(jobs, [&](const JobReport& report) {
    line.hide();
    finished(report);
  });
  const auto finish = [&](std::size_t i, JobReport report) {
    line.finish(i, report.statistics.texel_count);
    reports.finish(i, std::move(report));
  };
  ApartJobs apart;
  apart.count = jobs.size();
  apart.at_once = static_cast<unsigned>(at_once);
  apart.work = [&](std::size_t i, const std::function<void(double)>& advance) {
    return packed(report_of(worker, folder, plan, jobs[i], advance));
  };
  apart.advanced = [&](std::size_t i, double share) { line.advance(i, share); };
  apart.finished = [&](std::size_t i, std::string result) {
    finish(i, unpacked<JobReport>(std::move(result)));
  };
  apart.clean = [&](std::size_t i) {
    for (const std::filesystem::path& place : jobs[i].folders()) remove_unfinished(place);
  };
  apart.crashed = [&](std::size_t i, const std::string& reason) {
    JobReport report = JobReport::of(jobs[i]);
    report.failure = place_of(jobs[i]) + ": " + reason;
    report.tiles.clear();
    if (!plan.list.has_several) throw input_error(*report.failure);
    finish(i, std::move(report));
  };
  run_apart(apart);
  std::vector<JobReport> all = reports.all();
  require_effect(plan, all);
  return all;
}

namespace {

constexpr std::size_t kMostRepeats = 3;

void wait_before_repeat(std::size_t repeat) {
  for (int i = 0; i < 5 << repeat && !interruption(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace

std::vector<std::string> with_retries(const std::function<void()>& work) {
  std::vector<std::string> troubles;
  for (;;) try {
      work();
      return troubles;
    } catch (const Error& error) {
      if (!is_transient(error.system_code()) || troubles.size() == kMostRepeats || interruption()) throw;
      wait_before_repeat(troubles.size());
      troubles.emplace_back(error.what());
    }
}

}  // namespace remap
