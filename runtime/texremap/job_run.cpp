#include "texremap/job_run.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <memory>
#include <mutex>
#include <new>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/packed_values.hpp"
#include "core/report_text.hpp"
#include "core/stopwatch.hpp"
#include "remap/version.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/conversion_hash.hpp"
#include "texremap/conversion_request.hpp"
#include "texremap/job_processes.hpp"
#include "texremap/journal.hpp"
#include "texremap/manifest.hpp"
#include "texremap/repeats.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

namespace remap {
namespace {

// The share of one set in the progress line, independent of its size.
constexpr std::size_t kSetProgress = 1000;

// Each file once: a file of several parts is several maps.
OpenFiles files_of(const TextureSet& set) {
  OpenFiles files;
  for (const ImageReader& map : set.maps)
    if (std::ranges::find(files, map.file()) == files.end()) files.push_back(map.file());
  return files;
}

// The open file of that name; opens it where it is none of `files`.
std::shared_ptr<const InputFile> file_among(const OpenFiles& files, const std::filesystem::path& path) {
  const auto found = std::ranges::find(files, path, [](const auto& file) { return file->path(); });
  return found != files.end() ? *found : std::make_shared<const InputFile>(path);
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

Metadata metadata_of(const ChosenConverter& chosen) {
  const ConverterInfo& info = chosen.info();
  return {{"remap:converter", converter_ids(chosen)},
          {"remap:source", info.source.model},
          {"remap:target", info.target.model},
          {"remap:version", kVersion}};
}

// Refuses maps that were converted before to another model than the source of this conversion.
void require_not_converted(const TextureSet& set, const ChosenConverter& chosen, JournalLookup& journals) {
  const std::string& source = chosen.info().source.model;
  const WorkflowChoice& workflow = chosen.workflow;
  const WorkflowEnd end =
      workflow.is_material()
          ? *workflow.source
          : workflow_over(source, WorkflowKind::kSpecular, RoughnessConvention::kAlpha).end;
  const std::string& brdf = workflow.is_material() ? workflow.source_brdf : source;
  for (const ImageReader& map : set.maps) {
    std::optional<std::string> model = map.noted_metadata("remap:target");
    if (!model) model = journals.target_of(*map.file());
    if (model && *model != source && !holds_materials_of(*model, end, brdf))
      throw Error(ErrorKind::kUsage, map.path().string() + ": already converted to " + *model +
                                         ", but the source is " + source + " (--force converts it anyway)");
  }
}

std::vector<std::filesystem::path> results_of(const TargetPlan& plan) {
  std::vector<std::filesystem::path> files;
  for (const PlannedMap& map : plan.maps) files.push_back(map.path);
  for (const PlannedCopy& copy : plan.copies) files.push_back(copy.path);
  return files;
}

// Refuses to replace files that this conversion did not write.
void require_replaceable(const std::vector<std::filesystem::path>& files, const Journal& journal) {
  std::error_code ignored;
  for (const std::filesystem::path& file : files)
    if (std::filesystem::exists(file, ignored) && !journal.is_own(file))
      throw Error(ErrorKind::kOutput,
                  file.string() + ": already exists, and is not of this conversion (--force overwrites)");
}

// Refuses to replace any file, and names --resume where this conversion wrote it.
void require_free(const std::vector<std::filesystem::path>& files, const Journal& journal) {
  std::error_code ignored;
  for (const std::filesystem::path& file : files)
    if (std::filesystem::exists(std::filesystem::symlink_status(file, ignored)))
      throw Error(ErrorKind::kOutput, file.string() + ": already exists (" +
                                          (journal.is_own(file) ? "--resume skips finished sets, " : "") +
                                          "--force overwrites)");
}

// Refuses options that apply to none of the results.
void require_effect(const ConvertOptions& options, const JobReport& report) {
  if (options.dither && !report.has_8_bits)
    throw usage_error("--dither: applies to nothing, because no result has 8 bits (remove this option)");
  if (options.compression && !report.has_compression_level)
    throw usage_error(
        "--compression: applies to nothing, because no result is PNG, or EXR or TIFF with zip (remove this "
        "option)");
}

WidthSource width_source(const TextureSet& set) {
  const SetParameter* map = set.map_of(Parameter::kRoughness);
  if (map == nullptr) return {{}, set.convention};
  return {set.maps[map->channels.front().map].path(), set.convention};
}

// Notes in which color spaces the set is read and written.
void note_colors(const TextureSet& set, const std::vector<TargetMap>& targets, JobReport& report) {
  for (const auto& [parameter, values] : set.parameters)
    if (is_color(parameter) && values.is_map() &&
        (values.is_whole_numbers || values.transfer_reason != TransferReason::kUsual))
      ++report.colors[{parameter, false, values.transfer, values.transfer_reason}];
  for (const TargetMap& target : targets)
    for (std::size_t p = 0; p < target.parts.size(); ++p) {
      const TargetPart& part = target.parts[p];
      for (std::size_t c = 0; c < part.channels.size(); ++c) {
        const auto* channel = std::get_if<ConvertedChannel>(&part.channels[c]);
        if (channel == nullptr || !is_color(channel->parameter) || channel->index > 0) continue;
        const PixelType type = target.writer->layout(static_cast<int>(p)).channels[c].type;
        const ColorStorage& storage = *part.changes.colors;
        const auto source = set.parameters.find(channel->parameter);
        const bool is_asked =
            source != set.parameters.end() && source->second.transfer_reason == TransferReason::kUser;
        if (!is_integer(type) && !storage.chosen && !is_asked) continue;
        const TransferReason reason = storage.chosen                         ? TransferReason::kUser
                                      : storage.followed && is_integer(type) ? TransferReason::kFile
                                                                             : TransferReason::kUsual;
        ++report.colors[{channel->parameter, true, storage.of(type), reason}];
      }
    }
}

JobReport::Result result_of(const PlannedMap& planned) {
  JobReport::Result result{planned.path, {}, false};
  for (const TargetPart& part : planned.parts)
    for (const TargetChannel& channel : part.channels) {
      if (const auto* converted = std::get_if<ConvertedChannel>(&channel))
        result.parameters.push_back(converted->parameter);
      result.mask |= std::holds_alternative<MaskChannel>(channel);
    }
  return result;
}

class JobRunner {
 public:
  // `is_tree`: the output folder is of this conversion alone.
  JobRunner(const ChosenConverter& chosen, const ConvertOptions& options, int threads_a_job, bool is_tree,
            WrittenNames& names)
      : chosen_(chosen),
        options_(options),
        names_(names),
        choice_(target_choice(options, chosen.workflow)),
        pass_(pass_options(options)),
        is_tree_(is_tree),
        journal_(options.output, conversion_note(chosen, options),
                 options.part ? std::make_optional(options.part->part) : std::nullopt) {
    if (!options.force) journal_.require_own();
    pass_.thread_count = threads_a_job;
    pass_.cancelled = &interruption();
  }

  // `progress` receives the finished share of the set, 0 to 1.
  void run(const ConversionJob& job, const std::function<void(double)>& progress, JobReport& report);

 private:
  void commit(const ConversionJob& job, const TargetPlan& plan, const OpenFiles& files,
              const std::string& inputs, std::vector<TargetMap>& finished);
  std::unique_ptr<Converter> survey(TextureSet& set, JobReport& report) const;
  void note_doubts(const TextureSet& set, const std::vector<TargetMap>& targets, JobReport& report) const;
  // What the roughness results hold where neither a name nor an option says it: what the target model of a
  // workflow takes, else what the inputs hold where that is known, else what the target model takes.
  RoughnessConvention usual_width(const TextureSet& set) const {
    if (chosen_.workflow.is_material()) return width_of(*chosen_.workflow.target);
    return set.convention.value_or(chosen_.info().target.roughness);
  }

  const ChosenConverter& chosen_;
  const ConvertOptions& options_;
  WrittenNames& names_;
  TargetChoice choice_;  // without the members that differ between sets
  PassOptions pass_;
  bool is_tree_;
  Journal journal_;         // of the output folder
  JournalLookup journals_;  // of the inputs
};

// Samples the maps of a workflow and notes warnings. Returns a converter for this set alone if its dielectric
// F0 is to be estimated from the maps.
std::unique_ptr<Converter> JobRunner::survey(TextureSet& set, JobReport& report) const {
  const WorkflowChoice& workflow = chosen_.workflow;
  if (!workflow.is_material()) return nullptr;
  const MaterialSample sample = sample_materials(set);
  for (std::string& doubt : doubts_about(sample, set)) report.warnings.push_back(std::move(doubt));
  if (!workflow.is_to_metallic() || kind_of(*workflow.source) != WorkflowKind::kSpecular) return nullptr;
  WorkflowStages stages = stages_of(chosen_.workflow, chosen_.brdf);
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

// Says which maps of one value have a trace of color, where it could be visible.
void note_tints(const TextureSet& set, JobReport& report) {
  constexpr float kVisibleTint = 0.01f;
  for (const auto& [parameter, tint] : report.statistics.tints) {
    const SetParameter* parameter_map = set.map_of(parameter);
    if (parameter_map == nullptr || tint <= kVisibleTint) continue;
    const ChannelPlace used = parameter_map->channels.front();
    const ImageReader& map = set.maps[used.map];
    report.warnings.push_back(map.path().string() + ": is not quite grey: its channels differ from " +
                              map.layout().channels[used.channel].name + ", which is used, by at most " +
                              fixed(255.0 * static_cast<double>(tint), 0) + " of 255");
  }
}

void JobRunner::note_doubts(const TextureSet& set, const std::vector<TargetMap>& targets,
                            JobReport& report) const {
  for (const std::string& remark : remarks(set)) report.warnings.push_back(remark);
  // Of packed files; the first file with a constant is the one that lacks a map.
  const auto has_constant = [](const TargetMap& target) {
    const auto is_constant = [](const TargetChannel& channel) {
      return std::holds_alternative<float>(channel);
    };
    return std::ranges::any_of(target.parts.front().channels, is_constant);
  };
  const auto packed = std::ranges::find_if(targets, has_constant);
  if (packed != targets.end() && choice_.layout.file_with(Parameter::kMetallic) != nullptr) {
    const auto note = [&](const std::string& name, const std::string& value) {
      const auto has_name = [&](const CarriedParameter& carried) { return carried.name == name; };
      if (choice_.layout.has_place_for(name) && std::ranges::none_of(set.carried, has_name))
        report.warnings.push_back(packed->writer->path().string() + ": no " + name + " map; " + name +
                                  " is set to " + value);
    };
    note("occlusion", "1");
    if (!chosen_.workflow.is_to_metallic()) note("metallic", "0");
  }
  for (const TargetMap& target : targets) {
    if (const std::string& lossy = target.writer->layout().lossy_compression; !lossy.empty())
      report.warnings.push_back(target.writer->path().string() + ": " + lossy +
                                " compression changes values (--format png or exr keeps them)");
  }
}

// Copies that are finished and have no final name yet; those that do not get one are removed.
class FinishedCopies {
 public:
  FinishedCopies() = default;
  FinishedFile add(const PlannedCopy& copy, const std::shared_ptr<const InputFile>& source) {
    if (copy.turns_green) return finished_file(*turned_.emplace_back(turned_copy(source, copy.path)));
    NewFile& whole = *whole_.emplace_back(std::make_unique<NewFile>(copy.path));
    add_copy(*source, whole);
    whole.finish();
    return finished_file(whole);
  }
  void commit() {
    for (const auto& image : turned_) image->commit(Flush::kNo);
    for (const auto& file : whole_) file->commit(Flush::kNo);
  }

 private:
  std::vector<std::unique_ptr<NewImage>> turned_;
  std::vector<std::unique_ptr<NewFile>> whole_;
};

// Gives the finished files of a set, and its copies, their names. They are on the disk before; the lock of
// the folder is held for the renames alone.
void JobRunner::commit(const ConversionJob& job, const TargetPlan& plan, const OpenFiles& files,
                       const std::string& inputs, std::vector<TargetMap>& finished) {
  if (is_tree_) journal_.claim(options_.force);
  journal_.begin(results_of(plan));
  std::vector<FinishedFile> results;
  for (const TargetMap& target : finished) results.push_back(finished_file(*target.writer));
  FinishedCopies copies;
  for (const PlannedCopy& copy : plan.copies)
    results.push_back(copies.add(copy, file_among(files, copy.source)));
  journal_.commit(job.name + (job.tile.empty() ? "" : " " + job.tile), inputs, results, options_.force, [&] {
    for (TargetMap& target : finished) target.writer->commit(Flush::kNo);
    copies.commit();
  });
  std::error_code ignored;
  for (const std::filesystem::path& folder : {job.folder, job.diagnosis_folder})
    if (std::filesystem::exists(folder, ignored)) flush_to_disk(folder, folder);
}

void JobRunner::run(const ConversionJob& job, const std::function<void(double)>& progress,
                    JobReport& report) {
  const Stopwatch stopwatch;
  require_as_listed(job.listed);
  TextureSet set = open_texture_set(job.request);
  require_scale(set, set.convention.value_or(chosen_.info().source.roughness));
  const OpenFiles files = files_of(set);
  for (const auto& file : files) report.inputs.push_back(file->path());
  report.left_behind = job.left_behind;
  if (const SetParameter* specular = set.map_of(Parameter::kSpecular))
    report.specular_transfer = specular->transfer;
  if (!options_.force) require_not_converted(set, chosen_, journals_);

  TargetChoice choice = choice_;
  choice.folder = job.folder;
  choice.diagnosis_folder = job.diagnosis_folder;
  choice.names = job.names;
  choice.metadata = metadata_of(chosen_);
  choice.force = options_.force || options_.resume || is_tree_;  // existing files are checked below
  choice.copies = job.copies;
  const RoughnessConvention width = written_width(options_, choice, width_source(set), usual_width(set));
  const bool is_exponent = width == RoughnessConvention::kExponent;
  choice.width_name = width == RoughnessConvention::kGlossiness ? "glossiness"
                      : is_exponent                             ? "exponent"
                                                                : "roughness";
  require_factor_of_exponent(options_, width);
  if (options_.scales_exponents() || width != set.convention.value_or(chosen_.info().source.roughness))
    std::erase(choice.unchanged, Parameter::kRoughness);
  const TargetPlan plan = plan_targets(set, choice);
  if (is_exponent && !options_.scales_exponents()) require_target_scale(set, plan);
  for (const PlannedMap& map : plan.maps) report.results.push_back(result_of(map));
  for (const PlannedCopy& copy : plan.copies)
    if (copy.parts.empty())
      report.copies.push_back(copy.path);
    else
      report.results.push_back(result_of({copy.path, copy.parts}));
  for (const std::filesystem::path& file : results_of(plan))
    if (const std::string other = names_.take(file, job.owner); !other.empty())
      throw Error(ErrorKind::kOutput, file.string() + ": would be written twice, from " + other +
                                          " and from " + job.owner + " (rename one of the sets)");
  report.warnings = job.notes;
  report.warnings.insert(report.warnings.end(), plan.left_out.begin(), plan.left_out.end());
  const bool needs_hash = options_.resume || !options_.dry_run;
  OpenFiles all = files, copied;
  if (needs_hash)
    for (const CopiedFile& copy : job.copies) {
      copied.push_back(file_among(all, copy.source));
      all.push_back(copied.back());
    }
  const std::string inputs = needs_hash ? inputs_hash(files, job, copied) : "";
  if (options_.resume) {
    const std::vector<std::filesystem::path> results = results_of(plan);
    if (journal_.is_done(inputs, results)) {
      report.was_done = true;
      return;
    }
    if (!options_.force) require_replaceable(results, journal_);
  } else if (is_tree_ && !options_.force) {
    require_free(results_of(plan), journal_);
  }
  if (options_.dry_run) {
    report.plan = planned_roles(set, plan, choice, job, chosen_.info().source.roughness, width);
    return;
  }

  const std::unique_ptr<Converter> own = survey(set, report);
  std::vector<TargetMap> targets = open_targets(set, plan);
  note_doubts(set, targets, report);
  note_colors(set, targets, report);
  for (const TargetMap& target : targets) {
    const ImageLayout& layout = target.writer->layout();
    report.has_compression_level |= layout.has_compression_level;
    for (const Channel& channel : layout.channels) report.has_8_bits |= channel.type == PixelType::kUint8;
  }
  if (!is_tree_) require_effect(options_, report);
  PassOptions pass = pass_;
  pass.target_convention = width;
  pass.progress = progress;
  pass.commit = [&](std::vector<TargetMap>& finished) { commit(job, plan, all, inputs, finished); };
  report.statistics = run_texture_pass(set, targets, own ? *own : chosen_.converter(), pass);
  note_tints(set, report);
  report.bytes_read = size_of(report.inputs);
  for (const JobReport::Result& result : report.results) report.bytes_written += size_of({result.path});
  report.seconds = stopwatch.seconds();
}

// The progress line of the whole run.
class JobProgress {
 public:
  JobProgress(const JobList& list, const std::string& converter, bool shown)
      : list_(list), line_(list.is_tree ? text() : converter, list.jobs.size() * kSetProgress, shown) {}

  void advance(std::size_t count) { line_.advance(count); }
  void hide() { line_.hide(); }
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

// The sets of a run: the jobs of a set, its tiles, follow one another. Merges and hands over the report of a
// set when the last of its jobs is finished.
class Sets {
 public:
  Sets(const std::vector<ConversionJob>& jobs, std::function<void(const JobReport&)> finished)
      : finished_(std::move(finished)), set_of_(jobs.size()) {
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      const bool continues = i > 0 && !jobs[i].name.empty() && jobs[i].name == jobs[i - 1].name;
      if (!continues) sets_.emplace_back();
      sets_.back().jobs.emplace_back();
      set_of_[i] = {sets_.size() - 1, sets_.back().jobs.size() - 1};
    }
  }

  void finish(std::size_t job, JobReport report) {
    const std::lock_guard lock(mutex_);
    Set& set = sets_[set_of_[job].first];
    set.jobs[set_of_[job].second] = std::move(report);
    if (++set.finished_count < set.jobs.size()) return;
    for (std::size_t i = 1; i < set.jobs.size(); ++i) set.jobs.front() += set.jobs[i];
    set.jobs.resize(1);
    finished_(set.jobs.front());
  }

  std::vector<JobReport> reports() {
    std::vector<JobReport> all;
    for (Set& set : sets_) all.push_back(std::move(set.jobs.front()));
    return all;
  }

 private:
  struct Set {
    std::vector<JobReport> jobs;
    std::size_t finished_count = 0;
  };
  const std::function<void(const JobReport&)> finished_;
  std::mutex mutex_;
  std::vector<Set> sets_;
  std::vector<std::pair<std::size_t, std::size_t>> set_of_;  // index of the set, and of the job in it
};

}  // namespace

namespace {

// One set, or one tile, once.
void run_job(JobRunner& runner, const ConversionJob& job, const std::function<void(double)>& advance,
             JobReport& report) {
  try {
    runner.run(job, advance, report);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::kInput,
                (report.inputs.empty() ? shown(report.name) : report.inputs.front().string()) +
                    ": out of memory (use fewer --threads)");
  }
}

JobReport report_named(const ConversionJob& job) {
  JobReport report;
  report.name = job.name;
  if (!job.tile.empty()) report.tiles = {job.tile};
  return report;
}

// The set, or of a set without a name its first map.
std::string place_of(const ConversionJob& job) {
  if (!job.name.empty()) return shown(job.name);
  for (const auto& [parameter, asked] : job.request.parameters)
    if (const auto* map = std::get_if<MapName>(&asked.source)) return shown(map->file);
  return "the set";
}

// Converts a set, or a tile of one; of several, a failure is a part of the report.
JobReport report_of(JobRunner& runner, const JobList& list, const ConvertOptions& options, std::size_t i,
                    const std::function<void(double)>& advance) {
  const ConversionJob& job = list.jobs[i];
  JobReport report;
  try {
    const std::vector<std::string> troubles = with_repeats([&] {
      report = report_named(job);
      run_job(runner, job, advance, report);
    });
    for (const std::string& trouble : troubles) report.warnings.push_back("tried again after " + trouble);
  } catch (const Error& error) {
    if (!list.is_tree) throw;
    if (error.kind() == ErrorKind::kInterrupted)
      throw Error(error.kind(), "interrupted: finished sets are complete (--resume converts the others)",
                  options.part ? EINTR : 0);
    report.failure = error.what();
    report.failure_code = error.system_code();
    report.tiles.clear();
  }
  return report;
}

}  // namespace

std::vector<JobReport> run_jobs(const JobList& list, const ChosenConverter& chosen,
                                const ConvertOptions& options,
                                const std::function<void(const JobReport&)>& finished) {
  const int threads = options.threads();
  const int at_once =
      static_cast<int>(std::clamp<std::size_t>(list.jobs.size(), 1, static_cast<std::size_t>(threads)));
  JobRunner runner(chosen, options, threads / at_once, !options.folder.empty(), *list.names);
  set_image_limits({threads / at_once, options.memory_bytes() / static_cast<unsigned>(at_once)});
  JobProgress line(list, chosen.info().id, !options.quiet);
  Sets sets(list.jobs, [&](const JobReport& report) {
    line.hide();
    finished(report);
  });
  std::vector<std::size_t> shown(list.jobs.size(), 0);
  const auto advance = [&](std::size_t i, double share) {
    const auto now = static_cast<std::size_t>(share * kSetProgress);
    line.advance(now - shown[i]);
    shown[i] = now;
  };
  const auto finish = [&](std::size_t i, JobReport report) {
    advance(i, 1.0);
    line.finish(report.statistics.texel_count);
    sets.finish(i, std::move(report));
  };
  ApartJobs apart;
  apart.count = list.jobs.size();
  apart.at_once = static_cast<unsigned>(at_once);
  apart.work = [&](std::size_t i, const std::function<void(double)>& tell) {
    return packed(report_of(runner, list, options, i, tell));
  };
  apart.advanced = advance;
  apart.finished = [&](std::size_t i, std::string result) {
    finish(i, unpacked<JobReport>(std::move(result)));
  };
  apart.clean = [&](std::size_t i) {
    for (const std::filesystem::path& folder : {list.jobs[i].folder, list.jobs[i].diagnosis_folder})
      remove_unfinished(folder);
  };
  apart.crashed = [&](std::size_t i, const std::string& reason) {
    const ConversionJob& job = list.jobs[i];
    JobReport report = report_named(job);
    report.failure = place_of(job) + ": " + reason;
    report.tiles.clear();
    if (!list.is_tree) throw input_error(*report.failure);
    finish(i, std::move(report));
  };
  run_apart(apart);
  std::vector<JobReport> reports = sets.reports();
  const auto is_converted = [](const JobReport& report) { return !report.failure && !report.was_done; };
  if (!options.dry_run && !options.part && std::any_of(reports.begin(), reports.end(), is_converted)) {
    JobReport all;
    for (const JobReport& report : reports) {
      all.has_8_bits |= report.has_8_bits;
      all.has_compression_level |= report.has_compression_level;
    }
    require_effect(options, all);
  }
  return reports;
}

}  // namespace remap
