#include "texremap/asset_run.hpp"

#include <algorithm>
#include <cerrno>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "assets/specgloss_factors.hpp"
#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/packed_values.hpp"
#include "core/stopwatch.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/asset_files.hpp"
#include "texremap/asset_formats.hpp"
#include "texremap/conversion_hash.hpp"
#include "texremap/job_processes.hpp"
#include "texremap/journal.hpp"
#include "texremap/repeats.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

AssetOptions asset_options(const ConvertOptions& options) {
  AssetOptions asset{options.profile, options.prior, options.instructions, options.resample};
  asset.target = options.to.name == "gltf-specgloss" ? AssetTarget::kSpecGloss : AssetTarget::kMetalRough;
  asset.folds_specular = options.fold_specular;
  asset.mtl_maker = options.mtl_maker;
  asset.compacts = !options.keep_unused;
  asset.bakes = options.bake;
  asset.jpeg_quality = options.jpeg;
  asset.png_level = options.compression;
  return asset;
}

// Files that several assets of a run name are copied by the first; the others find them whole.
class SharedCopies {
 public:
  void copy(const ResourceCopy& copy) {
    const std::shared_ptr<std::mutex> own = lock_of(copy.to);
    const std::lock_guard lock(*own);
    std::error_code ignored;
    if (fs::is_regular_file(copy.to, ignored) && are_same_files(copy.from, copy.to)) return;
    copy_whole_file(copy.from, copy.to);
  }

 private:
  std::shared_ptr<std::mutex> lock_of(const fs::path& path) {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<std::mutex>& own = locks_[path.lexically_normal()];
    if (!own) own = std::make_shared<std::mutex>();
    return own;
  }

  std::mutex mutex_;
  std::map<fs::path, std::shared_ptr<std::mutex>> locks_;
};

std::string inputs_hash_of(const FileSource& source, const AssetJob& job,
                           const std::vector<AssetResource>& resources) {
  ContentHash hash;
  hash.add_file(source.file());
  hash.add(job.image_prefix);
  const FolderResources files(job);
  for (const AssetResource& resource : resources) {
    std::error_code ignored;
    if (resource.kind != UriKind::kFile) continue;
    const fs::path file = files.input(resource.path);
    hash.add(resource.path);
    if (fs::is_regular_file(file, ignored)) hash.add_file(file);
  }
  return hash.hex();
}

class AssetRunner {
 public:
  AssetRunner(const AssetList& list, const ConvertOptions& options, const ConversionNote& conversion)
      : list_(list),
        options_(options),
        conversion_(asset_options(options)),
        journal_(options.output, conversion,
                 options.part ? std::make_optional(options.part->part) : std::nullopt) {
    if (list.is_tree && !options.force) journal_.require_own();
  }

  void run(const AssetJob& job, AssetReport& report) {
    const Stopwatch stopwatch;
    if (!job.refusal.empty()) throw output_error(job.refusal);
    require_as_listed(job.listed);
    const FileSource source(job.input);
    const FolderResources files(job);
    std::vector<AssetResource> named;
    if (list_.is_tree) named = resources_of_asset(source, job.input, files);
    const std::string inputs = list_.is_tree ? inputs_hash_of(source, job, named) : "";
    if (options_.resume && is_done(job, inputs, named)) {
      report.was_done = true;
      return;
    }
    require_free(job.input, job.output);
    const AssetConversion conversion = convert_asset(source, job.input, job.output, conversion_, files);
    report.materials = conversion.materials;
    report.warnings = conversion.warnings;
    const ResourcePlan plan =
        plan_resources(job, conversion.resources, [&](const fs::path& target) { require_free({}, target); });
    report.warnings.insert(report.warnings.end(), plan.warnings.begin(), plan.warnings.end());
    // A file of which nothing was converted and something failed would be taken for a result.
    report.is_written = conversion.changed || report.failed_count() == 0;
    if (report.is_written)
      for (const ResourceCopy& copy : plan.copies) report.copies.push_back(copy.to);
    for (const NewResource& file : conversion.files) {
      report.images.push_back(files.output(file.path));
      std::error_code ignored;
      const bool is_same = fs::is_regular_file(report.images.back(), ignored) &&
                           have_same_bytes(report.images.back(), file.bytes);
      if (!is_same) require_free({}, report.images.back());
      if (const std::string other = list_.names->take(report.images.back(), owner_of_results(job));
          !other.empty())
        throw output_error(shown(job.input) + ": would write " + shown(report.images.back()) +
                           ", which is of " + other + " (rename one)");
    }
    // A resumed run tries again what failed.
    if (report.is_written && !options_.dry_run)
      write(job, source, conversion, plan, report.failed_count() == 0 ? inputs : "", report.images);
    report.seconds = stopwatch.seconds();
  }

