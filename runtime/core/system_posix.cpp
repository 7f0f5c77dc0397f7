#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/open_file.hpp"
#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

fs::file_type type_of(mode_t mode) {
  if (S_ISREG(mode)) return fs::file_type::regular;
  if (S_ISDIR(mode)) return fs::file_type::directory;
  if (S_ISFIFO(mode)) return fs::file_type::fifo;
  if (S_ISSOCK(mode)) return fs::file_type::socket;
  return fs::file_type::unknown;
}

FileFacts facts_of(const struct stat& found) {
  return {type_of(found.st_mode), static_cast<std::uintmax_t>(found.st_size), {found.st_dev, found.st_ino}};
}

void watch(int signal, unsigned flags, void (*note)(int)) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  if (action.sa_handler == SIG_IGN) return;  // the program was started to ignore it (nohup)
  action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(flags | SA_RESTART);
  sigaction(signal, &action, nullptr);
}

}  // namespace

std::optional<FileFacts> facts_of(const fs::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return facts_of(found);
}

std::optional<FileFacts> facts_of(int descriptor) {
  struct stat found {};
  if (::fstat(descriptor, &found) != 0) return std::nullopt;
  return facts_of(found);
}

int open_to_read(const fs::path& path) {
  return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
}

void wait_for_writers(int descriptor) { ::fcntl(descriptor, F_SETFL, 0); }

std::ptrdiff_t read_at(int descriptor, std::uintmax_t place, char* bytes, std::size_t size) {
  return ::pread(descriptor, bytes, size, static_cast<off_t>(place));
}

std::ptrdiff_t read_on(int descriptor, char* bytes, std::size_t size) {
  return ::read(descriptor, bytes, size);
}

std::FILE* create_file(const fs::path& path) { return std::fopen(path.c_str(), "w+be"); }

int descriptor_of(std::FILE* stream) { return ::fileno(stream); }

void copy_permissions(int from, int to) {
  struct stat found {};
  if (::fstat(from, &found) == 0) ::fchmod(to, found.st_mode & 07777);
}

bool append_to_file(const fs::path& path, std::string_view text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const bool written = file >= 0 &&
                       ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fdatasync(file) == 0;
  const int failure = errno;
  if (file >= 0) ::close(file);
  errno = failure;
  return written;
}

bool wait_for_disk(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS; }

// What cannot be opened was read-only when it was made.
bool wait_for_disk(const fs::path& path) {
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return !file.is_open() || wait_for_disk(file.get());
}

bool create_scratch_folder(std::string& name) { return ::mkdtemp(name.data()) != nullptr; }

FolderLock::FolderLock(const fs::path& folder)
    : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  while (handle_ >= 0 && ::flock(static_cast<int>(handle_), LOCK_EX) != 0 && errno == EINTR) {
  }
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) ::close(static_cast<int>(handle_));
}

void raise_limit_of_open_files() {
  ::rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

void fail_at_limit_of_file_size() { std::signal(SIGXFSZ, SIG_IGN); }

void watch_signals(void (*note)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) watch(signal, SA_RESETHAND, note);
  // Nobody reads the output any more. Every further write fails with the same signal, which must not end the
  // process before it has cleaned up.
  watch(SIGPIPE, 0, note);
}

}  // namespace remap
