#include "sets/naming.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "core/contains.hpp"
namespace remap {

// A NameParts holds the pieces of a name up to the word of the map. The resolution, the format and ignored
// words after this word are removed.
struct NameParts {
  std::string_view name;
  std::vector<NamePiece> pieces;
  bool resolution_after = false;
};

namespace {

// Formats and qualities stand next to a resolution (4K-PNG, 2K-HQ) or before a second extension (.exr.tx).
constexpr std::array<std::string_view, 12> kFormats = {"exr", "tif", "tiff", "png", "jpg", "jpeg",
                                                       "tga", "bmp", "hdr",  "hq",  "lq",  "webp"};

// Returns true if `digits` is the side of a square map: a power of two from 128 to 32768.
bool is_side(std::string_view digits) {
  if (digits.size() < 3 || digits.size() > 5 || !std::ranges::all_of(digits, is_digit)) return false;
  unsigned side = 0;
  for (const char c : digits) side = side * 10 + static_cast<unsigned>(c - '0');
  return side >= 128 && side <= 32768 && (side & (side - 1)) == 0;
}

// Returns true if a piece numbers a version, such as v001 or v2.
bool is_version(std::string_view piece) {
  return piece.size() >= 2 && piece.size() <= 5 && lower(piece.front()) == 'v' &&
         std::all_of(piece.begin() + 1, piece.end(), is_digit);
}

// Returns true if a capital at `i` begins a new part of a name, like S in heroSpec and M in ORMMap.
bool begins_part(std::string_view name, std::size_t i) {
  if (i == 0 || !is_upper(name[i]) || is_separator(name[i - 1])) return false;
  if (!is_upper(name[i - 1])) return true;
  return i + 1 < name.size() && is_lower(name[i + 1]);
}

bool is_acronym(std::string_view word) { return std::ranges::none_of(word, is_lower); }

// A Stem is the result of stem_before(): where the set's name ends, and where the resolution stands.
struct Stem {
  std::size_t end = 0;           // end of the set's name
  std::size_t numbered_end = 0;  // end of the set's name if a number after it belongs to it
  ResolutionPlace resolution = ResolutionPlace::kNone;
};

// Returns where the set's name ends before piece `word`, without a resolution: x_4K_Gloss, x_4K-PNG_Color.
Stem stem_before(const NameParts& parts, std::size_t word) {
  const auto piece = [&](std::size_t back) { return parts.pieces[word - back].in(parts.name); };
  const auto end_of = [&](std::size_t count) { return count == 0 ? 0 : parts.pieces[count - 1].end; };
  if (word >= 1 && is_resolution(piece(1))) {
    const bool bare_number = is_side(piece(1));
    return {end_of(word - 1), end_of(bare_number ? word : word - 1), ResolutionPlace::kBefore};
  }
  if (word >= 2 && is_format_word(piece(1)) && is_resolution(piece(2)))
    return {end_of(word - 2), end_of(word - 2), ResolutionPlace::kBeforeWithFormat};
  return {end_of(word), end_of(word), ResolutionPlace::kNone};
}

}  // namespace

bool is_roughness(Role role) {
  return role == Role::kRoughness || role == Role::kGlossiness || role == Role::kAlphaWidth;
}

bool is_resolution(std::string_view piece) {
  if (piece.size() >= 2 && piece.size() <= 3 && lower(piece.back()) == 'k')
    return std::all_of(piece.begin(), piece.end() - 1, is_digit);
  const std::size_t cross = piece.find_first_of("xX");
  if (cross == std::string_view::npos) return is_side(piece);
  return is_side(piece.substr(0, cross)) && is_side(piece.substr(cross + 1));
}

bool is_format_word(std::string_view piece) { return contains(kFormats, lower(piece)); }

std::string word_key(std::string_view word) {
  std::string key;
  for (const char c : word)
    if (!is_separator(c)) key += lower(c);
  return key;
}

struct Naming::Ending {
  std::string key;                // letters of the ending, in lower case
  std::vector<std::size_t> cuts;  // offsets in `key` where the name has separators
  std::string_view text;          // as written in the name
  bool follows_separator = true;  // also true at the beginning of the name
  ResolutionPlace resolution = ResolutionPlace::kNone;
};

Naming::Naming(std::vector<Habit> habits, std::vector<std::string> ignored_words)
    : habits_(std::move(habits)), ignored_words_(std::move(ignored_words)) {
  for (const std::string& word : ignored_words_) ignored_.insert(lower(word));
  for (std::size_t habit = 0; habit < habits_.size(); ++habit) {
    for (std::size_t rule = 0; rule < habits_[habit].rules.size(); ++rule) {
      for (const std::string& text : habits_[habit].rules[rule].words) {
        Word word{habit, rule, text, {}};
        std::size_t letter_count = 0;
        for (const NamePiece& piece : name_pieces(text)) {
          if (letter_count > 0) word.cuts.push_back(letter_count);
          letter_count += piece.end - piece.begin;
        }
        longest_word_ = std::max(longest_word_, letter_count);
        words_[word_key(text)].push_back(std::move(word));
      }
    }
  }
}

// Returns the best of the words that `ending` spells. The user's conventions win over built-in conventions.
// Then a word with exactly the same spelling wins, then a word whose convention has the resolution in this
// place, then the first word of the table.
const Naming::Word* Naming::best_word(const Ending& ending) const {
  const auto found = words_.find(ending.key);
  if (found == words_.end()) return nullptr;
  const Word* best = nullptr;
  std::tuple<bool, bool, bool> best_rank;
  for (const Word& word : found->second) {
    const Habit& habit = habits_[word.habit];
    if (!ending.follows_separator && !habit.camel_case) continue;
    const auto allowed = [&](std::size_t cut) { return contains(word.cuts, cut); };
    if (!std::ranges::all_of(ending.cuts, allowed)) continue;
    const std::tuple rank{!habit.built_in, word.text == ending.text, habit.resolution == ending.resolution};
    if (best == nullptr || rank > best_rank) {
      best = &word;
      best_rank = rank;
    }
  }
  return best;
}

// Returns the end of the name that starts at `begin` in piece `first`. Returns nothing if it is longer than
// every word.
std::optional<Naming::Ending> Naming::ending_from(const NameParts& parts, std::size_t first,
                                                  std::size_t begin) const {
  Ending ending;
  std::size_t from = begin;
  for (std::size_t i = first; i < parts.pieces.size(); ++i) {
    if (i > first) {
      ending.cuts.push_back(ending.key.size());
      from = parts.pieces[i].begin;
    }
    ending.key += lower(parts.name.substr(from, parts.pieces[i].end - from));
    if (ending.key.size() > longest_word_) return std::nullopt;
  }
  ending.text = parts.name.substr(begin, parts.pieces.back().end - begin);
  ending.follows_separator = begin == parts.pieces[first].begin;
  return ending;
}

std::vector<NameReading> Naming::read(std::string_view name) const {
  std::vector<NameReading> readings = read_end(name);
  if (const auto pair = read_pair(name)) readings.insert(readings.begin(), *pair);
  if (readings.empty()) readings = read_front(name);
  return readings;
}

// Reads `Robot Metallic-Robot Roughness`. Blender's glTF export names a packed map after the two maps in it.
std::optional<NameReading> Naming::read_pair(std::string_view name) const {
  for (std::size_t dash = name.find('-'); dash != std::string_view::npos; dash = name.find('-', dash + 1)) {
    const std::vector<NameReading> first = read_end(name.substr(0, dash)),
                                   second = read_end(name.substr(dash + 1));
    const auto is_whole = [](const std::vector<NameReading>& readings, Role role) {
      return !readings.empty() &&
             readings.front().meaning == std::vector{ChannelMeaning{Channels::kWhole, role}};
    };
    if (!is_whole(first, Role::kMetallic) || !is_whole(second, Role::kRoughness) ||
        first.front().stem != second.front().stem)
      continue;
    NameReading reading = first.front();
    reading.habit = "glTF";
    reading.doubtful = false;
    reading.meaning = {{Channels::kGreen, Role::kRoughness}, {Channels::kBlue, Role::kMetallic}};
    return reading;
  }
  return std::nullopt;
}

// Reads `ROUGHNESS_Robot`. Such a reading is valid only if another map has the same stem.
std::vector<NameReading> Naming::read_front(std::string_view name) const {
  const std::vector<NamePiece> pieces = name_pieces(name);
  for (std::size_t count = std::min<std::size_t>(3, pieces.size() - std::min<std::size_t>(1, pieces.size()));
       count > 0; --count) {
    std::vector<NameReading> readings = read_end(name.substr(0, pieces[count - 1].end));
    std::erase_if(readings, [](const NameReading& reading) { return !reading.stem.empty(); });
    if (readings.empty()) continue;
    readings.resize(1);
    readings.front().stem = readings.front().numbered_stem = std::string(name.substr(pieces[count].begin));
    readings.front().doubtful = true;
    return readings;
  }
  return {};
}

std::vector<NameReading> Naming::read_end(std::string_view name) const {
  NameParts parts{name, name_pieces(name), false};
  while (!parts.pieces.empty()) {
    const std::string_view last = parts.pieces.back().in(name);
    const bool resolution = is_resolution(last);
    if (!resolution && !is_format_word(last) && !is_version(last) && !ignored_.contains(lower(last))) break;
    parts.resolution_after = parts.resolution_after || resolution;
    parts.pieces.pop_back();
  }

  std::vector<NameReading> readings;
  for (std::size_t first = 0; first < parts.pieces.size(); ++first) {
    const NamePiece& piece = parts.pieces[first];
    for (std::size_t begin = piece.begin; begin < piece.end; ++begin) {
      if (begin > piece.begin && !begins_part(name, begin)) continue;
      std::optional<Ending> ending = ending_from(parts, first, begin);
      if (!ending) continue;
      const Stem stem = ending->follows_separator ? stem_before(parts, first) : Stem{begin, begin, {}};
      ending->resolution = parts.resolution_after ? ResolutionPlace::kAfter : stem.resolution;
      const Word* word = best_word(*ending);
      if (word == nullptr) continue;
      const NamingRule& rule = habits_[word->habit].rules[word->rule];
      const auto text_to = [&](std::size_t end) {
        const std::size_t stem_begin = std::min(parts.pieces.front().begin, end);
        return std::string(name.substr(stem_begin, end - stem_begin));
      };
      const bool certain = !rule.ordinary || ending->resolution != ResolutionPlace::kNone ||
                           (ending->text == word->text && is_acronym(word->text));
      readings.push_back(
          {text_to(stem.end), text_to(stem.numbered_end), habits_[word->habit].name, !certain, rule.meaning});
    }
  }
  return readings;
}

}  // namespace remap
