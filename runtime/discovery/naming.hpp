// Which map of which set an image is, told by its name: the habits of the tools that write texture sets.
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
// Of a rule:
// - `words` end the name of a map, before resolution and tile. They compare without regard to case, and
//   a separator in a word (`_`, `-`, `.`, space) stands for any separator or none: `base_color` is
//   baseColor, Base-Color and basecolor too, whereas `baseColor` is not base_color. Where several words
//   fit, the longest wins; of two habits that know the same word, that of the file wins.
// - `role` says what the whole map holds, `channels` what R, G, B, A or RGB hold; one of the two. Roles
//   are listed below.
// - `ordinary` (default false): the words are in names of things too (robot_arm). They count only where
//   another map has the same stem, where a resolution is beside them, or in capitals that the table has
//   too.
//
// Of a habit:
// - `camel_case` (default false): a word may follow the name of the set without a separator, as in
//   heroSpec.
// - `resolution` (default "none"): where the tool writes it: "before" the word (x_4K_Gloss),
//   "before-with-format" (x_4K-PNG_Color), "after" (x_rough_4k). Every habit accepts every place; this
//   only decides which habit is named where several know the word.
//
// `ignored_words` (optional) may stand after the word of a map, as names of color spaces do.
#pragma once

#include <compare>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace remap {

// What channels of a map say about the material.
enum class Role {
  kRoughness,
  kGlossiness,         // 1 - roughness
  kGlossinessSquared,  // Corona's, as Substance writes it: known, not converted
  kAlphaWidth,         // microfacet width, roughness squared
  kSpecular,           // reflectance at normal incidence
  kSpecularLevel,      // an artist's scale of it: known, not converted
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
  kOther,  // a map that is known and has no role here: masks, coats, sheen
};

// As naming files write it: `base_color`.
std::string_view role_name(Role role);
// Every role in the order of the enumeration.
std::span<const Role> all_roles();
// Whether the role tells the width of the highlight: a set has one such map.
bool tells_width(Role role);

// Which channels of a file a role takes.
enum class Channels { kWhole, kRed, kGreen, kBlue, kAlpha, kRgb };

// As naming files write it: `R`, `RGB`; `all` for the whole map.
std::string_view channels_name(Channels channels);
std::span<const Channels> all_channels();

struct ChannelMeaning {
  Channels channels = Channels::kWhole;
  Role role = Role::kOther;

  auto operator<=>(const ChannelMeaning&) const = default;
};

struct NamingRule {
  std::vector<std::string> words;
  bool ordinary = false;                // the words are in names of things too
  std::vector<ChannelMeaning> meaning;  // at least one; at most one width and one specular
};

enum class ResolutionPlace { kNone, kBefore, kBeforeWithFormat, kAfter };

struct Habit {
  std::string name;
  bool built_in = false;
  bool camel_case = false;
  ResolutionPlace resolution = ResolutionPlace::kNone;
  std::vector<NamingRule> rules;
};

// One way to read the name of an image.
struct NameReading {
  std::string stem;  // what names the set; empty where the name is nothing but the word of the map
  // The same with a bare number before the word, which may be a resolution or the set's own: wood_1024_rough.
  std::string numbered_stem;
  std::string habit;      // the name of the habit
  bool doubtful = false;  // counts only where another map has the same stem
  std::vector<ChannelMeaning> meaning;
};

struct NameParts;

// Habits, ready to be asked. Copies are independent.
class Naming {
 public:
  // Earlier habits win over later ones that fit as well. `ignored_words` as in the file.
  Naming(std::vector<Habit> habits, std::vector<std::string> ignored_words);

  // The ways to read `name`, a file name without extension and tile; the longest word first, and with it the
  // likeliest. Empty where no habit knows the end of the name.
  std::vector<NameReading> read(std::string_view name) const;

  const std::vector<Habit>& habits() const noexcept { return habits_; }
  const std::vector<std::string>& ignored_words() const noexcept { return ignored_words_; }

 private:
  struct Word {
    std::size_t habit = 0;
    std::size_t rule = 0;
    std::string text;               // as the table writes it
    std::vector<std::size_t> cuts;  // where separators may stand, counted without separators
  };
  struct Ending;  // a part of a name that may be a word
  std::optional<Ending> ending_from(const NameParts& parts, std::size_t first, std::size_t begin) const;
  const Word* best_word(const Ending& ending) const;

  std::vector<Habit> habits_;
  std::vector<std::string> ignored_words_;
  std::unordered_set<std::string> ignored_;                   // in lower case
  std::unordered_map<std::string, std::vector<Word>> words_;  // by their letters in lower case
  std::size_t longest_word_ = 0;
};

// Whether a piece of a name is a resolution, such as 4K, 1024 or 2048x2048. Words of maps cannot be.
bool is_resolution(std::string_view piece);

// Whether it is a format or quality as it stands beside a resolution (4K-PNG, 2K-HQ). Words of maps cannot
// be.
bool is_format_word(std::string_view piece);

// A word without separators and case: words of equal key are the same word.
std::string word_key(std::string_view word);

// The habits of Substance Painter, Poly Haven, ambientCG, Quixel Megascans, glTF, Mari and common renderers.
const Naming& built_in_naming();

// The built-in habits extended by those of `file`. Throws kInput, naming file and field, where it is not of
// the form above.
Naming read_naming(const std::filesystem::path& file);

// The same for the text of a naming file; complaints open with `place`.
Naming parse_naming(std::string_view text, const std::string& place);

}  // namespace remap
