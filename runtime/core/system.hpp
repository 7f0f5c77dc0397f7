// This file declares everything that differs between operating systems. No other part of the runtime asks
// which system it runs on: CMake chooses the system_*.cpp for POSIX, Windows or WebAssembly.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace remap {

// Returns the lower case of an upper-case letter of any script, and other characters unchanged.
char32_t small_letter(char32_t letter);

// The following functions handle files. If one fails, it returns an empty value, false or a descriptor below
// 0, and the reason is in errno.

struct FileFacts {
  std::filesystem::file_type type = std::filesystem::file_type::unknown;
  std::uintmax_t size = 0;
  // The identity is equal for all names and links of one file.
  std::pair<std::uint64_t, std::uint64_t> identity;
};
std::optional<FileFacts> facts_of(const std::filesystem::path& path);
std::optional<FileFacts> facts_of(int descriptor);

// Opens a file, and does not wait for the writer of a pipe. wait_for_writers() makes reads wait.
int open_to_read(const std::filesystem::path& path);
void wait_for_writers(int descriptor);
// Reads bytes that begin at `place`, or where the last call ended. It may return fewer than `size`. It
// returns 0 at the end.
std::ptrdiff_t read_at(int descriptor, std::uintmax_t place, char* bytes, std::size_t size);
std::ptrdiff_t read_on(int descriptor, char* bytes, std::size_t size);

// Creates a file for writing and reading. descriptor_of() returns its descriptor. Fails if the name exists,
// even as a link. The umask of the user decides its permissions.
std::FILE* create_file(const std::filesystem::path& path);
int descriptor_of(std::FILE* stream);

// Opens the program's own file `below` in a folder that others may write into, such as a journal. Follows no
// link below the folder. Fails with EPERM if it is not a regular file of this user, or if it has several
// names. kAppend creates the file.
enum class OwnFile { kRead, kAppend };
int open_own_file(const std::filesystem::path& folder, const std::filesystem::path& below, OwnFile use);
// Appends to a file with one write, and waits for the disk.
bool append_to_file(int descriptor, std::string_view text);
// Waits until the disk has the content of a file or the names of a folder. Returns true also for file systems
// that cannot do this.
bool wait_for_disk(int descriptor);
bool wait_for_disk(const std::filesystem::path& path);

// Creates a folder that only this user can open. Replaces the XXXXXX at the end of `name`.
bool create_scratch_folder(std::string& name);

// A FolderLock locks a folder while the object lives. If the file system has no locks, runs in the same
// folder are not protected from each other. Anyone who can read the folder can hold its lock, so waiting ends
// after a minute. Runs hold the lock only for a few renames.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  // Returns false if another process has kept the lock for the whole minute.
  bool is_held() const noexcept { return is_held_; }

 private:
  bool is_held_ = true;
  std::intptr_t handle_;
};

// Returns the error of the standard library as errno.
inline int errno_of(const std::error_code& failure) { return failure.default_error_condition().value(); }

// The following functions handle processes.

int own_process();
bool has_ended(int process);
std::string machine_name();             // empty if it is unknown
std::uint64_t memory_size();            // memory of this machine in bytes, 0 if it is unknown
std::filesystem::path program_file();   // path of this program, empty if it is unknown
void raise_limit_of_open_files();       // raises the limit as far as the system allows
void fail_at_limit_of_file_size();      // makes writes beyond the limit fail instead of ending the process
void watch_signals(void (*note)(int));  // command_line/progress.hpp lists the signals and their effect

// A ProcessCopy is a copy of this process, with the stream of bytes between the two.
struct ProcessCopy {
  int process = 0;
  int descriptor = -1;
};
// Starts a copy of this process, which must have only one thread. The copy calls `serve` with its end of the
// stream, and then ends. It also ends if this process ends. Returns nothing if the system cannot copy
// processes.
std::optional<ProcessCopy> copy_process(const std::function<void(int descriptor)>& serve);
// Closes the stream and waits. Returns `by signal 11 (Segmentation fault)`, or `with exit code 0`.
std::string end_of(const ProcessCopy& copy);
// Asks the process to stop, as Ctrl-C does.
void interrupt(const ProcessCopy& copy);
// Writes all bytes to the stream. Returns false if the other side has ended.
bool send_all(int descriptor, const std::string& bytes);
// Waits until a descriptor has data to read or has ended, until a signal comes, or for a tenth of a second.
// Returns which descriptors are ready. Ignores descriptors below 0.
std::vector<bool> wait_to_read(const std::vector<int>& descriptors);

struct ResourceUse {
  double processor_seconds = 0.0;     // processor time of all threads
  std::size_t peak_memory_bytes = 0;  // resident memory
};

// Returns what this process and its ended copies have used since the start. peak_memory_bytes is the peak of
// the process that used the most. Returns zeros if the system does not report it.
ResourceUse resource_use() noexcept;

// An OpenFile is a file descriptor that closes itself.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  ~OpenFile() {
    if (is_open()) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

 private:
  int descriptor_;
};

// A Stopwatch measures the time since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace remap
