// This file tests textured materials: which images are made, what they hold, and where they are stored. The
// codec is PlainCodec.
#include <cmath>

#include <catch2/catch.hpp>

#include "assets/maps/gltf_maps.hpp"
#include "core/base64.hpp"
#include "runtime/assets/gltf_containers.hpp"

using namespace remap;

namespace {

// These factors are linear, 0 to 1.
struct SpecGlossFactors {
  std::array<double, 3> diffuse{}, specular{};
  double glossiness = 1.0;
};

MaterialValues projected(const SpecGlossFactors& material) {
  static const auto converter =
      asset_converter("gltf-specgloss", "gltf", kCleanPrior, best_instruction_set());
  const auto &d = material.diffuse, &s = material.specular;
  return converted(*converter, {{Parameter::kDiffuse, {d.begin(), d.end()}},
                                {Parameter::kSpecular, {s.begin(), s.end()}},
                                {Parameter::kRoughness, {roughness_of(material.glossiness)}}});
}

// Compares each texel with a conversion of factors.
void require_projected(const Reread& after, SpanValue core, const ImagePixels& diffuse,
                       const ImagePixels& specgloss, const SpecGlossFactors& factors, double step) {
  const ImagePixels base = after.image(core["baseColorTexture"]),
                    data = after.image(core["metallicRoughnessTexture"]);
  REQUIRE(base.width == diffuse.width);
  for (std::size_t i = 0; i < 30; ++i) {
    SpecGlossFactors texel;
    for (std::size_t c = 0; c < 3; ++c) {
      texel.diffuse[c] = factors.diffuse[c] * linear(value_at(diffuse, i, diffuse.is_grey() ? 0 : c));
      texel.specular[c] = factors.specular[c] * linear(value_at(specgloss, i, specgloss.is_grey() ? 0 : c));
    }
    texel.glossiness =
        factors.glossiness *
        (specgloss.has_alpha() ? static_cast<double>(value_at(specgloss, i, specgloss.channels - 1)) : 1.0);
    const MaterialValues expected = projected(texel);
    for (std::size_t c = 0; c < 3; ++c) {
      float stored = expected.at(Parameter::kBaseColor)[c];
      from_linear(Transfer::kSrgb, {&stored, 1});
      CHECK(static_cast<double>(value_at(base, i, c)) == Approx(static_cast<double>(stored)).margin(step));
    }
    const auto factor = [&](const char* name) { return core[name].number().value_or(1.0); };
    CHECK(static_cast<double>(value_at(data, i, 1)) * factor("roughnessFactor") ==
          Approx(static_cast<double>(expected.at(Parameter::kRoughness)[0])).margin(step));
    CHECK(static_cast<double>(value_at(data, i, 2)) * factor("metallicFactor") ==
          Approx(static_cast<double>(expected.at(Parameter::kMetallic)[0])).margin(step));
    if (diffuse.has_alpha())
      CHECK(value_at(base, i, base.channels - 1) == value_at(diffuse, i, diffuse.channels - 1));
  }
}

}  // namespace

TEST_CASE("Both maps become base color and metallic-roughness, texel by texel", "[assets]") {
  for (const std::size_t diffuse_channels : {1u, 2u, 3u, 4u})
    for (const std::size_t other_channels : {3u, 4u})
      for (const PixelType type : {PixelType::kUint8, PixelType::kUint16}) {
        CAPTURE(diffuse_channels, other_channels, type);
        const ImagePixels diffuse = random_pixels(diffuse_channels, 1, type),
                          specgloss = random_pixels(other_channels, 2);
        const std::string bytes = container_of(
            {diffuse, specgloss},
            textured(
                kBoth +
                R"(,"diffuseFactor":[0.5,0.25,1,0.50],"specularFactor":[0.9,0.5,0.7],"glossinessFactor":0.75)"));
        const Reread after = reread(bytes);
        const SpanValue core = after.material(0)["pbrMetallicRoughness"];
        CHECK(core["baseColorFactor"].raw() == "[1,1,1,0.50]");
        CHECK(after.image(core["baseColorTexture"]).type == type);
        if (other_channels == 3) {
          CHECK(core["roughnessFactor"].raw() == "0.25");
        }
        require_projected(after, core, diffuse, specgloss, {{0.5, 0.25, 1.0}, {0.9, 0.5, 0.7}, 0.75},
                          0.51 / 255.0 + 1e-4);
        CHECK(require_others_kept(read_container(MemorySource(bytes), "before").json, after.container.json) ==
              1);
        // The binary chunk begins with the same bytes as before, and the private chunk follows it.
        const GltfContainer before = read_container(MemorySource(bytes), "before");
        const std::uint64_t start = before.chunks[0].begin + 8, size = before.chunks[0].end - start;
        CHECK(after.bytes.substr(after.container.chunks[0].begin + 8, size) == bytes.substr(start, size));
        CHECK(after.bytes.ends_with("mine"));
        CHECK(reread(after.bytes).bytes == after.bytes);
      }
}

