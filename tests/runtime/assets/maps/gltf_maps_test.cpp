// This file tests textured core materials as spec-gloss and folded, compaction, baking and JPEG. The codec is
// PlainCodec.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "assets/maps/texture_bake.hpp"
#include "runtime/assets/gltf_containers.hpp"
#include "support/srgb.hpp"

using namespace remap;

namespace {

std::string core_textured(const std::string& members, const std::string& more = "") {
  return R"({"pbrMetallicRoughness":{)" + members + "}" + more + "}";
}

const std::string kCoreBoth = R"("baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":1})";

// A TexelLobes holds the diffuse reflectance and F0 of a texel: of a core material by glTF 2.0, or of a
// spec-gloss material by its extension.
struct TexelLobes {
  std::array<double, 3> diffuse{}, f0{};
};

TexelLobes core_lobes(const std::array<double, 3>& base, double metallic,
                      const std::array<double, 3>& dielectric) {
  TexelLobes lobes;
  for (std::size_t c = 0; c < 3; ++c) {
    lobes.diffuse[c] = base[c] * (1.0 - metallic) * (1.0 - *std::ranges::max_element(dielectric));
    lobes.f0[c] = dielectric[c] * (1.0 - metallic) + base[c] * metallic;
  }
  return lobes;
}

// This is half a step of 8 bits, plus the errors of floats.
constexpr double kHalfStep = 0.51 / 255.0;

const SpanValue extension_of(const Reread& after, std::size_t index) {
  return after.material(index)["extensions"]["KHR_materials_pbrSpecularGlossiness"];
}

std::size_t chunk_length(const Reread& after) {
  return after.root()["buffers"].children()[0]["byteLength"].whole().value();
}

}  // namespace

TEST_CASE("Core maps become diffuse and specular-glossiness, texel by texel", "[assets]") {
  for (const std::size_t base_channels : {1u, 3u, 4u})
    for (const PixelType type : {PixelType::kUint8, PixelType::kUint16}) {
      CAPTURE(base_channels, type);
      const ImagePixels base = random_pixels(base_channels, 1, type), data = random_pixels(3, 2, type);
      const std::string bytes = container_of(
          {base, data},
          core_textured(
              kCoreBoth +
              R"(,"baseColorFactor":[0.5,0.25,1,0.50],"metallicFactor":0.75,"roughnessFactor":0.5)"));
      const Reread after = reread(bytes, kToSpecGloss);
      const SpanValue extension = extension_of(after, 0);
      CHECK(extension["diffuseFactor"].raw() == "[1,1,1,0.50]");
      const ImagePixels diffuse = after.image(extension["diffuseTexture"]),
                        specgloss = after.image(extension["specularGlossinessTexture"]);
      REQUIRE(specgloss.channels == 4);
      for (std::size_t i = 0; i < 30; ++i) {
        const std::array<double, 3> factors = {0.5, 0.25, 1.0};
        std::array<double, 3> color{};
        for (std::size_t c = 0; c < 3; ++c)
          color[c] = factors[c] * linear(value_at(base, i, base.is_grey() ? 0 : c));
        const double metallic = 0.75 * static_cast<double>(value_at(data, i, 2));
        const TexelLobes lobes = core_lobes(color, metallic, {0.04, 0.04, 0.04});
        const double left = 1.0 - *std::ranges::max_element(lobes.f0);
        for (std::size_t c = 0; c < 3; ++c) {
          CHECK(static_cast<double>(value_at(specgloss, i, c)) ==
                Approx(linear_to_srgb(lobes.f0[c])).margin(kHalfStep));
          CHECK(static_cast<double>(value_at(diffuse, i, c)) ==
                Approx(linear_to_srgb(lobes.diffuse[c] / left)).margin(kHalfStep));
        }
        CHECK(static_cast<double>(value_at(specgloss, i, 3)) ==
              Approx(1.0 - 0.5 * static_cast<double>(value_at(data, i, 1))).margin(kHalfStep));
        if (base.has_alpha())
          CHECK(value_at(diffuse, i, diffuse.channels - 1) == value_at(base, i, base.channels - 1));
      }
      CHECK(require_others_kept(read_container(MemorySource(bytes), "before").json, after.container.json,
                                kToSpecGloss) == 1);
      CHECK(reread(after.bytes, kToSpecGloss).bytes == after.bytes);
    }
}

