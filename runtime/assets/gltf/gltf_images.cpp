#include "assets/gltf/gltf_images.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "assets/document/asset_uri.hpp"
#include "assets/document/gltf_extensions.hpp"
#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::uint64_t kLargestImage = std::uint64_t{1} << 30;  // limit for the bytes of a file

}  // namespace

SpanValue gltf_entry(const std::vector<SpanValue>& list, std::size_t index, const char* name) {
  if (index >= list.size())
    throw input_error("refers to " + std::string(name) + " " + std::to_string(index) + ", but the file has " +
                      counted(list.size(), name) + ", numbered from 0 (export the file again)");
  return list[index];
}

std::string data_of_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) throw input_error("a data URI has no data (export the file again)");
  const std::string_view head = uri.substr(0, comma);
  const std::string data = percent_decoded(uri.substr(comma + 1));
  if (!head.ends_with(";base64")) return data;
  auto bytes = from_base64<std::string>(data);
  if (!bytes) throw input_error("a data URI is not base64 (export the file again)");
  return *std::move(bytes);
}

GltfBytes::GltfBytes(const SpannedJson& json, const GltfContainer& container, const ByteSource& source,
                     OpenAssetFile open)
    : container_(container),
      source_(source),
      open_(std::move(open)),
      images_(json.root()["images"].entries()),
      views_(json.root()["bufferViews"].entries()),
      buffers_(json.root()["buffers"].entries()) {}

std::string GltfBytes::of_image(std::size_t index) const {
  const SpanValue image = gltf_entry(images_, index, "image");
  if (const auto uri = image["uri"].text()) return of_uri(*uri);
  const std::optional<std::size_t> view = image["bufferView"].whole();
  if (!view) throw input_error("an image has neither uri nor bufferView (export the file again)");
  return of_view(*view);
}

std::string GltfBytes::of_uri(const std::string& uri) const {
  switch (uri_kind(uri)) {
    case UriKind::kData:
      return data_of_uri(uri);
    case UriKind::kFile: {
      const std::unique_ptr<ByteSource> file = open_(percent_decoded(uri));
      if (file->size() > kLargestImage) throw input_error(plain(uri, 200) + ": is too large for an image");
      return file->read(0, file->size());
    }
    case UriKind::kRemote:
      throw input_error(plain(uri, 200) +
                        ": is a remote address (download the file into the folder of the asset)");
    default:
      throw input_error(plain(uri, 200) + ": is an absolute path (use a path relative to the asset)");
  }
}

std::string GltfBytes::of_view(std::size_t index) const {
  const SpanValue view = gltf_entry(views_, index, "bufferView");
  const std::uint64_t offset = view["byteOffset"].whole().value_or(0),
                      length = view["byteLength"].whole().value_or(0);
  const std::size_t buffer_index = view["buffer"].whole().value_or(0);
  const SpanValue buffer = gltf_entry(buffers_, buffer_index, "buffer");
  const auto require_within = [&](std::uint64_t size) {
    if (offset > size || length > size - offset)
      throw input_error("bufferView " + std::to_string(index) + " ends after its buffer of " +
                        std::to_string(size) + " bytes");
  };
  if (const auto uri = buffer["uri"].text()) {
    if (uri_kind(*uri) == UriKind::kFile) {
      const std::unique_ptr<ByteSource> file = open_(percent_decoded(*uri));
      require_within(file->size());
      return file->read(offset, length);
    }
    const std::string bytes = of_uri(*uri);
    require_within(bytes.size());
    return bytes.substr(offset, length);
  }
  const GlbChunk* const chunk = container_.binary_chunk();
  if (buffer_index != 0 || chunk == nullptr)
    throw input_error("buffer " + std::to_string(buffer_index) + " has no bytes");
  require_within(chunk->content_size());
  return source_.read(chunk->content_begin() + offset, length);
}

