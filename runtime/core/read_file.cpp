#include "core/read_file.hpp"

#include <array>
#include <cerrno>

#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "core/open_file.hpp"
#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_to_read(const fs::path& path, int code) {
  throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", code);
}

[[noreturn]] void fail_of_size(const fs::path& path, std::uintmax_t largest) {
  const bool megabytes = largest >= 1 << 20;
  throw Error(ErrorKind::kInput, path.string() + ": has more than " +
                                     std::to_string(megabytes ? largest >> 20 : largest) +
                                     (megabytes ? " MB" : " bytes") + ", which is the limit for such a file");
}

// Returns true if the name leads to a file that the caller's shell has opened.
bool is_handed_down(const fs::path& path) {
  const std::string name = path.lexically_normal().string();
  return name == "/dev/stdin" || name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/");
}

void require_room(const fs::path& path, std::uintmax_t size, std::uintmax_t largest) {
  if (size > largest) fail_of_size(path, largest);
}

// Reads to the end of the pipe. One signal does not stop it. A second signal ends the process
// (interruption.hpp).
std::string content_of_pipe(const fs::path& path, std::uintmax_t largest) {
  const OpenFile file(open_to_read(path));
  if (!file.is_open()) fail_to_read(path, errno);
  wait_for_writers(file.get());
  std::string content;
  std::array<char, 1 << 16> part;
  for (;;) {
    const std::ptrdiff_t count = read_on(file.get(), part.data(), part.size());
    if (count == 0) return content;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(ErrorKind::kInput, path.string() + ": reading failed", errno);
    content.append(part.data(), static_cast<std::size_t>(count));
    require_room(path, content.size(), largest);
  }
}

}  // namespace

std::string read_file(const fs::path& path, std::uintmax_t largest) {
  const std::optional<FileFacts> found = facts_of(path);
  if (found && found->type == fs::file_type::fifo && is_handed_down(path))
    return content_of_pipe(path, largest);
  const InputFile file(path);
  require_room(path, file.size(), largest);
  std::string content;
  for_pieces(file, [&](std::string_view piece) {  // a file may have more bytes than its size
    content += piece;
    require_room(path, content.size(), largest);
  });
  return content;
}

}  // namespace remap
