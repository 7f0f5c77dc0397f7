// This file tests cases that users reported, each with the correct result.
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

class ReportSession : public Session {
 public:
  // Writes an image of 32x32 texels of 8 bits. Channels without a value are noise.
  void drawn(const std::string& name, const Names& channels, const std::map<int, float>& values = {},
             const OIIO::ParamValueList& tags = {}) const {
    OIIO::ImageSpec spec = test_spec(32, 32, channels, OIIO::TypeUInt8);
    for (const OIIO::ParamValue& tag : tags) spec.attribute(std::string(tag.name()), tag.type(), tag.data());
    make(name, spec, [&](int x, int y, int c) { return values.contains(c) ? values.at(c) : noise(x, y, c); });
  }
  // Writes a file with one material, whose textures are the images in their order.
  void gltf(const std::string& name, const std::string& material, const std::string& textures,
            const std::string& images) const {
    put(name, R"({"asset":{"version":"2.0"},"materials":[{"name":"m",)" + material + R"(}],"textures":[)" +
                  textures + R"(],"images":[)" + images + "]}");
  }
  // Returns `rule confidence` for each finding.
  std::vector<std::string> findings(const std::string& paths) const {
    const ProcessResult run = texremap("check " + paths + " --json --quiet --fail-on possible");
    INFO(run.errors);
    const nlohmann::json report = nlohmann::json::parse(run.output);
    CHECK(run.exit_code == (report["findings"].empty() && report["problems"].empty() ? 0 : 1));
    std::vector<std::string> found;
    for (const nlohmann::json& finding : report["findings"])
      found.push_back(finding["rule"].get<std::string>() + " " + finding["confidence"].get<std::string>());
    for (const nlohmann::json& problem : report["problems"])
      found.push_back("not read: " + problem.get<std::string>());
    return found;
  }
};

using Found = std::vector<std::string>;
const std::string kNotMetal = R"("pbrMetallicRoughness":{"metallicFactor":0)";

}  // namespace

TEST_CASE("reports: 04 check looks at the image of a texture that convert reads", "[slow]") {
  const ReportSession session;
  const auto normals = [](int x, int, int c) {
    return c == 2 ? 1.0f : 0.5f + 0.1f * (static_cast<float>(x) / 31.0f - 0.5f) * (c == 0 ? 1.0f : -1.0f);
  };
  for (const std::string extension : {"png", "webp"})
    session.map("n." + extension, kColor, normals, OIIO::TypeUInt8, 32);
  // OpenImageIO changes the colors of a WebP with alpha, so sets refuse it. Conversions of assets read it
  // correctly.
  const auto faded = [&](int x, int y, int c) { return c < 3 ? normals(x, y, c) : x + y == 0 ? 0.5f : 1.0f; };
  session.map("alpha.webp", kWithAlpha, faded, OIIO::TypeUInt8, 32);
  session.put("n.ktx2", "\xabKTX 20\xbb\r\n\x1a\n and no more");
  const std::string material = kNotMetal + R"(,"baseColorTexture":{"index":0}})";
  const Found wrong = {"wrong-texture likely"};
  session.gltf("png.gltf", material, R"({"source":0})", R"({"uri":"n.png"})");
  CHECK(session.findings("png.gltf") == wrong);
  for (const std::string image : {"n.webp", "alpha.webp"}) {
    session.gltf("webp.gltf", material, R"({"extensions":{"EXT_texture_webp":{"source":0}}})",
                 R"({"uri":")" + image + "\"}");
    CHECK(session.findings("webp.gltf") == wrong);
  }
  // If an image cannot be read, another image of the texture is used.
  session.gltf("both.gltf", material, R"({"source":1,"extensions":{"KHR_texture_basisu":{"source":0}}})",
               R"({"uri":"n.ktx2"},{"uri":"n.png"})");
  CHECK(session.findings("both.gltf") == wrong);
  session.gltf("ktx.gltf", material, R"({"extensions":{"KHR_texture_basisu":{"source":0}}})",
               R"({"uri":"n.ktx2"})");
  REQUIRE(session.findings("ktx.gltf").size() == 1);
  CHECK(session.findings("ktx.gltf").front().starts_with("not read: n.ktx2: "));
  session.gltf("other.gltf", material, R"({"extensions":{"VENDOR_texture_new":{"source":0}}})",
               R"({"uri":"n.new"})");
  CHECK(session.findings("other.gltf") ==
        Found{"not read: other.gltf: material \"m\": texture 0 has no image in a known format (export it "
              "with PNG or JPEG images)"});
}

