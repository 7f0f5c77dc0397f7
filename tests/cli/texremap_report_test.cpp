// This file tests reports as HTML. They must show what the files hold, contain everything that they need, and
// show names from files only as text.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "core/base64.hpp"
#include "texture/image_library.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

const std::string kSample = std::string(REMAP_SAMPLES) + "/painted_copper";

nlohmann::json data_of(const std::string& html) {
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t first = html.find(begin) + begin.size();
  return nlohmann::json::parse(html.substr(first, html.find("</script>", first) - first));
}

ImagePixels image_of(const nlohmann::json& data, const nlohmann::json& index) {
  const auto url = data["images"][index.get<std::string>()].get<std::string>();
  const auto bytes = from_base64<std::string>(url.substr(url.find(',') + 1));
  REQUIRE(bytes.has_value());
  return image_library().codec().decode(*bytes, "image of the report");
}

nlohmann::json reported(const Session& session, const Words& words) {
  require_success(session.texremap(Words("convert --report r.html") + words));
  return data_of(read_file(session.path("r.html")));
}

// Writes a set whose maps have one value each.
void write_metal(const Session& session, const std::string& name) {
  session.flat(name + "_roughness.png", {0.4f});
  session.flat(name + "_baseColor.png", {0.2f, 0.4f, 0.6f});
  session.flat(name + "_metallic.png", {1.0f});
}

}  // namespace

TEST_CASE("texremap report: a glTF file, as its material says, without conversion, and converted") {
  const Session session;
  const auto data = reported(session, "-o out.glb " + kSample + ".glb");
  CHECK(data["command"].get<std::string>() ==
        "texremap convert " + kSample + ".glb --output out.glb --report r.html");
  REQUIRE(data["materials"].size() == 1);
  const auto& material = data["materials"][0];
  REQUIRE(material["looks"].size() == 3);
  CHECK(material["looks"][0]["title"] == "source");
  CHECK_FALSE(material["looks"][0].contains("rms"));
  CHECK(material["looks"][1]["title"] == "without conversion");
  CHECK(material["looks"][1]["rms"].get<double>() > 0.2);
  CHECK(material["looks"][2]["rms"].get<double>() < 0.01);
  CHECK(material["looks"][2]["brdf"] == "ggx");
  const auto names = [&](const char* side) {
    std::vector<std::string> found;
    for (const auto& map : material["maps"][side]) found.push_back(map["name"]);
    std::ranges::sort(found);
    return found;
  };
  CHECK(names("before") == Names{"diffuse", "glossiness", "specular"});
  CHECK(names("after") == Names{"base color", "metallic", "roughness"});
}

TEST_CASE("texremap report: looks hold the numbers of the maps") {
  const Session session;
  write_metal(session, "a");
  const auto data = reported(session, ". -o out --from blender --to mitsuba/ggx --dry-run");
  CHECK_FALSE(std::filesystem::exists(session.path("out")));
  const auto& look = data["materials"][0]["looks"].back();
  const ImagePixels specular = image_of(data, look["specular"]);
  REQUIRE(specular.channels == 3);
  for (std::size_t c = 0; c < 3; ++c)  // a metal has its base color as F0
    CHECK(std::abs(static_cast<int>(specular.bytes[c]) -
                   std::lround(255.0 * (0.2 + 0.2 * static_cast<double>(c)))) <= 3);
  const ImagePixels roughness = image_of(data, data["materials"][0]["looks"][0]["roughness"]);
  CHECK(std::abs(static_cast<int>(roughness.bytes[0]) - 102) <= 3);
  CHECK(data["light"]["width"] == 2 * data["light"]["height"].get<int>());
}

TEST_CASE("texremap report: normal maps are shown with green up, heights are not") {
  const Session session;
  write_metal(session, "in/a");
  const auto normals = [&](const std::string& name, bool is_down) {
    session.make(name, test_spec(8, 8, {"R", "G", "B"}, OIIO::TypeUInt8), [&](int x, int y, int c) {
      const float value = 0.3f + 0.4f * static_cast<float>(c == 0 ? x : y) / 7.0f;
      return c == 2 ? 0.95f : c == 1 && is_down ? 1.0f - value : value;
    });
    const auto data = reported(session, "in -o out --from blender --to threejs --dry-run --force");
    std::filesystem::remove(session.path(name));
    return data;
  };
  const auto up = normals("in/a_normal_gl.png", false), down = normals("in/a_normal_dx.png", true);
  const ImagePixels first = image_of(up, up["materials"][0]["normal"]),
                    second = image_of(down, down["materials"][0]["normal"]);
  REQUIRE(first.bytes.size() == 3 * 8 * 8);
  for (std::size_t i = 0; i < first.bytes.size(); ++i)  // inverted integers differ by their rounding
    REQUIRE(std::abs(std::to_integer<int>(first.bytes[i]) - std::to_integer<int>(second.bytes[i])) <= 1);
  CHECK(first.bytes[0] < first.bytes[3 * 7]);          // red rises to the right
  CHECK(first.bytes[3 * 8 * 7 + 1] > first.bytes[1]);  // green rises downwards, as in the file
  const Words again = "in -o out --from blender --to threejs --dry-run --force";
  CHECK(up["materials"][0]["looks"][0]["still"] !=
        reported(session, again)["materials"][0]["looks"][0]["still"]);
  session.map("in/a_normal_gl.png", kGrey);
  CHECK_FALSE(reported(session, again)["materials"][0].contains("normal"));
}

