#include "core/process_mark.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <unistd.h>
#ifdef __EMSCRIPTEN__
#include <emscripten.h>
#endif

namespace remap {
namespace {

#ifdef __EMSCRIPTEN__
// WebAssembly has no processes. The host says in what process of which machine it is (packages/npm/cli.js); a
// page has none.
// clang-format off
EM_JS(int, remap_host_process, (), { return Module["processes"] ? Module["processes"].own : 1; });
EM_JS(int, remap_host_has_ended, (int process), { return Module["processes"] ? Module["processes"].hasEnded(process) : 0; });
EM_JS(char*, remap_host_machine, (), { return allocateUTF8(Module["processes"] ? Module["processes"].machine : ""); });
// clang-format on

pid_t own_process() { return remap_host_process(); }
bool has_ended(pid_t process) { return remap_host_has_ended(process) != 0; }
std::string machine() {
  char* const name = remap_host_machine();
  const std::string text = name;
  std::free(name);
  return text;
}
#else
pid_t own_process() { return ::getpid(); }
bool has_ended(pid_t process) { return ::kill(process, 0) != 0 && errno == ESRCH; }
std::string machine() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return host.data();
}
#endif

constexpr std::size_t kTagDigits = 8;

// The machine, and the space in which the numbers of its processes are unique.
std::string place_of_processes() {
  std::error_code ignored;
  return machine() + "/" + std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string();
}

// FNV-1a, 32 bits (Fowler, Noll, Vo 1991), in hexadecimal digits.
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

std::string process_mark() { return own_tag() + std::to_string(own_process()); }

bool is_mark_of_the_dead(std::string_view mark) {
  if (!mark.starts_with(own_tag())) return false;
  mark.remove_prefix(own_tag().size());
  pid_t process = 0;
  const auto [end, failure] = std::from_chars(mark.data(), mark.data() + mark.size(), process);
  if (failure != std::errc() || end != mark.data() + mark.size() || process <= 0) return false;
  return has_ended(process);
}

}  // namespace remap