TEST_CASE("reports: 05 what a factor of 0 turns off cannot be wrong", "[slow]") {
  const ReportSession session;
  session.drawn("c.png", kColor);
  session.drawn("y.png", kGrey);
  const auto found = [&](const std::string& image, const std::string& material,
                         const std::string& more = "") {
    session.gltf("a.gltf", material, R"({"source":0})", R"({"uri":")" + image + "\"}");
    return session.findings("a.gltf" + more);
  };
  for (const std::string image : {"c.png", "y.png"})
    CHECK(found(image, kNotMetal + R"(,"metallicRoughnessTexture":{"index":0}})") == Found{});
  CHECK(found("c.png", R"("normalTexture":{"index":0,"scale":0})") == Found{});
  CHECK(found("c.png", R"("occlusionTexture":{"index":0,"strength":0})") == Found{});
  CHECK(found("c.png", R"("emissiveFactor":[0,0,0],"emissiveTexture":{"index":0})") == Found{});
  for (const std::string off :
       {R"("KHR_materials_clearcoat":{"clearcoatFactor":0,"clearcoatTexture":{"index":0}})",
        R"("KHR_materials_clearcoat":{"clearcoatRoughnessTexture":{"index":0}})",
        R"("KHR_materials_sheen":{"sheenColorFactor":[0,0,0],"sheenRoughnessTexture":{"index":0}})",
        R"("KHR_materials_transmission":{"transmissionFactor":0,"transmissionTexture":{"index":0}})",
        R"("KHR_materials_specular":{"specularFactor":1,"specularColorFactor":[1,1,1]})",
        R"("KHR_materials_ior":{"ior":1.5})", R"("KHR_materials_volume":{"thicknessFactor":1})"})
    CHECK(found("c.png", kNotMetal + R"(},"extensions":{)" + off + "}", " --for gltf") == Found{});
  // Programs read only the base color of an unlit material.
  CHECK(found("c.png", R"("normalTexture":{"index":0},"extensions":{"KHR_materials_unlit":{}})") == Found{});

  // If a factor of 0 hides a texture by mistake, this is still a finding.
  CHECK(found("c.png", R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0,)"
                       R"("metallicRoughnessTexture":{"index":0}})") == Found{"factor-zero certain"});
  CHECK(found("c.png", R"("emissiveTexture":{"index":0})") == Found{"factor-zero possible"});
  const std::string color = kNotMetal + R"(,"baseColorTexture":{"index":0}},"occlusionTexture":{"index":0)";
  CHECK(found("c.png", color + R"(,"strength":0})") == Found{});
  CHECK(found("c.png", color + "}") == Found{"wrong-texture certain"});
  // Unity reads blue even if the factor is 0.
  CHECK(found("c.png", kNotMetal + R"(,"metallicRoughnessTexture":{"index":0}})", " --for unity") ==
        Found{"factor-ignored likely"});
}

TEST_CASE("reports: 05 what a material of MTL does not show cannot be wrong") {
  const ReportSession session;
  session.put("off.mtl", "newmtl a\nKs 0 0 0\nNs 0.5\nnewmtl b\nKs 1 1 1\nillum 1\nNs 0.7\n");
  CHECK(session.findings("off.mtl") == Found{});
  session.put("on.mtl", "newmtl a\nKs 1 1 1\nNs 0.5\nnewmtl b\nKs 1 1 1\nillum 2\nNs 0.7\n");
  CHECK(session.findings("on.mtl") == Found{"exponent-range likely"});
}