TEST_CASE("Spec-gloss maps are made once, and only where they vary", "[assets]") {
  ImagePixels smooth = random_pixels(3, 2);
  for (std::size_t i = 2; i < smooth.bytes.size(); i += 3) smooth.bytes[i] = std::byte{0};
  const std::string one = core_textured(kCoreBoth);
  const Reread after = reread(
      container_of(
          {random_pixels(4, 1), smooth, constant_pixels({255, 51, 255})},
          one + "," + one + "," +
              core_textured(R"("baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":2})") +
              "," +
              core_textured(R"("metallicFactor":0,"baseColorTexture":{"index":0,"extras":1},)"
                            R"("metallicRoughnessTexture":{"index":1,"texCoord":1})")),
      kToSpecGloss);
  // If the material is a dielectric, diffuse is base color, and specular is one number.
  const SpanValue first = extension_of(after, 0);
  CHECK(first["diffuseTexture"].raw() == R"({"index":0})");
  CHECK(first["specularFactor"].raw() == "[0.04,0.04,0.04]");
  CHECK(extension_of(after, 1).raw() == first.raw());
  // If the material is a metal with alpha, the base map stays for its alpha, multiplied by black.
  CHECK(extension_of(after, 2)["diffuseFactor"].raw() == "[0,0,0,1]");
  CHECK(extension_of(after, 2)["diffuseTexture"].raw() == R"({"index":0})");
  CHECK(extension_of(after, 2)["glossinessFactor"].raw() == "0.8");
  // Without a metallic map, textures need not share a grid.
  CHECK(extension_of(after, 3)["diffuseTexture"].raw() == R"({"index":0,"extras":1})");
  CHECK(extension_of(after, 3)["specularGlossinessTexture"]["texCoord"].raw() == "1");
  CHECK(after.root()["images"].size() == 5);
  const ImagePixels specgloss = after.image(first["specularGlossinessTexture"]);
  for (std::size_t i = 0; i < 30; ++i) CHECK(value_at(specgloss, i, 0) == 1.0f);
}

TEST_CASE("A base map of metals without alpha is not needed for diffuse", "[assets]") {
  const Reread after = reread(
      container_of({random_pixels(3, 1)}, core_textured(R"("baseColorTexture":{"index":0})")), kToSpecGloss);
  CHECK_FALSE(extension_of(after, 0)["diffuseTexture"]);
  CHECK(extension_of(after, 0)["diffuseFactor"].raw() == "[0,0,0,1]");
  CHECK(extension_of(after, 0)["specularGlossinessTexture"]);
}

TEST_CASE("A constant alpha of a base map that is not needed is a factor", "[assets]") {
  ImagePixels base = random_pixels(4, 1);
  for (std::size_t i = 3; i < base.bytes.size(); i += 4) base.bytes[i] = std::byte{51};
  const Reread after = reread(
      container_of({base}, core_textured(R"("baseColorTexture":{"index":0},"baseColorFactor":[1,1,1,0.5])")),
      kToSpecGloss);
  CHECK(extension_of(after, 0)["diffuseFactor"].raw() == "[0,0,0,0.1]");
}

TEST_CASE("Maps of KHR_materials_specular enter texel by texel", "[assets]") {
  const ImagePixels base = random_pixels(3, 1), data = random_pixels(3, 2), strength = random_pixels(4, 3),
                    tint = random_pixels(3, 4);
  const std::string material = core_textured(
      kCoreBoth,
      R"(,"extensions":{"KHR_materials_ior":{"ior":2.5},"KHR_materials_specular":{"specularFactor":0.9,)"
      R"("specularTexture":{"index":2},"specularColorFactor":[12,8,1],"specularColorTexture":{"index":3}}})");
  const std::string bytes = container_of({base, data, strength, tint}, material);
  const Reread after = reread(bytes, kToSpecGloss);
  const ImagePixels specgloss = after.image(extension_of(after, 0)["specularGlossinessTexture"]);
  const double f0 = std::pow(1.5 / 3.5, 2.0);
  for (std::size_t i = 0; i < 30; ++i) {
    std::array<double, 3> color{}, dielectric{};
    for (std::size_t c = 0; c < 3; ++c) {
      color[c] = linear(value_at(base, i, c));
      const double factor = std::array{12.0, 8.0, 1.0}[c] * linear(value_at(tint, i, c));
      dielectric[c] = std::min(f0 * factor, 1.0) * 0.9 * static_cast<double>(value_at(strength, i, 3));
    }
    const TexelLobes lobes = core_lobes(color, static_cast<double>(value_at(data, i, 2)), dielectric);
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(static_cast<double>(value_at(specgloss, i, c)) ==
            Approx(linear_to_srgb(lobes.f0[c])).margin(kHalfStep));
  }
  CHECK_FALSE(after.material(0)["extensions"]["KHR_materials_specular"]);
  const Reread folded = reread(bytes, kFolding);
  CHECK_FALSE(folded.material(0)["extensions"]);
  CHECK(folded.root()["images"].size() == 6);
  CHECK(reread(folded.bytes, kFolding).bytes == folded.bytes);
}

