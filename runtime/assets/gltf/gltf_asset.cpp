#include "assets/gltf/gltf_asset.hpp"

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/gltf_extensions.hpp"
#include "assets/document/text_edits.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_images.hpp"
#include "assets/gltf/gltf_material_writer.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "assets/gltf/material_textures.hpp"
#include "core/errors.hpp"
#include "core/json_spans.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::uint64_t kMostPadding = 3;  // padding of a binary chunk, after its buffer

// Returns a path such as `/images/2/uri`.
std::string pointer_of(SpanValue value) {
  const SpanValue parent = value.parent();
  if (!parent) return "";
  if (parent.is(SpanKind::kObject)) return pointer_of(parent) + "/" + plain(value.key(), 80);
  const std::vector<SpanValue> entries = parent.children();
  return pointer_of(parent) + "/" + std::to_string(std::ranges::find(entries, value) - entries.begin());
}

bool is_in_extras(SpanValue value) {
  for (; value; value = value.parent())
    if (value.has_key("extras")) return true;
  return false;
}

// Returns every `uri` of the file, also in extensions. It skips extras, which belong to other programs.
std::vector<AssetResource> resources_of(const SpannedJson& json) {
  std::vector<AssetResource> resources;
  std::set<std::string> known;
  bool is_up_known = false;
  for (std::size_t i = 1; i < json.value_count(); ++i) {
    const SpanValue value = json.value(i);
    if (!value.has_key("uri") || !value.is(SpanKind::kText) || value.raw().starts_with("\"data:")) continue;
    const std::string uri = value.text().value_or("");
    const UriKind kind = uri_kind(uri);
    if (kind == UriKind::kData || is_in_extras(value)) continue;
    const std::string path = kind == UriKind::kRemote ? uri : percent_decoded(uri);
    if (!known.insert(path).second) continue;
    const bool is_up = kind == UriKind::kAbsolute || path.find("..") != std::string::npos;
    const bool is_first = is_up && !std::exchange(is_up_known, true);
    resources.push_back({is_first ? pointer_of(value) : "", path, kind});
  }
  return resources;
}

// Removes files from the list of resources that only replaced images used. The asset no longer needs these
// files.
void drop_unnamed(AssetConversion& conversion, const std::string& context) {
  std::set<std::string> named;
  for (const AssetResource& resource : resources_of(SpannedJson(conversion.text, context)))
    named.insert(resource.path);
  std::erase_if(conversion.resources,
                [&](const AssetResource& resource) { return !named.contains(resource.path); });
}

// Returns the lengths of the buffers.
std::vector<std::size_t> buffer_lengths(SpanValue root, const std::string& context) {
  std::vector<std::size_t> lengths;
  for (const SpanValue& buffer : root["buffers"].entries()) {
    const std::optional<std::size_t> length = buffer["byteLength"].whole();
    if (!length)
      throw input_error(context + ": /buffers/" + std::to_string(lengths.size()) +
                        ": byteLength is not an integer (export the file again)");
    lengths.push_back(*length);
  }
  return lengths;
}

// Checks that the first buffer of a container lies within its binary chunk. Returns warnings.
std::vector<std::string> check_chunk(SpanValue root, const GltfContainer& container,
                                     const std::vector<std::size_t>& lengths, const std::string& context) {
  const GlbChunk* const chunk = container.binary_chunk();
  if (chunk == nullptr || lengths.empty()) return {};
  const std::vector<SpanValue> buffers = root["buffers"].entries();
  if (buffers.front()["uri"]) return {};
  const std::uint64_t size = chunk->content_size(), length = lengths.front();
  if (length > size)
    throw input_error(context + ": /buffers/0 has " + std::to_string(length) +
                      " bytes, but the binary chunk has " + std::to_string(size));
  if (size - length <= kMostPadding) return {};
  return {"the binary chunk is " + std::to_string(size - length) +
          " bytes longer than the buffer that it holds"};
}

// Checks that a view lies within its buffer. `name` is for messages.
void check_view(SpanValue view, const std::vector<std::size_t>& lengths, const std::string& name) {
  const std::optional<std::size_t> buffer = view["buffer"].whole(), length = view["byteLength"].whole();
  const SpanValue offset_value = view["byteOffset"];
  const std::optional<std::size_t> offset = offset_value ? offset_value.whole() : std::size_t{0};
  if (!buffer || !length || !offset)
    throw input_error(name + ": buffer, byteOffset and byteLength must be integers (export the file again)");
  if (*buffer >= lengths.size())
    throw input_error(name + ": refers to buffer " + std::to_string(*buffer) + ", but the file has " +
                      counted(lengths.size(), "buffer") + ", numbered from 0 (export the file again)");
  if (const std::size_t size = lengths[*buffer]; *offset + *length > size)
    throw input_error(name + ": ends at byte " + std::to_string(*offset + *length) + " of buffer " +
                      std::to_string(*buffer) + ", but the buffer has only " + counted(size, "byte"));
}