TEST_CASE("reports: 06 formats without a place for a color space have no tag", "[slow]") {
  const ReportSession session;
  OIIO::ParamValueList srgb;
  srgb.attribute("oiio:ColorSpace", "sRGB");
  for (const std::string extension : {"webp", "tga", "bmp", "jpg", "tif", "exr"}) {
    const bool is_tagged = extension == "jpg" || extension == "tif";  // their Exif data has a color space
    for (const std::string role : {"Roughness", "Metallic", "Normal", "AO"}) {
      session.drawn(extension + "/a_" + role + "." + extension, kColor, {{2, 0.99f}}, srgb);
      session.drawn(extension + "_plain/a_" + role + "." + extension, kColor, {{2, 0.99f}});
    }
    const Found found = session.findings(extension + " --ignore metallic-greys,wrong-texture,duplicate-map");
    CHECK(found == (is_tagged ? Found(4, "srgb-data likely") : Found{}));
    CHECK(session.findings(extension + "_plain --ignore metallic-greys,wrong-texture,duplicate-map") ==
          Found{});
  }
}

// texremap_advice_test.cpp runs the command of every rule.
TEST_CASE("reports: 09 the command for an asset converts it") {
  const ReportSession session;
  const auto advice = [&](const std::string& extension, const std::string& reader) {
    session.put("in/a.gltf", R"({"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":)"
                             R"({"metallicFactor":0},"extensions":{)" +
                                 extension + "}}]}");
    const ProcessResult run = session.texremap("check in/a.gltf --json --quiet --for " + reader);
    CHECK(run.exit_code == 1);
    return nlohmann::json::parse(run.output)["findings"].back()["command"].get<std::string>();
  };
  CHECK(advice(R"("KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.6})", "threejs") ==
        "texremap convert in/a.gltf --to gltf -o fixed");
  CHECK(advice(R"("KHR_materials_specular":{"specularColorFactor":[1.5,1.5,1.5]})", "godot") ==
        "texremap convert in/a.gltf --to gltf --extensions fold -o fixed");
}

TEST_CASE("reports: 12 channels of one packed map are no duplicates") {
  const ReportSession session;
  session.drawn("orm.png", kColor, {{0, 1.0f}});
  session.drawn("grey.png", kGrey);
  session.drawn("leaf.png", kWithAlpha);
  const auto found = [&](const std::string& lines) {
    session.put("a.mtl", "newmtl a\nKd 1 1 1\n" + lines);
    return session.findings("a.mtl --ignore metallic-greys");
  };
  CHECK(found("map_Pr -imfchan g orm.png\nmap_Pm -imfchan b orm.png\n") == Found{});
  CHECK(found("map_Kd leaf.png\nmap_d leaf.png\n") == Found{});
  CHECK(found("map_Pr -imfchan g orm.png\nmap_Pm -imfchan g orm.png\n") == Found{"duplicate-map likely"});
  CHECK(found("map_Pr grey.png\nmap_Pm grey.png\n") == Found{"duplicate-map likely"});
}

