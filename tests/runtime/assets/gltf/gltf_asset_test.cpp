// This file tests whole glTF files: containers, spec-gloss materials, and what a conversion must not change.
#include "assets/gltf/gltf_asset.hpp"

#include <chrono>
#include <random>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "core/number_text.hpp"
#include "remap/error.hpp"
#include "runtime/assets/gltf_texts.hpp"
#include "support/error_of.hpp"
#include "support/shared_data.hpp"

using namespace remap;

namespace {

AssetConversion result_of(const std::string& text, const AssetOptions& options = {}) {
  return convert_gltf(MemorySource(text), "file", options);
}

std::string asset_failure(const std::string& bytes) {
  return error_of([&] { (void)convert_gltf(MemorySource(bytes), "a.glb"); });
}

// Returns the text of the only material after a conversion.
std::string material_of(const std::string& text, const AssetOptions& options = {}) {
  const std::string json = converted_bytes(text, options);
  return std::string(SpannedJson(json, "file").root()["materials"].children().at(0).raw());
}

}  // namespace

TEST_CASE("Defaults are a white mirror", "[assets]") {
  CHECK(converted_bytes(specgloss_text("{}")) ==
        R"({"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":)"
        R"({"baseColorFactor":[1,1,1,1],"metallicFactor":1,"roughnessFactor":0}}]})");
}

TEST_CASE("A common dielectric keeps the text of its color", "[assets]") {
  CHECK(
      material_of(specgloss_text(
          R"({"diffuseFactor":[0.20,3e-1,0.4,0.50],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.25})")) ==
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.20,3e-1,0.4,0.50],"metallicFactor":0,"roughnessFactor":0.75}})");
}

TEST_CASE("The exact form uses an index of 0", "[assets]") {
  const std::string text = specgloss_text(
      R"({"diffuseFactor":[0.2,0.3,0.4,1],"specularFactor":[0.5,0.25,0.1],"glossinessFactor":1})");
  CHECK(
      converted_bytes(text, kExactOptions) ==
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_specular","KHR_materials_ior"],"materials":)"
      R"([{"extensions":{"KHR_materials_specular":{"specularColorFactor":[0.5,0.25,0.1]},"KHR_materials_ior":{"ior":0}},)"
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.2,0.3,0.4,1],"metallicFactor":0,"roughnessFactor":0}}]})");
  const AssetConversion taken = result_of(specgloss_text("{},\"KHR_materials_ior\":{}"), kExactOptions);
  CHECK(taken.materials[0].failure ==
        "has KHR_materials_ior already, but --extensions write would have to add this extension (convert the "
        "file without --extensions)");
}

TEST_CASE("The fallback goes, and what else it holds stays", "[assets]") {
  const std::string text = specgloss_text(
      R"({"diffuseFactor":[1,1,1,1],"specularFactor":[0.04,0.04,0.04],"extras":{"sg":1,"both":2}})",
      R"(, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "extras": {"both": 1}, "metallicFactor": 0.5, "metallicRoughnessTexture": {"index": 1}})");
  CHECK(
      material_of(text) ==
      R"({"pbrMetallicRoughness": {"extras": {"both": 1,"sg": 1}, "metallicFactor": 0, "baseColorFactor": [1,1,1,1], "roughnessFactor": 0}})");
  const AssetConversion result = result_of(text);
  CHECK(result.materials[0].warnings ==
        std::vector<std::string>{"loses extras.both of KHR_materials_pbrSpecularGlossiness, because "
                                 "pbrMetallicRoughness has the same member"});
  CHECK(
      material_of(specgloss_text(R"({"specularFactor":[1,1,1],"extras":[3.50]})")) ==
      R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":1,"roughnessFactor":0,"extras":[3.50]}})");
}

TEST_CASE("Unlit materials take their diffuse color and texture", "[assets]") {
  CHECK(
      material_of(specgloss_text(
          R"({"diffuseFactor":[1,0,0,1],"diffuseTexture":{"index":2,"extras":1}},"KHR_materials_unlit":{})")) ==
      R"({"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],)"
      R"("baseColorTexture":{"index":2,"extras":1},"metallicFactor":0,"roughnessFactor":0}})");
}

