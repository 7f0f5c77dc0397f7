#include "texremap/job_run.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "system/files.hpp"
#include "system/parallel.hpp"
#include "texremap/conversion_request.hpp"
#include "texture/content_hash.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

namespace remap {
namespace {

// The share of one set in the progress line, independent of its size.
constexpr std::size_t kSetProgress = 1000;

// Each file once: a file of several parts is several maps.
std::vector<std::filesystem::path> files_of(const TextureSet& set) {
  std::vector<std::filesystem::path> files;
  for (const ImageReader& map : set.maps)
    if (std::find(files.begin(), files.end(), map.path()) == files.end()) files.push_back(map.path());
  return files;
}

std::uintmax_t size_of(const std::vector<std::filesystem::path>& files) {
  std::uintmax_t bytes = 0;
  for (const std::filesystem::path& file : files) {
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(file, failure);
    if (!failure) bytes += size;
  }
  return bytes;
}

// A hash of everything that the results of a set depend on: the bytes of its files, the converter, the
// options.
std::string hash_of(const std::vector<std::filesystem::path>& files, const ChosenConverter& chosen,
                    const ConvertOptions& options) {
  ContentHash hash;
  for (const std::filesystem::path& file : files) hash.add_file(file);
  for (const Converter* step : chosen.path.steps) hash.add(step->info().id);
  if (chosen.workflow.is_material()) hash.add(converter_ids(chosen));
  if (!options.fit.empty()) hash.add_file(options.fit);
  hash.add(result_options_text(options));
  hash.add(kVersion);
  return hash.hex();
}

Metadata metadata_of(const ChosenConverter& chosen, const std::string& hash) {
  const ConverterInfo& info = chosen.info();
  return {{"remap:converter", converter_ids(chosen)},
          {"remap:source", info.source.model},
          {"remap:target", info.target.model},
          {"remap:version", kVersion},
          {"remap:inputs", hash}};
}

// Refuses maps that were converted before to another model than the source of this conversion.
void require_not_converted(const TextureSet& set, const ChosenConverter& chosen, bool force) {
  if (force) return;
  const std::string& source = chosen.info().source.model;
  const WorkflowChoice& workflow = chosen.workflow;
  const WorkflowEnd end =
      workflow.is_material()
          ? *workflow.source
          : workflow_over(source, WorkflowKind::kSpecular, RoughnessConvention::kAlpha).end;
  const std::string& brdf = workflow.is_material() ? workflow.source_brdf : source;
  for (const ImageReader& map : set.maps) {
    const std::optional<std::string> model = noted_metadata(map, "remap:target");
    if (model && *model != source && !holds_materials_of(*model, end, brdf))
      throw Error(ErrorKind::kUsage, map.path().string() + ": already converted to " + *model +
                                         ", but the source is " + source + " (--force converts it anyway)");
  }
}

// Whether `path` is a result of these inputs and options. Without metadata the answer is no.
bool is_made_of(const std::filesystem::path& path, const std::string& hash) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  try {
    return noted_metadata(ImageReader(path), "remap:inputs") == hash;
  } catch (const Error&) {
    return false;  // an incomplete image is not ours
  }
}

bool is_copy_of(const std::filesystem::path& path, const std::filesystem::path& source) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) ||
      std::filesystem::file_size(path, ignored) != std::filesystem::file_size(source, ignored))
    return false;
  const auto hash_of_file = [](const std::filesystem::path& file) {
    ContentHash hash;
    hash.add_file(file);
    return hash.hex();
  };
  return hash_of_file(path) == hash_of_file(source);
}

// Whether all results exist already. Throws kOutput for an existing file of other inputs or options.
bool all_done(const TargetPlan& plan, const std::string& hash, bool force) {
  bool all = true;
  const auto look = [&](const std::filesystem::path& path, bool is_ours) {
    std::error_code ignored;
    if (!is_ours && !force && std::filesystem::exists(path, ignored))
      throw Error(ErrorKind::kOutput,
                  path.string() + ": already exists, made from other inputs or options (--force overwrites)");
    all = all && is_ours;
  };
  for (const PlannedMap& map : plan.maps) look(map.path, is_made_of(map.path, hash));
  for (const PlannedCopy& copy : plan.copies) look(copy.path, is_copy_of(copy.path, copy.source));
  return all;
}