TEST_CASE("Results are shared by materials with the same images and factors", "[assets]") {
  const Reread after =
      reread(container_of({random_pixels(3, 1), random_pixels(4, 2)},
                          textured(kBoth) + "," + textured(kBoth + R"(,"diffuseFactor":[1.0,1,1,0.5])") +
                              "," + textured(kBoth + R"(,"glossinessFactor":0.5)")));
  CHECK(after.root()["images"].size() == 6);
  CHECK(after.root()["textures"].size() == 6);
  CHECK(after.material(0)["pbrMetallicRoughness"]["baseColorTexture"].raw() == R"({"index":2})");
  CHECK(after.material(1)["pbrMetallicRoughness"]["baseColorTexture"].raw() == R"({"index":2})");
  CHECK(after.material(2)["pbrMetallicRoughness"]["baseColorTexture"].raw() == R"({"index":4})");
  CHECK(after.root()["textures"].children()[2].raw() == R"({"source":2,"sampler":0})");
  CHECK(after.root()["textures"].children()[3].raw() == R"({"source":3,"sampler":1})");
  CHECK(after.root()["images"].children()[3].raw() ==
        R"({"bufferView":4,"mimeType":"image/png","name":"i1_metallicRoughness"})");
}

TEST_CASE("A texture info keeps what it holds", "[assets]") {
  const std::string info =
      R"({ "texCoord":1, "index" : %, "extensions":{"KHR_texture_transform":{"offset":[0.50,0]}}, "extras":1 })";
  const auto with = [&](const std::string& index) {
    return std::string(info).replace(info.find('%'), 1, index);
  };
  const Reread after = reread(container_of(
      {random_pixels(3, 1), random_pixels(4, 2)},
      textured("\"diffuseTexture\":" + with("0") + ",\"specularGlossinessTexture\":" + with("1"))));
  CHECK(after.material(0)["pbrMetallicRoughness"]["baseColorTexture"].raw() == with("2"));
  CHECK(after.material(0)["pbrMetallicRoughness"]["metallicRoughnessTexture"].raw() == with("3"));
}

TEST_CASE("Constant maps are factors", "[assets]") {
  const Reread after =
      reread(container_of({constant_pixels({255, 255, 0, 255}), constant_pixels({58, 58, 58, 51})},
                          textured(kBoth + R"(,"diffuseFactor":[0.5,0.5,0.5,0.5])")));
  CHECK(after.root()["images"].size() == 2);
  const SpanValue core = after.material(0)["pbrMetallicRoughness"];
  CHECK_FALSE(core["baseColorTexture"]);
  CHECK(core["roughnessFactor"].raw() == "0.8");
  CHECK(core["baseColorFactor"].children()[3].raw() == "0.5");
}

TEST_CASE("The diffuse image stays where base color equals it", "[assets]") {
  const Reread after = reread(container_of(
      {random_pixels(4, 1)},
      textured(
          R"("diffuseTexture":{"index":0,"extras":2},"diffuseFactor":[0.5,0.6,0.7,1],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.2)")));
  CHECK(after.root()["images"].size() == 1);
  CHECK(
      after.material(0)["pbrMetallicRoughness"].raw() ==
      R"({"baseColorFactor":[0.5,0.6,0.7,1],"baseColorTexture":{"index":0,"extras":2},"metallicFactor":0,"roughnessFactor":0.8})");
}

TEST_CASE("The exact form makes a map of only roughness", "[assets]") {
  const ImagePixels specgloss = random_pixels(4, 2);
  const Reread after =
      reread(container_of({random_pixels(3, 1), specgloss}, textured(kBoth + R"(,"glossinessFactor":0.5)")),
             kExactOptions);
  const SpanValue core = after.material(0)["pbrMetallicRoughness"];
  CHECK(after.root()["images"].size() == 3);
  CHECK(core["baseColorTexture"].raw() == R"({"index":0})");
  CHECK(after.material(0)["extensions"]["KHR_materials_specular"]["specularColorTexture"].raw() ==
        R"({"index":1})");
  const ImagePixels data = after.image(core["metallicRoughnessTexture"]);
  for (std::size_t i = 0; i < 30; ++i)
    CHECK(value_at(data, i, 1) == Approx(1.0f - 0.5f * value_at(specgloss, i, 3)).margin(0.51 / 255.0));
}

