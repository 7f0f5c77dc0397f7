#include "assets/gltf/gltf_new_images.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "assets/document/asset_uri.hpp"
#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "core/base64.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kNoSampler = std::numeric_limits<std::size_t>::max();
constexpr std::string_view kPng = "image/png", kJpeg = "image/jpeg";

// Removes `wanted` from `spares` and returns it. If it is not there, removes and returns the first spare.
std::optional<std::size_t> take_spare(std::vector<std::size_t>& spares, std::optional<std::size_t> wanted) {
  if (spares.empty()) return std::nullopt;
  auto found = wanted ? std::ranges::find(spares, *wanted) : spares.end();
  if (found == spares.end()) found = spares.begin();
  const std::size_t taken = *found;
  spares.erase(found);
  return taken;
}

}  // namespace

GltfNewImages::GltfNewImages(const SpannedJson& json, const GltfContainer& container,
                             const AssetResources& resources, const std::string& context)
    : root_(json.root()),
      container_(container),
      resources_(resources),
      context_(context),
      textures_(root_["textures"].entries()),
      images_(root_["images"].entries()),
      views_(root_["bufferViews"].entries()),
      buffers_(root_["buffers"].entries()),
      image_count_(images_.size()),
      texture_count_(textures_.size()),
      view_count_(views_.size()),
      names_(resources.image_prefix()) {
  for (const std::vector<SpanValue>* list : {&images_, &buffers_})
    for (const SpanValue& value : *list)
      if (const auto uri = value["uri"].text(); uri && uri_kind(*uri) == UriKind::kFile)
        names_.take(percent_decoded(*uri));
}

std::size_t GltfNewImages::add_image(const ImagePixels& pixels, std::size_t model, std::string_view suffix,
                                     std::optional<int> jpeg_quality, int png_level) {
  const ImageCodec& codec = resources_.codec();
  std::string bytes =
      jpeg_quality ? codec.encode_jpeg(pixels, *jpeg_quality) : codec.encode_png(pixels, png_level);
  // Materials that differ only in color often share the same metallic-roughness image.
  const auto same = std::ranges::find(new_images_, bytes, &NewImage::bytes);
  if (same != new_images_.end()) return static_cast<std::size_t>(same - new_images_.begin());
  new_images_.push_back({std::move(bytes), jpeg_quality ? kJpeg : kPng, model, std::string(suffix)});
  return new_images_.size() - 1;
}

std::size_t GltfNewImages::add_texture(std::size_t image, std::size_t model) {
  const std::size_t sampler = textures_[model]["sampler"].whole().value_or(kNoSampler);
  const auto [known, is_new] = known_textures_.try_emplace({image, sampler}, new_textures_.size());
  if (is_new) new_textures_.push_back({image, model});
  return known->second;
}

void GltfNewImages::write(const GltfSpares& spares, TextEdits& edits) {
  spares_ = spares;
  unused_images_.insert(spares.images.begin(), spares.images.end());
  tail_.kept = spares.chunk_end;
  if (const GlbChunk* const chunk = container_.binary_chunk())
    chunk_start_ = (tail_.kept.value_or(chunk->content_size()) + 3) / 4 * 4;
  for (std::size_t i = 0; i < new_images_.size(); ++i) {
    write_image(new_images_[i], i, edits);
    new_images_[i].bytes = std::string();  // frees memory, because the bytes are written now
  }
  for (NewTexture& texture : new_textures_) write_texture(texture, edits);
  empty_spares(edits);
  if (tail_.appended.empty() && !tail_.kept) return;
  // glTF requires that a buffer has at least one byte.
  if (tail_.appended.empty() && *tail_.kept == 0) tail_.kept = 1;
  const std::uint64_t length = tail_.appended.empty() ? *tail_.kept : chunk_start_ + tail_.appended.size();
  if (length > std::numeric_limits<std::uint32_t>::max())
    throw output_error(
        context_ + ": would have a binary chunk of " + std::to_string(length) +
        " bytes; a .glb holds less than 4 GiB (export the asset as .gltf with a .bin, then convert it)");
  edits.replace(buffers_.front()["byteLength"], std::to_string(length));
}

bool GltfNewImages::is_in_chunk(SpanValue image) const {
  const std::optional<std::size_t> view = image["bufferView"].whole();
  return view && *view < views_.size() && views_[*view]["buffer"].whole() == std::size_t{0} &&
         !buffers_.empty() && !buffers_.front()["uri"] && container_.binary_chunk() != nullptr;
}