// Checks the buffers and all views. Returns warnings.
std::vector<std::string> check_views(SpanValue root, const GltfContainer& container,
                                     const std::string& context) {
  const std::vector<std::size_t> lengths = buffer_lengths(root, context);
  std::vector<std::string> warnings = check_chunk(root, container, lengths, context);
  const std::vector<SpanValue> views = root["bufferViews"].entries();
  for (std::size_t i = 0; i < views.size(); ++i)
    check_view(views[i], lengths, context + ": /bufferViews/" + std::to_string(i));
  return warnings;
}

// A GltfSource is a glTF file that has been read.
struct GltfSource {
  const SpannedJson& json;
  const GltfContainer& container;
  const ByteSource& bytes;
  const std::string& context;
};

// Returns the material of a pointer such as /materials/3/extensions/..., and the rest of the pointer. Returns
// nothing for other pointers.
std::optional<std::pair<std::size_t, std::string>> pointed_material(std::string_view pointer) {
  constexpr std::string_view kStart = "/materials/";
  if (!pointer.starts_with(kStart)) return std::nullopt;
  pointer.remove_prefix(kStart.size());
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(pointer.data(), pointer.data() + pointer.size(), index);
  if (failure != std::errc()) return std::nullopt;
  return std::pair(index, std::string(end, static_cast<std::size_t>(pointer.data() + pointer.size() - end)));
}

struct ImageParts {
  ImageParts(const GltfSource& source, const AssetOptions& options, const AssetResources& resources)
      : bytes(source.json, source.container, source.bytes,
              [&resources](const std::string& path) { return resources.open(path); }),
        images(source.json, bytes, resources),
        added(source.json, source.container, resources, source.context),
        textures(options, resources, images, added) {}

  GltfBytes bytes;
  GltfImages images;
  GltfNewImages added;
  MaterialTextures textures;
};

class GltfConversion {
 public:
  GltfConversion(const GltfSource& source, const AssetOptions& options, const AssetResources* resources)
      : source_(source), root_(source.json.root()), options_(options) {
    if (options.folds_extensions() && options.target != AssetTarget::kMetalRough)
      throw usage_error("KHR_materials_specular is only folded into core (--to gltf)");
    if (resources != nullptr) parts_ = std::make_unique<ImageParts>(source, options, *resources);
    MaterialTextures* const textures = parts_ ? &parts_->textures : nullptr;
    if (options.target == AssetTarget::kSpecGloss)
      directions_.push_back(make_core_to_specgloss(options, textures));
    else
      directions_.push_back(make_specgloss_to_core(options, textures));
    if (options.folds_extensions()) directions_.push_back(make_specular_fold(options, textures));
  }

  AssetConversion result() {
    require_gltf();
    read_pointers();
    convert_all();
    result_.text = source_.json.text();
    if (!edits_.empty()) write_all();
    return std::move(result_);
  }

 private:
  void require_gltf() {
    const std::optional<std::string> version = root_["asset"]["version"].text();
    if (!version)
      throw input_error(source_.context + ": is not a glTF file, because it has no asset.version");
    if (!version->starts_with("2."))
      throw input_error(source_.context + ": is glTF " + plain(*version, 20) +
                        ", but only glTF 2 can be read (convert it to glTF 2 first)");
    for (const SpanValue& entry : root_["extensionsRequired"].children())
      if (const std::string name = entry.text().value_or(""); !is_known_extension(name))
        result_.warnings.push_back("requires " + plain(name) +
                                   ", which texremap does not know: texremap keeps this extension, but it "
                                   "may not match the converted materials");
  }

  // Finds the materials that animations change.
  void read_pointers() {
    for (const SpanValue& animation : root_["animations"].children())
      for (const SpanValue& channel : animation["channels"].children()) {
        const SpanValue target = channel["target"]["extensions"][kPointerExtension]["pointer"];
        if (const auto material = pointed_material(target.text().value_or(""))) pointers_.insert(*material);
      }
  }

  GltfDirection* direction_of(SpanValue material) const {
    const auto found = std::ranges::find_if(
        directions_, [&](const auto& direction) { return direction->applies_to(material); });
    return found == directions_.end() ? nullptr : found->get();
  }

