#include "assets/mtl/mtl_material.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kExcerptOfLine = 60;

enum class OptionArguments { kWord, kNumbers };
struct MapOption {
  std::string_view name;
  OptionArguments arguments;
  std::size_t most;  // largest number of arguments
};
constexpr std::array<MapOption, 14> kMapOptions = {{{"-s", OptionArguments::kNumbers, 3},
                                                    {"-o", OptionArguments::kNumbers, 3},
                                                    {"-t", OptionArguments::kNumbers, 3},
                                                    {"-mm", OptionArguments::kNumbers, 2},
                                                    {"-bm", OptionArguments::kNumbers, 1},
                                                    {"-boost", OptionArguments::kNumbers, 1},
                                                    {"-texres", OptionArguments::kNumbers, 1},
                                                    {"-blendu", OptionArguments::kWord, 1},
                                                    {"-blendv", OptionArguments::kWord, 1},
                                                    {"-clamp", OptionArguments::kWord, 1},
                                                    {"-cc", OptionArguments::kWord, 1},
                                                    {"-imfchan", OptionArguments::kWord, 1},
                                                    {"-type", OptionArguments::kWord, 1},
                                                    {"-colorspace", OptionArguments::kWord, 1}}};

// A MapReader reads the arguments of a map in order.
class MapReader {
 public:
  MapReader(const MtlDocument& document, std::size_t statement)
      : document_(document), words_(document.words(document.statements()[statement])) {
    constexpr std::array<std::string_view, 4> kColors = {"map_ka", "map_kd", "map_ke", "map_ks"};
    const std::string word = document.word(document.statements()[statement]);
    map_.is_color = contains(kColors, word);
    map_.statement = statement;
    const std::size_t end = document.statements()[statement].arguments.end;
    map_.name = {end, end};
  }

  MtlMap read() {
    const std::size_t begin = words_.empty() ? map_.name.begin : words_.front().begin;
    while (at_ < words_.size() && read_option()) {
    }
    if (at_ < words_.size()) {
      map_.name = words_[at_];
      map_.options = std::string(document_.raw({begin, map_.name.begin}));
      while (++at_ < words_.size() && option_at(at_) == kMapOptions.end()) map_.name.end = words_[at_].end;
    }
    // Some tools write options after the name.
    is_named_ = true;
    while (at_ < words_.size())
      if (!read_option()) ++at_;
    if (!words_.empty()) map_.options += document_.raw({map_.name.end, words_.back().end});
    MtlStatement name;
    name.arguments = map_.name;
    map_.file = document_.rest(name);
    std::ranges::replace(map_.file, '\\', '/');
    return std::move(map_);
  }

 private:
  const MapOption* option_at(std::size_t index) const {
    const std::string word = in_lower_case(document_.raw(words_[index]));
    return std::ranges::find(kMapOptions, word, &MapOption::name);
  }

  bool read_option() {
    const MapOption* const option = option_at(at_);
    if (option == kMapOptions.end()) return false;
    const std::size_t begin = words_[at_++].begin;
    if (option->arguments == OptionArguments::kWord) {
      if (at_ < words_.size()) apply_word(option->name, in_lower_case(document_.raw(words_[at_++])));
      return true;
    }
    std::vector<double> numbers;
    // If the name is not complete yet, the last word belongs to it, even if it is a number.
    const std::size_t end = words_.size() - (is_named_ ? 0 : 1);
    while (numbers.size() < option->most && at_ < end) {
      const auto number = mtl_number(document_.raw(words_[at_]));
      if (!number) break;
      numbers.push_back(*number);
      ++at_;
    }
    apply_numbers(option->name, numbers);
    if (option->name == "-mm")
      map_.levels.push_back({begin, at_ < words_.size() ? words_[at_].begin : words_.back().end});
    return true;
  }

  void apply_word(std::string_view option, const std::string& word) {
    if (option == "-clamp") map_.clamps = word == "on";
    if (option == "-imfchan" && !word.empty()) map_.channel = word.front();
    const bool changes_values = (option == "-cc" && word == "on") ||
                                (option == "-colorspace" && word != (map_.is_color ? "srgb" : "linear"));
    if (changes_values) map_.unusual.push_back(std::string(option) + " " + plain(word, 40));
  }