TEST_CASE("Diffuse of dielectrics stays where specular leaves nothing for it", "[assets]") {
  ImagePixels tint = random_pixels(3, 4);
  std::fill_n(tint.bytes.begin(), 9, std::byte{255});
  const Reread after =
      reread(container_of(
                 {random_pixels(3, 1), tint},
                 core_textured(
                     R"("baseColorTexture":{"index":0},"baseColorFactor":[0.5,0.25,1,1],"metallicFactor":0)",
                     R"(,"extensions":{"KHR_materials_ior":{"ior":0},"KHR_materials_specular":{)"
                     R"("specularColorTexture":{"index":1}}})")),
             kToSpecGloss);
  CHECK(extension_of(after, 0)["diffuseTexture"].raw() == R"({"index":0})");
  CHECK(extension_of(after, 0)["diffuseFactor"].raw() == "[0.5,0.25,1,1]");
  const ImagePixels specgloss = after.image(extension_of(after, 0)["specularGlossinessTexture"]);
  for (std::size_t i = 0; i < 30; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(value_at(specgloss, i, c) == Approx(value_at(tint, i, c)).margin(1e-6));
}

TEST_CASE("Folding the exact form of maps gives the maps of core", "[assets]") {
  const ImagePixels diffuse = random_pixels(4, 1), specgloss = random_pixels(4, 2);
  const std::string bytes =
      container_of({diffuse, specgloss},
                   textured(kBoth + R"(,"diffuseFactor":[0.5,0.6,0.7,1],"specularFactor":[0.9,0.8,1])"));
  const Reread core = reread(bytes), folded = reread(reread(bytes, kExactOptions).bytes, kFolding);
  for (const char* name : {"baseColorTexture", "metallicRoughnessTexture"}) {
    const ImagePixels a = core.image(core.material(0)["pbrMetallicRoughness"][name]),
                      b = folded.image(folded.material(0)["pbrMetallicRoughness"][name]);
    REQUIRE(a.bytes.size() == b.bytes.size());
    // In between, roughness was rounded to 8 bits, which slightly affects the projection.
    for (std::size_t i = 0; i < 30; ++i)
      for (std::size_t c = 0; c < a.channels; ++c)
        CHECK(value_at(a, i, c) == Approx(value_at(b, i, c)).margin(1.01 / 255.0));
  }
}

TEST_CASE("Maps of core that do not lie on one grid are named", "[assets]") {
  const std::string bytes = container_of(
      {random_pixels(3, 1), random_pixels(3, 2)},
      core_textured(R"("baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":1,"texCoord":1})"));
  CHECK(failures_of(bytes, kToSpecGloss).front() ==
        "its base color texture lies on TEXCOORD_0, its metallic roughness texture on TEXCOORD_1, and both "
        "decide on specular color (bake both with one set of UVs, for example in Blender)");
}

TEST_CASE("Compaction gives places of spare images to new ones, and cuts their bytes", "[assets]") {
  const std::string bytes = container_of({random_pixels(3, 1), random_pixels(4, 2)}, textured(kBoth));
  const Reread plain = reread(bytes), after = reread(bytes, kCompacting);
  CHECK(after.root()["images"].size() == 2);
  CHECK(after.root()["textures"].size() == 2);
  CHECK(after.root()["bufferViews"].size() == 3);
  CHECK(after.root()["images"].children()[0].raw() ==
        R"({"bufferView":1,"name":"i0_baseColor","mimeType":"image/png"})");
  const SpanValue core = after.material(0)["pbrMetallicRoughness"],
                  plain_core = plain.material(0)["pbrMetallicRoughness"];
  for (const char* name : {"baseColorTexture", "metallicRoughnessTexture"})
    CHECK(after.image(core[name]).bytes == plain.image(plain_core[name]).bytes);
  CHECK(core["metallicRoughnessTexture"].raw() == R"({"index":1})");
  // The chunk has the mesh, and two images of three channels.
  CHECK(chunk_length(after) == 4 + 96 + 95);
  CHECK(after.bytes.ends_with("mine"));
  CHECK(reread(after.bytes, kCompacting).bytes == after.bytes);
}

TEST_CASE("Compaction keeps what others use", "[assets]") {
  const ImagePixels shared = random_pixels(3, 1), odd = random_pixels(4, 2), mesh = random_pixels(3, 3);
  const std::string failing =
      textured(R"("diffuseTexture":{"index":0,"texCoord":1},"specularGlossinessTexture":{"index":1})");
  // A material that fails still uses both images.
  const Reread failed = reread(container_of({shared, odd}, textured(kBoth) + "," + failing), kCompacting);
  CHECK(failed.root()["images"].size() == 4);
  // A converted material has an occlusion map.
  std::string occluded = textured(kBoth);
  occluded.replace(occluded.size() - 1, 1, R"(,"occlusionTexture":{"index":1}})");
  const Reread kept = reread(container_of({shared, odd}, occluded), kCompacting);
  CHECK(kept.root()["images"].size() == 3);
  CHECK(kept.image(kept.material(0)["occlusionTexture"]).bytes == odd.bytes);
  CHECK(kept.material(0)["pbrMetallicRoughness"]["baseColorTexture"].raw() == R"({"index":0})");
  // The image that is no longer used lies before an image that is used, so its bytes stay. A new image gets
  // its index.
  std::string normal = textured(kBoth);
  normal.replace(normal.size() - 1, 1, R"(,"normalTexture":{"index":2}})");
  const std::string bytes = container_of({shared, odd, mesh}, normal);
  const Reread after = reread(bytes, kCompacting);
  CHECK(after.root()["images"].size() == 3);
  CHECK(after.image(after.material(0)["normalTexture"]).bytes == mesh.bytes);
  CHECK(chunk_length(after) > chunk_length(Reread(bytes)));
  CHECK(require_others_kept(read_container(MemorySource(bytes), "before").json, after.container.json,
                            kCompacting) == 1);
}

TEST_CASE("Compaction cuts no byte that another view has", "[assets]") {
  const std::string bytes = container_of({random_pixels(3, 1), random_pixels(4, 2)}, textured(kBoth));
  const Reread after = reread(
      with_json(bytes, R"({"buffer":0,"byteLength":4})", R"({"buffer":0,"byteLength":50})"), kCompacting);
  CHECK(chunk_length(after) == 52 + 96 + 95);
  CHECK(after.bytes.substr(after.container.chunks[0].content_begin(), 50) ==
        bytes.substr(Reread(bytes).container.chunks[0].content_begin(), 50));
}

TEST_CASE("Spare places that nothing takes share the bytes of others", "[assets]") {
  // Both maps become one factor and one map. The texture no longer has an image of another format.
  const std::string bytes =
      container_of({random_pixels(3, 1), random_pixels(4, 2)},
                   textured(R"("specularGlossinessTexture":{"index":1},"diffuseFactor":[0,0,0,1])") + "," +
                       textured(R"("diffuseTexture":{"index":0},"specularFactor":[1,1,1])"));
  const Reread after = reread(bytes, kCompacting);
  const std::vector<SpanValue> images = after.root()["images"].children();
  for (const SpanValue& image : images) {
    const SpanValue view = after.root()["bufferViews"].children().at(image["bufferView"].whole().value());
    CHECK(view["byteLength"].whole().value() >= 1);
    CHECK(view["byteOffset"].whole().value_or(0) + view["byteLength"].whole().value() <= chunk_length(after));
  }
  const Reread none =
      reread(container_of({constant_pixels({255, 0, 0}), constant_pixels({0, 0, 0, 51})}, textured(kBoth)),
             kCompacting);
  CHECK(none.root()["images"].children()[0]["uri"].raw().starts_with("\"data:image/png;base64,"));
  CHECK(none.root()["images"].children()[1]["uri"]);
  CHECK(none.root()["bufferViews"].children()[2].raw() == R"({"buffer":0,"byteOffset":0,"byteLength":1})");
  CHECK(chunk_length(none) == 4);
}

TEST_CASE("Textures of other formats lose their extension when they are spare", "[assets]") {
  const std::string bytes = container_of({random_pixels(3, 1), random_pixels(4, 2)},
                                         textured(R"("specularGlossinessTexture":{"index":1})"));
  const std::string webp =
      with_json(with_json(bytes, R"({"source":1,"sampler":1})",
                          R"({"extensions":{"EXT_texture_webp":{"source":1}},"sampler":1})"),
                R"(["KHR_)", R"(["EXT_texture_webp","KHR_)");
  CHECK(reread(webp).root()["extensionsUsed"].raw() == R"(["EXT_texture_webp"])");
  const Reread after = reread(webp, kCompacting);
  CHECK_FALSE(after.root()["extensionsUsed"]);
  CHECK(after.root()["textures"].children()[1].raw() == R"({"sampler":1,"source":1})");
}

TEST_CASE("A spare texture of another format keeps its extension where its image stays", "[assets]") {
  const std::string bytes = container_of(
      {constant_pixels({255, 0, 0}), random_pixels(4, 2)},
      R"({"normalTexture":{"index":1},"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},"specularFactor":[0.04,0.04,0.04]}}})");
  const std::string both = R"({"extensions":{"EXT_texture_webp":{"source":0}}})";
  const Reread after =
      reread(with_json(bytes, R"({"source":0,"sampler":0},{"source":1,"sampler":1})", both + "," + both),
             kCompacting);
  CHECK(after.material(0)["pbrMetallicRoughness"]["baseColorFactor"].raw() == "[1,0,0,1]");
  for (const SpanValue& texture : after.root()["textures"].children()) CHECK(texture.raw() == both);
}

