#include "core/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <set>
#include <utility>

#include "core/errors.hpp"
#include "core/owner_tag.hpp"
#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kUnfinished = ".unfinished-";

[[noreturn]] void fail_to_write(const fs::path& path, int code) {
  throw system_error(ErrorKind::kOutput, path.string() + ": cannot be written", code);
}

// Returns the mark in an unfinished file's name, before its random letters, or "" if the name has no mark.
std::string_view mark_in(std::string_view name) {
  const std::size_t found = name.rfind(kUnfinished);
  if (!name.starts_with('.') || found == std::string_view::npos) return {};
  std::string_view mark = name.substr(found + kUnfinished.size());
  mark = mark.substr(0, mark.find('.'));
  return mark.substr(0, mark.rfind('-'));
}

// Returns the first `size` bytes of `text`, and drops a UTF-8 character that this cuts.
std::string cut(std::string text, std::size_t size) {
  if (text.size() <= size) return text;
  while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80) --size;
  return text.substr(0, size);
}

// Removes abandoned files only once per folder, because a run writes thousands of files.
void remove_abandoned_once(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> done;
  const std::lock_guard lock(mutex);
  if (done.insert(folder).second) remove_unfinished(folder);
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

void replace(const fs::path& unfinished, const fs::path& path) {
  std::error_code failure;
  const fs::file_status found = fs::status(path, failure);
  if (fs::exists(found) && fs::is_other(found))
    throw output_error(path.string() +
                       ": cannot be written: is a device or a pipe, which a file must not replace");
  fs::rename(unfinished, path, failure);
  if (failure) fail_to_write(path, errno_of(failure));
}

}  // namespace

void remove_unfinished(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (is_stale_owner(mark_in(name)) && entry.is_regular_file(ignored)) fs::remove(entry.path(), ignored);
  }
}

fs::path unfinished_name(const fs::path& path) {
  remove_abandoned_once(folder_of(path));
  constexpr std::size_t kLongestFileName = 255;  // in bytes, on most file systems
  const std::string end =
      std::string(kUnfinished) + owner_tag() + "-" + random_letters() + path.extension().string();
  const std::string stem = end.size() < kLongestFileName
                               ? cut(path.stem().string(), kLongestFileName - 1 - end.size())
                               : std::string();
  return path.parent_path() / ("." + stem + end);
}

std::string with_final_name(std::string message, const fs::path& unfinished, const fs::path& path) {
  const std::string name = unfinished.filename().string(), final_name = path.filename().string();
  for (std::size_t at = message.find(name); at != std::string::npos;
       at = message.find(name, at + final_name.size()))
    message.replace(at, name.size(), final_name);
  return message;
}

void commit_file(const fs::path& unfinished, const fs::path& path, Flush flush) {
  try {
    if (flush == Flush::kYes) flush_to_disk(unfinished, path);
    replace(unfinished, path);
    if (flush == Flush::kYes) wait_for_disk(folder_of(path));  // ignores an error, because the file exists
  } catch (const Error&) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw;
  }
}

void require_new(const fs::path& path, bool force) {
  std::error_code ignored;
  if (!force && fs::is_regular_file(path, ignored))
    throw output_error(path.string() + ": already exists (--force overwrites)");
}

fs::path installed(const fs::path& below) {
  const fs::path program = program_file(), found = program.parent_path().parent_path() / below;
  std::error_code failure;
  return !program.empty() && fs::exists(found, failure) ? found : fs::path();
}

void create_parent(const fs::path& path) {
  const fs::path parent = path.parent_path();
  if (parent.empty()) return;
  std::error_code failure;
  fs::create_directories(parent, failure);
  if (failure)
    throw system_error(ErrorKind::kOutput, parent.string() + ": folder cannot be created", errno_of(failure));
  if (!fs::is_directory(parent))
    throw output_error(parent.string() + ": folder cannot be created: not a folder");
}

NewFile::NewFile(const fs::path& path) : path_(path) {
  create_parent(path);
  unfinished_ = unfinished_name(path);
  file_ = create_file(unfinished_);
  if (file_ == nullptr) fail_to_write(path, errno);
}

NewFile::~NewFile() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code ignored;
  if (!unfinished_.empty()) fs::remove(unfinished_, ignored);
}

void NewFile::add(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail_to_write(path_, errno);
}

const fs::path& NewFile::finish() {
  if (std::fflush(file_) != 0) fail_to_write(path_, errno);
  return unfinished_;
}

std::shared_ptr<const InputFile> NewFile::content() const {
  return std::make_shared<const InputFile>(unfinished_, descriptor_of(file_));
}

void NewFile::flush_to_disk() const {
  if (!wait_for_disk(descriptor_of(file_))) fail_to_write(path_, errno);
}

void NewFile::commit(Flush flush) {
  finish();
  if (flush == Flush::kYes) flush_to_disk();
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail_to_write(path_, errno);
  replace(unfinished_, path_);
  unfinished_.clear();
  if (flush == Flush::kYes) wait_for_disk(folder_of(path_));  // ignores an error, because the file exists
}

void write_file(const fs::path& path, std::string_view content, Flush flush) {
  NewFile file(path);
  file.add(content);
  file.commit(flush);
}

void flush_to_disk(const fs::path& path, const fs::path& shown) {
  if (!wait_for_disk(path)) fail_to_write(shown, errno);
}

void add_copy(const InputFile& from, NewFile& to) {
  for_pieces(from, [&](std::string_view piece) { to.add(piece); });
}

void copy_whole_file(const fs::path& from, const fs::path& to) {
  const InputFile source(from);
  NewFile copy(to);
  add_copy(source, copy);
  copy.commit();
}

void require_own_folder(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_symlink(folder, ignored))
    throw output_error(folder.string() + ": is a link, which the program does not follow here (remove it)");
}

OwnedFile::OwnedFile(const fs::path& folder, const fs::path& below, OwnFile use)
    : path_(folder / below), file_(open_own_file(folder, below, use)) {
  if (file_.is_open() || (use == OwnFile::kRead && errno == ENOENT)) return;
  if (errno == EPERM || errno == ELOOP || errno == ENOTDIR || errno == ENXIO)
    throw output_error(
        path_.string() +
        ": is a link, belongs to another user, or is not a file; texremap reads and writes its "
        "journals only in files of its own user (remove it, or choose another folder)");
  throw system_error(ErrorKind::kOutput, path_.string() + ": cannot be opened", errno);
}

void OwnedFile::append(std::string_view text) const {
  if (!append_to_file(file_.get(), text)) fail_to_write(path_, errno);
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  if (a == b || std::filesystem::equivalent(a, b, ignored)) return true;
  const std::filesystem::path canonical_a = std::filesystem::weakly_canonical(a, ignored),
                              canonical_b = std::filesystem::weakly_canonical(b, ignored);
  return !canonical_a.empty() && canonical_a == canonical_b;
}

ScratchFolder::ScratchFolder(const std::string& prefix) {
  std::string name = (fs::temp_directory_path() / (prefix + "-XXXXXX")).string();
  if (!create_scratch_folder(name)) throw output_error(name + ": cannot be created: " + std::strerror(errno));
  path_ = name;
}

}  // namespace remap
