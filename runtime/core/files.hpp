// This file writes files. A result appears under its final name when it is complete, or not at all. It also
// checks paths from manifests and journals, because others may have written these files.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/input_file.hpp"
#include "core/system.hpp"

namespace remap {

// Returns a new hidden name for an unfinished file in the folder of `path`:
// `.STEM.unfinished-MARK-LETTERS.EXTENSION`. MARK is the mark of this process (owner_tag()). The extension
// stays, because image writers choose the format by it. The stem is shortened if the name would exceed 255
// bytes. The first call for a folder also removes files of processes of this machine that have ended. A
// process that is killed cannot remove its own files.
std::filesystem::path unfinished_name(const std::filesystem::path& path);

// Removes the unfinished files of ended processes from a folder, even if an earlier call has done so.
void remove_unfinished(const std::filesystem::path& folder);

// Replaces the name `unfinished` by `path` in a message of a library.
std::string with_final_name(std::string message, const std::filesystem::path& unfinished,
                            const std::filesystem::path& path);

// Decides whether the program waits until a result is on the disk. After a power cut, the file then is either
// the old or the new file. Use kNo only for files that can be checked and made again.
enum class Flush { kYes, kNo };

// Gives the finished file its final name. On failure, removes `unfinished` and throws kOutput. Fails if
// `path` exists and is not a regular file (a device, a pipe).
void commit_file(const std::filesystem::path& unfinished, const std::filesystem::path& path,
                 Flush flush = Flush::kYes);

// A NewFile is written piece by piece under an unfinished name. Its destructor removes it if it was not
// committed. It creates missing parent folders. If it throws kOutput, an existing file stays unchanged. It
// opens the file only once, and uses the same descriptor for reading and flushing.
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
  // Returns the finished content, which can be read until commit().
  std::shared_ptr<const InputFile> content() const;
  // Waits until the finished content is on the disk.
  void flush_to_disk() const;
  void commit(Flush flush = Flush::kYes);

 private:
  std::filesystem::path path_, unfinished_;
  std::FILE* file_;
};

// Writes `content` as a new file.
void write_file(const std::filesystem::path& path, std::string_view content, Flush flush = Flush::kYes);

// Waits until the disk has the content of a finished file, or the names in a folder. Call this before and
// after renames that do not flush. If the system refuses, throws kOutput with the path `shown`.
void flush_to_disk(const std::filesystem::path& path, const std::filesystem::path& shown);

// Adds the bytes of a file. Its permissions are not copied, since a stranger may have set them.
void add_copy(const InputFile& from, NewFile& to);

// Copies a file byte for byte and replaces `to`, which is complete or unchanged. Throws kInput if `from` is
// not a readable file, and kOutput if the copy cannot be written.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// An OwnedFile is a file that the program keeps for itself, such as a journal. Others may write into its
// folder. Throws kOutput if somebody has put another file there; see open_own_file() (system.hpp).
class OwnedFile {
 public:
  // Opens the file. With kRead the file may be missing; exists() then returns false.
  OwnedFile(const std::filesystem::path& folder, const std::filesystem::path& below, OwnFile use);
  bool exists() const noexcept { return file_.is_open(); }
  InputFile content() const { return {path_, file_.get()}; }
  // Appends with one write, so that lines of processes do not mix. Waits for the disk. Throws kOutput.
  void append(std::string_view text) const;

 private:
  std::filesystem::path path_;
  OpenFile file_;
};

// Throws kOutput if a folder that the program makes for itself is a link.
void require_own_folder(const std::filesystem::path& folder);

// Returns true if two names lead to the same file. The file need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// Throws kOutput if `path` is a file already, unless `force` is set. All results follow this rule.
void require_new(const std::filesystem::path& path, bool force);

// Returns the path of the installed file `below` in the running program's prefix, or an empty path.
std::filesystem::path installed(const std::filesystem::path& below);

// Creates the folder of `path` if it does not exist. Throws kOutput on failure.
void create_parent(const std::filesystem::path& path);

// A ScratchFolder is a folder `PREFIX-XXXXXX` in the system's temporary folder. Its destructor removes it
// with all its files. The constructor throws kOutput if it cannot make the folder.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& prefix);
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

// Returns `TAG-PID` of this process. The tag has eight hexadecimal digits. They identify the machine since it
// was started, and the PID namespace, which differs between containers.
std::string owner_tag();

// Returns random letters from the system, for file names that nobody can guess in advance.
std::string random_letters();

// Returns true if `mark` is of a process of this machine and namespace that has ended. Returns false for
// other texts, and for a mark of another machine, because this machine cannot check it. If a new process has
// the same number, returns false until this process has ended, too.
bool is_stale_owner(std::string_view mark);

// Returns why `text` is not a path below a folder: it is absolute, it leads up with `..`, or it has control
// characters or line breaks. Returns an empty text for a safe path.
std::string fault_of_relative(const std::string& text);

// Returns `text` as a path below a folder. It is empty for the folder itself. If `text` is not safe, throws
// kInput, beginning with `context`.
std::filesystem::path safe_relative(const std::string& text, const std::string& context);
// Checks a single name in the same way. The name may be empty.
std::filesystem::path safe_name(const std::string& text, const std::string& context);

// Returns true for the name of a file of this program in an output folder (`.texremap*`). Other files must
// not use such names.
bool is_own_name(const std::filesystem::path& name);

}  // namespace remap
