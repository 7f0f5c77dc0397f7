#include "assets/gltf_images.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "assets/asset_uri.hpp"
#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// Images that stay decoded: materials that follow each other often share a pair.
constexpr std::size_t kRecentImages = 2;
constexpr std::uint64_t kLargestImage = std::uint64_t{1} << 30;  // bytes of a file
constexpr std::size_t kNoSampler = std::numeric_limits<std::size_t>::max();
constexpr std::string_view kTransform = "KHR_texture_transform";

// The extensions of textures that name an image of another format, the most common first.
constexpr std::array<std::string_view, 4> kTextureExtensions = {"EXT_texture_webp", "EXT_texture_avif",
                                                                "KHR_texture_basisu", "MSFT_texture_dds"};

std::string image_name(std::size_t index) { return "image " + std::to_string(index); }

// The numbers of a member, or `otherwise`.
void add_numbers(SpanValue object, const char* name, std::vector<double> otherwise,
                 std::vector<double>& numbers) {
  const SpanValue value = object[name];
  if (value) {
    const std::vector<SpanValue> entries =
        otherwise.size() == 1 ? std::vector<SpanValue>{value} : value.children();
    if (entries.size() != otherwise.size())
      throw input_error(std::string(kTransform) + "." + name + ": cannot be read");
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::optional<double> number = entries[i].number();
      if (!number) throw input_error(std::string(kTransform) + "." + name + ": cannot be read");
      otherwise[i] = *number;
    }
  }
  numbers.insert(numbers.end(), otherwise.begin(), otherwise.end());
}

// The bytes of a data URI (RFC 2397); its type may have parameters.
std::string data_of(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) throw input_error("its data URI has no data");
  const std::string_view head = uri.substr(0, comma);
  const std::string data = percent_decoded(uri.substr(comma + 1));
  if (!head.ends_with(";base64")) return data;
  auto bytes = from_base64<std::string>(data);
  if (!bytes) throw input_error("its data URI is not base64");
  return *std::move(bytes);
}

}  // namespace

GltfImages::GltfImages(const SpannedJson& json, const GltfContainer& container, const ByteSource& source,
                       const AssetResources& resources, const std::string& place, TextEdits& edits)
    : root_(json.root()),
      container_(container),
      source_(source),
      resources_(resources),
      place_(place),
      edits_(edits),
      textures_(root_["textures"].entries()),
      images_(root_["images"].entries()),
      views_(root_["bufferViews"].entries()),
      buffers_(root_["buffers"].entries()),
      samplers_(root_["samplers"].entries()),
      image_count_(images_.size()),
      texture_count_(textures_.size()),
      view_count_(views_.size()) {
  for (const std::vector<SpanValue>* list : {&images_, &buffers_})
    for (const SpanValue& value : *list)
      if (const auto uri = value["uri"].text(); uri && uri_kind(*uri) == UriKind::kFile)
        uris_.push_back(percent_decoded(*uri));
}

SpanValue GltfImages::entry(const std::vector<SpanValue>& list, std::size_t index, const char* name) const {
  if (index >= list.size())
    throw input_error("names " + std::string(name) + " " + std::to_string(index) + ", of which there are " +
                      std::to_string(list.size()));
  return list[index];
}

TextureInfo GltfImages::info_of(SpanValue texture_info) const {
  TextureInfo info;
  info.value = texture_info;
  const std::optional<std::size_t> index = texture_info["index"].whole();
  if (!index) throw input_error("a texture without an index");
  info.texture = *index;
  (void)entry(textures_, info.texture, "texture");
  info.tex_coord = texture_info["texCoord"].whole().value_or(0);
  const SpanValue transform = texture_info["extensions"][kTransform];
  if (const auto own = transform["texCoord"].whole()) info.tex_coord = *own;
  add_numbers(transform, "offset", {0.0, 0.0}, info.transform);
  add_numbers(transform, "scale", {1.0, 1.0}, info.transform);
  add_numbers(transform, "rotation", {0.0}, info.transform);
  return info;
}