  void apply_numbers(std::string_view option, const std::vector<double>& numbers) {
    for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 2); ++i) {
      if (option == "-s") map_.scale[i] = numbers[i];
      if (option == "-o") map_.offset[i] = numbers[i];
    }
    if (option == "-bm" && !numbers.empty()) map_.strength = numbers.front();
    if (option == "-mm" && !numbers.empty()) map_.base = numbers[0];
    if (option == "-mm" && numbers.size() > 1) map_.gain = numbers[1];
    if (option == "-t" && std::ranges::any_of(numbers, [](double number) { return number != 0.0; }))
      map_.unusual.push_back(std::string(option));
  }

  const MtlDocument& document_;
  std::vector<TextSpan> words_;
  std::size_t at_ = 0;
  bool is_named_ = false;
  MtlMap map_;
};

// A StatementReader reads numbers of statements, and records what it clamps.
class StatementReader {
 public:
  StatementReader(const MtlDocument& document, std::vector<std::string>& warnings)
      : document_(document), warnings_(warnings) {}

  // Reads one number for all channels, or three.
  std::array<double, 3> color(const MtlStatement& statement, double most) const {
    const std::vector<TextSpan> words = document_.words(statement);
    const std::string kind = words.empty() ? "" : in_lower_case(document_.raw(words.front()));
    if (kind == "spectral" || kind == "xyz")
      throw input_error(line_of(statement) + ": " + kind +
                        " colors are not read (write red, green and blue)");
    std::array<double, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::optional<double> value = c < words.size() ? finite(words[c]) : std::nullopt;
      if (!value && c == 1) return {color[0], color[0], color[0]};
      if (!value) throw input_error(line_of(statement) + ": expected three numbers from 0 to 1");
      color[c] = clamped(statement, *value, 0.0, most);
    }
    return color;
  }

  double number(const MtlStatement& statement, double least, double most, const char* expected) const {
    const std::vector<TextSpan> words = document_.words(statement);
    // With `d -halo 0.5`, opacity depends on the angle. Only the number is used.
    const bool has_option = words.size() > 1 && in_lower_case(document_.raw(words.front())) == "-halo";
    const std::size_t index = has_option ? 1 : 0;
    const std::optional<double> value = index < words.size() ? finite(words[index]) : std::nullopt;
    if (!value) throw input_error(line_of(statement) + ": expected " + expected);
    return clamped(statement, *value, least, most);
  }

  double exponent(const MtlStatement& statement) const {
    const std::vector<TextSpan> words = document_.words(statement);
    const std::optional<double> value = words.empty() ? std::nullopt : finite(words.front());
    if (!value) throw input_error(line_of(statement) + ": expected an exponent from 0 to 1000");
    return *value < 0.0 ? *value : clamped(statement, *value, 0.0, LegacyMaterial::kMostExponent);
  }

 private:
  std::string line_of(const MtlStatement& statement) const {
    return plain(std::string(document_.raw(statement.word)) + " " + document_.rest(statement).substr(0, 200),
                 kExcerptOfLine);
  }

  std::optional<double> finite(TextSpan word) const { return mtl_number(document_.raw(word)); }

  double clamped(const MtlStatement& statement, double value, double least, double most) const {
    const double result = std::clamp(value, least, most);
    if (result != value)
      warnings_.push_back(line_of(statement) + ": " + number_text(value) + " is outside of " +
                          number_text(least) + " to " + number_text(most) + " and becomes " +
                          number_text(result));
    return result;
  }

  const MtlDocument& document_;
  std::vector<std::string>& warnings_;
};

std::optional<MtlMap> map_at(const MtlDocument& document, std::size_t statement) {
  MtlMap map = read_mtl_map(document, statement);
  return map.file.empty() ? std::nullopt : std::optional(std::move(map));
}

constexpr std::array<double, 3> kUnused = {1.0, 1.0, 1.0};  // replaces a number that a map multiplies

// Applies Blender's rules for materials of its Principled BSDF. Roughness is 1 - sqrt(Ns / scale). Metallic
// is Ka if illum is 3 or 6, or if Ka is not 1. Ks is the specular level, and a level of 0.5 means F0 0.04.
// map_Ns holds roughness, and map_refl metallic. If there is a map, its number is not used.
void apply_blender(double scale, MtlSurface& surface) {
  if (surface.diffuse_map) surface.diffuse = kUnused;
  if (!surface.roughness) {
    const double exponent = std::clamp(surface.exponent.value_or(0.0), 0.0, scale);
    surface.roughness = 1.0 - std::sqrt(exponent / scale);
  }
  if (!surface.metallic) {
    const double ambient = surface.ambient.value_or(1.0), illumination = surface.illumination.value_or(2.0);
    const bool is_metallic = illumination == 3.0 || illumination == 6.0 || ambient < 1.0;
    surface.metallic = is_metallic ? ambient : 0.0;
  }
  if (!surface.roughness_map) surface.roughness_map = surface.exponent_map;
  if (!surface.metallic_map) surface.metallic_map = surface.reflection_map;
  if (surface.specular && !surface.specular_map) surface.specular_level = 2.0 * surface.specular->front();
}

