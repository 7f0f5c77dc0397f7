// This file makes glTF texts and containers for tests, and checks what a conversion must not change.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "assets/document/gltf_extensions.hpp"
#include "assets/gltf/gltf_asset.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "core/errors.hpp"
#include "core/json_spans.hpp"
#include "support/replaced.hpp"

namespace remap {

inline constexpr AssetOptions kCoreOptions = {.instructions = InstructionSet::kBaseline};
inline constexpr AssetOptions kExactOptions = {.extensions = DielectricExtensions::kWritten,
                                               .instructions = InstructionSet::kBaseline};
inline constexpr AssetOptions kFolding = {.extensions = DielectricExtensions::kFolded,
                                          .instructions = InstructionSet::kBaseline};
inline constexpr AssetOptions kToSpecGloss = {.instructions = InstructionSet::kBaseline,
                                              .target = AssetTarget::kSpecGloss};
inline constexpr AssetOptions kCompacting = {.instructions = InstructionSet::kBaseline, .compacts = true};
inline constexpr AssetOptions kResampling = {.instructions = InstructionSet::kBaseline, .resamples = true};

// Returns a file of one material with this spec-gloss object and more members.
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

// Returns a container of this JSON, padded, and of chunks that chunk_bytes() made.
inline std::string glb_bytes(std::string json, const std::string& chunks = "", char padding = ' ') {
  json.append((4 - json.size() % 4) % 4, padding);
  const std::string content = chunk_bytes(kJsonChunk, json) + chunks;
  return "glTF" + four_bytes(2) + four_bytes(static_cast<std::uint32_t>(12 + content.size())) + content;
}

// Returns the bytes of the file after a conversion, or the source if nothing was converted.
inline std::string converted_bytes(const std::string& bytes, const AssetOptions& options = {},
                                   const AssetResources* resources = nullptr) {
  const AssetConversion conversion = convert_gltf(MemorySource(bytes), "file", options, resources);
  if (!conversion.changed) return bytes;
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
  return key == "materials" || key == "extensionsUsed" || key == "extensionsRequired" || key == "buffers";
}

// Returns true for lists that new images make longer.
inline bool may_grow(const std::string& key) {
  return key == "images" || key == "textures" || key == "bufferViews";
}

// A PlainCodec stores pixels with its own header instead of an image format, because tests of the core need
// no image library.
class PlainCodec final : public ImageCodec {
 public:
  ImagePixels decode(std::string_view bytes, const std::string& place) const override {
    if (bytes.starts_with("\xff\xd8")) bytes.remove_prefix(4);
    if (bytes.size() < 5 || !bytes.starts_with("P")) throw input_error(place + ": is no image");
    const auto number = [&](std::size_t at) {
      return static_cast<std::size_t>(static_cast<std::uint8_t>(bytes[at]));
    };
    ImagePixels pixels{
        number(1), number(2), number(3), number(4) == 2 ? PixelType::kUint16 : PixelType::kUint8, {}};
    const std::size_t size = pixels.width * pixels.height * pixels.texel_bytes();
    if (size == 0 || pixels.channels > 4 || bytes.size() != size + 5)
      throw input_error(place + ": is cut off");
    for (const char c : bytes.substr(5)) pixels.bytes.push_back(static_cast<std::byte>(c));
    return pixels;
  }
  std::string encode_png(const ImagePixels& pixels, int) const override {
    std::string bytes = "P";
    for (const std::size_t number : {pixels.width, pixels.height, pixels.channels, byte_count(pixels.type)})
      bytes += static_cast<char>(number);
    for (const std::byte byte : pixels.bytes) bytes += static_cast<char>(byte);
    return bytes;
  }
  // Returns bytes that begin like a JPEG file, with the quality.
  std::string encode_jpeg(const ImagePixels& pixels, int quality) const override {
    return "\xff\xd8" + std::to_string(quality) + encode_png(pixels, kUsualPngLevel);
  }
};

// A PlainResources holds files in memory.
class PlainResources final : public AssetResources {
 public:
  std::map<std::string, std::string> files;
  std::string prefix = {};  // prefix of new images

