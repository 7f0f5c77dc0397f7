#include "core/read_file.hpp"

#include <array>
#include <cerrno>
#include <fstream>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/open_file.hpp"
#endif

#include "core/errors.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_to_read(const fs::path& path, int code) {
  throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", code);
}

[[noreturn]] void fail_of_size(const fs::path& path, std::uintmax_t largest) {
  const bool megabytes = largest >= 1 << 20;
  throw Error(ErrorKind::kInput,
              path.string() + ": has more than " + std::to_string(megabytes ? largest >> 20 : largest) +
                  (megabytes ? " MB" : " bytes") + ", the most that is read of such a file");
}

}  // namespace

#ifdef _WIN32

// Names of devices (CON, NUL) are no regular files to the library either.
void require_regular_file(const fs::path& path) {
  std::error_code failure;
  const fs::file_status found = fs::status(path, failure);
  if (!fs::exists(found)) fail_to_read(path, failure ? failure.value() : ENOENT);
  if (!fs::is_regular_file(found))
    throw Error(ErrorKind::kInput, path.string() + (fs::is_directory(found) ? ": is a folder, not a file"
                                                                            : ": is a device, not a file"));
}

std::string read_file(const fs::path& path, std::uintmax_t largest) {
  require_regular_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) fail_to_read(path, errno);
  std::string content;
  std::array<char, 1 << 16> part;
  while (file.read(part.data(), part.size()) || file.gcount() > 0) {
    content.append(part.data(), static_cast<std::size_t>(file.gcount()));
    if (content.size() > largest) fail_of_size(path, largest);
  }
  if (file.bad()) fail_to_read(path, errno);
  return content;
}

#else

namespace {

// What is not a regular file, in words.
std::string kind_text(mode_t mode) {
  if (S_ISDIR(mode)) return "is a folder, not a file";
  if (S_ISFIFO(mode)) return "is a named pipe, not a file (write its content to a file)";
  if (S_ISSOCK(mode)) return "is a socket, not a file (write its content to a file)";
  return "is a device, not a file (give a regular file)";
}

// Whether the shell of the caller has opened what this name leads to.
bool is_handed_down(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  return name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

void require_readable(const fs::path& path, const struct stat& found) {
  if (S_ISREG(found.st_mode) || (S_ISFIFO(found.st_mode) && is_handed_down(path))) return;
  throw Error(ErrorKind::kInput, path.string() + ": " + kind_text(found.st_mode));
}

// Reads to the end. A signal does not end the reading; the second one of interruption.hpp ends the process.
std::string content_of(const OpenFile& file, const fs::path& path, std::uintmax_t largest) {
  std::string content;
  std::array<char, 1 << 16> part;
  for (;;) {
    const ssize_t count = ::read(file.get(), part.data(), part.size());
    if (count == 0) return content;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(ErrorKind::kInput, path.string() + ": reading failed", errno);
    content.append(part.data(), static_cast<std::size_t>(count));
    if (content.size() > largest) fail_of_size(path, largest);
  }
}

}  // namespace

void require_regular_file(const fs::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) fail_to_read(path, errno);
  if (!S_ISREG(found.st_mode))
    throw Error(ErrorKind::kInput, path.string() + ": " + kind_text(found.st_mode));
}

std::string read_file(const fs::path& path, std::uintmax_t largest) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) fail_to_read(path, errno);
  require_readable(path, found);
  const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  // Looked at again, since the name may lead elsewhere by now.
  if (!file.is_open() || ::fstat(file.get(), &found) != 0) fail_to_read(path, errno);
  require_readable(path, found);
  if (S_ISREG(found.st_mode) && static_cast<std::uintmax_t>(found.st_size) > largest)
    fail_of_size(path, largest);
  ::fcntl(file.get(), F_SETFL, 0);  // reads wait for the writer again
  return content_of(file, path, largest);
}

#endif

}  // namespace remap