TEST_CASE("reports: 17 a number replaces a map only if all its tiles and channels are that number",
          "[slow]") {
  const ReportSession session;
  const auto tile = [&](const std::string& name, float value) {
    session.drawn(name, kColor, {{0, value}, {1, value}, {2, value}});
  };
  for (const std::string role : {"BaseColor", "Roughness"}) {
    tile("two/a_" + role + ".1001.png", 0.25f);
    tile("two/a_" + role + ".1002.png", 0.75f);
    tile("one/a_" + role + ".1001.png", 0.25f);
    tile("one/a_" + role + ".1002.png", 0.25f);
    tile("map/a_" + role + ".png", 0.25f);
  }
  CHECK(session.findings("two") == Found{});
  CHECK(session.findings("one") == Found{"constant-map possible", "constant-map possible"});
  CHECK(session.findings("map") == Found{"constant-map certain", "constant-map certain"});
  // A packed map is needed for its other channels, even if one is constant.
  session.drawn("packed/a_ORM.png", kColor, {{1, 0.5f}, {2, 0.0f}});
  CHECK(session.findings("packed --ignore channel-order") == Found{});
  // Tiles may differ in size, but the maps of one tile may not.
  session.map("sizes/a_Roughness.1001.png", kGrey, OIIO::TypeUInt8, 32);
  session.map("sizes/a_Roughness.1002.png", kGrey, OIIO::TypeUInt8, 16);
  CHECK(session.findings("sizes") == Found{});
  for (const char* name : {"sizes/a_Height.1001.png", "sizes/a_Height.1002.png"})
    session.map(name, kGrey, OIIO::TypeUInt8, 32);
  CHECK(session.findings("sizes --ignore duplicate-map") == Found{"sizes likely"});
}

TEST_CASE("reports: 18 metal has no reflectance but its base color") {
  const ReportSession session;
  const auto found = [&](const std::string& metallic, const std::string& extension) {
    session.put("a.gltf", R"({"asset":{"version":"2.0"},"materials":[{"pbrMetallicRoughness":{)" + metallic +
                              R"(},"extensions":{)" + extension + "}}]}");
    return session.findings("a.gltf --for gltf");
  };
  for (const std::string extension :
       {R"("KHR_materials_specular":{"specularFactor":0.5})", R"("KHR_materials_ior":{"ior":1000})",
        R"("KHR_materials_transmission":{"transmissionFactor":1})"}) {
    CHECK(found("", extension) == Found{});  // metallic is 1 by default
    CHECK(found(R"("metallicFactor":1)", extension) == Found{});
    CHECK_FALSE(found(R"("metallicFactor":0)", extension).empty());
  }
}

TEST_CASE("reports: check fails on certain findings, or on others by --fail-on") {
  const ReportSession session;
  session.drawn("set/a_Metallic.png", kGrey, {{0, 0.5f}});  // a possible finding
  CHECK(session.texremap("check set").exit_code == 0);
  CHECK(session.texremap("check set").output.find("[metallic-greys, possible]") != std::string::npos);
  CHECK(session.texremap("check set").errors.find("1 finding, none of which is certain") !=
        std::string::npos);
  CHECK(session.texremap("check set --fail-on likely").exit_code == 0);
  CHECK(session.texremap("check set --fail-on possible").exit_code == 1);
  session.drawn("set/a_Roughness.png", kGrey, {{0, 0.5f}});  // a certain finding
  CHECK(session.texremap("check set").exit_code == 1);
  CHECK(session.texremap("check set --fail-on never").exit_code == 2);
}

TEST_CASE("reports: an asset is converted with as few words as people type", "[slow]") {
  const ReportSession session;
  session.drawn("d.png", kColor);
  session.drawn("s.png", kWithAlpha);
  session.gltf("in.gltf",
               R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},)"
               R"("specularGlossinessTexture":{"index":1}}})",
               R"({"source":0},{"source":1})", R"({"uri":"d.png"},{"uri":"s.png"})");
  const ProcessResult two = session.texremap("convert in.gltf new/out.gltf");
  INFO(two.errors);
  REQUIRE(two.exit_code == 0);
  const nlohmann::json made = nlohmann::json::parse(session.content("new/out.gltf"));
  CHECK(made["materials"][0].contains("pbrMetallicRoughness"));
  // Only the images that converted materials used are removed.
  CHECK(made["images"].size() == 2);
  CHECK_FALSE(session.exists("new/s.png"));
  const ProcessResult again = session.texremap("convert in.gltf new/out.gltf");
  CHECK(again.exit_code != 0);
  CHECK_THAT(again.errors, Catch::Matchers::Contains("already exists (--force overwrites)"));
  for (const std::string word : {"metal-rough", "glb", "core", "gltf"})
    require_success(session.texremap("convert in.gltf --to " + word + " -o by_" + word));
  require_success(session.texremap("convert in.gltf --keep-unused -o kept"));
  CHECK(nlohmann::json::parse(session.content("kept/in.gltf"))["images"].size() == 4);
  CHECK(session.texremap("convert in.gltf").exit_code == 2);
}