// Returns `a/wood_baseColor.png` for `a/wood.jpg`, with a number if that name is taken.
std::string GltfNewImages::free_uri(const std::string& model, const NewImage& image) {
  const std::string prefix = resources_.image_prefix();
  std::string stem = stem_beside(model, percent_encoded(prefix), image.suffix);
  // Line breaks in a URI may be percent-encoded. stem_beside() replaces them only in a decoded path. All
  // other URIs keep their spelling.
  if (const std::string path = stem_beside(percent_decoded(model), prefix, image.suffix);
      path != percent_decoded(stem))
    stem = uri_of_path(path);
  return stem + names_.free_ending(percent_decoded(stem), image.type == kJpeg ? ".jpg" : ".png");
}

// Adds a view of `bytes`. If `own` is not empty, it is the old image that the new image replaces.
std::size_t GltfNewImages::add_view(const std::string& bytes, SpanValue own, TextEdits& edits) {
  std::string& appended = tail_.appended;
  appended.append((4 - appended.size() % 4) % 4, '\0');
  const std::string start = std::to_string(chunk_start_ + appended.size()),
                    length = std::to_string(bytes.size());
  appended += bytes;
  if (const auto spare = take_spare(spares_.views, own["bufferView"].whole())) {
    edits.set_member(views_[*spare], "byteOffset", start);
    edits.set_member(views_[*spare], "byteLength", length);
    return *spare;
  }
  edits.append_entry(root_["bufferViews"],
                     "{\"buffer\":0,\"byteOffset\":" + start + ",\"byteLength\":" + length + "}");
  return view_count_++;
}

GltfNewImages::Location GltfNewImages::location_of(const NewImage& image, SpanValue own, TextEdits& edits) {
  const SpanValue model = images_[image.model];
  const std::string type = quoted_json(image.type);
  if (is_in_chunk(model))
    return {{"bufferView", std::to_string(add_view(image.bytes, own, edits))}, {"mimeType", type}};
  const std::optional<std::string> uri = model["uri"].text();
  if (!uri || uri_kind(*uri) != UriKind::kFile)
    return {{"uri", "\"data:" + std::string(image.type) + ";base64," + base64(image.bytes) + "\""}};
  const std::string file = free_uri(*uri, image);
  files_.push_back({percent_decoded(file), image.bytes});
  return {{"uri", quoted_json(file)}, {"mimeType", type}};
}

void GltfNewImages::set_location(SpanValue image, const Location& location, TextEdits& edits) {
  for (const std::string_view name : {"uri", "bufferView", "mimeType"}) {
    const auto own = std::ranges::find(location, name, &Location::value_type::first);
    if (own != location.end())
      edits.set_member(image, name, own->second);
    else
      edits.remove_members(image, name);
  }
}

void GltfNewImages::write_image(const NewImage& image, std::size_t number, TextEdits& edits) {
  const std::optional<std::size_t> spare = take_spare(spares_.images, image.model);
  const SpanValue own = spare ? images_[*spare] : SpanValue();
  locations_.push_back(location_of(image, own, edits));
  image_places_.push_back(spare ? *spare : image_count_++);
  std::string name;
  if (const auto text = images_[image.model]["name"].text()) name = quoted_json(*text + image.suffix);
  if (spare) {
    set_location(own, locations_[number], edits);
    if (!name.empty()) edits.set_member(own, "name", name);
    return;
  }
  std::string text;
  for (const auto& [key, value] : locations_[number])
    text += (text.empty() ? "{" : ",") + quoted_json(key) + ":" + value;
  if (!name.empty()) text += ",\"name\":" + name;
  edits.append_entry(root_["images"], text + "}");
}

void GltfNewImages::write_texture(NewTexture& texture, TextEdits& edits) {
  const std::optional<std::size_t> sampler = textures_[texture.model]["sampler"].whole(),
                                   spare = take_spare(spares_.textures, texture.model);
  const std::string source = std::to_string(image_places_[texture.image]);
  texture.place = spare ? *spare : texture_count_;
  if (!spare) {
    ++texture_count_;
    const std::string samples = sampler ? ",\"sampler\":" + std::to_string(*sampler) : "";
    return edits.append_entry(root_["textures"], "{\"source\":" + source + samples + "}");
  }
  const SpanValue own = textures_[*spare];
  edits.set_member(own, "source", source);
  if (!sampler)
    edits.remove_members(own, "sampler");
  else if (own["sampler"].whole() != sampler)
    edits.set_member(own, "sampler", std::to_string(*sampler));
  drop_formats(own, edits);
}

