// This file writes converted materials into the text of a glTF file, and updates the lists of extensions.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/text_edits.hpp"
#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_new_images.hpp"
#include "core/json_spans.hpp"

namespace remap {

class GltfMaterialWriter {
 public:
  // All arguments must outlive this object. `images` must be written already. It is null if there are no new
  // images.
  GltfMaterialWriter(const SpannedJson& json, const std::string& context, const GltfNewImages* images,
                     TextEdits& edits)
      : json_(json), root_(json.root()), context_(context), images_(images), edits_(edits) {}

  void write(const MaterialEdit& edit, AssetMaterial& report);
  // Adds new extensions to extensionsUsed. Removes an extension from both lists if nothing uses it any more,
  // and if it is in `goers` or a material lost it. `removed` holds further values of removed extensions.
  // Throws kInput if one of the lists is not a list.
  void update_lists(const std::set<std::string>& goers, const std::set<std::size_t>& removed);

 private:
  void write_core(const MaterialEdit& edit, AssetMaterial& report);
  void write_extensions(const MaterialEdit& edit);
  void carry_extras(SpanValue extras, SpanValue core, AssetMaterial& report);
  std::string text_of(const MemberText& member) const;
  std::string object_of(const std::vector<MemberText>& members) const;
  bool is_still_used(std::string_view extension) const;
  void update_list(std::string_view name, const std::set<std::string>& unused,
                   std::vector<std::string> added);

  const SpannedJson& json_;
  SpanValue root_;
  const std::string& context_;
  const GltfNewImages* images_;
  TextEdits& edits_;
  std::set<std::size_t> removed_;   // values of removed extensions
  std::set<std::string> lost_;      // extensions that a material lost
  std::vector<std::string> added_;  // extensions that a material got, each once
};

}  // namespace remap
