#include "sets/tiles.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include "core/errors.hpp"
#include "sets/folder_walk.hpp"
#include "sets/naming.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr int kFirstUdim = 1001;
constexpr int kLastUdim = 1999;
constexpr int kUdimColumns = 10;
// 1024 is the only power of two that is also a UDIM. It is treated as a resolution if no other tile exists.
constexpr int kAmbiguousUdim = 1024;
constexpr std::size_t kMostDigits = 9;

constexpr std::array<std::pair<std::string_view, TileStyle>, 3> kTokens = {
    {{"<UDIM>", TileStyle::kUdim}, {"%(UDIM)d", TileStyle::kUdim}, {"<UVTILE>", TileStyle::kUvTile}}};

bool is_udim(int number) { return number >= kFirstUdim && number <= kLastUdim; }

// Returns the number that `digits` spells. Returns nothing for other text and for too many digits.
std::optional<int> digits_value(std::string_view digits) {
  if (digits.empty() || digits.size() > kMostDigits || !std::ranges::all_of(digits, is_digit))
    return std::nullopt;
  int value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

// Returns the pattern whose placeholder is [begin, end) of `name`.
TilePattern pattern_of(std::string_view name, std::size_t begin, std::size_t end, TileStyle style,
                       int digit_count = 0) {
  return {std::string(name.substr(0, begin)), std::string(name.substr(begin, end - begin)),
          std::string(name.substr(end)), style, digit_count};
}

// Finds `%d` or `%04d` at `begin`.
std::optional<TilePattern> printf_pattern(std::string_view name, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < name.size() && is_digit(name[end])) ++end;
  if (end >= name.size() || name[end] != 'd') return std::nullopt;
  const std::string_view width = name.substr(begin + 1, end - begin - 1);
  if (width.empty()) return pattern_of(name, begin, end + 1, TileStyle::kFrame, 1);
  // Refuse a width without a leading zero, because printf would fill with spaces.
  if (width.front() != '0' || width.size() != 2 || width.back() == '0') return std::nullopt;
  return pattern_of(name, begin, end + 1, TileStyle::kFrame, width.back() - '0');
}

// Returns the pattern if a placeholder begins at `begin`.
std::optional<TilePattern> pattern_at(std::string_view name, std::size_t begin) {
  for (const auto& [token, style] : kTokens)
    if (name.substr(begin).starts_with(token)) return pattern_of(name, begin, begin + token.size(), style);
  if (name[begin] == '%') return printf_pattern(name, begin);
  if (name[begin] != '#') return std::nullopt;
  std::size_t end = begin;
  while (end < name.size() && name[end] == '#') ++end;
  if (end - begin > kMostDigits) return std::nullopt;
  return pattern_of(name, begin, end, TileStyle::kFrame, static_cast<int>(end - begin));
}

// Returns the UDIM of a tile such as u3_v2, given as its two parts.
std::optional<int> uv_number(std::string_view u, std::string_view v) {
  if (u.size() < 2 || v.size() < 2 || lower(u.front()) != 'u' || lower(v.front()) != 'v') return std::nullopt;
  if (u[1] == '0' || v[1] == '0') return std::nullopt;
  const std::optional<int> column = digits_value(u.substr(1)), row = digits_value(v.substr(1));
  if (!column || !row || *column > kUdimColumns || *row > kLastUdim) return std::nullopt;
  const int number = kFirstUdim - 1 + *column + kUdimColumns * (*row - 1);
  return is_udim(number) ? std::optional(number) : std::nullopt;
}

std::string number_in_style(const TilePattern& pattern, int number) {
  if (pattern.style == TileStyle::kUvTile) {
    const int index = number - kFirstUdim;
    return "u" + std::to_string(index % kUdimColumns + 1) + "_v" + std::to_string(index / kUdimColumns + 1);
  }
  std::string digits = std::to_string(number);
  if (static_cast<int>(digits.size()) < pattern.digit_count)
    digits.insert(0, static_cast<std::size_t>(pattern.digit_count) - digits.size(), '0');
  return digits;
}

// A Candidate is a file name that may belong to a tile.
struct Candidate {
  std::string name;
  TilePattern pattern;
  int number = 0;
  bool ends_name = false;  // only the extension follows the number
};

