#include "assets/gltf/gltf_spares.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "core/plain_text.hpp"

namespace remap {
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