// Removes image extensions, because a texture of a PNG or JPEG file needs none.
void GltfNewImages::drop_formats(SpanValue texture, TextEdits& edits) {
  const SpanValue extensions = texture["extensions"];
  std::vector<SpanValue> gone = extensions.children();
  std::erase_if(gone, [](const SpanValue& member) { return !is_of_image_format(member.key()); });
  removed_extensions_.insert(removed_extensions_.end(), gone.begin(), gone.end());
  if (!gone.empty() && gone.size() == extensions.size()) return edits.remove_members(texture, "extensions");
  for (const SpanValue& member : gone) edits.remove(member);
}

// Returns bytes for an image that nothing uses but that must stay in the file. These are the bytes of a new
// image in a buffer view, because sharing them adds nothing to the file. If no new image has a view, they are
// a PNG of one texel.
GltfNewImages::Location GltfNewImages::cheapest_location() const {
  const auto is_short = [](const Location& location) { return location.back().first == "mimeType"; };
  if (const auto found = std::ranges::find_if(locations_, is_short); found != locations_.end()) return *found;
  const ImagePixels texel{1, 1, 1, PixelType::kUint8, std::vector<std::byte>(1)};
  return {{"uri",
           "\"data:image/png;base64," + base64(resources_.codec().encode_png(texel, kUsualPngLevel)) + "\""}};
}

// Empties images and views that nothing uses any more and that no new image replaces. An image must have
// bytes, and a view at least one byte. So they refer to bytes that other images use.
void GltfNewImages::empty_spares(TextEdits& edits) {
  for (const std::size_t image : spares_.images) set_location(images_[image], cheapest_location(), edits);
  for (const std::size_t view : spares_.views) {
    edits.set_member(views_[view], "byteOffset", "0");
    edits.set_member(views_[view], "byteLength", "1");
  }
  for (const std::size_t texture : spares_.textures) {
    const std::vector<std::size_t> images = images_of_texture(textures_[texture]);
    if (images.empty() || !unused_images_.contains(images.front())) continue;
    edits.set_member(textures_[texture], "source", std::to_string(images.front()));
    drop_formats(textures_[texture], edits);
  }
}

std::string GltfNewImages::info_text(const TextureText& texture) const {
  const SpanValue index = texture.info["index"];
  std::string text(texture.info.raw());
  const std::size_t begin = texture.info.span().begin;
  return text.replace(index.span().begin - begin, index.span().end - index.span().begin,
                      std::to_string(new_textures_[*texture.added].place));
}

namespace {

// This extension names images, not textures.
constexpr std::string_view kImageLights = "EXT_lights_image_based";

// Returns an extension whose uses this file cannot find, or an empty text.
std::string obscure_extension(SpanValue root) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"})
    for (const SpanValue& entry : root[list].entries())
      if (const std::string name = entry.text().value_or("");
          !is_known_extension(name) || name == kImageLights)
        return name;
  return "";
}

class SpareFinder {
 public:
  SpareFinder(const SpannedJson& json, const GltfContainer& container)
      : json_(json),
        root_(json.root()),
        container_(container),
        textures_(root_["textures"].entries()),
        images_(root_["images"].entries()),
        views_(root_["bufferViews"].entries()) {}

  GltfSpares find(const std::vector<MaterialEdit>& edits) {
    for (const MaterialEdit& edit : edits) read(edit);
    find_textures();
    find_images();
    if (has_chunk()) find_views();
    return std::move(spares_);
  }

 private:
  using Indices = std::set<std::size_t>;

  bool has_chunk() const {
    const std::vector<SpanValue> buffers = root_["buffers"].entries();
    return container_.binary_chunk() != nullptr && !buffers.empty() && !buffers.front()["uri"];
  }

  // Records the textures that a converted material loses, and the textures that it keeps.
  void read(const MaterialEdit& edit) {
    const SpanValue core = edit.material[kCoreMember];
    const auto keep = [&](const std::vector<MemberText>& members) {
      for (const MemberText& member : members)
        if (member.texture && !member.texture.added)
          if (const auto index = member.texture.info["index"].whole()) used_.insert(*index);
    };
    for (const MemberText& member : edit.core) lost_values_.insert(core[member.name].index());
    keep(edit.core);
    for (const std::string_view name : edit.removed_extensions)
      lost_values_.insert(edit.material["extensions"][name].index());
    for (const ExtensionText& extension : edit.added_extensions) keep(extension.members);
  }

