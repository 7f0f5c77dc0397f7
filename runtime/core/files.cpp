#include "core/files.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <random>
#include <set>
#include <utility>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "core/plain_text.hpp"
#include "core/system.hpp"
#include "remap/error.hpp"

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
    throw output_error(path_.string() +
                       ": is a link, belongs to another user, or is not a file; texremap reads and writes "
                       "its journals only in files of its own user (remove it, or choose another folder)");
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

namespace {

constexpr std::size_t kTagDigits = 8;

// Returns a text that identifies the machine since it was started, and its PID namespace. The name of the
// machine does not suffice, because cloned machines have the same name.
std::string place_of_processes() {
  std::error_code ignored;
  std::string start;
  try {
    start = read_file("/proc/sys/kernel/random/boot_id");
  } catch (const Error&) {
  }
  return machine_name() + "/" + start + "/" +
         std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string();
}

// Returns the hash FNV-1a with 32 bits (Fowler, Noll, Vo 1991), in hexadecimal digits.
std::string tag_of(const std::string& text) {
  std::uint32_t hash = 0x811c9dc5u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193u;
  std::string tag(kTagDigits, '0');
  for (std::size_t i = kTagDigits; i-- > 0; hash >>= 4) tag[i] = "0123456789abcdef"[hash & 15u];
  return tag;
}

const std::string& own_tag() {
  static const std::string tag = tag_of(place_of_processes()) + "-";
  return tag;
}

}  // namespace

std::string owner_tag() { return own_tag() + std::to_string(own_process()); }

std::string random_letters() {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz234567";
  constexpr std::size_t kCount = 12;  // letters of five bits each
  std::random_device device;
  std::string letters(kCount, ' ');
  for (char& letter : letters) letter = kLetters[device() % kLetters.size()];
  return letters;
}

bool is_stale_owner(std::string_view mark) {
  if (!mark.starts_with(own_tag())) return false;
  mark.remove_prefix(own_tag().size());
  int process = 0;
  const auto [end, failure] = std::from_chars(mark.data(), mark.data() + mark.size(), process);
  if (failure != std::errc() || end != mark.data() + mark.size() || process <= 0) return false;
  return has_ended(process);
}

namespace {

fs::path checked(const std::string& text, const std::string& context, std::string fault) {
  if (!fault.empty()) throw input_error(context + ": \"" + plain(text) + "\" " + fault);
  return text;
}

}  // namespace

std::string fault_of_relative(const std::string& text) {
  const fs::path path = text;
  if (path.has_root_path()) return "is an absolute path";
  if (contains(path, "..")) return "leads out of its folder";
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  return std::ranges::any_of(text, is_control) ? "has control characters" : "";
}

fs::path safe_relative(const std::string& text, const std::string& context) {
  return checked(text, context, fault_of_relative(text));
}

fs::path safe_name(const std::string& text, const std::string& context) {
  const std::string fault = fault_of_relative(text);
  return checked(text, context, fault.empty() && fs::path(text).has_parent_path() ? "is not a name" : fault);
}

bool is_own_name(const fs::path& name) {
  constexpr std::string_view kOwn = ".texremap";
  const std::string text = name.string().substr(0, kOwn.size());
  return std::ranges::equal(text, kOwn,
                            [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

}  // namespace remap
