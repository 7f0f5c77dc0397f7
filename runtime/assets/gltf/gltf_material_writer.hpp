// Writes converted materials into the text of a glTF file, and keeps the lists of extensions true.
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
  // All must outlive it. `images`: written already; null where there are none.
  GltfMaterialWriter(const SpannedJson& json, const std::string& context, const GltfNewImages* images,
                     TextEdits& edits)
      : json_(json), root_(json.root()), context_(context), images_(images), edits_(edits) {}

  void write(const MaterialEdit& edit, AssetMaterial& report);
  // Adds new extensions to extensionsUsed. Of `goers` and of those that materials lost, removes from both
  // lists what nothing uses any more. `removed`: more values of extensions that go. Throws kInput for lists
  // that are none.
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
  std::set<std::size_t> removed_;   // values of extensions that go
  std::set<std::string> lost_;      // extensions that a material lost
  std::vector<std::string> added_;  // that a material got, each once
};

}  // namespace remap
