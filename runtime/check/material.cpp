#include "check/material.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <string_view>
#include <utility>

#include "assets/document/gltf_extensions.hpp"
#include "assets/maps/map_pixels.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Returns `R` for `R` and for the layer `rough.R`.
std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

// Finds a channel. In a texture, a grey image has its value in every color channel.
std::optional<std::size_t> channel_of(const TexelSample& texels, Channels channels, bool is_texture) {
  const auto& all = texels.layout.channels;
  if (channels == Channels::kWhole) return 0;
  if (channels == Channels::kAlpha)
    return texels.layout.alpha_channel < 0
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(texels.layout.alpha_channel));
  const std::string_view wanted = name_of(kChannels, channels);
  for (std::size_t c = 0; c < all.size(); ++c)
    if (last_part(all[c].name) == wanted) return c;
  const bool is_grey = all.size() == (texels.layout.alpha_channel < 0 ? 1u : 2u);
  return is_texture && is_grey ? std::optional<std::size_t>(0) : std::nullopt;
}

// Returns the reason why the image of a map cannot be read, or an empty text after success.
std::string read_map(MaterialMap& map, bool is_texture) {
  try {
    map.texels =
        std::make_shared<const TexelSample>(is_texture ? sample_of_texture(map.file) : sample_of(map.file));
  } catch (const Error& error) {
    const std::string message = error.what(), own = map.file.string();
    return message.starts_with(own) ? map.shown + message.substr(own.size()) : message;
  } catch (const std::bad_alloc&) {
    return map.shown + ": out of memory (use fewer --threads)";
  }
  return "";
}

}  // namespace

std::vector<std::string> CheckedMaterial::read_maps() {
  std::vector<std::string> problems;
  std::map<std::filesystem::path, MaterialMap> read;  // keyed by the first image of the map
  for (MaterialMap& map : maps) {
    const std::filesystem::path first = map.file;
    if (const auto known = read.find(first); known != read.end()) {
      map = known->second;
      continue;
    }
    std::vector<MaterialMap> images = std::exchange(map.others, {});
    images.insert(images.begin(), map);
    std::vector<std::string> reasons;
    for (MaterialMap& image : images) {
      const std::string reason = read_map(image, kind != MaterialKind::kFolder);
      if (reason.empty()) {
        map = std::move(image);
        break;
      }
      reasons.push_back(reason);
    }
    if (map.texels == nullptr) std::ranges::move(reasons, std::back_inserter(problems));
    read[first] = map;
  }
  // A bump map of MTL may hold heights or normals. Like convert, check looks at its texels to find out.
  for (MaterialUse& use : uses)
    if (kind == MaterialKind::kMtl && use.role == Role::kHeight)
      if (const auto rgb = colors(use);
          rgb.size() == 3 && normal_shares({*rgb[0], *rgb[1], *rgb[2]}).are_normals())
        use.role = Role::kNormal;
  return problems;
}

std::optional<std::size_t> CheckedMaterial::channel(const MaterialUse& use) const {
  const TexelSample* sample = texels(use);
  if (sample == nullptr || use.channels == Channels::kRgb) return std::nullopt;
  // If opacity and color are in one file, opacity is the alpha of the color.
  const bool is_alpha =
      use.role == Role::kOpacity && use.channels == Channels::kWhole && sample->layout.alpha_channel >= 0;
  return channel_of(*sample, is_alpha ? Channels::kAlpha : use.channels, kind != MaterialKind::kFolder);
}

const std::vector<float>* CheckedMaterial::plane(const MaterialUse& use) const {
  const std::optional<std::size_t> found = channel(use);
  return found ? &texels(use)->channels[*found] : nullptr;
}

std::vector<const std::vector<float>*> CheckedMaterial::colors(const MaterialUse& use) const {
  std::vector<const std::vector<float>*> planes;
  const TexelSample* sample = texels(use);
  if (sample == nullptr || (use.channels != Channels::kRgb && use.channels != Channels::kWhole)) return {};
  for (const Channels channel : {Channels::kRed, Channels::kGreen, Channels::kBlue}) {
    const auto found = channel_of(*sample, channel, kind != MaterialKind::kFolder);
    if (!found) return {};
    planes.push_back(&sample->channels[*found]);
  }
  return planes;
}

bool CheckedMaterial::is_all_metal() const {
  if (kind != MaterialKind::kGltf || gltf.metallic_factor < 1.0 ||
      gltf.extensions.contains(std::string(kSpecGlossExtension)))
    return false;
  return std::ranges::all_of(uses, [&](const MaterialUse& use) {
    if (use.role != Role::kMetallic || use.is_neighbour) return true;
    const std::vector<float>* values = plane(use);
    constexpr float kNearlyOne = 0.95f;  // JPEG turns white into a very light grey
    return values != nullptr && std::ranges::all_of(*values, [](float value) { return value > kNearlyOne; });
  });
}

bool CheckedMaterial::same_size(const MaterialUse& a, const MaterialUse& b) const {
  const TexelSample *first = texels(a), *second = texels(b);
  return maps[a.map].tile == maps[b.map].tile && first != nullptr && second != nullptr &&
         first->layout.width == second->layout.width && first->layout.height == second->layout.height;
}

}  // namespace remap
