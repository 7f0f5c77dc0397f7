// A file that is opened once for all that is read of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/open_file.hpp"

namespace remap {

class InputFile {
 public:
  // Throws kInput, also for what is not a regular file.
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

}  // namespace remap