 private:
  // An input is replaced only by --force, in a resumed run a result of this conversion, too.
  void require_free(const fs::path& input, const fs::path& output) const {
    if (options_.force) return;
    if (!input.empty() && same_file(input, output))
      throw output_error(shown(output) + ": is the input itself (--force replaces it)");
    std::error_code ignored;
    if (!list_.is_tree || !fs::is_regular_file(output, ignored)) return require_new(output, false);
    if (!journal_.is_own(output))
      throw output_error(output.string() +
                         ": already exists, and is not of this conversion (--force overwrites)");
    if (!options_.resume)
      throw output_error(output.string() +
                         ": already exists (--resume skips finished assets, --force overwrites)");
  }

  // Copies are compared with what they are of: several assets may share one. Files that only converted
  // materials used are not in the result, and have none.
  bool is_done(const AssetJob& job, const std::string& inputs, std::vector<AssetResource> named) const {
    const std::vector<fs::path> files = journal_.files_of(job.name());
    if (files.empty() || !journal_.is_done(inputs, files)) return false;
    const bool is_new_format = job.input.extension() != job.output.extension();  // which names other files
    if (is_new_format) return true;
    std::set<std::string> kept;
    for (const AssetResource& resource :
         resources_of_asset(FileSource(job.output), job.output, FolderResources(job)))
      kept.insert(resource.path);
    std::erase_if(named, [&](const AssetResource& resource) { return !kept.contains(resource.path); });
    return plan_resources(job, named, [](const fs::path&) {}).copies.empty();
  }

  // The asset comes last, so that it never lies without its parts.
  void write(const AssetJob& job, const ByteSource& source, const AssetConversion& conversion,
             const ResourcePlan& plan, const std::string& inputs, const std::vector<fs::path>& images) {
    std::vector<std::unique_ptr<NewFile>> files;
    for (std::size_t i = 0; i < images.size(); ++i) {
      files.push_back(std::make_unique<NewFile>(images[i]));
      files.back()->add(conversion.files[i].bytes);
    }
    if (conversion.changed || !same_file(job.input, job.output)) {
      files.push_back(std::make_unique<NewFile>(job.output));
      if (conversion.changed)
        add_pieces(*files.back(), conversion.pieces, source);
      else
        add_pieces(*files.back(), {{"", 0, source.size()}}, source);
    }
    for (const std::unique_ptr<NewFile>& file : files) file->finish();
    if (list_.is_tree) journal_.claim(options_.force);
    if (list_.is_tree && !plan.copies.empty()) {  // so that a later run knows them
      std::vector<fs::path> paths;
      for (const ResourceCopy& copy : plan.copies) paths.push_back(copy.to);
      journal_.begin(paths);
    }
    for (const ResourceCopy& copy : plan.copies) copies_.copy(copy);
    const auto rename = [&] {
      for (const std::unique_ptr<NewFile>& file : files)
        file->commit(list_.is_tree ? Flush::kNo : Flush::kYes);
    };
    if (!list_.is_tree) return rename();
    std::vector<FinishedFile> finished;
    std::vector<fs::path> paths;
    for (const std::unique_ptr<NewFile>& file : files) finished.push_back(finished_file(*file));
    for (const FinishedFile& file : finished) paths.push_back(file.path);
    journal_.begin(paths);
    journal_.commit(job.name(), inputs, finished, options_.force, rename);
    flush_to_disk(folder_of_asset(job.output), folder_of_asset(job.output));
  }

