#include "texture/content_hash.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <new>

#define XXH_STATIC_LINKING_ONLY
#define XXH_IMPLEMENTATION
#include <xxhash.h>

namespace remap {

ContentHash::ContentHash() : state_(XXH3_createState(), [](XXH3_state_t* state) { XXH3_freeState(state); }) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}

void ContentHash::add(std::string_view text) {
  const std::uint64_t length = text.size();
  XXH3_128bits_update(state_.get(), &length, sizeof length);
  XXH3_128bits_update(state_.get(), text.data(), text.size());
}

void ContentHash::add_file(const InputFile& file) {
  std::uint64_t total = 0;
  for_pieces(file, [&](std::string_view piece) {
    XXH3_128bits_update(state_.get(), piece.data(), piece.size());
    total += piece.size();
  });
  XXH3_128bits_update(state_.get(), &total, sizeof total);
}

std::string ContentHash::hex() const {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, XXH3_128bits_digest(state_.get()));
  std::string text;
  for (const unsigned char byte : bytes.digest) {
    std::array<char, 3> digits;
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    text += digits.data();
  }
  return text;
}

std::string hash_of_file(const InputFile& file) {
  ContentHash hash;
  hash.add_file(file);
  return hash.hex();
}

}  // namespace remap