namespace {

// So many images stay decoded, because materials in sequence often use the same two.
constexpr std::size_t kRecentImages = 2;

// In these extensions, a texture refers to an image of another format. The most common extension comes first.
constexpr std::array<std::string_view, 4> kTextureExtensions = {"EXT_texture_webp", "EXT_texture_avif",
                                                                "KHR_texture_basisu", "MSFT_texture_dds"};

std::string image_name(std::size_t index) { return "image " + std::to_string(index); }

[[noreturn]] void refuse_transform(const char* name) {
  throw input_error(std::string(kTransformExtension) + "." + name + ": expected " +
                    (std::string_view(name) == "rotation" ? "a number" : "two numbers"));
}

void read_transform_pair(SpanValue transform, const char* name, double (&pair)[2]) {
  const SpanValue value = transform[name];
  if (!value) return;
  const std::vector<SpanValue> entries = value.entries();
  if (entries.size() != 2) refuse_transform(name);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<double> number = entries[i].number();
    if (!number) refuse_transform(name);
    pair[i] = *number;
  }
}

TextureTransform transform_of(SpanValue value) {
  TextureTransform transform;
  read_transform_pair(value, "offset", transform.offset);
  read_transform_pair(value, "scale", transform.scale);
  if (const SpanValue rotation = value["rotation"]) {
    if (!rotation.number()) refuse_transform("rotation");
    transform.rotation = *rotation.number();
  }
  return transform;
}

}  // namespace

std::vector<std::size_t> images_of_texture(SpanValue texture) {
  std::vector<std::size_t> found;
  for (const std::string_view extension : kTextureExtensions)
    if (const auto image = texture["extensions"][extension]["source"].whole()) found.push_back(*image);
  if (const auto image = texture["source"].whole()) found.push_back(*image);
  return found;
}

GltfImages::GltfImages(const SpannedJson& json, const GltfBytes& bytes, const AssetResources& resources)
    : bytes_(bytes),
      resources_(resources),
      textures_(json.root()["textures"].entries()),
      samplers_(json.root()["samplers"].entries()) {}

TextureInfo GltfImages::info_of(SpanValue texture_info) const {
  TextureInfo info;
  info.value = texture_info;
  const std::optional<std::size_t> index = texture_info["index"].whole();
  if (!index) throw input_error("a texture has no index (export the file again)");
  info.texture = *index;
  (void)gltf_entry(textures_, info.texture, "texture");
  info.tex_coord = texture_info["texCoord"].whole().value_or(0);
  const SpanValue transform = texture_info["extensions"][kTransformExtension];
  if (const auto own = transform["texCoord"].whole()) info.tex_coord = *own;
  info.transform = transform_of(transform);
  return info;
}

AssetImage GltfImages::load(const TextureInfo& info) {
  const std::vector<std::size_t> candidates = images_of_texture(textures_[info.texture]);
  if (candidates.empty())
    throw input_error("texture " + std::to_string(info.texture) +
                      " has no image in a known format (export it with PNG or JPEG images)");
  std::string reason;
  for (const std::size_t image : candidates) {
    if (const auto known = std::ranges::find(recent_, image, &AssetImage::image); known != recent_.end()) {
      AssetImage found = *known;
      found.texture = info.texture;
      return found;
    }
    try {
      const std::string bytes = bytes_.of_image(image);
      recent_.push_front(
          {info.texture, image,
           std::make_shared<const ImagePixels>(resources_.codec().decode(bytes, image_name(image))),
           bytes.starts_with("\xff\xd8")});
      if (recent_.size() > kRecentImages) recent_.pop_back();
      return recent_.front();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      reason += (reason.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  throw input_error(reason);
}

bool GltfImages::wraps_alike(std::size_t texture, std::size_t other) const {
  constexpr std::size_t kRepeat = 10497;
  const auto wraps = [&](std::size_t index) {
    const std::optional<std::size_t> own = textures_[index]["sampler"].whole();
    const SpanValue sampler = own && *own < samplers_.size() ? samplers_[*own] : SpanValue();
    return std::pair(sampler["wrapS"].whole().value_or(kRepeat), sampler["wrapT"].whole().value_or(kRepeat));
  };
  return wraps(texture) == wraps(other);
}

}  // namespace remap
