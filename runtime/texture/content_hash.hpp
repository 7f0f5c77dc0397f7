// A hash of the inputs of a result, by which a resumed run recognises finished results.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace remap {

// XXH3, 128 bits (Collet 2012 to 2023). It is as fast as memory, and not safe against deliberate collisions.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  ContentHash& operator=(ContentHash&&) noexcept;

  // Adds a text and its length, so `ab`, `c` and `a`, `bc` differ.
  void add(std::string_view text);
  // Adds the bytes of a file. Throws kInput if it cannot be read.
  void add_file(const std::filesystem::path& path);

  // The hash as 32 hexadecimal digits.
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace remap
