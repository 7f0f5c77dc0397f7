// What differs between systems. Nothing else of the runtime asks which one it is: of the files system_*.cpp,
// CMake takes those of POSIX, of Windows, or of WebAssembly with what its host knows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace remap {

// Files. What fails returns an empty value, false, nothing, or a descriptor below 0, and leaves the reason in
// errno.

struct FileFacts {
  std::filesystem::file_type type = std::filesystem::file_type::unknown;
  std::uintmax_t size = 0;
  // Of what links and other names lead to as well.
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

// A new file, to be written and read; `stream` has it as a descriptor.
std::FILE* create_file(const std::filesystem::path& path);
int descriptor_of(std::FILE* stream);
void copy_permissions(int from, int to);
// One write at the end of a file, which waits for the disk.
bool append_to_file(const std::filesystem::path& path, std::string_view text);
// Waits until the disk has the content of a file or the names of a folder. Some file systems cannot, which is
// no failure.
bool wait_for_disk(int descriptor);
bool wait_for_disk(const std::filesystem::path& path);

// A folder for this user alone: the XXXXXX at the end of `name` become others.
bool create_scratch_folder(std::string& name);

// The lock of a folder while the object lives. A file system without locks leaves runs in one folder at the
// same time unprotected, and nothing else.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::intptr_t handle_;
};

// What the standard library reports, as errno.
inline int errno_of(const std::error_code& failure) { return failure.default_error_condition().value(); }

// Processes.

int own_process();
bool has_ended(int process);
std::string machine_name();             // empty where it is not known
std::filesystem::path program_file();   // of this process; empty where it is not known
void raise_limit_of_open_files();       // as far as the system allows
void fail_at_limit_of_file_size();      // writes beyond it fail, and do not end the process
void watch_signals(void (*note)(int));  // interruption.hpp says which, and what happens then

struct ResourceUse {
  double processor_seconds = 0.0;     // of all threads
  std::size_t peak_memory_bytes = 0;  // resident
};

// The use of this process since it began; zeros where the system does not report it.
ResourceUse resource_use() noexcept;

}  // namespace remap