TEST_CASE("What cannot be represented is said", "[assets]") {
  const auto warnings = [](const std::string& text) { return result_of(text).materials.at(0).warnings; };
  const auto failure = [](const std::string& text) { return result_of(text).materials.at(0).failure; };
  CHECK(warnings(specgloss_text(R"({"glossinessFactor":96.08,"specularFactor":[1.5,-1,0.1]})")) ==
        std::vector<std::string>{"specularFactor 1.5 is outside of 0 to 1 and becomes 1",
                                 "specularFactor -1 is outside of 0 to 1 and becomes 0",
                                 "glossinessFactor 96.08 is outside of 0 to 1 and becomes 1"});
  CHECK(warnings(specgloss_text(R"({"extensions":{"ACME":{}},"odd":1},"KHR_materials_clearcoat":{})")) ==
        std::vector<std::string>{"loses extensions (ACME) of KHR_materials_pbrSpecularGlossiness",
                                 "loses odd of KHR_materials_pbrSpecularGlossiness",
                                 "KHR_materials_clearcoat takes effect now, because importers ignore it only "
                                 "in spec-gloss materials"});
  CHECK(failure(specgloss_text(R"({"diffuseFactor":[1,1,1]})")) ==
        "diffuseFactor: expected a list of 4 numbers, found [1,1,1]");
  CHECK(failure(specgloss_text(R"({"glossinessFactor":"a"})")) ==
        "glossinessFactor: expected a number from 0 to 1, found \"a\"");
  CHECK(failure(specgloss_text("7")) == "KHR_materials_pbrSpecularGlossiness: expected an object");
  const std::string mesh =
      R"(,"meshes":[{"primitives":[{"attributes":{"COLOR_0":0},"material":0},{"attributes":{"COLOR_0":0},"extensions":)"
      R"({"KHR_materials_variants":{"mappings":[{"material":0}]}}},{"attributes":{},"material":0}]}]})";
  std::string colored = specgloss_text("{}");
  colored.replace(colored.size() - 1, 1, mesh);
  CHECK(warnings(colored) ==
        std::vector<std::string>{"vertex colors of 2 primitives tinted its diffuse color and now "
                                 "tint its reflection, too"});
}