JobReport::Result result_of(const PlannedMap& planned) {
  using Content = TargetChannel::Content;
  JobReport::Result result{planned.path, {}, false};
  for (const PlannedPart& part : planned.parts)
    for (const TargetChannel& channel : part.channels) {
      if (channel.content == Content::kParameter) result.parameters.push_back(channel.parameter);
      result.mask |= channel.content == Content::kMask;
    }
  return result;
}

class JobRunner {
 public:
  JobRunner(const ChosenConverter& chosen, const ConvertOptions& options, int threads_a_job)
      : chosen_(chosen),
        options_(options),
        choice_(target_choice(options, chosen.workflow)),
        pass_(pass_options(options)) {
    pass_.thread_count = threads_a_job;
    pass_.cancelled = &interruption();
  }

  // `progress` receives the finished share of the set, 0 to 1.
  void run(const ConversionJob& job, const std::function<void(double)>& progress, JobReport& report) const;

 private:
  std::unique_ptr<Converter> survey(TextureSet& set, JobReport& report) const;
  void note_doubts(const TextureSet& set, const std::vector<TargetMap>& targets, JobReport& report) const;

  const ChosenConverter& chosen_;
  const ConvertOptions& options_;
  TargetChoice choice_;  // without the members that differ between sets
  PassOptions pass_;
};

// Samples the maps of a workflow and notes warnings. Returns a converter for this set alone if its dielectric
// F0 is to be estimated from the maps.
std::unique_ptr<Converter> JobRunner::survey(TextureSet& set, JobReport& report) const {
  const WorkflowChoice& workflow = chosen_.workflow;
  if (!workflow.is_material()) return nullptr;
  const MaterialSample sample = sample_materials(set);
  report.warnings = doubts_about(sample, set);
  if (!workflow.is_to_metallic() || kind_of(*workflow.source) != WorkflowKind::kSpecular) return nullptr;
  WorkflowStages stages = stages_of(chosen_);
  const RoughnessConvention width = set.convention.value_or(chosen_.info().source.roughness);
  if (!workflow.f0_given) report.estimated_f0 = estimated_f0(sample, stages, width);
  if (!workflow.estimates_f0) return nullptr;
  if (!report.estimated_f0 || !report.estimated_f0->is_certain) {
    report.warnings.push_back(report.inputs.front().string() +
                              ": too few texels to estimate the dielectric F0; the default is used "
                              "(--dielectric-f0 VALUE sets it)");
    return nullptr;
  }
  std::get<MetallicWorkflow>(stages.target).dielectric_f0 = std::round(report.estimated_f0->f0 * 1e4) / 1e4;
  return make_workflow_converter(stages, chosen_.info().instructions);
}

void JobRunner::note_doubts(const TextureSet& set, const std::vector<TargetMap>& targets,
                            JobReport& report) const {
  for (const std::string& remark : remarks(set)) report.warnings.push_back(remark);
  if (choice_.layout == Layout::kOrm || choice_.layout == Layout::kArm) {
    const auto note = [&](const std::string& name, const std::string& value) {
      const auto has_name = [&](const CarriedParameter& carried) { return carried.name == name; };
      if (std::none_of(set.carried.begin(), set.carried.end(), has_name))
        report.warnings.push_back(targets.front().writer.path().string() + ": no " + name + " map; " + name +
                                  " is set to " + value);
    };
    note("occlusion", "1");
    if (!chosen_.workflow.is_to_metallic()) note("metallic", "0");
  }
  for (const TargetMap& target : targets) {
    if (const std::string& lossy = target.writer.layout().lossy_compression; !lossy.empty())
      report.warnings.push_back(target.writer.path().string() + ": " + lossy +
                                " compression changes values (--format png or exr keeps them)");
  }
}

