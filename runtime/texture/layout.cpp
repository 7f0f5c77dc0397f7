#include "texture/layout.hpp"

#include <algorithm>
#include <array>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr auto kRoughness = RoughnessEncoding::kRoughness, kGlossiness = RoughnessEncoding::kGlossiness;
constexpr auto kEightBits = PixelType::kUint8;
constexpr auto kGreenUp = NormalGreen::kUp;

constexpr std::size_t kPlainLayouts = 5;  // layouts without an engine, which come first
constexpr std::array<NamedLayout, 14> kLayouts = {{
    {"as-inputs", "", "", "", {}, {}},
    {"separate", "", "", "", {}, {}},
    {"orm", "", "orm=occlusion,roughness,metallic", "", {}, {}},
    {"arm", "", "arm=occlusion,roughness,metallic", "", {}, {}},
    {"specgloss", "", "specular_glossiness=specular,glossiness", "", {}, {}},
    {"gltf", "", "baseColor=base_color; occlusionRoughnessMetallic=occlusion,roughness,metallic", "png",
     kEightBits, kGreenUp},
    {"unity", "unity unity-urp",
     "BaseMap=base_color; MetallicSmoothness=metallic,metallic,metallic,smoothness; Occlusion=occlusion",
     "png", kEightBits, kGreenUp},
    {"unity-hdrp", "unity-hdrp", "BaseMap=base_color; MaskMap=metallic,occlusion,0,smoothness", "png",
     kEightBits, kGreenUp},
    {"unreal", "unreal unreal-engine ue4 ue5", "T_*_BC=base_color; T_*_ORM=occlusion,roughness,metallic",
     "png", kEightBits, NormalGreen::kDown},
    {"godot", "godot", "albedo=base_color; orm=occlusion,roughness,metallic", "png", kEightBits, kGreenUp},
    {"threejs", "three three-js threejs", "baseColor=base_color; orm=occlusion,roughness,metallic", "png",
     kEightBits, kGreenUp},
    {"blender", "blender", "", "png", kEightBits, kGreenUp},
    {"usd", "usd usdz", "", "png", kEightBits, kGreenUp},
    {"marmoset", "marmoset", "", "png", kEightBits, {}},
}};

// Returns the content that a word in the text of a layout means.
LayoutContent content_of(const std::string& option, const std::string& file, const std::string& word) {
  static const std::vector<std::pair<std::string, LayoutContent>> kWords = {
      {"roughness", LayoutParameter{Parameter::kRoughness, kRoughness}},
      {"glossiness", LayoutParameter{Parameter::kRoughness, kGlossiness}},
      {"smoothness", LayoutParameter{Parameter::kRoughness, kGlossiness}},
      {"metallic", LayoutParameter{Parameter::kMetallic, {}}},
      {"specular", LayoutParameter{Parameter::kSpecular, {}}},
      {"diffuse", LayoutParameter{Parameter::kDiffuse, {}}},
      {"base_color", LayoutParameter{Parameter::kBaseColor, {}}},
      {"occlusion", std::string("occlusion")}};
  std::vector<std::string> known;
  for (const auto& [name, content] : kWords) {
    if (name == word) return content;
    known.push_back(name);
  }
  const auto number = parse_number(word);
  if (number && *number >= 0.0 && *number <= 1.0) return static_cast<float>(*number);
  throw usage_error(option + ": " + file + ": unknown content '" + word + "' (choose " + joined(known, ", ") +
                    ", or a number from 0 to 1)");
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(' ') - begin + 1));
}

std::size_t channels_of(const LayoutContent& content) {
  const auto* own = std::get_if<LayoutParameter>(&content);
  return own != nullptr && is_color(own->parameter) ? 3 : 1;
}

