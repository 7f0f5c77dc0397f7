// This file declares everything that differs between operating systems. No other part of the runtime asks
// which system it runs on: CMake chooses the system_*.cpp of POSIX, Windows or WebAssembly (with what its
// host knows).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace remap {

// The small letter of a capital one of any script; other characters as they are.
char32_t small_letter(char32_t letter);

// Files. What fails returns an empty value, false, nothing, or a descriptor below 0, and leaves the reason in
// errno.

struct FileFacts {
  std::filesystem::file_type type = std::filesystem::file_type::unknown;
  std::uintmax_t size = 0;
  // Equal for all names and links of one file.
  std::pair<std::uint64_t, std::uint64_t> identity;
};
std::optional<FileFacts> facts_of(const std::filesystem::path& path);
std::optional<FileFacts> facts_of(int descriptor);

// Does not wait for the writer of a pipe; wait_for_writers() makes reads wait.
int open_to_read(const std::filesystem::path& path);
void wait_for_writers(int descriptor);
// Bytes from `place` on, or from where the last call ended; fewer than `size` may come, and 0 at the end.
std::ptrdiff_t read_at(int descriptor, std::uintmax_t place, char* bytes, std::size_t size);
std::ptrdiff_t read_on(int descriptor, char* bytes, std::size_t size);

// A new file, to be written and read; `stream` has it as a descriptor. Fails where the name exists, also as a
// link. Its permissions are those that the user gives to new files (umask).
std::FILE* create_file(const std::filesystem::path& path);
int descriptor_of(std::FILE* stream);

// The program's own file `below` a folder that others may write into, such as a journal. No link below the
// folder is followed. Fails unless it is a regular file of one name that belongs to this user (EPERM).
// kAppend creates it.
enum class OwnFile { kRead, kAppend };
int open_own_file(const std::filesystem::path& folder, const std::filesystem::path& below, OwnFile use);
// One write at the end of a file, which waits for the disk.
bool append_to_file(int descriptor, std::string_view text);
// Waits until the disk has the content of a file or the names of a folder. Some file systems cannot, which is
// no failure.
bool wait_for_disk(int descriptor);
bool wait_for_disk(const std::filesystem::path& path);

// A folder for this user alone: the XXXXXX at the end of `name` become others.
bool create_scratch_folder(std::string& name);

// The lock of a folder while the object lives. A file system without locks leaves runs in one folder at the
// same time unprotected, and nothing else. Whoever may read the folder can hold its lock, so waiting ends
// after a minute: runs hold it for the time of a few renames.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  // False where another process has kept the lock for all that time.
  bool is_held() const noexcept { return is_held_; }

 private:
  bool is_held_ = true;
  std::intptr_t handle_;
};

// The error of the standard library, as errno.
inline int errno_of(const std::error_code& failure) { return failure.default_error_condition().value(); }

// Processes.

int own_process();
bool has_ended(int process);
std::string machine_name();             // empty where it is not known
std::uint64_t memory_size();            // of this machine, in bytes; 0 where it is not known
std::filesystem::path program_file();   // of this process; empty where it is not known
void raise_limit_of_open_files();       // as far as the system allows
void fail_at_limit_of_file_size();      // writes beyond it fail, and do not end the process
void watch_signals(void (*note)(int));  // interruption.hpp says which, and what happens then

// A copy of this process, and the stream of bytes between both.
struct ProcessCopy {
  int process = 0;
  int descriptor = -1;
};
// The copy calls `serve` with its end of the stream and ends; it also ends with this process, which must have
// one thread. None where the system makes no copies.
std::optional<ProcessCopy> copy_process(const std::function<void(int descriptor)>& serve);
// Closes the stream and waits for the end: `by signal 11 (Segmentation fault)`, or `with exit code 0`.
std::string end_of(const ProcessCopy& copy);
// Asks the process to stop, as Ctrl-C does.
void interrupt(const ProcessCopy& copy);
// Writes all to the stream; false where the other side has ended.
bool send_all(int descriptor, const std::string& bytes);
// Which of the descriptors can be read or have ended; those below 0 cannot. Waits until one can, a signal
// comes, or a tenth of a second is over.
std::vector<bool> wait_to_read(const std::vector<int>& descriptors);

struct ResourceUse {
  double processor_seconds = 0.0;     // of all threads
  std::size_t peak_memory_bytes = 0;  // resident
};

// The use of this process since it began, and of its copies that have ended (peak_memory_bytes: the largest
// of them); zeros where the system does not report it.
ResourceUse resource_use() noexcept;

}  // namespace remap
