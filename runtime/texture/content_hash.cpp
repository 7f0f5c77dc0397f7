#include "texture/content_hash.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>
#include <xxhash.h>

#include "remap/error.hpp"

namespace remap {

struct ContentHash::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() {
    if (xxh == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(xxh);
  }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  void add(const void* bytes, std::size_t count) { XXH3_128bits_update(xxh, bytes, count); }
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {}
ContentHash::~ContentHash() = default;
ContentHash::ContentHash(ContentHash&&) noexcept = default;
ContentHash& ContentHash::operator=(ContentHash&&) noexcept = default;

void ContentHash::add(std::string_view text) {
  const std::uint64_t length = text.size();
  state_->add(&length, sizeof length);
  state_->add(text.data(), text.size());
}

void ContentHash::add_file(const std::filesystem::path& path) {
  const auto fail = [&] {
    throw Error(ErrorKind::kInput, path.string() + ": cannot be read: " + std::strerror(errno));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail();
  std::vector<char> buffer(std::size_t{1} << 20);
  std::uint64_t total = 0;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    state_->add(buffer.data(), count);
    total += count;
  }
  if (std::ferror(file.get()) != 0) fail();
  state_->add(&total, sizeof total);
}

std::string ContentHash::hex() const {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, XXH3_128bits_digest(state_->xxh));
  std::string text;
  for (const unsigned char byte : bytes.digest) {
    std::array<char, 3> digits;
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    text += digits.data();
  }
  return text;
}

}  // namespace remap
