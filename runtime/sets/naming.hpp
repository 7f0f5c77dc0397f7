// This file reads from the name of an image which map of which set it is, by the naming conventions
// ("habits") of the tools that write texture sets.
//
// The built-in habits are data: naming.json, compiled in. A file of the same form extends them:
//
//   {
//     "habits": [
//       {
//         "name": "our studio",
//         "camel_case": true,
//         "resolution": "after",
//         "rules": [
//           {"words": ["spec_rough", "srgh"], "role": "roughness"},
//           {"words": ["packed"], "channels": {"RGB": "specular", "A": "glossiness"}}
//         ]
//       }
//     ],
//     "ignored_words": ["ACEScg"]
//   }
//
// Members of a rule:
// - `words` end the name of a map, before resolution and tile. Case is ignored. A separator in a word
//   (`_`, `-`, `.`, space) matches any separator or none: `base_color` matches baseColor, Base-Color and
//   basecolor, but `baseColor` does not match base_color. The longest matching word wins. If a built-in
//   habit has the same word as the file, the file wins.
// - `role` is what the whole map holds, `channels` is what R, G, B, A or RGB hold. A rule has either `role`
//   or `channels`.
//   The roles are listed below; inputs of surface models, such as coat_roughness, are roles as well.
// - `ordinary` (default false): the words also occur in names of objects (robot_arm). They are used only if
//   another map has the same stem, if a resolution is next to them, or if they are written in capitals here
//   and in the name.
//
// Members of a habit:
// - `camel_case` (default false): a word may follow the name of the set without a separator (heroSpec).
// - `resolution` (default "none"): where the tool writes the resolution: "before" the word (x_4K_Gloss),
//   "before-with-format" (x_4K-PNG_Color) or "after" it (x_rough_4k). Every habit accepts every place; the
//   field only decides between habits with the same word.
//
// `ignored_words` (optional) are skipped after the word of a map, for example names of color spaces.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/json_spans.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"

namespace remap {

inline bool is_separator(char c) noexcept { return c == '_' || c == '-' || c == '.' || c == ' '; }
inline bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
inline bool is_lower(char c) noexcept { return c >= 'a' && c <= 'z'; }
inline bool is_upper(char c) noexcept { return c >= 'A' && c <= 'Z'; }

// Converts ASCII letters to lower case and keeps all other bytes. The result does not depend on the locale,
// and UTF-8 stays valid.
inline char lower(char c) noexcept { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }
inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower(c);
  return result;
}

// A NamePiece is the part of a name between two separators. A piece is never empty.
using NamePiece = TextSpan;