namespace {

// A ReportedSets is a folder of sets for one report.
class ReportedSets : public Session {
 public:
  // Writes a map of one color, in steps of 8 bits.
  void plain(const std::string& name, const std::vector<int>& values, int size = 16) const {
    std::vector<float> shares;
    for (const int value : values) shares.push_back(static_cast<float>(value) / 255.0f);
    flat(name, shares, OIIO::TypeUInt8, size);
  }
};

}  // namespace

TEST_CASE("reports: 13 rough_ao of Poly Haven", "[reports][slow]") {
  const ReportedSets sets;
  sets.plain("in/textures/old_bench_diff_1k.jpg", {120, 80, 40});
  sets.plain("in/textures/old_bench_nor_1k.jpg", {128, 128, 255});
  sets.plain("in/textures/old_bench_rough_ao_1k.png", {200, 180, 0});
  const std::string packed = "out/textures/old_bench_occlusionRoughnessMetallic.png";
  SECTION("alone") {
    require_success(
        sets.texremap("convert in -r --from polyhaven --to gltf --layout gltf --metallic 0 -o out"));
    CHECK(sets.texel(packed) == std::vector{180, 200, 0});
  }
  SECTION("beside arm, which contains more of the material") {
    sets.plain("in/textures/old_bench_arm_1k.png", {190, 210, 255});
    const ProcessResult result =
        require_success(sets.texremap("convert in -r --from polyhaven --to gltf --layout gltf -o out"));
    CHECK(sets.texel(packed) == std::vector{190, 210, 255});
    CHECK_THAT(result.errors, Contains("roughness is read from old_bench_arm_1k.png:G"));
  }
}

TEST_CASE("reports: 19 a nearly grey roughness map", "[reports][slow]") {
  const ReportedSets sets;
  const int tint = GENERATE(5, 18);
  const std::string extension = GENERATE("png", "jpg"), map = "in/sand_rough." + extension;
  sets.plain("in/sand_albedo.png", {120, 80, 40}, 32);
  const auto draw = [&](const std::function<int(int)>& red) {
    const auto step = [&](int x, int, int c) {
      return static_cast<float>(100 + (c == 0 ? red(x) : 0)) / 255.0f;
    };
    sets.map(map, kColor, step, OIIO::TypeUInt8, 32);
  };
  draw([&](int x) { return x >= 16 ? tint : 0; });
  const Words words = "convert in --from metal-rough --to gltf --layout gltf --metallic 0 -o out";
  const ProcessResult result = require_success(sets.texremap(words));
  CHECK_THAT(result.errors,
             Contains("warning: " + map +
                      ": is not exactly grey: the channels differ from G, which is used, by at most "));
  if (extension == "png")
    CHECK_THAT(result.errors, Contains("by at most " + std::to_string(tint) + " of 255"));
  CHECK(std::abs(sets.texel("out/sand_occlusionRoughnessMetallic.png")[1] - 100) <=
        (extension == "png" ? 0 : 3));

  // A map with different colors is refused, and the message proposes an option that works.
  draw([](int x) { return 4 * x; });
  const ProcessResult refused = sets.texremap(words + "--force");
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.errors, Contains("(choose one channel: --roughness '*_rough." + extension + ":G')"));
  require_success(sets.texremap(words + ("--force --roughness *_rough." + extension + ":R")));
}