  void convert_all() {
    const SpanValue list = root_["materials"];
    if (list && !list.is(SpanKind::kList))
      throw input_error(source_.context + ": materials: expected a list");
    const std::vector<SpanValue> all = list.children();
    result_.materials.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      AssetMaterial& report = result_.materials[i];
      report.index = i;
      report.name = all[i]["name"].text().value_or("");
      if (GltfDirection* const direction = direction_of(all[i])) convert(*direction, all[i], report);
    }
  }

  void convert(GltfDirection& direction, SpanValue material, AssetMaterial& report) {
    try {
      require_not_animated(direction, report.index);
      edits_.emplace_back(report.index, direction.convert(material, report));
      report.state = MaterialState::kConverted;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      report.state = MaterialState::kFailed;
      report.failure = plain(error.what(), 500);
    }
  }

  void require_not_animated(const GltfDirection& direction, std::size_t index) const {
    for (auto at = pointers_.lower_bound({index, ""}); at != pointers_.end() && at->first == index; ++at)
      for (const std::string& member : direction.replaced())
        if (at->second.starts_with("/" + member))
          throw input_error(
              "an animation (" + std::string(kPointerExtension) +
              ") changes a value that this conversion replaces (remove this channel of the animation)");
  }

  void write_all() {
    std::vector<MaterialEdit> edits;
    for (const auto& [index, edit] : edits_) edits.push_back(edit);
    TextEdits text(source_.json);
    GltfMaterialWriter writer(source_.json, source_.context, parts_ ? &parts_->added : nullptr, text);
    std::set<std::size_t> removed;  // values of extensions that textures lose
    std::set<std::string> formats;
    if (parts_) {
      const GltfSpares spares = options_.compacts
                                    ? find_spares(source_.json, source_.container, edits, result_.warnings)
                                    : GltfSpares();
      parts_->added.write(spares, text);
      for (const SpanValue& extension : parts_->added.removed_extensions()) {
        removed.insert(extension.index());
        formats.insert(extension.key());
      }
      result_.files = std::move(parts_->added.files());
    }
    note_colored();
    for (const auto& [index, edit] : edits_) writer.write(edit, result_.materials[index]);
    writer.update_lists(formats, removed);
    result_.changed = !text.empty();
    result_.touched = text.touched();
    result_.text = text.result();
    if (result_.changed)
      result_.pieces = with_json(source_.container, result_.text,
                                 parts_ ? parts_->added.tail() : BinaryTail(), source_.context);
  }

  // Reports vertex colors (COLOR_0), because they multiply base color in one workflow and diffuse in the
  // other.
  void note_colored() {
    std::vector<std::size_t> counts(result_.materials.size());
    for (const SpanValue& mesh : root_["meshes"].children())
      for (const SpanValue& primitive : mesh["primitives"].children())
        if (primitive["attributes"]["COLOR_0"]) count_uses(primitive, counts);
    for (const auto& [index, edit] : edits_)
      if (counts[index] > 0 && !edit.vertex_color_warning.empty())
        result_.materials[index].warnings.push_back(
            "vertex colors of " + counted(counts[index], "primitive") + " " + edit.vertex_color_warning);
  }

  static void count_uses(SpanValue primitive, std::vector<std::size_t>& counts) {
    std::set<std::size_t> used;
    const auto use = [&](SpanValue material) {
      const std::optional<std::size_t> index = material.whole();
      if (index && *index < counts.size()) used.insert(*index);
    };
    use(primitive["material"]);
    for (const SpanValue& mapping : primitive["extensions"]["KHR_materials_variants"]["mappings"].children())
      use(mapping["material"]);
    for (const std::size_t index : used) ++counts[index];
  }

  const GltfSource& source_;
  SpanValue root_;
  const AssetOptions& options_;
  std::unique_ptr<ImageParts> parts_;
  // The first of these that accepts a material converts it.
  std::vector<std::unique_ptr<GltfDirection>> directions_;
  std::set<std::pair<std::size_t, std::string>> pointers_;  // keyed by material
  std::vector<std::pair<std::size_t, MaterialEdit>> edits_;
  AssetConversion result_;
};

}  // namespace

std::vector<AssetResource> gltf_resources(const ByteSource& source, const std::string& context) {
  const GltfContainer container = read_container(source, context);
  return resources_of(SpannedJson(container.json, context));
}

AssetConversion convert_gltf(const ByteSource& source, const std::string& context,
                             const AssetOptions& options, const AssetResources* resources) {
  const GltfContainer container = read_container(source, context);
  const SpannedJson json(container.json, context);
  std::vector<std::string> warnings = container.notes;
  for (const std::string& warning : check_views(json.root(), container, context)) warnings.push_back(warning);
  AssetConversion conversion =
      GltfConversion({json, container, source, context}, options, resources).result();
  conversion.warnings.insert(conversion.warnings.begin(), warnings.begin(), warnings.end());
  conversion.resources = resources_of(json);
  if (options.compacts && conversion.changed) drop_unnamed(conversion, context);
  return conversion;
}

}  // namespace remap