LayoutFile file_from(const std::string& option, const std::string& text) {
  const std::size_t sign = text.find('=');
  LayoutFile file;
  file.name = trimmed(std::string_view(text).substr(0, sign));
  if (sign == std::string::npos || file.name.empty() || file.name.find('/') != std::string::npos)
    throw usage_error(
        option + ": '" + text +
        "' does not describe a file (write NAME=CONTENT,..., such as orm=occlusion,roughness,metallic)");
  std::size_t channels = 0;
  for (const std::string& word : parts_between(std::string_view(text).substr(sign + 1), ',')) {
    file.content.push_back(content_of(option, file.name, trimmed(word)));
    channels += channels_of(file.content.back());
  }
  if (channels != 1 && channels != 3 && channels != 4)
    throw usage_error(option + ": " + file.name + " has " + std::to_string(channels) +
                      " channels (use 1, 3 or 4; a color counts as three)");
  return file;
}

Layout layout_in(const std::string& option, const std::string& name, std::string_view text) {
  Layout layout;
  layout.name = name;
  layout.keeps_names = name == "as-inputs";
  for (const std::string& part : parts_between(text, ';'))
    if (const std::string file = trimmed(part); !file.empty())
      layout.files.push_back(file_from(option, file));
  for (const LayoutFile& file : layout.files)
    for (const LayoutContent& content : file.content)
      if (const auto* own = std::get_if<LayoutParameter>(&content); own != nullptr && own->width) {
        if (const auto other = layout.width(); other != own->width)
          throw usage_error(option + ": holds both roughness and glossiness (choose one)");
      }
  return layout;
}

}  // namespace

std::optional<RoughnessEncoding> Layout::width() const {
  for (const LayoutFile& file : files)
    for (const LayoutContent& content : file.content)
      if (const auto* own = std::get_if<LayoutParameter>(&content); own != nullptr && own->width)
        return own->width;
  return std::nullopt;
}

const LayoutFile* Layout::file_with(Parameter parameter) const {
  const auto found = std::ranges::find_if(files, [parameter](const LayoutFile& file) {
    return std::ranges::any_of(file.content, [parameter](const LayoutContent& content) {
      const auto* own = std::get_if<LayoutParameter>(&content);
      return own != nullptr && own->parameter == parameter;
    });
  });
  return found == files.end() ? nullptr : &*found;
}

bool Layout::has_place_for(std::string_view carried) const {
  for (const LayoutFile& file : files)
    for (const LayoutContent& content : file.content) {
      const auto* other = std::get_if<std::string>(&content);
      const auto* own = std::get_if<LayoutParameter>(&content);
      if (other != nullptr && *other == carried) return true;
      if (own != nullptr && parameter_name(own->parameter) == carried) return true;
    }
  return false;
}

Layout as_inputs() { return {"as-inputs", true, {}}; }

Layout separate() { return {"separate", false, {}}; }

std::span<const NamedLayout> named_layouts() { return kLayouts; }

std::span<const NamedLayout> engine_layouts() { return named_layouts().subspan(kPlainLayouts); }

const NamedLayout* engine_layout(std::string_view name) {
  const auto found = std::ranges::find(engine_layouts(), name, &NamedLayout::name);
  return found == engine_layouts().end() ? nullptr : &*found;
}

const NamedLayout* engine_layout_of(std::string_view word) {
  const auto found = std::ranges::find_if(kLayouts, [word](const NamedLayout& layout) {
    const std::vector<std::string> words = parts_between(layout.words, ' ');
    return !word.empty() && contains(words, word);
  });
  return found == kLayouts.end() ? nullptr : &*found;
}

Layout layout_from(const std::string& option, const std::string& text) {
  if (text.find('=') != std::string::npos) return layout_in(option, text, text);
  std::vector<std::string> known;
  for (const NamedLayout& layout : kLayouts) {
    if (layout.name == text) return layout_in(option, text, layout.files);
    known.emplace_back(layout.name);
  }
  throw usage_error(option + ": unknown layout '" + text + "'" + suggestion(text, known) +
                    (nearest_name(text, known).empty() ? ", or write FILE=CONTENT,..." : ""));
}

}  // namespace remap
