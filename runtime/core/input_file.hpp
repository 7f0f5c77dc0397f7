// This file reads files, either whole, or from one opening for everything that is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/system.hpp"

namespace remap {

// Throws kInput unless `path` leads to a regular file. A program that opens a pipe waits for its writer, and
// a device has no end. Call this before you hand a path that a user typed to a library.
void require_regular_file(const std::filesystem::path& path);

// Sets the folders that may contain files from strangers. A file below such a folder must still lie below it
// after links are resolved. The setting applies to the whole process. Set it before reading inputs.
void confine_inputs(std::vector<std::filesystem::path> folders);

class InputFile {
 public:
  // Opens the file, and does not wait for the writer of a pipe. Throws kInput if it is not a regular file, or
  // if a link leads out of a folder of confine_inputs().
  explicit InputFile(const std::filesystem::path& path);
  // Reads through a descriptor that must stay open longer than this object. Opens nothing.
  InputFile(const std::filesystem::path& path, int descriptor);

  const std::filesystem::path& path() const noexcept { return path_; }
  std::uintmax_t size() const noexcept { return size_; }  // the size when the file was opened
  int descriptor() const noexcept { return descriptor_; }

  // Reads `size` bytes from `place` on, and fewer only at the end of the file. Thread-safe. Throws kInput.
  std::size_t read(std::uintmax_t place, char* bytes, std::size_t size) const;

 private:
  void look();

  std::filesystem::path path_;
  OpenFile own_;
  int descriptor_;
  std::uintmax_t size_ = 0;
};

// Passes the whole file in order, in pieces of a megabyte, to `take(std::string_view)`.
template <typename Take>
void for_pieces(const InputFile& file, const Take& take) {
  std::vector<char> piece(std::size_t{1} << 20);
  std::uintmax_t place = 0;
  while (const std::size_t count = file.read(place, piece.data(), piece.size())) {
    take(std::string_view(piece.data(), count));
    place += count;
  }
}

// InputLines reads the lines of a file, one after another.
class InputLines {
 public:
  // Limits a line. This project's files have far shorter lines, but a sparse file may be huge.
  static constexpr std::size_t kLongest = std::size_t{16} << 20;
  // Begins to read at `start`. `file` must outlive this object.
  explicit InputLines(const InputFile& file, std::uintmax_t start = 0) : file_(file), end_(start) {}
  // Returns the next line without its line break, valid until the next call. Returns nothing at the end, also
  // for a last line without a line break. Throws kInput for a line longer than kLongest.
  std::optional<std::string_view> next();
  std::size_t number() const noexcept { return number_; }  // number of the last line, from 1
  // Returns the place in the file where the last line ends.
  std::uintmax_t end() const noexcept { return end_; }
  // Returns the text after the last line break. Call it once next() has returned nothing.
  std::string_view rest() const noexcept { return std::string_view(buffer_).substr(next_); }

 private:
  const InputFile& file_;
  std::string buffer_;    // text read from the file
  std::size_t next_ = 0;  // place in `buffer_` after the last line
  std::uintmax_t end_;
  std::size_t number_ = 0;
};

// Limits the bytes that read_file() reads by default. This is 100 times the size of the largest text file of
// remap, and fits into the memory of any machine that runs it.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;

// Returns the whole file as bytes. Besides regular files it reads only pipes that the caller's shell has
// opened (/dev/stdin, /dev/fd/N, /proc/self/fd/N), because such pipes end with their writer. Throws kInput
// with the system's reason if the file cannot be read, and for more than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest = kLargestFile);

}  // namespace remap