TEST_CASE("reports: one map for several sets of a folder", "[reports][slow]") {
  const ReportedSets sets;
  for (const std::string name : {"black", "white"}) {
    sets.plain("in/king_" + name + "_roughness.png", {90});
    sets.plain("in/king_" + name + "_baseColor.png", {120, 80, 40});
  }
  sets.plain("in/king_shared_metallic.png", {255});
  const ProcessResult result = require_success(sets.texremap(
      "convert in --from metallic --to gltf --layout gltf --metallic in/king_shared_metallic.png -o out"));
  CHECK_THAT(result.errors, Contains("note: in/king_shared_metallic.png is used for all sets"));
  for (const std::string name : {"black", "white"})
    CHECK(sets.texel("out/king_" + name + "_occlusionRoughnessMetallic.png") == std::vector{255, 90, 255});
  // A name without * is also searched in the folder of each set's maps.
  require_success(
      sets.texremap("convert in --from metallic --to gltf --metallic king_shared_metallic.png -o two"));
  CHECK(sets.texremap("convert in --from metallic --to gltf --metallic nothing.png -o three").exit_code == 1);
}

namespace {

// A Green is the direction of green that an engine reads: up, down, or as in the input.
enum class Green { kUp, kDown, kKept };
constexpr const char* kEngines[] = {"gltf",    "unity",   "unity-hdrp", "unreal",  "godot",
                                    "threejs", "blender", "usd",        "marmoset"};
Green green_of(const std::string& engine) {
  return engine == "unreal" ? Green::kDown : engine == "marmoset" ? Green::kKept : Green::kUp;
}

void write_rock(const ReportedSets& sets, const std::string& normal) {
  sets.plain("in/T_Rock_BC.png", {120, 80, 40});
  sets.plain("in/T_Rock_ORM.png", {255, 90, 0});
  sets.plain("in/" + normal, {128, 100, 255});
}

// `--to gltf` only chooses the material, so the layout must be given.
Words words_to(const std::string& engine) {
  return "--to " + engine + (engine == "gltf" ? " --layout gltf" : "");
}

}  // namespace

TEST_CASE("reports: 07 green of normal maps between all engines", "[reports][slow]") {
  const ReportedSets sets;
  write_rock(sets, "T_Rock_N.png");
  for (const char* from : kEngines)
    for (const char* to : kEngines) {
      INFO(from << " to " << to);
      const Green written = green_of(from), read = green_of(to);
      const ProcessResult result =
          require_success(sets.texremap(Words("convert in --force -o out --from") + from + words_to(to)));
      const bool is_known = written != Green::kKept && read != Green::kKept;
      const bool is_inverted = is_known && written != read;
      CHECK(sets.texel("out/T_Rock_N.png") == std::vector{128, is_inverted ? 155 : 100, 255});
      const std::string line = "note: in/T_Rock_N.png: green is ";
      if (is_inverted)
        CHECK_THAT(result.errors,
                   Contains(line + "inverted in the copy T_Rock_N.png, because --from " + from));
      else if (is_known)
        CHECK_THAT(result.errors, !Contains(line));
      else
        CHECK_THAT(result.errors, Contains(line + "kept, because "));
    }
}

TEST_CASE("reports: 07 the name of a normal map wins over --from", "[reports][slow]") {
  const ReportedSets sets;
  const auto green = [&](const std::string& words, const std::string& name) {
    std::filesystem::remove_all(sets.path("out"));
    require_success(sets.texremap(Words("convert in -o out") + Words(words)));
    return sets.texel("out/" + name)[1];
  };
  SECTION("OpenGL") {
    write_rock(sets, "T_Rock_NormalGL.png");
    CHECK(green("--from unreal --to gltf --layout gltf", "T_Rock_NormalGL.png") == 100);
    CHECK(green("--from gltf --to unreal", "T_Rock_NormalDX.png") == 155);
    CHECK(green("--from metal-rough --to ue5", "T_Rock_NormalDX.png") == 155);
  }
  SECTION("DirectX") {
    write_rock(sets, "T_Rock_nor_dx.png");
    CHECK(green("--from gltf --to unreal", "T_Rock_nor_dx.png") == 100);
    CHECK(green("--from gltf --to blender", "T_Rock_nor_gl.png") == 155);
  }
  SECTION("neither the name nor the source says it") {
    write_rock(sets, "T_Rock_N.png");
    CHECK(green("--from metal-rough --to unity", "T_Rock_N.png") == 100);
    CHECK_THAT(sets.texremap("convert in --from substance --to unity -o two").errors,
               Contains("in/T_Rock_N.png: green is kept, because neither the file name nor --from shows "
                        "whether the map is OpenGL or DirectX; unity reads OpenGL (green up)"));
  }
}