void JobRunner::run(const ConversionJob& job, const std::function<void(double)>& progress,
                    JobReport& report) const {
  const auto start = std::chrono::steady_clock::now();
  TextureSet set = open_texture_set(job.request);
  report.inputs = files_of(set);
  if (const SetParameter* specular = set.map_of(Parameter::kSpecular))
    report.specular_transfer = specular->transfer;
  require_not_converted(set, chosen_, options_.force);

  TargetChoice choice = choice_;
  choice.folder = job.folder;
  choice.names = job.names;
  const bool needs_hash = options_.resume || !options_.dry_run;
  const std::string hash = needs_hash ? hash_of(report.inputs, chosen_, options_) : "";
  choice.metadata = metadata_of(chosen_, hash);
  choice.force = options_.force || options_.resume;  // existing files are checked below
  choice.copies = job.copies;
  const TargetPlan plan = plan_targets(set, choice);
  for (const PlannedMap& map : plan.maps) report.results.push_back(result_of(map));
  for (const PlannedCopy& copy : plan.copies) report.copies.push_back(copy.path);
  if (options_.resume && all_done(plan, hash, options_.force)) {
    report.was_done = true;
    return;
  }
  if (options_.dry_run) return;

  const std::unique_ptr<Converter> own = survey(set, report);
  std::vector<TargetMap> targets = open_targets(set, plan, choice);
  note_doubts(set, targets, report);
  PassOptions pass = pass_;
  // Results have the encoding of the inputs if that was given. Those of a workflow follow its model.
  if (choice.layout == Layout::kSpecGloss) pass.target_convention = RoughnessConvention::kGlossiness;
  if (!pass.target_convention)
    pass.target_convention =
        chosen_.workflow.is_material() ? width_of(*chosen_.workflow.target) : job.request.convention;
  pass.progress = progress;
  report.statistics = run_texture_pass(set, targets, own ? *own : chosen_.converter(), pass);
  for (const PlannedCopy& copy : plan.copies) copy_whole_file(copy.source, copy.path);
  report.bytes_read = size_of(report.inputs);
  for (const JobReport::Result& result : report.results) report.bytes_written += size_of({result.path});
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The progress line of the whole run.
class JobProgress {
 public:
  JobProgress(const JobList& list, const std::string& converter, bool shown)
      : list_(list), line_(list.is_tree ? text() : converter, list.jobs.size() * kSetProgress, shown) {}

  void advance(std::size_t count) { line_.advance(count); }
  void finish(std::size_t texels) {
    const std::lock_guard lock(mutex_);
    ++done_;
    texels_ += texels;
    if (list_.is_tree) line_.relabel(text());
  }

 private:
  std::string text() const {
    return std::to_string(done_) + " of " + std::to_string(list_.jobs.size()) + " sets, " +
           std::to_string(texels_ / 1000000) + " million texels";
  }
  const JobList& list_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::size_t texels_ = 0;
  Progress line_;  // declared after the counts that its first text needs
};

// Merges the reports of the tiles of each set, which follow one another.
std::vector<JobReport> merged(std::vector<JobReport> tiles) {
  std::vector<JobReport> sets;
  for (JobReport& tile : tiles) {
    if (!sets.empty() && !tile.name.empty() && sets.back().name == tile.name)
      sets.back() += tile;
    else
      sets.push_back(std::move(tile));
  }
  return sets;
}

}  // namespace

std::vector<JobReport> run_jobs(const JobList& list, const ChosenConverter& chosen,
                                const ConvertOptions& options) {
  const int threads = thread_count(options);
  const int at_once =
      static_cast<int>(std::clamp<std::size_t>(list.jobs.size(), 1, static_cast<std::size_t>(threads)));
  const JobRunner runner(chosen, options, threads / at_once);
  set_image_thread_count(threads / at_once);
  JobProgress line(list, chosen.info().id, !options.quiet);
  std::vector<JobReport> reports(list.jobs.size());
  run_parallel(list.jobs.size(), static_cast<unsigned>(at_once), [&](std::size_t i) {
    reports[i].name = list.jobs[i].name;
    if (!list.jobs[i].tile.empty()) reports[i].tiles = {list.jobs[i].tile};
    std::size_t shown = 0;
    const auto advance = [&](double share) {
      const auto now = static_cast<std::size_t>(share * kSetProgress);
      line.advance(now - shown);
      shown = now;
    };
    try {
      runner.run(list.jobs[i], advance, reports[i]);
    } catch (const Error& error) {
      if (!list.is_tree) throw;
      if (error.kind() == ErrorKind::kInterrupted)
        throw Error(error.kind(), "interrupted: finished sets are complete (--resume converts the others)");
      reports[i].failure = error.what();
      reports[i].tiles.clear();
    }
    advance(1.0);
    line.finish(reports[i].statistics.texel_count);
  });
  return merged(std::move(reports));
}

}  // namespace remap
