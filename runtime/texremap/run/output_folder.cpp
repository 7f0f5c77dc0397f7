#include <set>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "texremap/run/run_jobs.hpp"

namespace remap {
namespace fs = std::filesystem;

OutputFolder::OutputFolder(const ConvertPlan& plan) : plan_(plan) {
  if (plan.list.kind == ListedKind::kAssets && !plan.list.is_of_folder) return;
  journal_.emplace(plan.output, plan.conversion, plan.part);
  if (!plan.force) journal_->require_own();
}

void OutputFolder::require_free(const fs::path& file) const {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(file, ignored);
  if (!fs::exists(status)) return;
  if (fs::is_directory(file, ignored))
    throw output_error(
        file.string() +
        ": is a folder, but a file would be written here (choose another path, or rename the folder)");
  if (plan_.force) return;
  const bool is_own = journal_ && journal_->is_own(file);
  // If the user gives the maps one by one, an earlier run may have made this file from other maps of the same
  // names.
  if (is_own && plan_.list.is_of_folder) return;
  throw output_error(file.string() + ": already exists" +
                     (is_own     ? " and was made from other maps"
                      : journal_ ? " and was not made by this conversion"
                                 : "") +
                     " (--force overwrites)");
}

void OutputFolder::take(const fs::path& file, const std::string& owner) const {
  if (const std::string other = plan_.list.names->take(file, owner); !other.empty())
    throw output_error(written_twice_text(file, other, owner));
}

bool OutputFolder::may_be_done(const std::vector<fs::path>& files) const {
  return !plan_.force && journal_ && !files.empty() && journal_->is_own(files.front());
}

bool OutputFolder::is_done(const std::string& inputs, const std::vector<fs::path>& files) const {
  return may_be_done(files) && journal_->is_done(inputs, files);
}

std::vector<fs::path> OutputFolder::files_of(const std::string& entry) const {
  return journal_ ? journal_->files_of(entry) : std::vector<fs::path>();
}

void OutputFolder::begin(const std::vector<fs::path>& files) {
  if (!journal_ || files.empty()) return;
  if (plan_.list.is_of_folder) journal_->claim(plan_.force);
  journal_->begin(files);
}

void OutputFolder::commit(const std::string& entry, const std::string& inputs,
                          const std::vector<FinishedFile>& files, const std::function<void()>& rename) {
  if (!journal_) return rename();
  journal_->commit(entry, inputs, files, plan_.force, rename);
  std::set<fs::path> folders;
  for (const FinishedFile& file : files) folders.insert(file.path.parent_path());
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (fs::exists(folder, ignored)) flush_to_disk(folder, folder);
}

}  // namespace remap