  std::unique_ptr<ByteSource> open(const std::string& path) const override {
    const auto found = files.find(path);
    if (found == files.end()) throw input_error(path + ": is not there");
    return std::make_unique<MemorySource>(found->second);
  }
  const ImageCodec& codec() const override { return codec_; }
  std::string image_prefix() const override { return prefix; }
  // Returns the closest texels, without interpolation.
  ImagePixels enlarged(const ImagePixels& pixels, std::size_t width, std::size_t height) const override {
    ImagePixels result{width, height, pixels.channels, pixels.type, {}};
    const auto size = static_cast<std::ptrdiff_t>(pixels.texel_bytes());
    for (std::size_t i = 0; i < width * height; ++i) {
      const std::size_t x = i % width * pixels.width / width, y = i / width * pixels.height / height;
      const auto from = pixels.bytes.begin() + static_cast<std::ptrdiff_t>(y * pixels.width + x) * size;
      result.bytes.insert(result.bytes.end(), from, from + size);
    }
    return result;
  }

 private:
  PlainCodec codec_;
};

// Returns true if a conversion may remove the extension from a material.
inline bool may_lose(const std::string& extension, const AssetOptions& options) {
  const bool is_dielectric = extension == kSpecularExtension || extension == kIorExtension;
  if (options.target == AssetTarget::kSpecGloss) return is_dielectric;
  return extension == kSpecGlossExtension || (options.folds_extensions() && is_dielectric);
}

inline void require_material_kept(SpanValue before, SpanValue after, const AssetOptions& options) {
  const bool keeps_core = options.target == AssetTarget::kSpecGloss;
  for (const SpanValue& member : before.children())
    if (const std::string key = member.key();
        key != "extensions" && (keeps_core || key != "pbrMetallicRoughness"))
      REQUIRE(after.find(key).raw() == before.find(key).raw());
  for (const SpanValue& member : before["extensions"].children())
    if (const std::string key = member.key(); !may_lose(key, options))
      REQUIRE(after["extensions"].find(key).raw() == before["extensions"].find(key).raw());
}

// Checks that no byte has changed except in converted materials, in the lists of extensions and, if unused
// images are removed, in images that only converted materials used. Returns the number of materials that
// differ.
inline std::size_t require_others_kept(const std::string& before, const std::string& after,
                                       const AssetOptions& options = {}) {
  const SpannedJson old_json(before, "before"), new_json(after, "after");
  const auto kept = [](const std::vector<SpanValue>& members) {
    std::vector<std::string> texts;
    for (const SpanValue& member : members)
      if (!is_of_materials(member.key()) && !may_grow(member.key()))
        texts.push_back(member.key() + std::string(member.raw()));
    return texts;
  };
  REQUIRE(kept(old_json.root().children()) == kept(new_json.root().children()));
  for (const char* key : {"images", "textures", "bufferViews"}) {
    const std::vector<SpanValue> old_list = old_json.root()[key].children(),
                                 new_list = new_json.root()[key].children();
    REQUIRE(old_list.size() <= new_list.size());
    for (std::size_t i = 0; i < old_list.size() && !options.compacts; ++i)
      REQUIRE(old_list[i].raw() == new_list[i].raw());
  }
  const std::vector<SpanValue> old_list = old_json.root()["materials"].children(),
                               new_list = new_json.root()["materials"].children();
  REQUIRE(old_list.size() == new_list.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < old_list.size(); ++i) {
    if (old_list[i].raw() == new_list[i].raw()) continue;
    ++changed;
    bool may_change = options.target == AssetTarget::kSpecGloss;
    for (const SpanValue& member : old_list[i]["extensions"].children())
      may_change = may_change || may_lose(member.key(), options);
    REQUIRE(may_change);
    require_material_kept(old_list[i], new_list[i], options);
  }
  return changed;
}

}  // namespace remap