// Applies the rules of nvdiffrec and of programs based on it: Ks and map_Ks have roughness in green, metallic
// in blue.
void apply_nvdiffrec(MtlSurface& surface) {
  const std::array<double, 3> packed = surface.specular.value_or(kUnused);
  surface.roughness = packed[1];
  surface.metallic = surface.specular || surface.specular_map ? packed[2] : 0.0;
  if (!surface.specular_map) return;
  surface.roughness_map = surface.metallic_map = surface.specular_map;
  surface.roughness_map->channel = 'g';
  surface.metallic_map->channel = 'b';
}

// Replaces metallic and roughness by what the maker of the file wrote in other statements. Pr, Pm and their
// maps stay.
void apply_maker(MtlMaker maker, MtlSurface& surface) {
  switch (maker) {
    case MtlMaker::kText:
      return;
    case MtlMaker::kBlender:
    case MtlMaker::kBlender28:
      apply_blender(blender_scale(maker), surface);
      break;
    case MtlMaker::kNvdiffrec:
      if (!surface.has_pbr_bsdf) return;
      apply_nvdiffrec(surface);
      break;
  }
  surface.is_metal_rough = true;
}

}  // namespace

MtlMap read_mtl_map(const MtlDocument& document, std::size_t statement) {
  return MapReader(document, statement).read();
}