// Finds the last number of `name` that may be a UDIM.
std::optional<Candidate> find_candidate(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const std::string_view stem = std::string_view(name).substr(0, dot);
  const std::vector<NamePiece> pieces = name_pieces(stem);
  for (std::size_t i = pieces.size(); i-- > 0;) {
    const std::string_view piece = pieces[i].in(stem);
    const bool last = i + 1 == pieces.size();
    const std::optional<int> number = piece.size() == 4 ? digits_value(piece) : std::nullopt;
    if (number && is_udim(*number)) {
      Candidate candidate{name, pattern_of(name, pieces[i].begin, pieces[i].end, TileStyle::kUdim), *number,
                          last};
      candidate.pattern.token = "<UDIM>";
      return candidate;
    }
    if (i == 0 || stem.substr(pieces[i - 1].end, pieces[i].begin - pieces[i - 1].end) != "_") continue;
    if (const std::optional<int> uv = uv_number(pieces[i - 1].in(stem), piece)) {
      Candidate candidate{name, pattern_of(name, pieces[i - 1].begin, pieces[i].end, TileStyle::kUvTile), *uv,
                          last};
      candidate.pattern.token = "<UVTILE>";
      // Refuse other spellings, because the pattern could not produce a name in capitals.
      if (tile_name(candidate.pattern, *uv) == name) return candidate;
    }
  }
  return std::nullopt;
}

bool is_tile_alone(const Candidate& candidate) {
  if (candidate.pattern.style == TileStyle::kUvTile || candidate.number == kFirstUdim) return true;
  return candidate.ends_name && candidate.number != kAmbiguousUdim;
}

}  // namespace

std::optional<TilePattern> tile_pattern(std::string_view name) {
  std::optional<TilePattern> pattern;
  for (std::size_t i = 0; i < name.size();) {
    const std::optional<TilePattern> found = pattern_at(name, i);
    if (found && pattern)
      throw usage_error(display_path(name) + ": has two placeholders, " + pattern->token + " and " +
                        found->token + " (use one)");
    if (found) pattern = found;
    i += found ? found->token.size() : 1;
  }
  return pattern;
}

std::string tile_name(const TilePattern& pattern, int number) {
  if (pattern.style == TileStyle::kFrame ? number < 0 : !is_udim(number))
    throw usage_error(display_path(pattern.text()) + ": invalid tile number " + std::to_string(number) +
                      (pattern.style == TileStyle::kFrame ? " (frames begin at 0)" : " (use 1001 to 1999)"));
  return pattern.before + number_in_style(pattern, number) + pattern.after;
}

std::optional<int> tile_number(const TilePattern& pattern, std::string_view name) {
  if (name.size() <= pattern.before.size() + pattern.after.size() || !name.starts_with(pattern.before) ||
      !name.ends_with(pattern.after))
    return std::nullopt;
  const std::string_view middle =
      name.substr(pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
  std::optional<int> number;
  if (pattern.style == TileStyle::kUvTile) {
    const std::size_t separator = middle.find('_');
    if (separator == std::string_view::npos) return std::nullopt;
    number = uv_number(middle.substr(0, separator), middle.substr(separator + 1));
  } else {
    number = digits_value(middle);
    if (pattern.style == TileStyle::kUdim && number && !is_udim(*number)) return std::nullopt;
  }
  // A number in a different spelling (01001, U1_v1) belongs to a different file.
  if (!number || number_in_style(pattern, *number) != middle) return std::nullopt;
  return number;
}

Tiles existing_tiles(const fs::path& path) {
  const std::optional<TilePattern> pattern = tile_pattern(path.filename().string());
  if (!pattern)
    throw usage_error(display_path(path) +
                      ": no placeholder for tiles in the file name (use <UDIM>, <UVTILE>, #### or %04d)");
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  for (const auto& [token, style] : kTokens)
    if (folder.string().find(token) != std::string::npos)
      throw usage_error(display_path(path) + ": " + std::string(token) +
                        " in a folder name (use it in the file name)");

  Tiles tiles;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    const std::optional<int> number = tile_number(*pattern, name);
    std::error_code unreadable;
    if (number && entry->is_regular_file(unreadable)) tiles[*number] = path.parent_path() / name;
  }
  if (failure) throw input_error(display_path(folder) + ": cannot be read: " + failure.message());
  return tiles;
}

std::vector<TileGroup> group_tiles(std::span<const std::string> names) {
  std::map<std::pair<std::string, std::string>, std::vector<Candidate>> patterns;
  std::vector<TileGroup> groups;
  for (const std::string& name : names) {
    if (std::optional<Candidate> candidate = find_candidate(name)) {
      auto key = std::pair(candidate->pattern.before + candidate->pattern.token, candidate->pattern.after);
      patterns[std::move(key)].push_back(std::move(*candidate));
    } else {
      groups.push_back({name, std::nullopt, {}});
    }
  }
  for (const auto& [key, candidates] : patterns) {
    const TilePattern& pattern = candidates.front().pattern;
    if (candidates.size() == 1 && !is_tile_alone(candidates.front())) {
      groups.push_back({candidates.front().name, std::nullopt, {}});
      continue;
    }
    TileGroup group{pattern.text(), pattern, {}};
    for (const Candidate& candidate : candidates) group.numbers.push_back(candidate.number);
    std::ranges::sort(group.numbers);
    groups.push_back(std::move(group));
  }
  std::ranges::sort(groups, [](const TileGroup& a, const TileGroup& b) { return a.name < b.name; });
  return groups;
}

}  // namespace remap