TEST_CASE("A failed material keeps the extension in its lists", "[assets]") {
  const std::string text =
      R"({"asset":{"version":"2.0"},"extensionsRequired":["A","KHR_materials_pbrSpecularGlossiness"],"extensionsUsed":)"
      R"(["A","KHR_materials_pbrSpecularGlossiness"],"materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}},)"
      R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}}],"animations":[{"channels":[{"target":{"extensions":)"
      R"({"KHR_animation_pointer":{"pointer":"/materials/1/extensions/KHR_materials_pbrSpecularGlossiness/glossinessFactor"}}}}]}]})";
  const AssetConversion result = result_of(text);
  CHECK(result.count(MaterialState::kConverted) == 1);
  CHECK(result.materials[1].failure ==
        "an animation (KHR_animation_pointer) changes a value that this conversion replaces (remove this "
        "channel of the animation)");
  CHECK(result.text.find(R"("extensionsRequired":["A","KHR_materials_pbrSpecularGlossiness"])") !=
        std::string::npos);
  CHECK(result.warnings ==
        std::vector<std::string>{"requires A, which texremap does not know: texremap keeps this extension, "
                                 "but it may not match the converted materials"});
}

TEST_CASE("A file without spec-gloss does not change", "[assets]") {
  const std::string text =
      R"({"asset":{"version":"2.0"}, "materials":[{"x": 1.0e+2}],"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"]})";
  CHECK_FALSE(result_of(text).changed);
  CHECK(convert_gltf(MemorySource(text), "file").pieces.empty());
}

TEST_CASE("Containers keep their chunks", "[assets]") {
  const std::string binary = chunk_bytes(kBinaryChunk, "abcd"), own = chunk_bytes(0x12345678, "private!");
  const std::string bytes = glb_bytes(specgloss_text("{ }"), binary + own, '\0');
  const std::string converted = converted_bytes(bytes);
  CHECK(converted == glb_bytes(converted_bytes(specgloss_text("{}")), binary + own));
  CHECK(converted_bytes(converted) == converted);
  CHECK(convert_gltf(MemorySource(bytes), "a").warnings ==
        std::vector<std::string>{"the JSON is padded with zeros, but glTF requires spaces"});
}

TEST_CASE("Damaged containers are refused", "[assets]") {
  const std::string good = glb_bytes(specgloss_text("{}"), chunk_bytes(kBinaryChunk, "abcd"));
  for (std::size_t size = 4; size < good.size(); ++size) {
    CAPTURE(size);
    CHECK(asset_failure(good.substr(0, size)).find("cut off") != std::string::npos);
  }
  const auto with = [&](std::size_t place, const std::string& bytes) {
    return asset_failure(std::string(good).replace(place, 4, bytes));
  };
  CHECK_THAT(
      with(12, four_bytes(0xfffffff0)),
      Catch::StartsWith("a.glb: the chunk at byte 12 should have 4294967280 bytes, but the file ends"));
  CHECK(with(4, four_bytes(1)) == "a.glb: is a GLB file of version 1, but only version 2 can be read");
  CHECK(with(16, "BIN ") == "a.glb: its first chunk is not JSON (the file is damaged; export it again)");
  CHECK(asset_failure("glTF" + four_bytes(2) + four_bytes(12)) ==
        "a.glb: has no JSON chunk (the file is damaged; export it again)");
  CHECK(asset_failure("{}") == "a.glb: is not a glTF file, because it has no asset.version");
  CHECK(asset_failure(R"({"asset":{"version":"1.0"}})") ==
        "a.glb: is glTF 1.0, but only glTF 2 can be read (convert it to glTF 2 first)");
  CHECK(asset_failure(R"({"asset":{"version":"2.0"},"materials":{}})") ==
        "a.glb: materials: expected a list");
}

TEST_CASE("Views beyond their buffers are refused", "[assets]") {
  const auto with = [](const std::string& members) {
    return R"({"asset":{"version":"2.0"},)" + members + "}";
  };
  CHECK(asset_failure(with(
            R"("buffers":[{"byteLength":4}],"bufferViews":[{"buffer":0,"byteOffset":1,"byteLength":4}])")) ==
        "a.glb: /bufferViews/0: ends at byte 5 of buffer 0, but the buffer has only 4 bytes");
  CHECK(asset_failure(with(R"("buffers":[{"byteLength":4},{}])")) ==
        "a.glb: /buffers/1: byteLength is not an integer (export the file again)");
  CHECK(asset_failure(with(R"("bufferViews":[{"buffer":3,"byteLength":4}])")) ==
        "a.glb: /bufferViews/0: refers to buffer 3, but the file has 0 buffers, numbered from 0 (export the "
        "file again)");
  CHECK(asset_failure(with(R"("buffers":[{"byteLength":4}],"bufferViews":[{"buffer":0,"byteLength":-4}])")) ==
        "a.glb: /bufferViews/0: buffer, byteOffset and byteLength must be integers (export the file again)");
  CHECK(
      asset_failure(glb_bytes(with(R"("buffers":[{"byteLength":8}])"), chunk_bytes(kBinaryChunk, "abcd"))) ==
      "a.glb: /buffers/0 has 8 bytes, but the binary chunk has 4");
}

TEST_CASE("URIs are sorted by where they lead", "[assets]") {
  CHECK(uri_kind("a%20b/c.png") == UriKind::kFile);
  CHECK(uri_kind("data:image/png;base64,AA==") == UriKind::kData);
  CHECK(uri_kind("DATA:,x") == UriKind::kData);
  CHECK(uri_kind("https://example.org/a.png") == UriKind::kRemote);
  CHECK(percent_decoded("a%20b%2") == "a b%2");
  CHECK(percent_decoded(percent_encoded("a b/%~\xc3\xa4")) == "a b/%~\xc3\xa4");
  CHECK(percent_encoded("a b-1.png") == "a%20b-1.png");
  for (const char* uri : {"../a.png", "a/../../b", "%2e%2e/a", "..\\a"})
    CHECK(uri_kind(uri) == UriKind::kFile);
  for (const char* uri : {"/a.png", "%2Fa.png", "C:\\a.png", "file:///a", "a%00"}) {
    CAPTURE(uri);
    CHECK(uri_kind(uri) == UriKind::kAbsolute);
  }
}

TEST_CASE("A hundred thousand materials take a moment", "[assets][slow]") {
  std::string text =
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],"materials":[)";
  constexpr std::size_t kCount = 100000;
  for (std::size_t i = 0; i < kCount; ++i)
    text += std::string(i == 0 ? "" : ",") + R"({"name":"m)" + std::to_string(i) +
            R"(","extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.5}}})";
  text += "],\"images\":[";
  for (std::size_t i = 0; i < kCount; ++i)
    text += std::string(i == 0 ? "" : ",") + R"({"uri":")" + std::to_string(i) + ".png\"}";
  const auto start = std::chrono::steady_clock::now();
  CHECK(result_of(text + "]}").count(MaterialState::kConverted) == kCount);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
}

