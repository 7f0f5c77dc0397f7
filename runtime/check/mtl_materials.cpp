// This file reads materials of Wavefront MTL files, with the metallic and roughness lines of later tools.
#include <algorithm>
#include <array>
#include <string_view>

#include "assets/document/mtl_document.hpp"
#include "assets/mtl/mtl_asset.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "check/material.hpp"
#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// These are the words of lines with maps, in lower case.
constexpr NamedValues<Role, 11> kMapLines = {{{Role::kDiffuse, "map_kd"},
                                              {Role::kSpecular, "map_ks"},
                                              {Role::kOther, "map_ns"},
                                              {Role::kRoughness, "map_pr"},
                                              {Role::kMetallic, "map_pm"},
                                              {Role::kOpacity, "map_d"},
                                              {Role::kEmissive, "map_ke"},
                                              {Role::kHeight, "map_bump"},
                                              {Role::kHeight, "bump"},
                                              {Role::kNormal, "norm"},
                                              {Role::kNormal, "map_kn"}}};

Channels channels_of(const MtlMap& map) {
  switch (map.channel) {
    case 'r':
      return Channels::kRed;
    case 'g':
      return Channels::kGreen;
    case 'b':
      return Channels::kBlue;
    case 'm':
      return Channels::kAlpha;
    default:
      return Channels::kWhole;
  }
}

// Returns true if any program uses the highlight of a material. It needs illumination of highlights, and Ks
// above 0, because Ks multiplies its map.
bool has_highlight(const MtlSurface& surface) {
  const bool is_black = surface.specular && *surface.specular == std::array<double, 3>{};
  return surface.illumination.value_or(2.0) >= 2.0 && !is_black;
}

void add_map(const MtlMap& map, std::string_view word, Role role, bool is_read, CheckedMaterial& material) {
  const fs::path path = material.path.parent_path() / fs::path(map.file).relative_path();
  std::vector<MaterialUse>& uses = is_read ? material.uses : material.unread;
  uses.push_back({role, material.maps.size(), channels_of(map), std::string(word), {}, "", false});
  material.maps.push_back({path, path.string(), path.filename().string()});
}

// Reads a material as conversions do, and records what they refuse.
MtlSurface read_block(const MtlDocument& document, const MtlBlock& block, MtlMaker maker,
                      CheckedMaterial& material) {
  const auto attempt = [&](const auto& step) {
    try {
      step();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      material.failures.emplace_back(error.what());
    }
  };
  MtlSurface surface;
  std::vector<std::string> ignored;
  attempt([&] { read_mtl_surface(document, block, maker, surface, ignored); });
  attempt([&] { (void)read_mtl_cover(document, block, maker, ignored); });
  return surface;
}

// Returns the role of a line, which depends on the maker of the file. `written` is the role in files of the
// specification.
Role role_of(std::string_view word, Role written, MtlMaker maker) {
  if (maker == MtlMaker::kText) return written;
  const bool is_blender = maker != MtlMaker::kNvdiffrec;
  if (is_blender && word == "map_ns") return Role::kRoughness;
  if (is_blender && word == "map_refl") return Role::kMetallic;
  if (!is_blender && word == "map_ks") return Role::kOther;
  return written;
}

}  // namespace

void add_mtl(const fs::path& file, FoundMaterials& found) {
  const std::string text = mtl_text(MemorySource(read_file(file)), display_path(file));
  const MtlDocument document(text, display_path(file));
  const MtlMaker maker = maker_of(document);
  std::vector<double> exponents;
  const std::size_t first = found.materials.size();
  for (const MtlBlock& block : document.materials()) {
    CheckedMaterial& material = found.materials.emplace_back();
    const std::string name = "material \"" + plain(block.name) + "\"";
    material.kind = MaterialKind::kMtl;
    material.path = file;
    material.name = display_path(file) + ": " + name;
    const MtlSurface surface = read_block(document, block, maker, material);
    const bool shines = maker != MtlMaker::kText || has_highlight(surface);
    for (std::size_t i = block.first; i < block.last; ++i) {
      const MtlStatement& statement = document.statements()[i];
      const std::string word = document.word(statement);
      const std::vector<TextSpan> words = document.words(statement);
      if (maker == MtlMaker::kText && word == "ns" && !words.empty() && shines)
        if (const auto value = mtl_number(document.raw(words.front()))) exponents.push_back(*value);
      const std::optional<Role> written = value_named(kMapLines, word);
      if (!written) continue;
      if (const MtlMap map = read_mtl_map(document, i); !map.file.empty())
        add_map(map, word, role_of(word, *written, maker),
                map.strength != 0.0 && (shines || *written != Role::kSpecular), material);
    }
  }
  if (first < found.materials.size()) found.materials[first].exponents = std::move(exponents);
}

}  // namespace remap
