#include "core/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/system.hpp"

namespace remap {
namespace {

// A Character is a character of UTF-8, or a byte that belongs to no character.
struct Character {
  std::size_t bytes = 1;
  bool is_valid = false;
  std::uint32_t code = 0;
};

// These are the smallest codes of characters of one to four bytes. If a smaller code has so many bytes, it is
// not valid UTF-8.
constexpr std::array<std::uint32_t, 4> kLeastCodes = {0, 0x80, 0x800, 0x10000};

std::size_t byte_count(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t count = byte_count(byte(0));
  if (count == 0 || count > text.size()) return {1, false, byte(0)};
  std::uint32_t code = count == 1 ? byte(0) : byte(0) & (0x7fu >> count);
  for (std::size_t i = 1; i < count; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {1, false, byte(0)};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  if (code < kLeastCodes[count - 1] || code > 0x10ffff || is_surrogate) return {1, false, byte(0)};
  return {count, true, code};
}

bool is_plain(const Character& character) {
  using Codes = std::pair<std::uint32_t, std::uint32_t>;
  // These are control characters, marks of direction (Unicode, Bidi_Control), breaks of lines and paragraphs,
  // and the byte order mark.
  constexpr std::array<Codes, 7> kRefused = {Codes{0x00, 0x1f}, {0x7f, 0x9f},     {0x061c, 0x061c},
                                             {0x200e, 0x200f},  {0x2028, 0x202e}, {0x2066, 0x2069},
                                             {0xfeff, 0xfeff}};
  const std::uint32_t code = character.code;
  return character.is_valid && std::ranges::none_of(kRefused, [code](const Codes& codes) {
           return code >= codes.first && code <= codes.second;
         });
}

void add_utf8(char32_t code, std::string& text) {
  const auto add = [&text](char32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // bytes after the first
  add((0xf00u >> (more + 1) & 0xffu) | code >> 6 * more);
  for (int i = more - 1; i >= 0; --i) add(0x80u | (code >> 6 * i & 0x3fu));
}

std::string escape_of(const Character& character) {
  std::string digits;
  for (std::uint32_t code = character.code; code != 0 || digits.size() < 2; code >>= 4)
    digits.insert(digits.begin(), "0123456789abcdef"[code & 15u]);
  const bool is_byte = !character.is_valid || character.code < 0x80;
  return (is_byte ? "\\x" : "\\u") + std::string(is_byte || digits.size() >= 4 ? 0 : 4 - digits.size(), '0') +
         digits;
}

}  // namespace

bool is_plain_text(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!is_plain(character)) return false;
    text.remove_prefix(character.bytes);
  }
  return true;
}

std::string plain(std::string_view text, std::size_t longest) {
  std::string result;
  std::size_t whole = 0;  // number of bytes of `result` that leave room for "..."
  while (!text.empty()) {
    const Character character = first_character(text);
    result += is_plain(character) ? std::string(text.substr(0, character.bytes)) : escape_of(character);
    if (result.size() > longest) return result.substr(0, whole) + "...";
    if (result.size() + 3 <= longest) whole = result.size();
    text.remove_prefix(character.bytes);
  }
  return result;
}

std::string without_case(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character character = first_character(text);
    const char32_t small = character.is_valid ? small_letter(character.code) : character.code;
    if (small == character.code)
      result += text.substr(0, character.bytes);
    else
      add_utf8(small, result);
    text.remove_prefix(character.bytes);
  }
  return result;
}

std::string plain_file_name(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character character = first_character(text);
    result += is_plain(character) || !character.is_valid ? text.substr(0, character.bytes) : "_";
    text.remove_prefix(character.bytes);
  }
  return result;
}

std::vector<std::string> parts_between(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::string percent_code(char byte) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  const auto code = static_cast<unsigned char>(byte);
  return {'%', kDigits[code >> 4], kDigits[code & 15]};
}

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=,:%+@").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

namespace {

// Only so many letters are compared, because nobody mistypes more letters.
constexpr std::size_t kLettersCompared = 200;

std::size_t edit_distance(std::string_view a, std::string_view b) {
  a = a.substr(0, kLettersCompared);
  b = b.substr(0, kLettersCompared);
  std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) distance[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      std::size_t best =
          std::min({distance[i - 1][j] + 1, distance[i][j - 1] + 1, distance[i - 1][j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) best = std::min(best, distance[i - 2][j - 2] + 1);
      distance[i][j] = best;
    }
  }
  return distance[a.size()][b.size()];
}

// Returns true if at most a third of the letters are wrong. Nobody mistypes more.
bool is_near(std::size_t distance, std::string_view name, std::string_view candidate) {
  return 3 * distance <= std::max(name.size(), candidate.size());
}

// Returns true if `name` is at least the first half of the candidate, such as --out of --output.
bool is_beginning(std::string_view name, std::string_view candidate) {
  return name.size() >= 3 && candidate.starts_with(name) && 2 * name.size() >= candidate.size();
}

}  // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
  std::string nearest;
  std::size_t smallest = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = is_beginning(name, candidate) ? 1 : edit_distance(name, candidate);
    if (!is_near(distance, name, candidate)) continue;
    if (nearest.empty() || distance < smallest) {
      nearest = candidate;
      smallest = distance;
    }
  }
  return nearest;
}

std::string closest_name(std::string_view name, std::span<const std::string> candidates) {
  const auto nearer = [name](const std::string& a, const std::string& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  };
  return *std::min_element(candidates.begin(), candidates.end(), nearer);
}

// If one name contains the other, treat them as so many typing errors apart.
constexpr std::size_t kPartDistance = 3;

std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates,
                                       std::size_t count) {
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(name, candidate);
    const bool is_whole = candidate.find(name) != std::string::npos;  // such as ggx in mitsuba/ggx
    const bool is_part = name.find(candidate) != std::string::npos;
    if (is_whole || is_part || is_near(distance, name, candidate))
      ranked.emplace_back(is_whole  ? 0
                          : is_part ? std::min(distance, kPartDistance)
                                    : distance,
                          std::move(candidate));
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<std::size_t, std::string>::first);
  ranked.resize(std::min(ranked.size(), count));
  std::vector<std::string> nearest;
  for (auto& [distance, name_of_rank] : ranked) nearest.push_back(std::move(name_of_rank));
  return nearest;
}

std::string joined(std::span<const std::string> names, std::string_view between) {
  std::string text;
  for (const std::string& name : names) (text += text.empty() ? "" : between) += name;
  return text;
}

std::string suggestion(std::string_view name, std::span<const std::string> candidates) {
  if (const std::string nearest = nearest_name(name, candidates); !nearest.empty())
    return " (did you mean " + nearest + "?)";
  if (candidates.empty()) return "";
  return " (choose " + joined(candidates, ", ") + ")";
}

}  // namespace remap
