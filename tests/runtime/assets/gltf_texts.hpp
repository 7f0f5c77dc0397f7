// glTF texts and containers for tests, and what a conversion must keep of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "assets/gltf_asset.hpp"
#include "assets/json_spans.hpp"

namespace remap {

// A file of one material with this object of spec-gloss, and more members of the material.
inline std::string specgloss_text(const std::string& extension, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],)"
         R"("materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":)" +
         extension + "}" + more + "}]}";
}

inline std::string four_bytes(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

inline std::string chunk_bytes(std::uint32_t type, const std::string& content) {
  return four_bytes(static_cast<std::uint32_t>(content.size())) + four_bytes(type) + content;
}

// A container of this JSON, padded, and chunks as chunk_bytes() makes them.
inline std::string glb_bytes(std::string json, const std::string& chunks = "", char padding = ' ') {
  json.append((4 - json.size() % 4) % 4, padding);
  const std::string content = chunk_bytes(kJsonChunk, json) + chunks;
  return "glTF" + four_bytes(2) + four_bytes(static_cast<std::uint32_t>(12 + content.size())) + content;
}

// The bytes of the file after a conversion; the source where nothing was converted.
inline std::string converted_bytes(const std::string& bytes, const SpecGlossOptions& options = {}) {
  const AssetConversion conversion = convert_asset(MemorySource(bytes), "file", options);
  if (!conversion.result.changed) return bytes;
  std::string result;
  for (const AssetPiece& piece : conversion.pieces)
    result += piece.bytes.empty() ? bytes.substr(piece.begin, piece.end - piece.begin) : piece.bytes;
  return result;
}

inline std::vector<std::string> keys_of(SpanValue object) {
  std::vector<std::string> keys;
  for (const SpanValue& member : object.children()) keys.push_back(member.key());
  return keys;
}

inline bool is_of_materials(const std::string& key) {
  return key == "materials" || key == "extensionsUsed" || key == "extensionsRequired";
}

// Every byte is as it was but those of converted materials and of the lists of extensions. Returns the number
// of materials that differ.
inline std::size_t require_others_kept(const std::string& before, const std::string& after) {
  const SpannedJson old_json(before, "before"), new_json(after, "after");
  const auto kept = [](const std::vector<SpanValue>& members) {
    std::vector<std::string> texts;
    for (const SpanValue& member : members)
      if (!is_of_materials(member.key())) texts.push_back(member.key() + std::string(member.raw()));
    return texts;
  };
  REQUIRE(kept(old_json.root().children()) == kept(new_json.root().children()));
  const std::vector<SpanValue> old_list = old_json.root()["materials"].children(),
                               new_list = new_json.root()["materials"].children();
  REQUIRE(old_list.size() == new_list.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < old_list.size(); ++i) {
    changed += old_list[i].raw() != new_list[i].raw();
    const bool is_specgloss = static_cast<bool>(old_list[i]["extensions"][kSpecGlossExtension]);
    if (!is_specgloss) REQUIRE(old_list[i].raw() == new_list[i].raw());
    for (const SpanValue& member : old_list[i].children())
      if (const std::string key = member.key(); key != "pbrMetallicRoughness" && key != "extensions")
        REQUIRE(new_list[i].find(key).raw() == old_list[i].find(key).raw());
    for (const SpanValue& member : old_list[i]["extensions"].children())
      if (const std::string key = member.key(); key != kSpecGlossExtension)
        REQUIRE(new_list[i]["extensions"].find(key).raw() == old_list[i]["extensions"].find(key).raw());
  }
  return changed;
}

}  // namespace remap