TEST_CASE("reports: a set for an engine is complete, by --to as by --layout", "[reports][slow]") {
  const ReportedSets sets;
  write_rock(sets, "T_Rock_N.png");
  sets.plain("in/T_Rock_Height.png", {70});
  sets.plain("in/T_Rock_Emissive.png", {1, 2, 3});
  sets.plain("in/T_Rock_Opacity.png", {40});
  const std::vector<std::string> others = {"T_Rock_Emissive.png", "T_Rock_Height.png", "T_Rock_N.png",
                                           "T_Rock_Opacity.png"};
  std::vector<std::string> made = {"T_Rock_BaseMap.png", "T_Rock_MetallicSmoothness.png",
                                   "T_Rock_Occlusion.png"};
  std::vector<std::string> all = made;
  all.insert(all.end(), others.begin(), others.end());
  std::sort(all.begin(), all.end());
  const std::string words = GENERATE("--to unity", "--from gltf --to gltf --layout unity");
  require_success(sets.texremap("convert in -o out " + words));
  CHECK(sets.results() == all);
  CHECK(sets.texel("out/T_Rock_MetallicSmoothness.png") == std::vector{0, 0, 0, 165});
  std::filesystem::remove_all(sets.path("out"));
  require_success(sets.texremap("convert in --only-converted -o out " + words));
  CHECK(sets.results() == made);
}

TEST_CASE("reports: what a packed map holds besides comes along as a map", "[reports][slow]") {
  const ReportedSets sets;
  sets.plain("in/T_Rock_BC.png", {120, 80, 40});
  sets.plain("in/T_Rock_ORDp.png", {250, 90, 33});
  require_success(sets.texremap("convert in --from unreal --to unity --metallic 0 -o out"));
  CHECK(sets.texel("out/T_Rock_height.png") == std::vector{33});
  CHECK(sets.texel("out/T_Rock_Occlusion.png") == std::vector{250});
}

TEST_CASE("reports: a folder prints one line a set where nothing is visible", "[reports][slow]") {
  const ReportedSets sets;
  constexpr std::size_t kSets = 12;
  for (std::size_t i = 0; i < kSets; ++i) {
    const std::string name = "in/rock" + std::to_string(i) + "x_";
    sets.plain(name + "diffuse.png", {120, 80, 40}, 8);
    sets.plain(name + "specular.png", {56, 56, 56}, 8);
    sets.plain(name + "glossiness.png", {200}, 8);
    sets.plain(name + "normal.png", {128, 128, 255}, 8);
  }
  const Words words = "convert in --from gltf-specgloss --to unreal --force -o out";
  const std::string brief = require_success(sets.texremap(words)).errors;
  CHECK(count_of(brief, "\n") <= kSets + 16);
  CHECK_THAT(brief, !Contains("undetermined") && Contains("of the same kinds (--verbose lists them)"));
  const std::string verbose = require_success(sets.texremap(words + "--verbose")).errors;
  CHECK(count_of(verbose, "\n") >= 4 * kSets);
  CHECK_THAT(verbose, Contains("metallic is undetermined, without visible effect"));
  // Metal-rough cannot express a blue metal with red diffuse.
  sets.plain("in/rock0x_specular.png", {20, 20, 230}, 8);
  sets.plain("in/rock0x_diffuse.png", {230, 20, 20}, 8);
  CHECK_THAT(
      require_success(sets.texremap(words)).errors,
      Contains("in/rock0x: metal-rough cannot express these maps exactly; the visible difference is about"));
}
