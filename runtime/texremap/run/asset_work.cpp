#include <map>
#include <memory>
#include <mutex>
#include <set>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/system.hpp"
#include "sets/folder_walk.hpp"
#include "texremap/plan/asset_files.hpp"
#include "texremap/plan/asset_formats.hpp"
#include "texremap/run/run_jobs.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

std::string inputs_hash_of(const FileSource& source, const AssetWork& asset,
                           const std::vector<AssetResource>& resources) {
  ContentHash hash;
  hash.add_file(source.file());
  hash.add(asset.image_prefix);
  const FolderResources files(asset);
  for (const AssetResource& resource : resources) {
    std::error_code ignored;
    if (resource.kind != UriKind::kFile) continue;
    const fs::path file = files.input(resource.path);
    hash.add(resource.path);
    if (fs::is_regular_file(file, ignored)) hash.add_file(file);
  }
  return hash.hex();
}

class AssetWorker {
 public:
  AssetWorker(const ConvertPlan& plan, OutputFolder& folder)
      : plan_(plan), options_(std::get<AssetOptions>(plan.work)), folder_(folder) {}

  void run(const Job& job, JobReport& report) {
    const Stopwatch stopwatch;
    const auto& asset = std::get<AssetWork>(job.work);
    const FileSource source(asset.input);
    const FolderResources files(asset);
    std::vector<AssetResource> named;
    if (folder_.has_journal()) named = resources_of_asset(source, asset.input, files);
    const std::string inputs = folder_.has_journal() ? inputs_hash_of(source, asset, named) : "";
    report.was_done = is_done(asset, inputs, named);
    report.results = {{asset.output, {}, false}};
    if (report.was_done) return;
    if (!plan_.force && same_file(asset.input, asset.output))
      throw output_error(display_path(asset.output) + ": is the input itself (--force replaces it)");
    folder_.require_free(asset.output);
    const AssetConversion conversion = convert_asset(source, asset.input, asset.output, options_, files);
    report.materials = conversion.materials;
    report.warnings = conversion.warnings;
    const ResourcePlan beside = plan_resources(asset, conversion.resources,
                                               [&](const fs::path& target) { folder_.require_free(target); });
    report.warnings.insert(report.warnings.end(), beside.warnings.begin(), beside.warnings.end());
    for (const NewResource& file : conversion.files) {
      const fs::path image = files.output(file.path);
      report.results.push_back({image, {}, false});
      std::error_code ignored;
      if (!fs::is_regular_file(image, ignored) ||
          !have_same_bytes(FileSource(image), MemorySource(file.bytes)))
        folder_.require_free(image);
      folder_.take(image, job.owner);
    }
    const bool has_failed = report.failure_text().has_value();
    // Report no result if nothing was converted and something failed.
    if (has_failed && !conversion.changed) report.results.clear();
    if (!report.results.empty()) {
      for (const ResourceCopy& copy : beside.copies) report.copies.push_back(copy.to);
      // Without inputs in the journal, a resumed run tries the failed parts again.
      if (!plan_.dry_run) write(asset, source, conversion, report, beside, has_failed ? "" : inputs);
    }
    report.bytes_read = source.size();
    for (const JobReport::Result& result : report.results) report.bytes_written += size_of({result.path});
    report.seconds = stopwatch.seconds();
  }

 private:
  // Returns true if the results are complete. Compares copies with their sources, because several assets may
  // share a copy. Expects no copies of files that only converted materials used.
  bool is_done(const AssetWork& asset, const std::string& inputs, std::vector<AssetResource> named) const {
    if (!folder_.is_done(inputs, folder_.files_of(asset.name()))) return false;
    const bool is_new_format =
        asset.input.extension() != asset.output.extension();  // the result uses other files
    if (is_new_format) return true;
    std::set<std::string> kept;
    for (const AssetResource& resource :
         resources_of_asset(FileSource(asset.output), asset.output, FolderResources(asset)))
      kept.insert(resource.path);
    std::erase_if(named, [&](const AssetResource& resource) { return !kept.contains(resource.path); });
    return plan_resources(asset, named, [](const fs::path&) {}).copies.empty();
  }

  // Writes the asset last, so that it never exists without the files that it names.
  void write(const AssetWork& asset, const ByteSource& source, const AssetConversion& conversion,
             const JobReport& report, const ResourcePlan& beside, const std::string& inputs) {
    std::vector<std::unique_ptr<NewFile>> files;
    for (std::size_t i = 0; i < conversion.files.size(); ++i) {
      files.push_back(std::make_unique<NewFile>(report.results[i + 1].path));
      files.back()->add(conversion.files[i].bytes);
    }
    if (conversion.changed || !same_file(asset.input, asset.output)) {
      files.push_back(std::make_unique<NewFile>(asset.output));
      if (conversion.changed)
        add_pieces(*files.back(), conversion.pieces, source);
      else
        add_pieces(*files.back(), {{"", 0, source.size()}}, source);
    }
    for (const std::unique_ptr<NewFile>& file : files) file->finish();
    folder_.begin(report.copies);  // a later run then knows that it wrote them
    for (const ResourceCopy& file : beside.copies) copy(file);
    const Flush flush = folder_.has_journal() ? Flush::kNo : Flush::kYes;
    std::vector<FinishedFile> finished;
    std::vector<fs::path> paths;
    if (folder_.has_journal())
      for (const std::unique_ptr<NewFile>& file : files) finished.push_back(finished_file(*file));
    for (const FinishedFile& file : finished) paths.push_back(file.path);
    folder_.begin(paths);
    folder_.commit(asset.name(), inputs, finished, [&] {
      for (const std::unique_ptr<NewFile>& file : files) file->commit(flush);
    });
  }

  // Copies a file that several assets may share. The first of them copies it, and the others wait for the
  // whole file.
  void copy(const ResourceCopy& copy) {
    std::unique_lock all(mutex_);
    std::mutex& own = locks_[copy.to.lexically_normal()];
    all.unlock();
    const std::lock_guard lock(own);
    std::error_code ignored;
    if (fs::is_regular_file(copy.to, ignored) && have_same_bytes(FileSource(copy.from), FileSource(copy.to)))
      return;
    copy_whole_file(copy.from, copy.to);
  }

  const ConvertPlan& plan_;
  const AssetOptions options_;
  OutputFolder& folder_;
  std::mutex mutex_;                      // of `locks_`
  std::map<fs::path, std::mutex> locks_;  // keyed by the copy; entries are never removed
};

}  // namespace

JobWorker asset_worker(const ConvertPlan& plan, OutputFolder& folder) {
  const auto worker = std::make_shared<AssetWorker>(plan, folder);
  return [worker](const Job& job, const std::function<void(double)>&, JobReport& report) {
    worker->run(job, report);
  };
}

}  // namespace remap
