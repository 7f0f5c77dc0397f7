#include "check/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <new>
#include <string_view>
#include <utility>

#include "assets/document/gltf_extensions.hpp"
#include "assets/maps/map_pixels.hpp"
#include "core/input_file.hpp"
#include "remap/error.hpp"
#include "texture/image_library.hpp"
#include "texture/image_reader.hpp"

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

namespace {

// An image of at most so many texels a side is read whole. From a larger image, squares with kRun texels a
// side are read, as many as fit into kSide.
constexpr int kSide = 1024, kRun = 64;

// Returns which of `size` columns or rows are kept.
std::vector<int> kept_of(int size) {
  std::vector<int> kept;
  if (size <= kSide) {
    for (int i = 0; i < size; ++i) kept.push_back(i);
    return kept;
  }
  constexpr int kRuns = kSide / kRun;
  for (int run = 0; run < kRuns; ++run) {
    const int first = static_cast<int>(static_cast<long long>(size - kRun) * run / (kRuns - 1));
    for (int i = 0; i < kRun; ++i) kept.push_back(first + i);
  }
  return kept;
}

void count_bad(const std::vector<float>& values, TexelSample& sample) {
  for (const float value : values) {
    sample.nan_count += !std::isfinite(value);
    sample.negative_count += value < 0.0f;
    sample.above_one_count += value > 1.0f;
  }
}

// SampledRows samples an image from its rows, which are added from the top.
class SampledRows {
 public:
  explicit SampledRows(const ImageLayout& layout)
      : columns_(kept_of(layout.width)),
        rows_(kept_of(layout.height)),
        values_(static_cast<std::size_t>(layout.width)) {
    sample.layout = layout;
    sample.columns = static_cast<int>(columns_.size());
    sample.rows = static_cast<int>(rows_.size());
    sample.channels.resize(layout.channels.size());
    has_floats_ = sample.has_floats();
  }

  void add(int first, int count, const std::byte* texels) {
    const ImageLayout& layout = sample.layout;
    for (int y = first; y < first + count; ++y) {
      const bool is_kept = next_ < rows_.size() && rows_[next_] == y;
      for (std::size_t c = 0; c < layout.channels.size() && (is_kept || has_floats_); ++c) {
        load(channel_view(texels, layout, c), {0, static_cast<std::size_t>(y - first), values_.size()},
             values_.data());
        if (!is_integer(layout.channels[c].type)) count_bad(values_, sample);
        if (!is_kept) continue;
        for (const int x : columns_) sample.channels[c].push_back(values_[static_cast<std::size_t>(x)]);
      }
      next_ += is_kept;
    }
  }

  TexelSample sample;

 private:
  std::vector<int> columns_, rows_;
  std::vector<float> values_;
  std::size_t next_ = 0;  // index into rows_
  bool has_floats_ = false;
};

bool is_webp(const std::filesystem::path& file) {
  std::array<char, 12> head{};
  const std::string_view text(head.data(), InputFile(file).read(0, head.data(), head.size()));
  return text.starts_with("RIFF") && text.ends_with("WEBP");
}

constexpr std::uintmax_t kLargestTexture = std::uintmax_t{4} << 30;  // the limit of the glb format

}  // namespace

bool TexelSample::has_floats() const {
  return std::ranges::any_of(layout.channels,
                             [](const Channel& channel) { return !is_integer(channel.type); });
}

TexelSample sample_of(const std::filesystem::path& file) {
  ImageReader reader(file);
  SampledRows rows(reader.layout());
  const ImageLayout& layout = rows.sample.layout;
  const int band = layout.tile_height > 0 ? layout.tile_height : std::min(layout.height, 32);
  std::vector<std::byte> stored(static_cast<std::size_t>(band) * layout.row_bytes());
  for (int first = 0; first < layout.height; first += band) {
    const int count = std::min(band, layout.height - first);
    reader.read_rows(first, count, stored.data());
    rows.add(first, count, stored.data());
  }
  return std::move(rows.sample);
}

TexelSample sample_of_texture(const std::filesystem::path& file) {
  if (!is_webp(file)) return sample_of(file);
  const ImagePixels pixels = image_library().codec().decode(read_file(file, kLargestTexture), file.string());
  constexpr std::array<std::string_view, 4> kGrey = {"Y", "A"}, kColor = {"R", "G", "B", "A"};
  ImageLayout layout;
  layout.width = static_cast<int>(pixels.width);
  layout.height = static_cast<int>(pixels.height);
  layout.alpha_channel = pixels.has_alpha() ? static_cast<int>(pixels.channels) - 1 : -1;
  for (std::size_t c = 0; c < pixels.channels; ++c) {
    layout.channels.push_back(
        {std::string((pixels.is_grey() ? kGrey : kColor)[c]), pixels.type, layout.texel_bytes});
    layout.texel_bytes += byte_count(pixels.type);
  }
  SampledRows rows(layout);
  rows.add(0, layout.height, pixels.bytes.data());
  return std::move(rows.sample);
}

}  // namespace remap