inline std::vector<NamePiece> name_pieces(std::string_view name) {
  std::vector<NamePiece> pieces;
  for (std::size_t i = 0; i < name.size();) {
    if (is_separator(name[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < name.size() && !is_separator(name[i])) ++i;
    pieces.push_back({begin, i});
  }
  return pieces;
}

// A Role is the property of the material that channels of a map hold.
enum class Role {
  kRoughness,
  kGlossiness,         // 1 - roughness
  kGlossinessSquared,  // Corona's, as Substance writes it; recognised, not converted
  kAlphaWidth,         // microfacet width, roughness squared
  kSpecular,           // reflectance at normal incidence
  kSpecularLevel,      // an artist's scale of specular; recognised, not converted
  kDiffuse,
  kBaseColor,
  kMetallic,
  kOcclusion,
  kCavity,
  kNormal,
  kHeight,
  kOpacity,
  kEmissive,
  kTransmission,
  kSubsurface,
  kIor,
  kOther,  // recognised, without a role here: masks, coats, sheen
};

// These are the names of roles in naming files.
inline constexpr NamedValues<Role, 19> kRoles = {{{Role::kRoughness, "roughness"},
                                                  {Role::kGlossiness, "glossiness"},
                                                  {Role::kGlossinessSquared, "glossiness_squared"},
                                                  {Role::kAlphaWidth, "alpha_width"},
                                                  {Role::kSpecular, "specular"},
                                                  {Role::kSpecularLevel, "specular_level"},
                                                  {Role::kDiffuse, "diffuse"},
                                                  {Role::kBaseColor, "base_color"},
                                                  {Role::kMetallic, "metallic"},
                                                  {Role::kOcclusion, "occlusion"},
                                                  {Role::kCavity, "cavity"},
                                                  {Role::kNormal, "normal"},
                                                  {Role::kHeight, "height"},
                                                  {Role::kOpacity, "opacity"},
                                                  {Role::kEmissive, "emissive"},
                                                  {Role::kTransmission, "transmission"},
                                                  {Role::kSubsurface, "subsurface"},
                                                  {Role::kIor, "ior"},
                                                  {Role::kOther, "other"}}};
inline std::string_view role_name(Role role) { return name_of(kRoles, role); }
// Returns true if the role determines the roughness. A set has at most one map with such a role.
bool is_roughness(Role role);
template <Role kRole>
bool is(Role role) {
  return role == kRole;
}

// A Channels value is the channels of a file that hold a role.
enum class Channels { kWhole, kRed, kGreen, kBlue, kAlpha, kRgb };

// These are the names of channels in naming files. `all` means the whole map.
inline constexpr NamedValues<Channels, 6> kChannels = {{{Channels::kWhole, "all"},
                                                        {Channels::kRed, "R"},
                                                        {Channels::kGreen, "G"},
                                                        {Channels::kBlue, "B"},
                                                        {Channels::kAlpha, "A"},
                                                        {Channels::kRgb, "RGB"}}};

struct ChannelMeaning {
  Channels channels = Channels::kWhole;
  Role role = Role::kOther;
  std::optional<Parameter> input = {};  // of a surface model, such as coat_weight; the role is then kOther

  bool operator==(const ChannelMeaning&) const = default;
  bool operator<(const ChannelMeaning& other) const {
    return std::tie(channels, role, input) < std::tie(other.channels, other.role, other.input);
  }
};

struct NamingRule {
  std::vector<std::string> words;
  bool ordinary = false;                // the words also occur in names of objects
  std::vector<ChannelMeaning> meaning;  // not empty; at most one roughness and one specular role
};

enum class ResolutionPlace { kNone, kBefore, kBeforeWithFormat, kAfter };
inline constexpr NamedValues<ResolutionPlace, 4> kResolutionPlaces = {
    {{ResolutionPlace::kNone, "none"},
     {ResolutionPlace::kBefore, "before"},
     {ResolutionPlace::kBeforeWithFormat, "before-with-format"},
     {ResolutionPlace::kAfter, "after"}}};

struct Habit {
  std::string name;
  bool built_in = false;
  bool camel_case = false;
  ResolutionPlace resolution = ResolutionPlace::kNone;
  std::vector<NamingRule> rules;
};

// A NameReading is one way to read the name of an image.
struct NameReading {
  std::string stem;  // name of the set; empty if the map's word is the whole name
  // This is the stem with the number before the word of the map: wood_1024 in wood_1024_rough. The number may
  // be a resolution, or part of the set's name.
  std::string numbered_stem;
  std::string habit;      // the name of the convention
  bool doubtful = false;  // valid only if another map has the same stem
  std::vector<ChannelMeaning> meaning;
};

struct NameParts;

// Naming holds naming conventions, indexed for reading names. Copies are independent.
class Naming {
 public:
  // If two conventions match equally well, the earlier one wins. `ignored_words` has the meaning of the
  // member in naming files.
  Naming(std::vector<Habit> habits, std::vector<std::string> ignored_words);

  // Returns the ways to read `name`, a file name without extension and tile. The longest word comes first,
  // because it is the most likely. A word at the beginning is read only if the name ends with no word.
  // Returns nothing if no convention matches.
  std::vector<NameReading> read(std::string_view name) const;

  const std::vector<Habit>& habits() const noexcept { return habits_; }
  const std::vector<std::string>& ignored_words() const noexcept { return ignored_words_; }

 private:
  struct Word {
    std::size_t habit = 0;
    std::size_t rule = 0;
    std::string text;               // as the table writes it
    std::vector<std::size_t> cuts;  // offsets in the word, without separators, where a separator may be
  };
  struct Ending;                                                   // a part of a name that may be a word
  std::vector<NameReading> read_end(std::string_view name) const;  // words at the end
  std::optional<NameReading> read_pair(std::string_view name) const;
  std::vector<NameReading> read_front(std::string_view name) const;
  std::optional<Ending> ending_from(const NameParts& parts, std::size_t first, std::size_t begin) const;
  const Word* best_word(const Ending& ending) const;

  std::vector<Habit> habits_;
  std::vector<std::string> ignored_words_;
  std::unordered_set<std::string> ignored_;                   // words in lower case
  std::unordered_map<std::string, std::vector<Word>> words_;  // keyed by their letters in lower case
  std::size_t longest_word_ = 0;
};

// Returns true if a piece of a name is a resolution, such as 4K, 1024 or 2048x2048. A map's word must not be
// a resolution.
bool is_resolution(std::string_view piece);

// Returns true if a piece is a format or quality next to a resolution (4K-PNG, 2K-HQ). A map's word must not
// be such a piece.
bool is_format_word(std::string_view piece);

// Returns a word in lower case without separators. Two words with the same key are treated as one word.
std::string word_key(std::string_view word);

// Returns the conventions of Substance Painter, Poly Haven, ambientCG, Quixel Megascans, glTF, Mari and
// common renderers.
const Naming& built_in_naming();

// Returns the built-in conventions together with the conventions in `file`. Throws kInput, with file and
// field.
Naming read_naming(const std::filesystem::path& file);

// Reads the text of a naming file in the same way. Errors begin with `context`.
Naming parse_naming(std::string_view text, const std::string& context);

}  // namespace remap