namespace {

// A RandomText writes random JSON in unusual formatting.
class RandomText {
 public:
  explicit RandomText(std::uint32_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(random_() % count); }
  bool often(std::uint32_t percent) { return below(100) < percent; }
  std::string space() {
    std::string text;
    for (std::uint32_t i = often(60) ? 0 : below(4); i > 0; --i) text += " \n\t\r"[below(4)];
    return text;
  }
  std::string number() {
    static const char* const numbers[] = {
        "0", "-0.0", "1.50", "1e-3", "5E-1", "9007199254740993", "1E400", "12345678901234567890", "-7"};
    return numbers[below(9)];
  }
  std::string word() {
    static const char* const words[] = {
        "\"a\"", "\"\\u00e9\\/\"", "\"\\\"}\"", "\"\xc3\xa9\"", "\"\\ud83d\\ude00\"", "\"\"", "\"k,]\""};
    return words[below(7)];
  }
  std::string value(int depth) {
    const std::uint32_t kind = below(depth > 0 ? 8 : 5);
    if (kind < 2) return number();
    if (kind < 3) return word();
    if (kind < 5) return std::array{"true", "false", "null"}[below(3)];
    std::vector<std::pair<std::string, std::string>> members;
    for (std::uint32_t i = below(4); i > 0; --i)
      members.emplace_back(kind == 5 ? "" : word(), value(depth - 1));
    return kind == 5 ? list(members) : object(members);
  }
  std::string object(const std::vector<std::pair<std::string, std::string>>& members) {
    std::string text = "{" + space();
    for (std::size_t i = 0; i < members.size(); ++i)
      text += (i == 0 ? "" : "," + space()) + members[i].first + space() + ":" + space() + members[i].second +
              space();
    return text + "}";
  }
  std::string list(const std::vector<std::pair<std::string, std::string>>& entries) {
    std::string text = "[" + space();
    for (std::size_t i = 0; i < entries.size(); ++i)
      text += (i == 0 ? "" : "," + space()) + entries[i].second + space();
    return text + "]";
  }
  void shuffle(std::vector<std::pair<std::string, std::string>>& members) {
    std::shuffle(members.begin(), members.end(), random_);
  }
  std::string factor() { return number_text(rounded(below(1001) / 1000.0, 3)); }

 private:
  std::mt19937 random_;
};

using RandomMembers = std::vector<std::pair<std::string, std::string>>;

std::string random_specgloss(RandomText& random) {
  RandomMembers members;
  const auto factors = [&](int count) {
    RandomMembers entries;
    for (; count > 0; --count) entries.emplace_back("", random.factor());
    return random.list(entries);
  };
  if (random.often(70)) members.emplace_back("\"diffuseFactor\"", factors(4));
  if (random.often(70)) members.emplace_back("\"specularFactor\"", factors(3));
  if (random.often(70)) members.emplace_back("\"glossiness\\u0046actor\"", random.factor());
  if (random.often(30)) members.emplace_back("\"extras\"", random.value(2));
  random.shuffle(members);
  return random.object(members);
}

// With `has_dielectrics`, some materials have KHR_materials_specular and _ior.
std::string random_material(RandomText& random, bool has_dielectrics) {
  RandomMembers members, extensions;
  if (random.often(50)) members.emplace_back("\"name\"", random.word());
  if (random.often(40)) members.emplace_back("\"extras\"", random.value(3));
  if (random.often(30)) members.emplace_back("\"alphaMode\"", "\"BLEND\"");
  if (random.often(70))
    extensions.emplace_back("\"KHR_materials_pbrSpecularGlossiness\"", random_specgloss(random));
  if (random.often(30)) extensions.emplace_back("\"ACME_x\"", random.value(2));
  if (random.often(20)) extensions.emplace_back("\"KHR_materials_unlit\"", "{}");
  if (has_dielectrics && random.often(30))
    extensions.emplace_back("\"KHR_materials_ior\"", random.often(50) ? "{}" : "{\"ior\" : 1.330}");
  if (has_dielectrics && random.often(30))
    extensions.emplace_back("\"KHR_materials_specular\"", "{ \"specularColorFactor\": [1.0, 2.5, 0] }");
  random.shuffle(extensions);
  if (!extensions.empty()) members.emplace_back("\"extensions\"", random.object(extensions));
  if (random.often(40)) {
    RandomMembers core;
    if (random.often(50)) core.emplace_back("\"extras\"", random.value(2));
    if (random.often(50)) core.emplace_back("\"metallicFactor\"", "0.30");
    if (random.often(50)) core.emplace_back("\"baseColorTexture\"", "{\"index\": 0}");
    random.shuffle(core);
    members.emplace_back("\"pbrMetallicRoughness\"", random.object(core));
  }
  random.shuffle(members);
  return random.object(members);
}

std::string random_gltf(RandomText& random, bool has_dielectrics = false) {
  RandomMembers members = {{"\"asset\"", "{\"version\":\"2.0\",\"x\":" + random.value(2) + "}"}}, materials;
  for (std::uint32_t i = random.below(6); i > 0; --i)
    materials.emplace_back("", random_material(random, has_dielectrics));
  members.emplace_back("\"materials\"", random.list(materials));
  RandomMembers used = {{"", "\"KHR_materials_pbrSpecularGlossiness\""}};
  if (random.often(50)) used.emplace_back("", "\"ACME_x\"");
  random.shuffle(used);
  members.emplace_back("\"extensionsUsed\"", random.list(used));
  if (random.often(50)) members.emplace_back("\"extensionsRequired\"", random.list(used));
  for (const char* key : {"\"nodes\"", "\"extras\"", "\"ex\\u0074ensions\"", "\"unknown\""})
    if (random.often(50)) members.emplace_back(key, random.value(4));
  random.shuffle(members);
  return (random.often(20) ? "\xef\xbb\xbf" : "") + random.space() + random.object(members) + random.space();
}

std::string json_in(const std::string& bytes) { return read_container(MemorySource(bytes), "file").json; }

}  // namespace

