// This file makes glTF containers with images for tests, as PlainCodec writes them, and reads the results.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "assets/maps/map_pixels.hpp"
#include "runtime/assets/gltf_texts.hpp"

namespace remap {

inline ImagePixels random_pixels(std::size_t channels, std::uint32_t seed,
                                 PixelType type = PixelType::kUint8) {
  ImagePixels pixels{6, 5, channels, type, {}};
  std::mt19937 random(seed);
  pixels.bytes.resize(pixels.width * pixels.height * pixels.texel_bytes());
  for (std::byte& byte : pixels.bytes) byte = static_cast<std::byte>(random() & 255);
  return pixels;
}

inline ImagePixels constant_pixels(std::initializer_list<int> texel) {
  ImagePixels pixels{6, 5, texel.size(), PixelType::kUint8, {}};
  for (std::size_t i = 0; i < 30; ++i)
    for (const int value : texel) pixels.bytes.push_back(static_cast<std::byte>(value));
  return pixels;
}

inline std::string file_of(const ImagePixels& pixels) {
  return PlainCodec().encode_png(pixels, kUsualPngLevel);
}
inline ImagePixels pixels_of(const std::string& bytes) { return PlainCodec().decode(bytes, "image"); }

// Returns a container with the given materials. Its binary chunk has the images, and each image has a
// texture.
inline std::string container_of(const std::vector<ImagePixels>& images, const std::string& materials,
                                const std::string& more = "") {
  std::string binary = "mesh", views = R"({"buffer":0,"byteLength":4})", entries, textures;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string file = file_of(images[i]);
    views += R"(,{"buffer":0,"byteOffset":)" + std::to_string(binary.size()) + R"(,"byteLength":)" +
             std::to_string(file.size()) + "}";
    entries += std::string(i == 0 ? "" : ",") + R"({"bufferView":)" + std::to_string(i + 1) +
               R"(,"name":"i)" + std::to_string(i) + "\"}";
    textures += std::string(i == 0 ? "" : ",") + R"({"source":)" + std::to_string(i) + R"(,"sampler":)" +
                std::to_string(i) + "}";
    binary += file;
  }
  const std::size_t size = binary.size();
  binary.append((4 - size % 4) % 4, '\0');
  return glb_bytes(
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],"materials":[)" +
          materials + R"(],"textures":[)" + textures + R"(],"samplers":[{},{"wrapS":33071},{}],"images":[)" +
          entries + R"(],"bufferViews":[)" + views + R"(],"buffers":[{"byteLength":)" + std::to_string(size) +
          "}]" + more + "}",
      chunk_bytes(kBinaryChunk, binary) + chunk_bytes(7, "mine"));
}

inline std::string textured(const std::string& members) {
  return R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + members + "}}}";
}

inline const std::string kBoth = R"("diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1})";

// Returns a container with `other` instead of the first `part` of its JSON.
inline std::string with_json(const std::string& bytes, const std::string& part, const std::string& other) {
  const GltfContainer container = read_container(MemorySource(bytes), "before");
  return glb_bytes(replaced(container.json, part, other), bytes.substr(container.chunks.front().begin));
}

// A Reread holds a converted container, its JSON, and its images.
struct Reread {
  std::string bytes;
  GltfContainer container;
  std::unique_ptr<SpannedJson> json;

  explicit Reread(std::string content)
      : bytes(std::move(content)),
        container(read_container(MemorySource(bytes), "after")),
        json(std::make_unique<SpannedJson>(container.json, "after")) {}

  SpanValue root() const { return json->root(); }
  SpanValue material(std::size_t index) const { return root()["materials"].children().at(index); }
  // Returns the image of a texture info.
  ImagePixels image(SpanValue info) const {
    const SpanValue texture = root()["textures"].children().at(*info["index"].whole());
    const SpanValue view = root()["bufferViews"].children().at(
        *root()["images"].children().at(*texture["source"].whole())["bufferView"].whole());
    return pixels_of(bytes.substr(container.chunks.front().begin + 8 + view["byteOffset"].whole().value_or(0),
                                  *view["byteLength"].whole()));
  }
};

inline Reread reread(const std::string& bytes, const AssetOptions& options = kCoreOptions) {
  const PlainResources resources;
  return Reread(converted_bytes(bytes, options, &resources));
}

inline std::vector<std::string> failures_of(const std::string& bytes,
                                            const AssetOptions& options = kCoreOptions,
                                            const PlainResources& resources = {}) {
  std::vector<std::string> failures;
  for (const AssetMaterial& material :
       convert_gltf(MemorySource(bytes), "file", options, &resources).materials)
    failures.push_back(material.failure);
  return failures;
}

inline float value_at(const ImagePixels& pixels, std::size_t texel, std::size_t channel) {
  float value = 0.0f;
  load_values(pixels.type,
              pixels.bytes.data() + texel * pixels.texel_bytes() + channel * byte_count(pixels.type), 1, 1,
              &value);
  return value;
}

inline double linear(float stored) { return static_cast<double>(linear_of_srgb(stored)); }

}  // namespace remap
