#include "texture/content_hash.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <new>
#include <vector>

#define XXH_STATIC_LINKING_ONLY
#define XXH_IMPLEMENTATION
#include <xxhash.h>

#include "core/errors.hpp"
#include "core/files.hpp"

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

void ContentHash::add_file(const std::filesystem::path& path) {
  const auto fail = [&] { throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", errno); };
  require_regular_file(path);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail();
  std::vector<char> buffer(std::size_t{1} << 20);
  std::uint64_t total = 0;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    XXH3_128bits_update(state_.get(), buffer.data(), count);
    total += count;
  }
  if (std::ferror(file.get()) != 0) fail();
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

std::string hash_of_file(const std::filesystem::path& path) {
  ContentHash hash;
  hash.add_file(path);
  return hash.hex();
}

}  // namespace remap
