// This file hashes the inputs of a result, so that a resumed run recognises finished results.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/input_file.hpp"

struct XXH3_state_s;

namespace remap {

// A ContentHash uses XXH3, 128 bits (Collet 2012 to 2023). It is as fast as memory, but somebody could make
// two files with the same hash on purpose.
class ContentHash {
 public:
  ContentHash();

  // Adds a text and its length, so that `ab`, `c` and `a`, `bc` differ.
  void add(std::string_view text);
  // Adds the bytes of a file. Throws kInput if it cannot be read.
  void add_file(const InputFile& file);
  void add_file(const std::filesystem::path& path) { add_file(InputFile(path)); }

  // Returns the hash as 32 hexadecimal digits.
  std::string hex() const;

 private:
  std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> state_;
};

std::string hash_of_file(const InputFile& file);
inline std::string hash_of_file(const std::filesystem::path& path) { return hash_of_file(InputFile(path)); }

}  // namespace remap
