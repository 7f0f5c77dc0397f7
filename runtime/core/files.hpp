// Writes files. A result appears under its final name complete or not at all.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/input_file.hpp"
#include "core/open_file.hpp"
#include "core/read_file.hpp"
#include "core/system.hpp"

namespace remap {

// A hidden name in the folder of `path` for an unfinished file: `.STEM.unfinished-MARK-LETTERS.EXTENSION`
// with the mark of this process (owner_tag.hpp), random letters, and the extension by which image writers
// choose the format. Each call gives another name. A stem that makes the name longer than 255 bytes is cut.
// The first call for a folder removes from it the unfinished files of processes of this machine that have
// ended: those that were killed could not.
std::filesystem::path unfinished_name(const std::filesystem::path& path);

// Removes what processes that have ended left unfinished in a folder, whatever an earlier call did.
void remove_unfinished(const std::filesystem::path& folder);

// A library's message about the file `unfinished`, with the name of `path` in its place.
std::string with_final_name(std::string message, const std::filesystem::path& unfinished,
                            const std::filesystem::path& path);

// Whether the program waits until a result is on the disk, so that after a power cut the file is the old or
// the new one. kNo is only for files that their reader can verify and make again.
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

// Adds the bytes of a file. Its permissions are not copied, since a stranger may have set them.
void add_copy(const InputFile& from, NewFile& to);

// Copies a file byte for byte and replaces `to`, which is complete or unchanged. Throws kInput if `from` is
// not a readable file, kOutput if the copy cannot be written.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// A file that the program keeps for itself in a folder that others may write into: a journal. See
// open_own_file() (system.hpp). Throws kOutput for what others may have planted under the name.
class OwnedFile {
 public:
  // With kRead the file may be missing: exists() is false then.
  OwnedFile(const std::filesystem::path& folder, const std::filesystem::path& below, OwnFile use);
  bool exists() const noexcept { return file_.is_open(); }
  InputFile content() const { return {path_, file_.get()}; }
  // One write, so that lines of several processes do not mix; it waits for the disk. Throws kOutput.
  void append(std::string_view text) const;

 private:
  std::filesystem::path path_;
  OpenFile file_;
};

// Throws kOutput where a folder that the program makes for itself is a link.
void require_own_folder(const std::filesystem::path& folder);

// Whether two names lead to the same file, which need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// The one rule for results: throws kOutput where `path` is a file already, unless `force`.
void require_new(const std::filesystem::path& path, bool force);

// The path of the installed file `below` in the prefix of the running program; empty if it is missing.
std::filesystem::path installed(const std::filesystem::path& below);

// Creates the folder of `path` if it does not exist. Throws kOutput on failure.
void create_parent(const std::filesystem::path& path);

}  // namespace remap
