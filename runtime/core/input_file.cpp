#include "core/input_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <mutex>
#include <utility>

#include "core/errors.hpp"
#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// A Confinement is a folder to which inputs are confined. It has two forms of its path: as file names begin
// with it, and with links resolved.
struct Confinement {
  fs::path name, place;
};

std::mutex confinement_mutex;
std::shared_ptr<const std::vector<Confinement>> confinements;  // null if there are none

[[noreturn]] void fail_to_read(const fs::path& path) {
  throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", errno);
}

// Returns a description of a file that is not a regular file.
std::string kind_text(fs::file_type type) {
  if (type == fs::file_type::directory) return "is a folder, not a file";
  if (type == fs::file_type::fifo) return "is a named pipe, not a file (write its content to a file)";
  if (type == fs::file_type::socket) return "is a socket, not a file (write its content to a file)";
  return "is a device, not a file (give a regular file)";
}

fs::path without_end(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();  // the path `tree/` has an empty filename
}

bool lies_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// Compares the open file with the file of the resolved name, because somebody may have changed the name in
// the meantime.
void require_confined(const fs::path& path, int descriptor) {
  std::shared_ptr<const std::vector<Confinement>> all;
  {
    const std::lock_guard lock(confinement_mutex);
    all = confinements;
  }
  if (!all) return;
  const std::optional<FileFacts> found = facts_of(descriptor);
  const fs::path name = fs::absolute(path).lexically_normal();
  for (const Confinement& folder : *all) {
    if (!lies_below(name, folder.name)) continue;
    std::error_code failure;
    const fs::path place = fs::canonical(path, failure);
    const std::optional<FileFacts> there = failure ? std::nullopt : facts_of(place);
    if (!there || !found || there->identity != found->identity || !lies_below(place, folder.place))
      throw input_error(path.string() + ": is a link that leads out of " + folder.name.string() +
                        " (--follow-links reads it)");
  }
}

// Checks the file before it opens it. To open a pipe would wait for its writer, and to open a device may have
// effects.
int opened(const fs::path& path) {
  require_regular_file(path);
  return open_to_read(path);
}

}  // namespace

void require_regular_file(const fs::path& path) {
  const std::optional<FileFacts> found = facts_of(path);
  if (!found) fail_to_read(path);
  if (found->type != fs::file_type::regular) throw input_error(path.string() + ": " + kind_text(found->type));
}

void confine_inputs(std::vector<fs::path> folders) {
  std::vector<Confinement> all;
  for (const fs::path& folder : folders) {
    std::error_code failure;
    const fs::path place = fs::canonical(folder, failure);
    if (!failure) all.push_back({without_end(fs::absolute(folder).lexically_normal()), place});
  }
  const std::lock_guard lock(confinement_mutex);
  confinements = all.empty() ? nullptr : std::make_shared<const std::vector<Confinement>>(std::move(all));
}

InputFile::InputFile(const fs::path& path) : path_(path), own_(opened(path)), descriptor_(own_.get()) {
  look();
  require_confined(path, descriptor_);
}

InputFile::InputFile(const fs::path& path, int descriptor) : path_(path), own_(-1), descriptor_(descriptor) {
  look();
}

void InputFile::look() {
  const std::optional<FileFacts> found = descriptor_ < 0 ? std::nullopt : facts_of(descriptor_);
  if (!found) fail_to_read(path_);
  // Check again, because the name may mean another file by now.
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

std::optional<std::string_view> InputLines::next() {
  constexpr std::size_t kPiece = std::size_t{1} << 16;
  std::size_t searched = next_;
  for (;;) {
    const std::size_t found = buffer_.find('\n', searched);
    if (found != std::string::npos) {
      const std::string_view line = std::string_view(buffer_).substr(next_, found - next_);
      end_ += line.size() + 1;
      next_ = found + 1;
      ++number_;
      return line;
    }
    buffer_.erase(0, next_);
    next_ = 0;
    searched = buffer_.size();
    if (searched > kLongest)
      throw input_error(file_.path().string() + ": line " + std::to_string(number_ + 1) + " has more than " +
                        std::to_string(kLongest >> 20) + " MB, which is the limit for a line");
    buffer_.resize(searched + kPiece);
    const std::size_t count = file_.read(end_ + searched, buffer_.data() + searched, kPiece);
    buffer_.resize(searched + count);
    if (count == 0) return std::nullopt;
  }
}

namespace {

[[noreturn]] void fail_of_size(const fs::path& path, std::uintmax_t largest) {
  const bool megabytes = largest >= 1 << 20;
  throw input_error(path.string() + ": has more than " + std::to_string(megabytes ? largest >> 20 : largest) +
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
// (command_line/progress.hpp).
std::string content_of_pipe(const fs::path& path, std::uintmax_t largest) {
  const OpenFile file(open_to_read(path));
  if (!file.is_open()) fail_to_read(path);
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