  bool is_lost(SpanValue value) const {
    for (; value.index() != 0; value = value.parent())
      if (lost_values_.contains(value.index())) return true;
    return false;
  }

  // Finds the textures in use. A texture info is a member `...Texture` with an index.
  void find_textures() {
    Indices lost;
    for (std::size_t i = 1; i < json_.value_count(); ++i) {
      const SpanValue value = json_.value(i);
      if (!value.is(SpanKind::kObject) || !value.key().ends_with("Texture")) continue;
      const std::optional<std::size_t> index = value["index"].whole();
      if (index) (is_lost(value) ? lost : used_).insert(*index);
    }
    for (const std::size_t index : lost)
      if (!used_.contains(index) && index < textures_.size()) spares_.textures.push_back(index);
  }

  // Finds the images of spare textures, unless other textures use them.
  void find_images() {
    Indices lost, used;
    for (std::size_t i = 0; i < textures_.size(); ++i)
      for (const std::size_t image : images_of_texture(textures_[i]))
        (std::ranges::binary_search(spares_.textures, i) ? lost : used).insert(image);
    for (const std::size_t image : lost)
      if (!used.contains(image) && image < images_.size()) spares_.images.push_back(image);
  }

  // Finds the views that only spare images use. A view that the JSON mentions anywhere else stays, for
  // example a view of a compressed mesh.
  void find_views() {
    Indices lost, used;
    std::set<std::size_t> spare_images;
    for (const std::size_t image : spares_.images) spare_images.insert(images_[image].index());
    for (std::size_t i = 1; i < json_.value_count(); ++i) {
      const SpanValue value = json_.value(i);
      if (!value.has_key("bufferView")) continue;
      const std::optional<std::size_t> view = value.whole();
      if (view) (spare_images.contains(value.parent().index()) ? lost : used).insert(*view);
    }
    for (const std::size_t view : lost)
      if (!used.contains(view) && view < views_.size() && views_[view]["buffer"].whole() == std::size_t{0})
        spares_.views.push_back(view);
    if (!spares_.views.empty()) spares_.chunk_end = spare_tail();
  }

  // Returns where the spare views at the end of the buffer begin, or the end of the buffer if there are none.
  std::uint64_t spare_tail() const {
    constexpr std::uint64_t kMostGap = 15;  // largest gap between views, because exporters align them
    std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
    for (const std::size_t view : spares_.views) {
      const std::uint64_t begin = views_[view]["byteOffset"].whole().value_or(0);
      ranges.emplace_back(begin + views_[view]["byteLength"].whole().value_or(0), begin);
    }
    std::ranges::sort(ranges, std::greater());
    std::uint64_t tail = root_["buffers"].entries().front()["byteLength"].whole().value_or(0);
    for (const auto& [end, begin] : ranges)
      if (end + kMostGap >= tail) tail = std::min(tail, begin);
    return std::max(tail, used_end());
  }

  std::uint64_t used_end() const {
    Indices spare_views;
    for (const std::size_t view : spares_.views) spare_views.insert(views_[view].index());
    std::uint64_t end = 0;
    for (std::size_t i = 1; i < json_.value_count(); ++i) {
      const SpanValue value = json_.value(i);
      const std::optional<std::size_t> length = value["byteLength"].whole();
      if (!length || value["buffer"].whole() != std::size_t{0} || spare_views.contains(i)) continue;
      end = std::max<std::uint64_t>(end, value["byteOffset"].whole().value_or(0) + *length);
    }
    return end;
  }

  const SpannedJson& json_;
  SpanValue root_;
  const GltfContainer& container_;
  std::vector<SpanValue> textures_, images_, views_;
  Indices used_;         // textures in use
  Indices lost_values_;  // values that converted materials lose
  GltfSpares spares_;
};

}  // namespace

GltfSpares find_spares(const SpannedJson& json, const GltfContainer& container,
                       const std::vector<MaterialEdit>& edits, std::vector<std::string>& warnings) {
  if (const std::string name = obscure_extension(json.root()); !name.empty()) {
    warnings.push_back("keeps its unused images, because the extension " + plain(name) + " may use them");
    return {};
  }
  return SpareFinder(json, container).find(edits);
}

}  // namespace remap