TEST_CASE("Maps that do not lie on one grid fail", "[assets]") {
  const auto failure = [](const std::string& diffuse, const std::string& specgloss) {
    ImagePixels small = random_pixels(4, 3);
    small.height = 4;
    small.bytes.resize(6 * 4 * 4);
    return failures_of(container_of({random_pixels(3, 1), random_pixels(4, 2), small},
                                    textured("\"diffuseTexture\":{" + diffuse +
                                             "},\"specularGlossinessTexture\":{" + specgloss + "}")))
        .front();
  };
  CHECK(failure(R"("index":0,"texCoord":1)", R"("index":1)")
            .find("lies on TEXCOORD_1, its specular glossiness texture on TEXCOORD_0") != std::string::npos);
  CHECK(failure(R"("index":0,"texCoord":1)",
                R"("index":1,"extensions":{"KHR_texture_transform":{"texCoord":1}})")
            .empty());
  CHECK(failure(R"("index":0)", R"("index":1,"extensions":{"KHR_texture_transform":{"rotation":1}})")
            .find("different KHR_texture_transform") != std::string::npos);
  CHECK(failure(R"("index":0)", R"("index":1,"extensions":{"KHR_texture_transform":{"scale":[1,1.0]}})")
            .empty());
  CHECK(failure(R"("index":0)", R"("index":2)") ==
        "its diffuse image has 6x5 texels, its specular glossiness image 6x4 (use --resample, or "
        "--extensions write)");
  CHECK(failure(R"("index":9)", R"("index":1)") ==
        "refers to texture 9, but the file has 3 textures, numbered from 0 (export the file again)");
}

TEST_CASE("Images in files and in URIs stay what they are", "[assets]") {
  PlainResources resources;
  resources.files["a b/wood.jpg"] = file_of(random_pixels(3, 1));
  const std::string data = "data:image/png;charset=x;base64," + base64(file_of(random_pixels(4, 2)));
  const std::string text =
      R"({"asset":{"version":"2.0"},"materials":[)" + textured(kBoth) + "," +
      textured(kBoth + R"(,"glossinessFactor":0.5)") +
      R"(],"textures":[{"source":0},{"source":1}],"images":[{"uri":"a%20b/wood.jpg"},{"uri":")" + data +
      R"("},{"uri":"a%20b/wood_baseColor.png"}]})";
  const AssetConversion conversion = convert_gltf(MemorySource(text), "file", kCoreOptions, &resources);
  REQUIRE(conversion.count(MaterialState::kConverted) == 2);
  REQUIRE(conversion.files.size() == 2);
  CHECK(conversion.files[0].path == "a b/wood_baseColor_2.png");
  CHECK(conversion.files[1].path == "a b/wood_baseColor_3.png");
  CHECK(pixels_of(conversion.files[0].bytes).channels == 3);
  const SpannedJson json(conversion.text, "file");
  CHECK(json.root()["images"].children()[3].raw() ==
        R"({"uri":"a%20b/wood_baseColor_2.png","mimeType":"image/png"})");
  CHECK(json.root()["images"].children()[4]["uri"].raw().starts_with("\"data:image/png;base64,"));
  CHECK(require_others_kept(text, conversion.text) == 2);
}

TEST_CASE("Names of new images have no line breaks", "[assets]") {
  PlainResources resources;
  resources.prefix = "c\nd_";
  resources.files["a\nb.png"] = file_of(random_pixels(3, 1));
  resources.files["b.png"] = file_of(random_pixels(4, 2));
  const std::string text =
      R"({"asset":{"version":"2.0"},"materials":[)" + textured(kBoth) +
      R"(],"textures":[{"source":0},{"source":1}],"images":[{"uri":"a%0Ab.png"},{"uri":"b.png"}]})";
  const AssetConversion result = convert_gltf(MemorySource(text), "file", kCoreOptions, &resources);
  REQUIRE(result.files.size() == 2);
  CHECK(result.files[0].path == "c_d_a_b_baseColor.png");
  CHECK(result.files[1].path == "c_d_b_metallicRoughness.png");
  CHECK(SpannedJson(result.text, "file").root()["images"].children()[2]["uri"].text() ==
        result.files[0].path);
}

