#include "assets/gltf/gltf_bytes.hpp"

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "assets/document/asset_uri.hpp"
#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "core/report_text.hpp"

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

}  // namespace remap