std::vector<std::size_t> GltfImages::images_of(SpanValue texture) const {
  std::vector<std::size_t> found;
  for (const std::string_view extension : kTextureExtensions)
    if (const auto image = texture["extensions"][extension]["source"].whole()) found.push_back(*image);
  if (const auto image = texture["source"].whole()) found.push_back(*image);
  return found;
}

AssetImage GltfImages::load(const TextureInfo& info) {
  const std::vector<std::size_t> candidates = images_of(textures_[info.texture]);
  if (candidates.empty())
    throw input_error("texture " + std::to_string(info.texture) + " has no image that is known here");
  std::string reason;
  for (const std::size_t image : candidates) {
    const auto known =
        std::ranges::find(recent_, image, &std::pair<std::size_t, std::shared_ptr<const ImagePixels>>::first);
    if (known != recent_.end()) return {info.texture, image, known->second};
    try {
      const std::string bytes = bytes_of_image(entry(images_, image, "image"));
      auto pixels = std::make_shared<const ImagePixels>(resources_.codec().decode(bytes, image_name(image)));
      recent_.emplace_front(image, pixels);
      if (recent_.size() > kRecentImages) recent_.pop_back();
      return {info.texture, image, std::move(pixels)};
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      reason += (reason.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  throw input_error(reason);
}

std::string GltfImages::bytes_of_image(SpanValue image) const {
  if (const auto uri = image["uri"].text()) return bytes_of_uri(*uri);
  const std::optional<std::size_t> view = image["bufferView"].whole();
  if (!view) throw input_error("an image has neither uri nor bufferView");
  return bytes_of_view(*view);
}

std::string GltfImages::bytes_of_uri(const std::string& uri) const {
  switch (uri_kind(uri)) {
    case UriKind::kData:
      return data_of(uri);
    case UriKind::kFile: {
      const std::unique_ptr<ByteSource> file = resources_.open(percent_decoded(uri));
      if (file->size() > kLargestImage) throw input_error(plain(uri, 200) + ": is too large for an image");
      return file->read(0, file->size());
    }
    case UriKind::kRemote:
      throw input_error(plain(uri, 200) + ": is not in a file here (download it beside the asset)");
    default:
      throw input_error(plain(uri, 200) + ": is an absolute path (name the file relative to the asset)");
  }
}

std::uint64_t GltfImages::chunk_size() const { return container_.binary_chunk()->content_size(); }

// The view lies in its buffer, which was checked; of an external buffer the file is compared.
std::string GltfImages::bytes_of_view(std::size_t index) const {
  const SpanValue view = entry(views_, index, "bufferView");
  const std::uint64_t offset = view["byteOffset"].whole().value_or(0),
                      length = view["byteLength"].whole().value_or(0);
  const std::size_t buffer_index = view["buffer"].whole().value_or(0);
  const SpanValue buffer = entry(buffers_, buffer_index, "buffer");
  const auto require_within = [&](std::uint64_t size) {
    if (offset > size || length > size - offset)
      throw input_error("bufferView " + std::to_string(index) + " ends after its buffer of " +
                        std::to_string(size) + " bytes");
  };
  if (const auto uri = buffer["uri"].text()) {
    if (uri_kind(*uri) == UriKind::kFile) {
      const std::unique_ptr<ByteSource> file = resources_.open(percent_decoded(*uri));
      require_within(file->size());
      return file->read(offset, length);
    }
    const std::string bytes = bytes_of_uri(*uri);
    require_within(bytes.size());
    return bytes.substr(offset, length);
  }
  const GlbChunk* const chunk = container_.binary_chunk();
  if (buffer_index != 0 || chunk == nullptr)
    throw input_error("buffer " + std::to_string(buffer_index) + " has no bytes");
  require_within(chunk->content_size());
  return source_.read(chunk->content_begin() + offset, length);
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

bool GltfImages::is_in_chunk(SpanValue image) const {
  const std::optional<std::size_t> view = image["bufferView"].whole();
  return view && *view < views_.size() && views_[*view]["buffer"].whole() == std::size_t{0} &&
         !buffers_.empty() && !buffers_.front()["uri"] && container_.binary_chunk() != nullptr;
}

// `a/wood_baseColor.png` of `a/wood.jpg`, with a number where that is taken.
std::string GltfImages::free_uri(const std::string& model, std::string_view suffix) {
  const std::size_t slash = model.find_last_of('/'), dot = model.find_last_of('.');
  const bool has_extension = dot != std::string::npos && (slash == std::string::npos || dot > slash);
  const std::size_t name = slash == std::string::npos ? 0 : slash + 1;
  const std::string stem = model.substr(0, name) + percent_encoded(resources_.image_prefix()) +
                           model.substr(name, (has_extension ? dot : model.size()) - name) +
                           std::string(suffix);
  for (std::size_t number = 1;; ++number) {
    const std::string uri = stem + (number == 1 ? "" : "_" + std::to_string(number)) + ".png";
    if (std::ranges::find(uris_, percent_decoded(uri)) != uris_.end()) continue;
    uris_.push_back(percent_decoded(uri));
    return uri;
  }
}

// The members of a new image that say where it is.
std::string GltfImages::place_of_new(const std::string& png, SpanValue model, std::string_view suffix) {
  const std::string type = ",\"mimeType\":\"image/png\"";
  if (is_in_chunk(model)) {
    appended_.append((4 - appended_.size() % 4) % 4, '\0');
    const std::uint64_t start = (chunk_size() + 3) / 4 * 4 + appended_.size();
    appended_ += png;
    edits_.append_entry(root_["bufferViews"], "{\"buffer\":0,\"byteOffset\":" + std::to_string(start) +
                                                  ",\"byteLength\":" + std::to_string(png.size()) + "}");
    return "\"bufferView\":" + std::to_string(view_count_++) + type;
  }
  const std::optional<std::string> uri = model["uri"].text();
  if (!uri || uri_kind(*uri) != UriKind::kFile)
    return "\"uri\":\"data:image/png;base64," + base64(png) + "\"";
  const std::string own = free_uri(*uri, suffix);
  files_.push_back({percent_decoded(own), png});
  return "\"uri\":" + quoted_json(own) + type;
}

std::size_t GltfImages::add_image(const ImagePixels& pixels, std::size_t model, std::string_view suffix) {
  const std::string png = resources_.codec().encode_png(pixels);
  std::string text = "{" + place_of_new(png, images_[model], suffix);
  if (const auto name = images_[model]["name"].text())
    text += ",\"name\":" + quoted_json(*name + std::string(suffix));
  edits_.append_entry(root_["images"], text + "}");
  return image_count_++;
}

std::size_t GltfImages::add_texture(std::size_t image, std::size_t model) {
  const std::optional<std::size_t> sampler = textures_[model]["sampler"].whole();
  const auto [known, is_new] =
      new_textures_.try_emplace({image, sampler.value_or(kNoSampler)}, texture_count_);
  if (!is_new) return known->second;
  const std::string samples = sampler ? ",\"sampler\":" + std::to_string(*sampler) : "";
  edits_.append_entry(root_["textures"], "{\"source\":" + std::to_string(image) + samples + "}");
  return texture_count_++;
}

void GltfImages::finish() {
  if (appended_.empty()) return;
  const std::uint64_t length = (chunk_size() + 3) / 4 * 4 + appended_.size();
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw output_error(place_ + ": would have a binary chunk of " + std::to_string(length) +
                       " bytes; a .glb holds less than 4 GiB (convert it as .gltf with a .bin)");
  edits_.replace(buffers_.front()["byteLength"], std::to_string(length));
}

}  // namespace remap
