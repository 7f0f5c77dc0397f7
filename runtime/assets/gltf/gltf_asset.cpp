#include "assets/gltf/gltf_asset.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "assets/gltf/gltf_container.hpp"
#include "assets/gltf/gltf_conversion.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "core/report_text.hpp"

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
                        ": its byteLength is not an integer");
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
  return {"its binary chunk is " + std::to_string(size - length) + " bytes longer than its buffer"};
}

// Checks that a view lies within its buffer. `name` is for messages.
void check_view(SpanValue view, const std::vector<std::size_t>& lengths, const std::string& name) {
  const std::optional<std::size_t> buffer = view["buffer"].whole(), length = view["byteLength"].whole();
  const SpanValue offset_value = view["byteOffset"];
  const std::optional<std::size_t> offset = offset_value ? offset_value.whole() : std::size_t{0};
  if (!buffer || !length || !offset)
    throw input_error(name + ": its buffer, byteOffset and byteLength are not integers");
  if (*buffer >= lengths.size())
    throw input_error(name + ": refers to buffer " + std::to_string(*buffer) + ", but the file has " +
                      counted(lengths.size(), "buffer"));
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
  AssetConversion conversion = convert_materials({json, container, source, context}, options, resources);
  conversion.warnings.insert(conversion.warnings.begin(), warnings.begin(), warnings.end());
  conversion.resources = resources_of(json);
  if (options.compacts && conversion.changed) drop_unnamed(conversion, context);
  return conversion;
}

}  // namespace remap