  const AssetList& list_;
  const ConvertOptions& options_;
  const AssetOptions conversion_;
  Journal journal_;
  SharedCopies copies_;
};

AssetReport report_named(const AssetJob& job) {
  AssetReport report;
  report.input = job.input;
  report.output = job.output;
  return report;
}

// Where the result, its images and copies go.
std::set<fs::path> folders_of(const AssetJob& job) {
  std::set<fs::path> folders = {folder_of_asset(job.output)};
  for (const fs::path& file : job.files) folders.insert(folder_of_asset(job.copy_of(file)));
  return folders;
}

// Converts an asset; of several, a failure is a part of the report.
AssetReport report_of(AssetRunner& runner, const AssetList& list, const ConvertOptions& options,
                      std::size_t i) {
  const AssetJob& job = list.jobs[i];
  AssetReport report;
  try {
    if (interruption()) throw Error(ErrorKind::kInterrupted, "interrupted", EINTR);
    const std::vector<std::string> troubles = with_repeats([&] {
      report = report_named(job);
      runner.run(job, report);
    });
    for (const std::string& trouble : troubles) report.warnings.push_back("tried again after " + trouble);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted)
      throw Error(error.kind(),
                  std::string("interrupted: finished assets are complete") +
                      (list.is_tree ? " (--resume converts the others)" : ""),
                  options.part ? EINTR : 0);
    if (list.jobs.size() == 1 && !list.is_tree) throw;
    report.failure = error.what();
    report.failure_code = error.system_code();
  } catch (const std::bad_alloc&) {
    report.failure = shown(job.input) + ": out of memory (use fewer --threads)";
  }
  return report;
}

std::string progress_text(std::size_t done, std::size_t all) {
  return std::to_string(done) + " of " + std::to_string(all) + " assets";
}

}  // namespace

ConversionNote conversion_of_assets(const ConvertOptions& options) {
  return conversion_note("assets", options.to.name,
                         *specgloss_projection(options.prior, options.instructions), options);
}

std::vector<AssetReport> run_assets(const AssetList& list, const ConvertOptions& options,
                                    const ConversionNote& conversion,
                                    const std::function<void(const AssetReport&)>& finished) {
  const std::size_t threads = std::min(static_cast<std::size_t>(options.threads()), list.jobs.size());
  AssetRunner runner(list, options, conversion);
  set_image_limits({1, options.memory_bytes() / std::max<std::size_t>(threads, 1)});
  std::vector<AssetReport> reports(list.jobs.size());
  Progress line(progress_text(0, list.jobs.size()), list.jobs.size(), !options.quiet);
  std::size_t done = 0;
  const auto finish = [&](std::size_t i, AssetReport report) {
    reports[i] = std::move(report);
    line.hide();
    finished(reports[i]);
    line.relabel(progress_text(++done, list.jobs.size()));
    line.advance();
  };
  ApartJobs apart;
  apart.count = list.jobs.size();
  apart.at_once = static_cast<unsigned>(threads);
  apart.work = [&](std::size_t i, const std::function<void(double)>&) {
    return packed(report_of(runner, list, options, i));
  };
  apart.finished = [&](std::size_t i, std::string result) {
    finish(i, unpacked<AssetReport>(std::move(result)));
  };
  apart.clean = [&](std::size_t i) {
    for (const fs::path& folder : folders_of(list.jobs[i])) remove_unfinished(folder);
  };
  apart.crashed = [&](std::size_t i, const std::string& reason) {
    AssetReport report = report_named(list.jobs[i]);
    report.failure = shown(report.input) + ": " + reason;
    if (list.jobs.size() == 1 && !list.is_tree) throw input_error(report.failure);
    finish(i, std::move(report));
  };
  run_apart(apart);
  return reports;
}

}  // namespace remap
