// A file that is opened once for all that is read of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/open_file.hpp"

namespace remap {

// Throws kInput unless `path` leads to a regular file. A reader that opens a pipe waits for a writer, and a
// device has no end, so whoever hands a path that a user named to a library calls this first.
void require_regular_file(const std::filesystem::path& path);

// Folders whose files others may have put there. What is opened below one of them must lie below it after
// links are resolved, too. Of the whole process; a command sets them before it reads its inputs.
void confine_inputs(std::vector<std::filesystem::path> folders);

class InputFile {
 public:
  // Does not wait for the writer of a pipe. Throws kInput, also for what is not a regular file, and for a
  // file that leads out of a folder of confine_inputs() through a link.
  explicit InputFile(const std::filesystem::path& path);
  // Reads through a descriptor that stays open longer than this, and opens nothing.
  InputFile(const std::filesystem::path& path, int descriptor);

  const std::filesystem::path& path() const noexcept { return path_; }
  std::uintmax_t size() const noexcept { return size_; }  // when it was opened
  int descriptor() const noexcept { return descriptor_; }

  // Reads `size` bytes from `place` on, and fewer at the end of the file alone. Callable from many threads.
  // Throws kInput.
  std::size_t read(std::uintmax_t place, char* bytes, std::size_t size) const;

 private:
  void look();

  std::filesystem::path path_;
  OpenFile own_;
  int descriptor_;
  std::uintmax_t size_ = 0;
};

// Hands over the whole file in order, in pieces of a megabyte: `take(std::string_view)`.
template <typename Take>
void for_pieces(const InputFile& file, const Take& take) {
  std::vector<char> piece(std::size_t{1} << 20);
  std::uintmax_t place = 0;
  while (const std::size_t count = file.read(place, piece.data(), piece.size())) {
    take(std::string_view(piece.data(), count));
    place += count;
  }
}

// The lines of a file, one after another.
class InputLines {
 public:
  // The longest line that is read. Lines of this project's files are far shorter, but a sparse file may be
  // huge.
  static constexpr std::size_t kLongest = std::size_t{16} << 20;
  // `file` must outlive it. Reading begins at `start`.
  explicit InputLines(const InputFile& file, std::uintmax_t start = 0) : file_(file), end_(start) {}
  // The next line, without its line break; none at the end, nor for a last line without a line break. It
  // stays valid until the next call. Throws kInput for a line that is too long.
  std::optional<std::string_view> next();
  std::size_t number() const noexcept { return number_; }  // of the last line, from 1
  // The end of that line in the file.
  std::uintmax_t end() const noexcept { return end_; }
  // The text after the last line break, once next() has returned none.
  std::string_view rest() const noexcept { return std::string_view(buffer_).substr(next_); }

 private:
  const InputFile& file_;
  std::string buffer_;    // read from the file
  std::size_t next_ = 0;  // in `buffer_`: after the last line
  std::uintmax_t end_;
  std::size_t number_ = 0;
};

}  // namespace remap