std::optional<double> mtl_number(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  const std::optional<double> value = parse_number(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

bool has_metal_rough_lines(const MtlDocument& document, const MtlBlock& block) {
  constexpr std::array<std::string_view, 4> kWords = {"pr", "pm", "map_pr", "map_pm"};
  for (std::size_t i = block.first; i < block.last; ++i)
    if (contains(kWords, document.word(document.statements()[i]))) return true;
  return false;
}

void read_mtl_surface(const MtlDocument& document, const MtlBlock& block, MtlMaker maker, MtlSurface& surface,
                      std::vector<std::string>& warnings) {
  const StatementReader reader(document, warnings);
  surface.last_statement = block.last - 1;
  std::optional<std::size_t> exponent;
  std::optional<Error> failure;
  const auto read = [&](std::size_t i) {
    const MtlStatement& statement = document.statements()[i];
    const std::string word = document.word(statement);
    if (word == "kd") {
      surface.diffuse = reader.color(statement, 1.0);
      surface.diffuse_statement = i;
    }
    if (word == "ks") surface.specular = reader.color(statement, 1.0);
    if (word == "ns") exponent = i;
    if (word == "ka" && maker != MtlMaker::kText) surface.ambient = reader.color(statement, 1.0).front();
    if (word == "bsdf") surface.has_pbr_bsdf = in_lower_case(document.rest(statement)) == "pbr";
    if (word == "illum") surface.illumination = reader.number(statement, 0.0, 10.0, "a number from 0 to 10");
    if (word == "pr") surface.roughness = reader.number(statement, 0.0, 1.0, "a number from 0 to 1");
    if (word == "pm") surface.metallic = reader.number(statement, 0.0, 1.0, "a number from 0 to 1");
    if (word == "map_kd") surface.diffuse_map = map_at(document, i);
    if (word == "map_ks") surface.specular_map = map_at(document, i);
    if (word == "map_ns") surface.exponent_map = map_at(document, i);
    if (word == "map_refl" || word == "refl") surface.reflection_map = map_at(document, i);
    if (word == "map_pr") surface.roughness_map = map_at(document, i);
    if (word == "map_pm") surface.metallic_map = map_at(document, i);
  };
  const auto attempt = [&](const auto& step) {
    try {
      step();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      if (!failure) failure = error;
    }
  };
  for (std::size_t i = block.first + 1; i < block.last; ++i) attempt([&] { read(i); });
  // If there are several lines Ns, only the last one is read.
  if (exponent) attempt([&] { surface.exponent = reader.exponent(document.statements()[*exponent]); });
  const bool is_black = surface.diffuse && *surface.diffuse == std::array<double, 3>{};
  if (is_black && surface.diffuse_map) {
    // Taken literally, Kd 0 would make the map black. Exporters write 0 because the map replaces this number.
    warnings.emplace_back("Kd is 0, which would make map_Kd black: texremap uses Kd 1");
    surface.diffuse = kUnused;
  }
  surface.is_metal_rough = has_metal_rough_lines(document, block);
  apply_maker(maker, surface);
  if (failure) throw *failure;
}

MtlCover read_mtl_cover(const MtlDocument& document, const MtlBlock& block, MtlMaker maker,
                        std::vector<std::string>& warnings) {
  const StatementReader reader(document, warnings);
  MtlCover cover;
  for (std::size_t i = block.first + 1; i < block.last; ++i) {
    const MtlStatement& statement = document.statements()[i];
    const std::string word = document.word(statement);
    if (word == "d") cover.opacity = reader.number(statement, 0.0, 1.0, "a number from 0 to 1");
    if (word == "tr") cover.transparency = reader.number(statement, 0.0, 1.0, "a number from 0 to 1");
    if (word == "ke") {
      cover.emissive = reader.color(statement, 1.0);
      cover.has_emissive = true;
    }
    if (word == "map_d") cover.opacity_map = map_at(document, i);
    if (word == "map_ke") cover.emissive_map = map_at(document, i);
    if (word == "norm" || word == "map_kn") cover.normal_map = map_at(document, i);
    if (word == "bump" || word == "map_bump") cover.bump_map = map_at(document, i);
    if (word == "disp") cover.has_displacement = true;
    if (word == "ni") cover.refraction = reader.number(statement, 0.0, 1000.0, "an index of refraction");
    if (word == "tf") cover.filter = reader.color(statement, 1.0);
    if (word == "illum") {
      const double model = mtl_number(document.rest(statement)).value_or(0.0);
      cover.refracts = model == 4.0 || model == 6.0 || model == 7.0 || model == 9.0;
    }
  }
  if (maker == MtlMaker::kText) return cover;
  // Blender and other programs write these numbers although maps replace them. They also write illum 6 and 9
  // for any alpha.
  if (cover.opacity_map) cover.opacity = 1.0;
  if (cover.emissive_map) cover.has_emissive = false, cover.emissive = {};
  cover.refracts = false;
  return cover;
}

MetalRoughFactors metal_rough_of(const MtlSurface& surface, bool is_core) {
  MetalRoughFactors numbers;
  numbers.base_color = surface.diffuse.value_or(numbers.base_color);
  numbers.metallic = surface.metallic_map ? 1.0 : surface.metallic.value_or(0.0);
  numbers.roughness = surface.roughness_map ? 1.0 : surface.roughness.value_or(1.0);
  // Core cannot remove the highlight of a dielectric. It is least visible at roughness 1.
  if (is_core && surface.specular_level == 0.0 && numbers.metallic == 0.0) numbers.roughness = 1.0;
  return numbers;
}

LegacyMaterial reflection_of(const MtlSurface& surface, std::vector<std::string>& warnings) {
  constexpr double kDiffuseDefault = 0.8;
  const std::array<double, 3> white = {1.0, 1.0, 1.0}, black{};
  const bool has_map = surface.diffuse_map.has_value();
  LegacyMaterial factors;
  factors.diffuse = surface.diffuse.value_or(
      has_map ? white : std::array<double, 3>{kDiffuseDefault, kDiffuseDefault, kDiffuseDefault});
  if (!surface.diffuse && !has_map)
    warnings.push_back("has no Kd: " + number_text(kDiffuseDefault) + " is used instead");
  factors.specular = surface.specular.value_or(surface.specular_map ? white : black);
  const bool is_shaded_by_specular = surface.illumination.value_or(2.0) >= 2.0;
  if (!is_shaded_by_specular || !factors.has_highlight()) {
    factors.specular = black;
    return factors;
  }
  if (!surface.exponent && surface.exponent_map)
    throw input_error("has map_Ns but no Ns, which the map multiplies (add a line such as Ns 1000)");
  if (surface.exponent.value_or(0.0) <= 0.0) {
    warnings.push_back((surface.exponent ? "has Ns " + number_text(*surface.exponent) : "has no Ns") +
                       ", so its Ks gives no highlight (write the exponent of the highlight as Ns)");
    factors.specular = black;
    return factors;
  }
  factors.exponent = *surface.exponent;
  if (factors.exponent < LegacyMaterial::kLeastExponent) {
    factors.exponent = LegacyMaterial::kLeastExponent;
    warnings.push_back("Ns " + number_text(*surface.exponent) +
                       ": the highlight covers the whole surface, so texremap uses Ns 1");
  }
  return factors;
}

}  // namespace remap
