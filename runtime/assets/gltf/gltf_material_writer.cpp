#include "assets/gltf/gltf_material_writer.hpp"

#include <algorithm>
#include <cstddef>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_inputs.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// Returns all members with that key, which may be repeated.
std::vector<SpanValue> members_of(SpanValue object, std::string_view key) {
  std::vector<SpanValue> members = object.children();
  std::erase_if(members, [&](const SpanValue& member) { return !member.has_key(key); });
  return members;
}

}  // namespace

void GltfMaterialWriter::write(const MaterialEdit& edit, AssetMaterial& report) {
  write_core(edit, report);
  write_extensions(edit);
}

std::string GltfMaterialWriter::text_of(const MemberText& member) const {
  if (!member.texture) return member.text;
  return member.texture.added ? images_->info_text(member.texture) : std::string(member.texture.info.raw());
}

std::string GltfMaterialWriter::object_of(const std::vector<MemberText>& members) const {
  std::string text;
  for (const MemberText& member : members)
    if (!member.is_absent())
      text += (text.empty() ? "" : ",") + quoted_json(member.name) + ":" + text_of(member);
  return text;
}

void GltfMaterialWriter::write_core(const MaterialEdit& edit, AssetMaterial& report) {
  if (edit.core.empty()) return;
  const SpanValue extras = edit.carried_extras;
  if (const SpanValue core = edit.material[kCoreMember]) {
    for (const MemberText& member : edit.core)
      if (member.is_absent())
        edits_.remove_members(core, member.name);
      else
        edits_.set_member(core, member.name, text_of(member));
    if (extras) carry_extras(extras, core, report);
    return;
  }
  std::string object = object_of(edit.core);
  if (extras) object += ",\"extras\":" + std::string(extras.raw());
  edits_.append_member(edit.material, kCoreMember, "{" + object + "}");
}

// Moves extras of the extension into the extras of core. Extras that core already has stay.
void GltfMaterialWriter::carry_extras(SpanValue extras, SpanValue core, AssetMaterial& report) {
  const std::string from = extras.parent().key();
  const SpanValue kept = core["extras"];
  if (!kept) return edits_.append_member(core, "extras", std::string(extras.raw()));
  if (!extras.is(SpanKind::kObject) || !kept.is(SpanKind::kObject)) {
    report.warnings.push_back("loses extras of " + from + ", because " + std::string(kCoreMember) +
                              " has the same member");
    return;
  }
  for (const SpanValue& member : extras.children())
    if (kept.find(member.key()))
      report.warnings.push_back("loses extras." + plain(member.key()) + " of " + from + ", because " +
                                std::string(kCoreMember) + " has the same member");
    else
      edits_.append_member(kept, member.key(), std::string(member.raw()));
}

void GltfMaterialWriter::write_extensions(const MaterialEdit& edit) {
  const SpanValue extensions = edit.material["extensions"];
  std::vector<SpanValue> gone;
  for (const std::string_view name : edit.removed_extensions)
    for (const SpanValue& member : members_of(extensions, name))
      if (removed_.insert(member.index()).second) {
        gone.push_back(member);
        lost_.emplace(name);
      }
  for (const ExtensionText& extension : edit.added_extensions)
    if (!contains(added_, extension.name)) added_.emplace_back(extension.name);
  if (edit.added_extensions.empty() && !gone.empty() && gone.size() == extensions.size())
    return edits_.remove_members(edit.material, "extensions");
  for (const SpanValue& member : gone) edits_.remove(member);
  std::string object;
  for (const ExtensionText& extension : edit.added_extensions) {
    const std::string text = "{" + object_of(extension.members) + "}";
    if (extensions)
      edits_.append_member(extensions, extension.name, text);
    else
      object += (object.empty() ? "" : ",") + quoted_json(extension.name) + ":" + text;
  }
  if (!object.empty()) edits_.append_member(edit.material, "extensions", "{" + object + "}");
}

bool GltfMaterialWriter::is_still_used(std::string_view extension) const {
  if (contains(added_, extension)) return true;
  for (std::size_t i = 1; i < json_.value_count(); ++i) {
    const SpanValue value = json_.value(i);
    if (value.has_key(extension) && !removed_.contains(i) && value.parent().has_key("extensions"))
      return true;
  }
  return false;
}

void GltfMaterialWriter::update_lists(const std::set<std::string>& goers,
                                      const std::set<std::size_t>& removed) {
  removed_.insert(removed.begin(), removed.end());
  std::set<std::string> unused = lost_;
  unused.insert(goers.begin(), goers.end());
  std::erase_if(unused, [&](const std::string& name) { return is_still_used(name); });
  update_list("extensionsUsed", unused, added_);
  update_list("extensionsRequired", unused, {});
}

void GltfMaterialWriter::update_list(std::string_view name, const std::set<std::string>& unused,
                                     std::vector<std::string> added) {
  const SpanValue list = root_[name];
  if (list && !list.is(SpanKind::kList))
    throw input_error(context_ + ": " + std::string(name) + ": expected a list");
  std::vector<SpanValue> removed;
  for (const SpanValue& entry : list.children()) {
    const std::string text = entry.text().value_or("");
    std::erase(added, text);
    if (unused.contains(text)) removed.push_back(entry);
  }
  if (!list) {
    std::vector<std::string> quoted;
    for (const std::string& text : added) quoted.push_back(quoted_json(text));
    if (!added.empty()) edits_.append_member(root_, name, list_text(quoted));
    return;
  }
  if (added.empty() && !removed.empty() && removed.size() == list.size())
    return edits_.remove_members(root_, name);
  for (const SpanValue& entry : removed) edits_.remove(entry);
  for (const std::string& text : added) edits_.append_entry(list, quoted_json(text));
}

}  // namespace remap
