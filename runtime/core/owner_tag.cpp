#include "core/owner_tag.hpp"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <random>

#include "core/input_file.hpp"
#include "core/system.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr std::size_t kTagDigits = 8;

// Returns a text that identifies the machine since it was started, and its PID namespace. The name of the
// machine does not suffice, because cloned machines have the same name.
std::string place_of_processes() {
  std::error_code ignored;
  std::string start;
  try {
    start = read_file("/proc/sys/kernel/random/boot_id");
  } catch (const Error&) {
  }
  return machine_name() + "/" + start + "/" +
         std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string();
}

// Returns the hash FNV-1a with 32 bits (Fowler, Noll, Vo 1991), in hexadecimal digits.
std::string tag_of(const std::string& text) {
  std::uint32_t hash = 0x811c9dc5u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193u;
  std::string tag(kTagDigits, '0');
  for (std::size_t i = kTagDigits; i-- > 0; hash >>= 4) tag[i] = "0123456789abcdef"[hash & 15u];
  return tag;
}

const std::string& own_tag() {
  static const std::string tag = tag_of(place_of_processes()) + "-";
  return tag;
}

}  // namespace

std::string owner_tag() { return own_tag() + std::to_string(own_process()); }

std::string random_letters() {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz234567";
  constexpr std::size_t kCount = 12;  // letters of five bits each
  std::random_device device;
  std::string letters(kCount, ' ');
  for (char& letter : letters) letter = kLetters[device() % kLetters.size()];
  return letters;
}

bool is_stale_owner(std::string_view mark) {
  if (!mark.starts_with(own_tag())) return false;
  mark.remove_prefix(own_tag().size());
  int process = 0;
  const auto [end, failure] = std::from_chars(mark.data(), mark.data() + mark.size(), process);
  if (failure != std::errc() || end != mark.data() + mark.size() || process <= 0) return false;
  return has_ended(process);
}

}  // namespace remap
