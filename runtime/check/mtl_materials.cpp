// Materials of Wavefront MTL files, with the lines for metallic and roughness that later tools added.
#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include "check/material.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "core/read_file.hpp"
#include "sets/folder_walk.hpp"
#include "sets/name_pieces.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

struct MapLine {
  std::string_view word;  // in lower case
  Role role;
};
constexpr std::array<MapLine, 11> kMapLines = {{{"map_kd", Role::kDiffuse},
                                                {"map_ks", Role::kSpecular},
                                                {"map_ns", Role::kOther},
                                                {"map_pr", Role::kRoughness},
                                                {"map_pm", Role::kMetallic},
                                                {"map_d", Role::kOpacity},
                                                {"map_ke", Role::kEmissive},
                                                {"map_bump", Role::kHeight},
                                                {"bump", Role::kHeight},
                                                {"norm", Role::kNormal},
                                                {"map_kn", Role::kNormal}}};

// The options of a map, which come before its name and, from some tools, after it; those that take a word,
// not numbers.
constexpr std::array<std::string_view, 13> kOptions = {
    "-imfchan", "-type", "-colorspace", "-clamp", "-blendu", "-blendv", "-cc",
    "-s",       "-o",    "-t",          "-mm",    "-bm",     "-texres"};
constexpr std::size_t kOptionsOfWords = 7;

// The file that a line names; the name may hold spaces. Backslashes are separators of folders.
std::string file_in(std::istringstream& line) {
  std::string word, name;
  while (line >> word) {
    const auto option = std::ranges::find(kOptions, lower(word));
    if (option != kOptions.end() && !name.empty()) break;
    if (option != kOptions.end()) {
      if (option < kOptions.begin() + kOptionsOfWords) line >> word;
    } else if (!name.empty() || !parse_number(word)) {
      name += (name.empty() ? "" : " ") + word;
    }
  }
  std::ranges::replace(name, '\\', '/');
  return name;
}

}  // namespace

void add_mtl(const fs::path& file, FoundMaterials& found) {
  std::istringstream lines(read_file(file));
  std::vector<CheckedMaterial> materials;
  std::vector<Exponent> exponents;
  for (std::string text; std::getline(lines, text);) {
    std::istringstream line(text);
    std::string word;
    line >> word;
    word = lower(word);
    if (word == "newmtl") {
      std::string name;
      std::getline(line >> std::ws, name);
      while (!name.empty() && (name.back() == '\r' || name.back() == ' ')) name.pop_back();
      CheckedMaterial material;
      material.kind = MaterialKind::kMtl;
      material.place = file;
      material.name = shown(file) + ": material \"" + plain(name) + "\"";
      materials.push_back(std::move(material));
      continue;
    }
    if (materials.empty()) continue;
    std::string number;
    if (word == "ns" && line >> number) {
      if (const auto value = parse_number(number))
        exponents.push_back({materials.back().name.substr(shown(file).size() + 2), *value});
      continue;
    }
    for (const MapLine& known : kMapLines) {
      if (known.word != word) continue;
      const std::string name = file_in(line);
      if (name.empty()) continue;
      const fs::path path = file.parent_path() / fs::path(name).relative_path();
      CheckedMaterial& material = materials.back();
      material.uses.push_back(
          {known.role, material.maps.size(), Channels::kWhole, std::string(known.word), {}, "", false});
      material.maps.push_back({path, shown(path), path.filename().string(), nullptr});
    }
  }
  if (!materials.empty()) materials.front().exponents = std::move(exponents);
  for (CheckedMaterial& material : materials) found.materials.push_back(std::move(material));
}

}  // namespace remap