TEST_CASE("Random files keep every byte outside of converted materials, in every direction", "[assets]") {
  const PlainResources resources;
  std::size_t converted = 0;
  for (std::uint32_t seed = 0; seed < 600; ++seed)
    for (const AssetOptions& options : {kCoreOptions, kExactOptions, kToSpecGloss, kFolding, kCompacting}) {
      RandomText random(seed);
      const bool has_dielectrics = !options.writes_extensions() && seed % 2 == 0;
      const std::string text = random_gltf(random, has_dielectrics);
      const std::string bytes =
          random.often(50) ? text
                           : glb_bytes(text, chunk_bytes(kBinaryChunk, "abcd") + chunk_bytes(7, "1234"));
      CAPTURE(seed, text, static_cast<int>(options.target), static_cast<int>(options.extensions));
      const AssetConversion result = convert_gltf(MemorySource(bytes), "file", options, &resources);
      const std::string after = converted_bytes(bytes, options, &resources);
      REQUIRE(require_others_kept(json_in(bytes), json_in(after), options) ==
              result.count(MaterialState::kConverted));
      if (!has_dielectrics && options.target == AssetTarget::kMetalRough) {
        REQUIRE(result.count(MaterialState::kFailed) == 0);
        REQUIRE(after.find(kSpecGlossExtension) ==
                (result.changed ? std::string::npos : bytes.find(kSpecGlossExtension)));
      }
      REQUIRE(converted_bytes(after, options, &resources) == after);
      converted += result.count(MaterialState::kConverted);
    }
  CHECK(converted > 3000);
}

TEST_CASE("Public files keep every byte outside of converted materials", "[assets][needs]") {
  const std::filesystem::path folder = shared_data("assets");
  if (folder.empty()) return;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
    CAPTURE(entry.path());
    const std::string bytes = read_file(entry.path());
    for (const AssetOptions& options : {AssetOptions(), kToSpecGloss, kFolding}) {
      const std::string after = converted_bytes(bytes, options);
      const AssetConversion result = result_of(bytes, options);  // tests/cli converts files with images
      CHECK(require_others_kept(json_in(bytes), json_in(after), options) ==
            result.count(MaterialState::kConverted));
      CHECK(converted_bytes(after, options) == after);
    }
    ++files;
  }
  CHECK(files > 35);
}

TEST_CASE("The torture file keeps extras, names, unknown extensions and its own chunk", "[assets][needs]") {
  const std::filesystem::path file = shared_data("assets/made/torture.glb");
  if (file.empty()) return;
  const std::string bytes = read_file(file), after = converted_bytes(bytes);
  // Returns the numbers of extras, names and unknown extensions.
  const auto counts = [](const std::string& json) {
    const SpannedJson spans(json, "file");
    std::array<std::size_t, 3> found{};
    for (std::size_t i = 0; i < spans.value_count(); ++i) {
      found[0] += spans.value(i).has_key("extras");
      found[1] += spans.value(i).has_key("name");
      found[2] += spans.value(i).key().starts_with("ACME_");
    }
    return found;
  };
  CHECK(counts(json_in(bytes))[0] == 36);
  CHECK(counts(json_in(after)) == counts(json_in(bytes)));
  const GltfContainer before = read_container(MemorySource(bytes), "before"),
                      result = read_container(MemorySource(after), "after");
  REQUIRE(before.chunks.size() == 2);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(bytes.substr(before.chunks[i].begin, before.chunks[i].end - before.chunks[i].begin) ==
          after.substr(result.chunks[i].begin, result.chunks[i].end - result.chunks[i].begin));
}
