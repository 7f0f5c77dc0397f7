// Writes files. A result appears under its final name complete or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/input_file.hpp"
#include "core/read_file.hpp"

namespace remap {

// A hidden name in the folder of `path` for an unfinished file: `.STEM.unfinished-MARK.EXTENSION` with the
// mark of this process (process_mark.hpp), and the extension by which image writers choose the format. The
// first call for a folder removes from it the unfinished files of processes of this machine that have ended:
// those that were killed could not.
std::filesystem::path unfinished_name(const std::filesystem::path& path);

// A library's message about the file `unfinished`, with the name of `path` in its place.
std::string with_final_name(std::string message, const std::filesystem::path& unfinished,
                            const std::filesystem::path& path);

// Whether a result waits until the disk has it, so that a power cut leaves the old file or the new one. Only
// what its reader can verify and make again does without.
enum class Flush { kYes, kNo };

// Gives the finished file its final name. On failure it removes `unfinished` and throws kOutput; a final name
// of something that is not a file (a device, a pipe) fails.
void commit_file(const std::filesystem::path& unfinished, const std::filesystem::path& path,
                 Flush flush = Flush::kYes);

// A file that is written piece by piece under an unfinished name, and removed unless it is committed. Creates
// missing parent folders. Throws kOutput, and then leaves an existing file unchanged. It is opened once: what
// was written is read, and waits for the disk, through the same descriptor.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void add(std::string_view text);
  // Ends the content. Returns the name that the file has until commit().
  const std::filesystem::path& finish();
  const std::filesystem::path& path() const noexcept { return path_; }
  const std::filesystem::path& unfinished() const noexcept { return unfinished_; }  // the name until commit()
  std::FILE* stream() const noexcept { return file_; }
  // The finished content, to be read until commit().
  std::shared_ptr<const InputFile> content() const;
  // Waits until the disk has the finished content.
  void flush_to_disk() const;
  void commit(Flush flush = Flush::kYes);

 private:
  std::filesystem::path path_, unfinished_;
  std::FILE* file_;
};

// Writes `content` as a new file.
void write_file(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::kYes);

// Waits until the disk has the content of a finished file, or the names in a folder: before and after renames
// that do not flush, for several files at once. Throws kOutput, naming `shown`, if the system refuses.
void flush_to_disk(const std::filesystem::path& path, const std::filesystem::path& shown);

// Adds the bytes of a file, and gives the new file its permissions.
void add_copy(const InputFile& from, NewFile& to);

// Copies a file byte for byte and replaces `to`, which is complete or unchanged. Throws kInput if `from` is
// not a readable file, kOutput if the copy cannot be written.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Whether two names lead to the same file, which need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// The one rule for results: throws kOutput where `path` is a file already, unless `force`.
void require_new(const std::filesystem::path& path, bool force);

// What is installed as `below` in the prefix of the running program; empty where that is not there.
std::filesystem::path installed(const std::filesystem::path& below);

// Creates the folder of `path` if it does not exist. Throws kOutput on failure.
void create_parent(const std::filesystem::path& path);

}  // namespace remap