TEST_CASE("Files with unknown extensions are not compacted", "[assets]") {
  const std::string bytes =
      with_json(container_of({random_pixels(3, 1), random_pixels(4, 2)}, textured(kBoth)), R"(["KHR_)",
                R"(["ACME_atlas","KHR_)");
  const PlainResources resources;
  const AssetConversion result = convert_gltf(MemorySource(bytes), "file", kCompacting, &resources);
  CHECK(result.warnings ==
        std::vector<std::string>{"keeps its unused images, because the extension ACME_atlas may use them"});
  CHECK(Reread(converted_bytes(bytes, kCompacting, &resources)).root()["images"].size() == 4);
}

namespace {

// A RandomContainer has meshes and images in any order, views that images share, and textures that materials
// share.
class RandomContainer {
 public:
  explicit RandomContainer(std::uint32_t seed) : random_(seed) {}

  std::string bytes() {
    std::string binary, views, images, textures, materials;
    std::vector<std::size_t> image_views;
    for (std::size_t i = 0; i < 7; ++i) {
      const bool is_image = below(4) > 0;
      const std::string content =
          is_image ? file_of(random_pixels(3 + below(2), static_cast<std::uint32_t>(random_())))
                   : "mesh" + std::string(below(9), 'm');
      if (is_image) image_views.push_back(i);
      add(views, R"({"buffer":0,"byteOffset":)" + std::to_string(binary.size()) + R"(,"byteLength":)" +
                     std::to_string(content.size()) + "}");
      binary += content + std::string(below(3), '\0');
    }
    if (image_views.empty()) return bytes();
    const std::size_t image_count = 2 + below(5), texture_count = 2 + below(5);
    for (std::size_t i = 0; i < image_count; ++i)
      add(images, R"({"bufferView":)" + std::to_string(image_views[below(image_views.size())]) +
                      R"(,"extras":)" + std::to_string(i) + "}");
    for (std::size_t i = 0; i < texture_count; ++i)
      add(textures, R"({"source":)" + std::to_string(below(image_count)) + "}");
    for (std::size_t i = 0; i < 4; ++i) add(materials, material(texture_count));
    return glb_bytes(R"({"asset":{"version":"2.0"},"materials":[)" + materials + R"(],"textures":[)" +
                         textures + R"(],"images":[)" + images + R"(],"bufferViews":[)" + views +
                         R"(],"accessors":[{"bufferView":0}],)" + R"("buffers":[{"byteLength":)" +
                         std::to_string(binary.size()) + "}]}",
                     chunk_bytes(kBinaryChunk, binary + std::string((4 - binary.size() % 4) % 4, '\0')));
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  static void add(std::string& list, const std::string& entry) { list += (list.empty() ? "" : ",") + entry; }
  std::string info(std::size_t count) { return R"({"index":)" + std::to_string(below(count)) + "}"; }
  std::string material(std::size_t count) {
    std::string text;
    if (below(3) == 0) text += R"("normalTexture":)" + info(count) + ",";
    if (below(3) > 0)
      return "{" + text + R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":)" +
             info(count) + R"(,"specularGlossinessTexture":)" + info(count) + "}}}";
    return "{" + text + R"("pbrMetallicRoughness":{"baseColorTexture":)" + info(count) +
           R"(,"metallicRoughnessTexture":)" + info(count) + "}}";
  }

  std::mt19937 random_;
};

// Returns the pixels of every texture of the materials, keyed by the place of the texture info.
std::map<std::string, std::vector<std::byte>> pixels_by_place(const Reread& file) {
  std::map<std::string, std::vector<std::byte>> found;
  const std::vector<SpanValue> materials = file.root()["materials"].children();
  for (std::size_t i = 0; i < materials.size(); ++i)
    for (const SpanValue& object : {materials[i], materials[i]["pbrMetallicRoughness"],
                                    materials[i]["extensions"]["KHR_materials_pbrSpecularGlossiness"]})
      for (const SpanValue& member : object.children())
        if (member["index"])
          found[std::to_string(i) + object.key() + member.key()] = file.image(member).bytes;
  return found;
}

}  // namespace

TEST_CASE("Compacted random containers show what others show", "[assets]") {
  std::size_t plain_bytes = 0, compact_bytes = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed)
    for (const AssetTarget target : {AssetTarget::kMetalRough, AssetTarget::kSpecGloss}) {
      const std::string bytes = RandomContainer(seed).bytes();
      CAPTURE(seed, static_cast<int>(target));
      AssetOptions options = kCoreOptions, compact = kCompacting;
      options.target = compact.target = target;
      const Reread before(bytes), plain = reread(bytes, options), after = reread(bytes, compact);
      REQUIRE(pixels_by_place(after) == pixels_by_place(plain));
      REQUIRE(after.bytes.size() <= plain.bytes.size());
      REQUIRE(require_others_kept(before.container.json, after.container.json, compact) ==
              require_others_kept(before.container.json, plain.container.json, options));
      // Reading the file again checks that views lie in the buffer. The mesh stays.
      REQUIRE(reread(after.bytes, compact).bytes == after.bytes);
      const auto first_view = [](const Reread& file) {
        return file.bytes.substr(file.container.chunks[0].content_begin(),
                                 file.root()["bufferViews"].children()[0]["byteLength"].whole().value());
      };
      REQUIRE(first_view(after) == first_view(before));
      plain_bytes += plain.bytes.size();
      compact_bytes += after.bytes.size();
    }
  // Most images lie between other images that are used. Conversions to spec-gloss leave no image unused.
  CHECK(compact_bytes < plain_bytes);
}

