#include "check/material.hpp"

#include <algorithm>
#include <map>
#include <new>
#include <string_view>

#include "assets/map_pixels.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// `R` of `R` and of the layer `rough.R`.
std::string_view last_part(std::string_view name) { return name.substr(name.rfind('.') + 1); }

std::optional<std::size_t> channel_of(const TexelSample& texels, Channels channels) {
  const auto& all = texels.layout.channels;
  if (channels == Channels::kWhole) return 0;
  if (channels == Channels::kAlpha)
    return texels.layout.alpha_channel < 0
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(texels.layout.alpha_channel));
  const std::string_view wanted = name_of(kChannels, channels);
  for (std::size_t c = 0; c < all.size(); ++c)
    if (last_part(all[c].name) == wanted) return c;
  return std::nullopt;
}

}  // namespace

std::vector<std::string> CheckedMaterial::read_maps() {
  std::vector<std::string> problems;
  std::map<std::filesystem::path, std::shared_ptr<const TexelSample>> read;
  for (MaterialMap& map : maps) {
    if (const auto known = read.find(map.file); known != read.end()) {
      map.texels = known->second;
      continue;
    }
    try {
      map.texels = std::make_shared<const TexelSample>(sample_of(map.file));
    } catch (const Error& error) {
      const std::string message = error.what(), own = map.file.string();
      problems.push_back(message.starts_with(own) ? map.shown + message.substr(own.size()) : message);
    } catch (const std::bad_alloc&) {
      problems.push_back(map.shown + ": out of memory (use fewer --threads)");
    }
    read[map.file] = map.texels;
  }
  // A bump map of MTL may hold either, and convert takes it for what it is.
  for (MaterialUse& use : uses)
    if (kind == MaterialKind::kMtl && use.role == Role::kHeight)
      if (const auto rgb = colors(use);
          rgb.size() == 3 && normal_shares({*rgb[0], *rgb[1], *rgb[2]}).are_normals())
        use.role = Role::kNormal;
  return problems;
}

const std::vector<float>* CheckedMaterial::plane(const MaterialUse& use) const {
  const TexelSample* sample = texels(use);
  if (sample == nullptr || use.channels == Channels::kRgb) return nullptr;
  const auto channel = channel_of(*sample, use.channels);
  return channel ? &sample->channels[*channel] : nullptr;
}

std::vector<const std::vector<float>*> CheckedMaterial::colors(const MaterialUse& use) const {
  std::vector<const std::vector<float>*> planes;
  const TexelSample* sample = texels(use);
  if (sample == nullptr || (use.channels != Channels::kRgb && use.channels != Channels::kWhole)) return {};
  for (const Channels channel : {Channels::kRed, Channels::kGreen, Channels::kBlue}) {
    const auto found = channel_of(*sample, channel);
    if (!found) return {};
    planes.push_back(&sample->channels[*found]);
  }
  return planes;
}

bool CheckedMaterial::same_size(const MaterialUse& a, const MaterialUse& b) const {
  const TexelSample *first = texels(a), *second = texels(b);
  return first != nullptr && second != nullptr && first->layout.width == second->layout.width &&
         first->layout.height == second->layout.height;
}

}  // namespace remap
