#include <cerrno>
#include <chrono>
#include <csignal>
#include <cwctype>
#include <fcntl.h>
#include <locale.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <wctype.h>

#include "core/files.hpp"
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
  if (action.sa_handler == SIG_IGN) return;  // nohup makes the program ignore this signal
  action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(flags | SA_RESTART);
  sigaction(signal, &action, nullptr);
}

std::optional<struct stat> status_of(int descriptor) {
  struct stat found {};
  if (::fstat(descriptor, &found) != 0) return std::nullopt;
  return found;
}

// Returns the user that owns new files of a folder. On some network storage this is not the current user.
uid_t owner_of_new_files(int folder) {
  const std::string name = ".unfinished-owner-" + random_letters();
  const OpenFile file(
      ::openat(folder, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!file.is_open()) return ::geteuid();
  const auto found = status_of(file.get());
  ::unlinkat(folder, name.c_str(), 0);
  return found ? found->st_uid : ::geteuid();
}

bool is_own(int file, int folder) {
  const auto found = status_of(file);
  if (!found || !S_ISREG(found->st_mode) || found->st_nlink > 1) return false;
  return found->st_uid == ::geteuid() || found->st_uid == owner_of_new_files(folder);
}

}  // namespace

// Uses the locale C.UTF-8, because without a locale the C library knows only ASCII letters.
char32_t small_letter(char32_t letter) {
  static const ::locale_t unicode = ::newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  const auto wide = static_cast<std::wint_t>(letter);
  if (unicode == nullptr) return static_cast<char32_t>(std::towlower(wide));
  return static_cast<char32_t>(::towlower_l(wide, unicode));
}

std::optional<FileFacts> facts_of(const fs::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return facts_of(found);
}

std::optional<FileFacts> facts_of(int descriptor) {
  const auto found = status_of(descriptor);
  return found ? std::optional(facts_of(*found)) : std::nullopt;
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

std::FILE* create_file(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  std::FILE* const stream = file < 0 ? nullptr : ::fdopen(file, "w+b");
  if (stream == nullptr && file >= 0) ::close(file);
  return stream;
}

int descriptor_of(std::FILE* stream) { return ::fileno(stream); }

int open_own_file(const fs::path& folder, const fs::path& below, OwnFile use) {
  int at = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const fs::path inner = below.parent_path();
  for (auto part = inner.begin(); at >= 0 && part != inner.end(); ++part) {
    const OpenFile above(at);
    at = ::openat(above.get(), part->c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  }
  if (at < 0) return -1;
  const OpenFile last(at);
  const int flags = use == OwnFile::kRead ? O_RDONLY : O_WRONLY | O_CREAT | O_APPEND;
  int file = ::openat(last.get(), below.filename().c_str(),
                      flags | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
  if (file >= 0 && !is_own(file, last.get())) {
    ::close(file);
    file = -1;
    errno = EPERM;
  }
  return file;
}

bool append_to_file(int descriptor, std::string_view text) {
  return ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
         ::fdatasync(descriptor) == 0;
}

bool wait_for_disk(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS; }

// If a path cannot be opened, it is read-only, and the disk already has it. So the function returns true.
bool wait_for_disk(const fs::path& path) {
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return !file.is_open() || wait_for_disk(file.get());
}

bool create_scratch_folder(std::string& name) { return ::mkdtemp(name.data()) != nullptr; }

FolderLock::FolderLock(const fs::path& folder)
    : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  constexpr auto kStep = std::chrono::milliseconds(10);
  auto left = std::chrono::milliseconds(std::chrono::minutes(1));
  while (handle_ >= 0 && ::flock(static_cast<int>(handle_), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) return;  // the file system has no locks
    if (left <= left.zero()) {
      is_held_ = false;
      return;
    }
    std::this_thread::sleep_for(kStep);
    left -= kStep;
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
  // This signal means that nobody reads the output any more. Every further write raises SIGPIPE again, which
  // must not end the process before it has removed its files.
  watch(SIGPIPE, 0, note);
}

}  // namespace remap
