// This file tests cases that users reported, each with the correct result.
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

class ReportSession : public Session {
 public:
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(path(name)).parent_path());
    std::ofstream(path(name), std::ios::binary) << text;
  }
  // Writes an image of 32x32 texels of 8 bits. Channels without a value are noise.
  void image(const std::string& name, const std::vector<std::string>& channels,
             const std::map<int, float>& values = {}, const OIIO::ParamValueList& tags = {}) const {
    fs::create_directories(fs::path(path(name)).parent_path());
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
const std::vector<std::string> kReportGrey = {"Y"}, kReportColor = {"R", "G", "B"},
                               kReportAlpha = {"R", "G", "B", "A"};
const std::string kNotMetal = R"("pbrMetallicRoughness":{"metallicFactor":0)";

}  // namespace

TEST_CASE("reports: 04 check looks at the image of a texture that convert reads", "[slow]") {
  const ReportSession session;
  const auto normals = [](int x, int, int c) {
    return c == 2 ? 1.0f : 0.5f + 0.1f * (static_cast<float>(x) / 31.0f - 0.5f) * (c == 0 ? 1.0f : -1.0f);
  };
  for (const std::string extension : {"png", "webp"})
    session.make("n." + extension, test_spec(32, 32, kReportColor, OIIO::TypeUInt8), normals);
  // OpenImageIO changes the colors of a WebP with alpha, so sets refuse it. Conversions of assets read it
  // correctly.
  session.make("alpha.webp", test_spec(32, 32, kReportAlpha, OIIO::TypeUInt8),
               [&](int x, int y, int c) { return c == 3 ? (x + y == 0 ? 0.5f : 1.0f) : normals(x, y, c); });
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
  session.image("c.png", kReportColor);
  session.image("y.png", kReportGrey);
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
      session.image(extension + "/a_" + role + "." + extension, kReportColor, {{2, 0.99f}}, srgb);
      session.image(extension + "_plain/a_" + role + "." + extension, kReportColor, {{2, 0.99f}});
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
  session.image("orm.png", kReportColor, {{0, 1.0f}});
  session.image("grey.png", kReportGrey);
  session.image("leaf.png", kReportAlpha);
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
    session.image(name, kReportColor, {{0, value}, {1, value}, {2, value}});
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
  session.image("packed/a_ORM.png", kReportColor, {{1, 0.5f}, {2, 0.0f}});
  CHECK(session.findings("packed --ignore channel-order") == Found{});
  // Tiles may differ in size, but the maps of one tile may not.
  fs::create_directories(session.path("sizes"));
  session.make("sizes/a_Roughness.1001.png", test_spec(32, 32, {"Y"}, OIIO::TypeUInt8), noise);
  session.make("sizes/a_Roughness.1002.png", test_spec(16, 16, {"Y"}, OIIO::TypeUInt8), noise);
  CHECK(session.findings("sizes") == Found{});
  session.make("sizes/a_Height.1001.png", test_spec(32, 32, {"Y"}, OIIO::TypeUInt8), noise);
  session.make("sizes/a_Height.1002.png", test_spec(32, 32, {"Y"}, OIIO::TypeUInt8), noise);
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
  session.image("set/a_Metallic.png", kReportGrey, {{0, 0.5f}});  // a possible finding
  CHECK(session.texremap("check set").exit_code == 0);
  CHECK(session.texremap("check set").output.find("[metallic-greys, possible]") != std::string::npos);
  CHECK(session.texremap("check set").errors.find("1 finding, none of which is certain") !=
        std::string::npos);
  CHECK(session.texremap("check set --fail-on likely").exit_code == 0);
  CHECK(session.texremap("check set --fail-on possible").exit_code == 1);
  session.image("set/a_Roughness.png", kReportGrey, {{0, 0.5f}});  // a certain finding
  CHECK(session.texremap("check set").exit_code == 1);
  CHECK(session.texremap("check set --fail-on never").exit_code == 2);
}

TEST_CASE("reports: an asset is converted with as few words as people type", "[slow]") {
  const ReportSession session;
  session.image("d.png", kReportColor);
  session.image("s.png", kReportAlpha);
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
  CHECK_FALSE(fs::exists(session.path("new/s.png")));
  const ProcessResult again = session.texremap("convert in.gltf new/out.gltf");
  CHECK(again.exit_code != 0);
  CHECK_THAT(again.errors, Catch::Matchers::Contains("already exists (--force overwrites)"));
  for (const std::string word : {"metal-rough", "glb", "core", "gltf"})
    require_success(session.texremap("convert in.gltf --to " + word + " -o by_" + word));
  require_success(session.texremap("convert in.gltf --keep-unused -o kept"));
  CHECK(nlohmann::json::parse(session.content("kept/in.gltf"))["images"].size() == 4);
  CHECK(session.texremap("convert in.gltf").exit_code == 2);
}