TEST_CASE("Files that only unused images refer to no longer belong to the asset", "[assets]") {
  PlainResources resources;
  resources.files["a.png"] = file_of(random_pixels(3, 1));
  resources.files["b.png"] = file_of(random_pixels(4, 2));
  const std::string text =
      R"({"asset":{"version":"2.0"},"materials":[)" + textured(kBoth) +
      R"(],"textures":[{"source":0},{"source":1}],"images":[{"uri":"a.png"},{"uri":"b.png"},{"uri":"c.png"}]})";
  const AssetConversion result = convert_gltf(MemorySource(text), "file", kCompacting, &resources);
  REQUIRE(result.resources.size() == 1);
  CHECK(result.resources[0].path == "c.png");
  CHECK(SpannedJson(result.text, "file").root()["images"].children()[0].raw() ==
        R"({"uri":"a_baseColor.png","mimeType":"image/png"})");
  CHECK(result.files[1].path == "b_metallicRoughness.png");
}

TEST_CASE("A map is baked onto the grid of another", "[assets]") {
  const ImagePixels map = random_pixels(4, 1);
  const TextureTransform same;
  CHECK(baked(map, Transfer::kSrgb, same, {6, 5, same}).bytes == map.bytes);
  // The transform shifts by two texels of six.
  TextureTransform shifted;
  shifted.offset[0] = 2.0 / 6.0;
  const ImagePixels moved = baked(map, Transfer::kSrgb, shifted, {6, 5, same});
  for (std::size_t y = 0; y < 5; ++y)
    for (std::size_t x = 0; x < 6; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        CHECK(value_at(moved, y * 6 + x, c) ==
              Approx(value_at(map, y * 6 + (x + 2) % 6, c)).margin(0.51 / 255.0));
  // The transform turns a square by a quarter counter-clockwise: the top left shows what was on the right of
  // the top.
  ImagePixels square{
      2, 2, 1, PixelType::kUint8, {std::byte{10}, std::byte{20}, std::byte{30}, std::byte{40}}};
  TextureTransform turned;
  turned.rotation = std::acos(-1.0) / 2.0;
  const ImagePixels quarter = baked(square, Transfer::kLinear, turned, {2, 2, same});
  // As in three.js, (u, v) reads (cos u + sin v, cos v - sin u) = (v, 1 - u), repeated.
  CHECK(quarter.bytes == std::vector<std::byte>{std::byte{30}, std::byte{10}, std::byte{40}, std::byte{20}});
  // The transform of the grid is undone. If map and grid have the same transform, the map does not change.
  TextureTransform both = turned;
  both.scale[0] = 2.0;
  both.offset[1] = 0.3;
  CHECK(baked(map, Transfer::kSrgb, both, {6, 5, both}).bytes == map.bytes);
  // Halfway between a black and a white texel, the value is half of the light.
  const ImagePixels step{2, 1, 1, PixelType::kUint8, {std::byte{0}, std::byte{255}}};
  TextureTransform half;
  half.offset[0] = 0.25;
  CHECK(std::to_integer<int>(baked(step, Transfer::kSrgb, half, {2, 1, same}).bytes[0]) == 188);
  TextureTransform flat;
  flat.scale[1] = 0.0;
  CHECK_THROWS_WITH(baked(map, Transfer::kSrgb, same, {6, 5, flat}), Catch::Contains("scale: is 0"));
}

TEST_CASE("Maps with different transforms are converted on request", "[assets]") {
  const std::string bytes = container_of(
      {random_pixels(3, 1), random_pixels(4, 2)},
      textured(R"("diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1,"extensions":{)"
               R"("KHR_texture_transform":{"offset":[0.5,0]}}})"));
  CHECK(
      failures_of(bytes).front() ==
      "its diffuse and specular glossiness textures have different KHR_texture_transform, and both decide on "
      "metallic (use --resample, or --extensions write)");
  const PlainResources resources;
  const AssetConversion result = convert_gltf(MemorySource(bytes), "file", kResampling, &resources);
  for (const std::string& warning : result.materials[0].warnings)
    CHECK(warning.find("drawn onto") == std::string::npos);
  const Reread after = reread(bytes, kResampling);
  const SpanValue core = after.material(0)["pbrMetallicRoughness"];
  CHECK(core["metallicRoughnessTexture"].raw() == R"({"index":3})");
  const ImagePixels data = after.image(core["metallicRoughnessTexture"]), specgloss = random_pixels(4, 2);
  // The texels are shifted by half of six.
  for (std::size_t i = 0; i < 30; ++i)
    CHECK(value_at(data, i, 1) ==
          Approx(1.0f - value_at(specgloss, i / 6 * 6 + (i + 3) % 6, 3)).margin(1.01 / 255.0));
}

TEST_CASE("reports: 08 a texture that repeats is drawn as often as it repeats", "[assets]") {
  // The diffuse map repeats twice along each side, the other map once. The right half of the other map is
  // gold.
  const ImagePixels gold{2,
                         1,
                         4,
                         PixelType::kUint8,
                         {std::byte{58}, std::byte{58}, std::byte{58}, std::byte{99}, std::byte{255},
                          std::byte{220}, std::byte{150}, std::byte{99}}};
  ImagePixels stripes = random_pixels(3, 1);
  const std::string scale = R"("extensions":{"KHR_texture_transform":{"scale":[2,2]}})";
  const PlainResources resources;
  const std::string bytes = container_of(
      {stripes, gold},
      textured(R"("diffuseTexture":{"index":0,)" + scale + R"(},"specularGlossinessTexture":{"index":1})"));
  const AssetConversion result = convert_gltf(MemorySource(bytes), "file", kResampling, &resources);
  REQUIRE(result.materials[0].failure.empty());
  const auto warnings_of = [](const AssetMaterial& material) {
    std::string text;
    for (const std::string& warning : material.warnings) text += warning + "\n";
    return text;
  };
  CHECK(warnings_of(result.materials[0]).find("drawn onto") == std::string::npos);
  const Reread after = reread(bytes, kResampling);
  const SpanValue core = after.material(0)["pbrMetallicRoughness"];
  CHECK(core["baseColorTexture"].raw().find("extensions") == std::string::npos);
  const ImagePixels base = after.image(core["baseColorTexture"]),
                    data = after.image(core["metallicRoughnessTexture"]);
  REQUIRE(base.width == 2 * stripes.width);
  REQUIRE(base.height == 2 * stripes.height);
  const std::size_t right = base.width * 3 / 4;
  CHECK(value_at(data, right, 2) > 0.9f);
  CHECK(value_at(base, right, 0) > 0.97f);
  CHECK(value_at(base, right, 2) < 0.75f);
  // If neither scale is a multiple of the other, no image fits, unless one texture covers everything.
  const auto outcome = [&](const std::string& first, const std::string& second) {
    const auto transform = [](const std::string& value) {
      return R"("extensions":{"KHR_texture_transform":{"scale":[)" + value + "]}}}";
    };
    const AssetConversion both = convert_gltf(
        MemorySource(container_of(
            {stripes, gold}, textured(R"("diffuseTexture":{"index":0,)" + transform(first) +
                                      R"(,"specularGlossinessTexture":{"index":1,)" + transform(second)))),
        "file", kResampling, &resources);
    const AssetMaterial& material = both.materials[0];
    return material.failure + warnings_of(material);
  };
  CHECK(outcome("4,4", "2,2").find("drawn onto") == std::string::npos);
  CHECK(outcome("2,2", "3,3").find("repeat differently") != std::string::npos);
  CHECK(outcome("0.75,0.75", "0.5,0.5").find("drawn onto") != std::string::npos);
}

TEST_CASE("reports: 20 materials share new images with the same bytes", "[assets]") {
  const auto material = [](const char* diffuse) {
    return textured(std::string(R"("diffuseTexture":{"index":)") + diffuse +
                    R"(},"specularGlossinessTexture":{"index":2})");
  };

  const Reread after = reread(container_of({random_pixels(3, 4), random_pixels(3, 4), random_pixels(4, 2)},
                                           material("0") + "," + material("1")));
  const auto data = [&](std::size_t i) {
    return after.material(i)["pbrMetallicRoughness"]["metallicRoughnessTexture"].raw();
  };
  CHECK(data(0) == data(1));
}

TEST_CASE("Pairs that are baked differently are converted apart", "[assets]") {
  const auto material = [](const std::string& offset) {
    return textured(R"("diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1,"extensions":{)"
                    R"("KHR_texture_transform":{"offset":[)" +
                    offset + ",0]}}}");
  };
  const Reread after = reread(container_of({random_pixels(3, 1), random_pixels(4, 2)},
                                           material("0.5") + "," + material("0.25") + "," + material("0.50")),
                              kResampling);
  CHECK(after.root()["images"].size() == 6);
  CHECK(after.material(2)["pbrMetallicRoughness"].raw() == after.material(0)["pbrMetallicRoughness"].raw());
}

TEST_CASE("Color of JPEG files is JPEG on request, data and alpha never", "[assets]") {
  PlainResources resources;
  AssetOptions options = kCoreOptions;
  options.jpeg_quality = 85;
  const auto new_files = [&](const ImagePixels& diffuse, bool is_jpeg) {
    resources.files["a.jpg"] = is_jpeg ? PlainCodec().encode_jpeg(diffuse, 85) : file_of(diffuse);
    resources.files["b.png"] = file_of(random_pixels(4, 2));
    const std::string text =
        R"({"asset":{"version":"2.0"},"materials":[)" + textured(kBoth) +
        R"(],"textures":[{"source":0},{"source":1}],"images":[{"uri":"a.jpg"},{"uri":"b.png"}]})";
    std::vector<std::string> names;
    const AssetConversion result = convert_gltf(MemorySource(text), "file", options, &resources);
    for (const NewResource& file : result.files)
      names.push_back(file.path + (file.bytes.starts_with("\xff\xd8"
                                                          "85")
                                       ? " jpeg"
                                       : " png"));
    return names;
  };
  using Names = std::vector<std::string>;
  CHECK(new_files(random_pixels(3, 1), true) == Names{"a_baseColor.jpg jpeg", "b_metallicRoughness.png png"});
  CHECK(new_files(random_pixels(3, 1), false) == Names{"a_baseColor.png png", "b_metallicRoughness.png png"});
  CHECK(new_files(random_pixels(4, 1), true) == Names{"a_baseColor.png png", "b_metallicRoughness.png png"});
  options.jpeg_quality.reset();
  CHECK(new_files(random_pixels(3, 1), true) == Names{"a_baseColor.png png", "b_metallicRoughness.png png"});
}
