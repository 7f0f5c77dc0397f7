#include "core/input_file.hpp"

#include <cerrno>

#include "core/errors.hpp"
#include "core/read_file.hpp"
#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail_to_read(const fs::path& path) {
  throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", errno);
}

// To open a pipe would wait for its writer, and to open a device may do something.
int opened(const fs::path& path) {
  require_regular_file(path);
  return open_to_read(path);
}

}  // namespace

InputFile::InputFile(const fs::path& path) : path_(path), own_(opened(path)), descriptor_(own_.get()) {
  look();
}

InputFile::InputFile(const fs::path& path, int descriptor) : path_(path), own_(-1), descriptor_(descriptor) {
  look();
}

void InputFile::look() {
  const std::optional<FileFacts> found = descriptor_ < 0 ? std::nullopt : facts_of(descriptor_);
  if (!found) fail_to_read(path_);
  // The name may lead elsewhere by now.
  if (found->type != fs::file_type::regular) throw input_error(path_.string() + ": is not a file");
  size_ = found->size;
}

std::size_t InputFile::read(std::uintmax_t place, char* bytes, std::size_t size) const {
  std::size_t done = 0;
  while (done < size) {
    const std::ptrdiff_t count = read_at(descriptor_, place + done, bytes + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(path_);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

}  // namespace remap