TEST_CASE("A material whose image is missing fails, and others go on", "[assets]") {
  PlainResources resources;
  resources.files["b.png"] = "not an image";
  const std::string text =
      R"({"asset":{"version":"2.0"},"materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}},)" +
      textured(R"("diffuseTexture":{"index":0})") + "," + textured(R"("diffuseTexture":{"index":1})") + "," +
      textured(R"("diffuseTexture":{"index":2})") + "," + textured(R"("diffuseTexture":{"index":3})") +
      R"(],"textures":[{"source":0},{"source":1},{"extensions":{"KHR_texture_basisu":{"source":2}}},{}],)"
      R"("images":[{"uri":"a.png"},{"uri":"b.png"},{"uri":"https://example.org/c.ktx2"}]})";
  CHECK(
      failures_of(text, kCoreOptions, resources) ==
      std::vector<std::string>{
          "", "a.png: is not there", "image 1: is no image",
          "https://example.org/c.ktx2: is a remote address (download the file into the folder of the asset)",
          "texture 3 has no image in a known format (export it with PNG or JPEG images)"});
}

TEST_CASE("The best image that can be decoded is taken", "[assets]") {
  const ImagePixels good = random_pixels(4, 1);
  const std::string bytes = container_of({constant_pixels({255, 255, 255}), good},
                                         textured(R"("specularGlossinessTexture":{"index":2})"));
  const Reread after =
      reread(with_json(bytes, R"({"source":1,"sampler":1}])",
                       R"({"source":1},{"source":0,"extensions":{"EXT_texture_webp":{"source":1}}}])"));
  CHECK(after.root()["textures"].children().back().raw() == R"({"source":3})");
  CHECK(after.material(0)["pbrMetallicRoughness"]["metallicRoughnessTexture"]);
}

TEST_CASE("The smaller image of a pair is enlarged on request", "[assets]") {
  ImagePixels small = random_pixels(4, 3);
  small.width = 3;
  small.bytes.resize(3 * 5 * 4);
  const std::string bytes = container_of({random_pixels(3, 1), small}, textured(kBoth));
  const Reread after = reread(bytes, kResampling);
  const ImagePixels data = after.image(after.material(0)["pbrMetallicRoughness"]["metallicRoughnessTexture"]);
  CHECK(data.width == 6);
  for (std::size_t i = 0; i < 30; ++i)
    CHECK(value_at(data, i, 1) == Approx(1.0f - value_at(small, i / 6 * 3 + i % 6 / 2, 3)).margin(0.003));
}

namespace {

// A HugeSource is a container of almost 4 GiB that needs no memory.
class HugeSource final : public ByteSource {
 public:
  explicit HugeSource(std::string start) : start_(std::move(start)) {}
  std::uint64_t size() const override { return 0xfffffff0u; }
  std::string read(std::uint64_t begin, std::size_t count) const override {
    std::string bytes = begin < start_.size() ? start_.substr(begin, count) : "";
    bytes.resize(count, '\0');
    return bytes;
  }

 private:
  std::string start_;
};

}  // namespace

TEST_CASE("A container of 4 GiB cannot be written", "[assets]") {
  std::string json = specgloss_text("{}");
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::string head = "glTF" + four_bytes(2) + four_bytes(0xfffffff0u) + chunk_bytes(kJsonChunk, json);
  const auto binary = static_cast<std::uint32_t>(0xfffffff0u - head.size() - 8);
  const HugeSource source(head + four_bytes(binary) + four_bytes(kBinaryChunk));
  CHECK_THROWS_WITH(convert_gltf(source, "a.glb", kExactOptions),
                    Catch::Contains("a.glb: would have 4294967") &&
                        Catch::Contains("(export the asset as .gltf with a .bin, then convert it)"));
}

namespace {

class NoLibrary final : public AssetResources {
 public:
  std::unique_ptr<ByteSource> open(const std::string& path) const override { throw input_error(path); }
  const ImageCodec& codec() const override { throw numeric_error("the image library was loaded"); }
  ImagePixels enlarged(const ImagePixels& pixels, std::size_t, std::size_t) const override { return pixels; }
};

}  // namespace

TEST_CASE("Materials without textures load no image library", "[assets]") {
  const std::string text = specgloss_text("{}");
  const NoLibrary resources;
  const AssetOptions back = {.target = AssetTarget::kSpecGloss, .compacts = true};
  const std::string core = converted_bytes(text, kCoreOptions, &resources);
  CHECK(core == converted_bytes(text));
  CHECK_NOTHROW(converted_bytes(core, back, &resources));
}
