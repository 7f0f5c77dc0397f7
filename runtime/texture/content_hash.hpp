// What a result is made of, in a number: so that a run that goes on knows what is done.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace remap {

// XXH3, 128 bits (Collet 2012 to 2023): as fast as memory, and no defence against anybody who wants two
// contents of one hash.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;

  // A text with its length: `ab`, `c` and `a`, `bc` differ.
  void add(std::string_view text);
  // The bytes of a file. Throws kInput where it cannot be read.
  void add_file(const std::filesystem::path& path);

  // 32 hexadecimal digits.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace remap