TEST_CASE("texremap report: sets of a BRDF model are shown with their diffuse map") {
  const Session session;
  session.flat("in/a_roughness.png", {0.4f});
  session.flat("in/a_specular.png", {0.2f, 0.2f, 0.2f});
  session.flat("in/a_diffuse.png", {0.2f, 0.4f, 0.6f}, OIIO::TypeUInt8, 8);
  for (const std::string& words :
       {std::string("in"), std::string("--roughness in/a_roughness.png --specular "
                                       "in/a_specular.png --diffuse in/a_diffuse.png")}) {
    const auto data =
        reported(session, words + " -o out --from mitsuba/ward --to mitsuba/as --dry-run --force");
    for (const auto& look : data["materials"][0]["looks"]) {
      const ImagePixels diffuse = image_of(data, look["diffuse"]);
      for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(std::to_integer<int>(diffuse.bytes[c]) -
                       std::lround(255.0 * (0.2 + 0.2 * static_cast<double>(c)))) <= 1);
    }
  }
}

TEST_CASE("texremap report: materials of MTL and OBJ files are shown by Blinn's lobe, then by GGX") {
  const Session session;
  session.make("wood.png", test_spec(8, 8, {"R", "G", "B"}, OIIO::TypeUInt8), [](int x, int, int c) {
    return 0.3f + 0.05f * static_cast<float>(x) + 0.1f * static_cast<float>(c);
  });
  session.put("box.mtl",
              "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\nKs 0.1 0.1 0.1\nNs 60\n"
              "newmtl metal\nKd 0 0 0\nKs 0.6 0.5 0.4\nNs 200\n");
  session.put("box.obj",
              "mtllib box.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
              "usemtl wood\nf 1/1 2/2 3/3\nusemtl metal\nf 1/1 3/3 2/2\n");
  for (const std::string& words :
       {std::string("box.mtl -o out.mtl"), std::string("box.obj --to gltf -o out.glb"),
        std::string("box.obj --to gltf --dry-run --force -o out.gltf")}) {
    CAPTURE(words);
    const auto data = reported(session, words + " --force");
    REQUIRE(data["materials"].size() == 2);
    CHECK(data["materials"][1]["name"] == "metal");
    for (const auto& material : data["materials"]) {
      REQUIRE(material["looks"].size() == 2);
      CHECK(material["looks"][0]["model"] == "legacy/blinn-phong");
      CHECK(material["looks"][0]["brdf"] == "plain_blinn");
      CHECK(material["looks"][1]["model"] == "mitsuba/ggx");
      CHECK(material["looks"][1]["rms"].get<double>() < 0.2);  // Blinn's lobe has no Fresnel effect
    }
    const ImagePixels wood = image_of(data, data["materials"][0]["looks"][0]["diffuse"]);
    CHECK(std::abs(std::to_integer<int>(wood.bytes[0]) - 76) <= 2);
    CHECK(std::abs(std::to_integer<int>(wood.bytes[3 * 7]) - 166) <= 2);
  }
}

TEST_CASE("texremap report: maps of an MTL file are shown by the channels that -imfchan names") {
  const Session session;
  session.flat("orm.png", {1.0f, 0.4f, 0.0f});
  session.put("a.mtl", "newmtl a\nKd 0.5 0.5 0.5\nmap_Pr -imfchan g orm.png\nmap_Pm -imfchan b orm.png\n");
  session.put("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  const auto data = reported(session, "a.obj --to gltf -o a.glb");
  CHECK(data["materials"][0]["looks"].back()["rms"].get<double>() < 0.02);
}

TEST_CASE("texremap report: large maps are shown smaller, with their own size beside") {
  const Session session;
  session.make("a_roughness.png", test_spec(2048, 8, {"Y"}, OIIO::TypeUInt8),
               [](int, int, int) { return 0.4f; });
  session.make("a_specular.png", test_spec(2048, 8, {"Y"}, OIIO::TypeUInt8),
               [](int, int, int) { return 0.2f; });
  const auto data = reported(session, ". -o out --from mitsuba/ward --to mitsuba/as --dry-run");
  for (const char* side : {"before", "after"})
    for (const auto& map : data["materials"][0]["maps"][side]) {
      CHECK(map["width"] == 2048);
      CHECK(map["height"] == 8);
      CHECK(map["shown_width"] == 1024);
      CHECK(image_of(data, map["image"]).width == 1024);
    }
}

TEST_CASE("texremap report: sixteen materials at most, and what is not shown is said", "[slow]") {
  const Session session;
  for (int i = 10; i < 28; ++i) write_metal(session, "set" + std::to_string(i));
  const auto data = reported(session, ". -o out --from blender --to threejs --dry-run");
  CHECK(data["materials"].size() == 16);
  const std::string notes = data["notes"].dump();
  CHECK_THAT(notes, Contains("only the first 16 materials are shown"));
  CHECK_THAT(notes, Contains("threejs-r187/standard-metal is shown as mitsuba/"));
}

TEST_CASE("texremap report: names stay text") {
  const Session session;
  write_metal(session, "in/a");
  std::filesystem::rename(session.path("in"), session.path("in<b>&"));
  require_success(session.texremap("convert in<b>& -o out --from blender --to threejs --report r.html"));
  const std::string html = read_file(session.path("r.html"));
  CHECK(html.find("in<b>") == std::string::npos);
  CHECK_THAT(data_of(html)["command"].get<std::string>(), Contains("'in<b>&'"));
}

TEST_CASE("texremap report: an existing file stays") {
  const Session session;
  write_metal(session, "a");
  write_file(session.path("r.html"), "mine");
  const Words words("convert . -o out --from blender --to threejs --report r.html");
  CHECK_THAT(session.texremap(words).errors, Contains("r.html"));
  CHECK(read_file(session.path("r.html")) == "mine");
  require_success(session.texremap(words + " --force"));
}
