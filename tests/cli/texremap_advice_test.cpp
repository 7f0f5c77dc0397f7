// This file tests the advice of `texremap check`. Each printed command is run, and its result must then pass
// the rule.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include <catch2/catch.hpp>

#include "check/rules.hpp"
#include "cli/texremap_session.hpp"
#include "core/base64.hpp"
#include "support/skip.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

constexpr int kAdviceSide = 48;
using Shape = std::function<double(double x, double y)>;

double bumps(double x, double y) { return 0.5 + 0.3 * std::sin(9.0 * x) * std::cos(7.0 * y); }
double patches(double x, double y) { return std::sin(8.0 * x) * std::sin(6.0 * y) > 0.3 ? 1.0 : 0.0; }
Shape flat(double value) {
  return [value](double, double) { return value; };
}
Shape power_of(double exponent) {
  return [exponent](double x, double y) { return std::pow(bumps(x, y), exponent); };
}
double opposite(double x, double y) { return 1.0 - bumps(x, y); }
double through_srgb(double x, double y) { return linear_to_srgb(bumps(x, y)); }

// Returns the normal of the height 0.05 sin(a x + b y + c x y), from its derivatives.
std::array<double, 3> normal_at(double x, double y) {
  const double slope = 0.05 * std::cos(14.0 * x + 9.0 * y + 11.0 * x * y);
  const double along = slope * (14.0 + 11.0 * y), down = slope * (9.0 + 11.0 * x);
  const double length = std::hypot(1.0, along, down);
  return {0.5 - 0.5 * along / length, 0.5 + 0.5 * down / length, 0.5 + 0.5 / length};
}
Shape normal(int channel, bool is_directx) {
  return [=](double x, double y) {
    const double value = normal_at(x, y)[static_cast<std::size_t>(channel)];
    return is_directx && channel == 1 ? 1.0 - value : value;
  };
}
std::vector<Shape> normals(bool is_directx) {
  return {normal(0, is_directx), normal(1, is_directx), normal(2, is_directx)};
}

// An AdviceMap is an image in the folder `in`.
struct AdviceMap {
  std::string name;
  std::vector<Shape> channels;
  std::string tag = "";
  OIIO::TypeDesc type = OIIO::TypeUInt8;
  int width = kAdviceSide, height = width;
};

class AdviceSession : public Session {
 public:
  AdviceSession() { fs::create_directories(path("in")); }
  void write(const AdviceMap& map) const {
    const std::size_t count = map.channels.size();
    OIIO::ImageSpec spec = test_spec(map.width, map.height,
                                     count == 1   ? kGrey
                                     : count == 3 ? kColor
                                                  : kWithAlpha,
                                     map.type);
    if (!map.tag.empty()) spec.attribute("oiio:ColorSpace", map.tag);
    if (map.tag == "sRGB") spec.attribute("Exif:ColorSpace", 1);
    make("in/" + map.name, spec, [&](int x, int y, int c) {
      return static_cast<float>(
          map.channels[static_cast<std::size_t>(c)]((x + 0.5) / map.width, (y + 0.5) / map.height));
    });
  }
  // Writes in/a.gltf with one material. Texture i uses image i.
  void gltf(const std::string& material, const std::vector<std::string>& images = {}) const {
    nlohmann::json list = nlohmann::json::array(), textures = list;
    for (const std::string& image : images) {
      textures.push_back({{"source", list.size()}});
      list.push_back({{"uri", image}});
    }
    const std::string more =
        images.empty() ? "" : R"(,"images":)" + list.dump() + R"(,"textures":)" + textures.dump();
    put("in/a.gltf",
        R"({"asset":{"version":"2.0"},"materials":[{"name":"m",)" + material + "}]" + more + "}");
  }

  // Returns the findings of one rule in `paths`. Checks what the command prints and returns.
  std::vector<nlohmann::json> findings(const std::string& rule, const std::string& paths) const {
    const ProcessResult run = texremap("check " + paths + " --json --quiet --fail-on possible");
    INFO(run.errors);
    const nlohmann::json report = nlohmann::json::parse(run.output);
    REQUIRE(report["problems"].empty());
    CHECK(run.exit_code == (report["findings"].empty() ? 0 : 1));
    std::vector<nlohmann::json> found;
    for (const nlohmann::json& finding : report["findings"])
      if (finding["rule"] == rule) found.push_back(finding);
    return found;
  }
  // Runs a command as a user types it.
  ProcessResult type(const std::string& command) const {
    const std::string folders = fs::path(REMAP_TEXREMAP).parent_path().string() + ":" +
                                fs::path(REMAP_OIIOTOOL).parent_path().string();
    return run(Words{"/bin/sh", "-c", "PATH=" + folders + ":$PATH; " + command});
  }
};

enum Help { kCommand, kWords };  // how the finding can be fixed

// A Fault has maps. If it has a material, maps whose names have no `_` are its textures.
struct Fault {
  std::string rule, what;
  std::vector<AdviceMap> maps;
  Help help;
  std::string material;
  std::string checked;  // arguments of `texremap check`; empty: the asset of the material, or the folder
  std::function<void(const AdviceSession&)> more;

  std::string arguments() const { return !checked.empty() ? checked : material.empty() ? "in" : "in/a.gltf"; }
  void write(const AdviceSession& session) const {
    std::vector<std::string> images;
    for (const AdviceMap& map : maps) {
      session.write(map);
      if (map.name.find('_') == std::string::npos) images.push_back(map.name);
    }
    if (!material.empty()) session.gltf(material, images);
    if (more) more(session);
  }
};

const std::string kRoughTexture = R"("pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}})";
const std::string kPlasticTexture =
    R"("pbrMetallicRoughness":{"metallicFactor":0,"metallicRoughnessTexture":{"index":0}})";
const std::string kPlasticFactor = R"("pbrMetallicRoughness":{"metallicFactor":0},)";
const std::string kGlossFactor =
    R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.5}})";

// Returns a material of two textures. `more` belongs to the second.
std::string gloss_textures(const std::string& more = "") {
  return R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},)"
         R"("specularGlossinessTexture":{"index":1)" +
         more + "}}}";
}
const std::string kTransform = R"(,"extensions":{"KHR_texture_transform":{"scale":[2,2]}})";
const std::string kBrightSpecular =
    R"("extensions":{"KHR_materials_specular":{"specularColorFactor":[1.5,1.5,1.5]})";

const std::vector<Shape> kAdviceColor = {bumps, opposite, patches}, kAdviceOrm = {flat(1), bumps, patches},
                         kAdviceGloss = {bumps, bumps, bumps, opposite};

std::vector<Shape> with_alpha(std::vector<Shape> shapes) {
  shapes.push_back(power_of(0.5));
  return shapes;
}

std::vector<Fault> faults() {
  using S = const AdviceSession&;
  const auto &color = kAdviceColor, &orm = kAdviceOrm, &gloss = kAdviceGloss;
  const OIIO::TypeDesc bytes = OIIO::TypeUInt8, half = OIIO::TypeHalf;
  const auto metal = [](double, double y) { return y < 0.9 ? 0.04 : 0.9; };
  const auto beyond = [](double x, double y) { return y < 0.1 ? NAN : 1.5 * x - 0.2; };
  const auto heights = [](double x, double y) { return y < 0.1 ? NAN : 3.0 * x - 1.0; };
  const auto dark = [](double x, double) { return 0.01 + 0.03 * x; };
  const auto cosine = [](double x, double) { return 0.5 + 0.5 * std::cos(6.28 * x); };
  const auto sine = [](double x, double) { return 0.5 + 0.5 * std::sin(6.28 * x); };
  const auto mtl = [](const std::string& text) { return [text](S s) { s.put("in/a.mtl", text); }; };
  std::vector<Fault> all;
  const auto add = [&](const std::string& rule, const std::string& what, const std::vector<AdviceMap>& maps,
                       Help help = kCommand, const std::string& material = "",
                       const std::string& checked = "", const std::function<void(S)>& more = {}) {
    all.push_back({rule, what, maps, help, material, checked, more});
  };
  add("srgb-data", "a tag in PNG", {{"a_Roughness.png", {bumps}, "sRGB"}});
  add("srgb-data", "a tag in JPEG", {{"a_Roughness.jpg", {bumps}, "sRGB"}});
  add("srgb-data", "a tag in TIFF", {{"a_Roughness.tif", {bumps}, "sRGB"}});
  add("srgb-data", "a tag in an asset", {{"x.png", orm, "sRGB"}}, kCommand, kRoughTexture);
  add("srgb-data", "one map", {{"a_Roughness.png", {bumps}, "sRGB"}}, kCommand, "", "in/a_Roughness.png");
  add("srgb-data", "maps of one name in two folders",
      {{"a/roughness.png", {bumps}, "sRGB"},
       {"a/basecolor.png", color},
       {"b/c/roughness.png", {bumps}, "sRGB"},
       {"b/c/basecolor.png", color}});
  add("srgb-data", "a texture of an asset in its own folder", {{"textures/x.png", orm, "sRGB"}}, kCommand,
      kRoughTexture, "in");
  add("srgb-data", "a name that a shell would split", {{"it's a_Roughness.png", {bumps}, "sRGB"}});
  add("srgb-data", "stored through the curve",
      {{"rock_rough_2k.png", {through_srgb}}, {"rock_arm_2k.png", orm}});
  add("srgb-data", "stored through the curve in an asset",
      {{"x.png", {through_srgb, through_srgb, through_srgb}}, {"a_Roughness.png", {bumps}}}, kCommand,
      kPlasticTexture, "in");
  add("linear-color", "a set", {{"a_BaseColor.png", color, "Linear"}});
  add("linear-color", "an asset", {{"x.png", color, "Linear"}}, kCommand,
      R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}})");
  add("gloss-as-roughness", "a set", {{"a_Roughness.png", {bumps}}, {"a_Glossiness.png", {bumps}}});
  add("gloss-as-roughness", "an asset beside its source",
      {{"x.png", {flat(1), opposite, patches}}, {"a_Roughness.png", {bumps}}}, kCommand, kRoughTexture, "in");
  add("alpha-as-roughness", "a set",
      {{"a_Roughness.png", {power_of(2.0)}}, {"a_Glossiness.png", {opposite}}});
  add("alpha-as-roughness", "a gloss map of alpha",
      {{"a_Roughness.exr", {bumps}, "", half},
       {"a_Glossiness.exr", {[](double x, double y) { return 1.0 - power_of(2.0)(x, y); }}, "", half}});
  add("alpha-as-roughness", "squared twice beside roughness",
      {{"a_Roughness.exr", {bumps}, "", half}, {"a_Alpha.exr", {power_of(4.0)}, "", half}});
  add("alpha-as-roughness", "an asset beside its source",
      {{"x.png", {flat(1), power_of(2.0), patches}}, {"a_Roughness.png", {bumps}}}, kCommand, kRoughTexture,
      "in");
  add("channel-order", "a set", {{"T_a_ORM.png", {flat(1), patches, bumps}}});
  add("channel-order", "an image with alpha", {{"T_a_ORM.png", with_alpha({flat(1), patches, bumps})}});
  add("channel-order", "an asset", {{"x.png", {patches, bumps, flat(0)}}}, kCommand, kRoughTexture);
  add("specgloss-channels", "a set", {{"a_SpecularGlossiness.png", color}}, kWords);
  add("sizes", "a set of three sizes",
      {{"a_BaseColor.png", color, "", bytes, 32},
       {"a_Roughness.png", {bumps}, "", bytes, 64},
       {"a_Metallic.png", {patches}, "", bytes, 64, 32}});
  add("wrong-texture", "a set", {{"a_BaseColor.png", normals(false)}}, kWords);
  add("metallic-greys", "a set", {{"a_Metallic.png", {bumps}}}, kWords);
  add("factor-zero", "roughness", {{"x.png", orm}}, kWords,
      R"("pbrMetallicRoughness":{"roughnessFactor":0,"metallicRoughnessTexture":{"index":0}})");
  add("factor-ignored", "metallic of 0", {{"x.png", orm}}, kWords, kPlasticTexture, "in/a.gltf --for unity");
  add("normal-space", "a set", {{"a_Normal.png", {cosine, flat(0.5), sine}}}, kWords);
  add("normal-orientation", "a set", {{"a_NormalGL.png", normals(true)}});
  add("normal-orientation", "an image with alpha", {{"a_NormalGL.png", with_alpha(normals(true))}});
  add("normal-orientation", "a map for a reader", {{"a_Normal.png", normals(false)}}, kCommand, "",
      "in --for unreal");
  add("normal-orientation", "an asset", {{"x.png", normals(true)}}, kCommand,
      R"("normalTexture":{"index":0})");
  add("specular-color", "a set", {{"a_Specular.png", {metal, metal, metal}}}, kWords);
  add("constant-map", "a set", {{"a_Roughness.png", {flat(0.5)}}}, kWords);
  add("banding", "a set", {{"a_Roughness.png", {dark}}}, kWords);
  add("bad-values", "a set", {{"a_Roughness.exr", {beyond}, "", half}});
  add("bad-values", "NaN in heights", {{"a_Height.exr", {heights}, "", OIIO::TypeFloat}});
  add("bad-values", "an asset", {{"x.exr", {[](double x, double) { return 1.5 * x - 0.2; }}, "", half}},
      kCommand, "", "in/a.mtl", mtl("newmtl m\nKd 1 1 1\nmap_Pr x.exr\n"));
  add("ior", "an asset", {}, kWords, kPlasticFactor + R"("extensions":{"KHR_materials_ior":{"ior":1000}})");
  add("ignored-by-reader", "specular-glossiness", {}, kCommand, kGlossFactor, "in/a.gltf --for threejs");
  add("ignored-by-reader", "two assets of one name", {}, kCommand, kGlossFactor, "in --for threejs", [](S s) {
    for (const char* name : {"in/b/a.gltf", "in/c/a.gltf"}) s.put(name, s.content("in/a.gltf"));
  });
  add("ignored-by-reader", "maps of two sizes", {{"x.png", color}, {"y.png", gloss, "", bytes, 24}}, kCommand,
      gloss_textures(), "in/a.gltf --for threejs");
  add("ignored-by-reader", "maps in two places", {{"x.png", color}, {"y.png", gloss}}, kCommand,
      gloss_textures(kTransform), "in/a.gltf --for threejs");
  add("ignored-by-reader", "specular and ior", {}, kCommand,
      kPlasticFactor + kBrightSpecular + R"(,"KHR_materials_ior":{"ior":1.4}})", "in/a.gltf --for godot");
  add("ignored-by-reader", "materials of all kinds", {{"x.png", color}, {"y.png", gloss, "", bytes, 24}},
      kCommand, gloss_textures() + "},{" + kPlasticFactor + kBrightSpecular + "}", "in/a.gltf --for gltf");
  add("ignored-by-reader", "ior of a volume", {}, kWords,
      kPlasticFactor + R"("extensions":{"KHR_materials_ior":{"ior":1.4},"KHR_materials_volume":{}})",
      "in/a.gltf --for godot");
  add("ignored-by-reader", "clearcoat", {}, kWords,
      R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1}})", "in/a.gltf --for godot");
  add("unreadable-statement", "an asset", {}, kWords, "", "", mtl("newmtl a\nKd .5 .5 .5\nNs shiny\n"));
  add("exponent-range", "an asset", {}, kWords, "", "",
      mtl("newmtl m\nKs 1 1 1\nNs 0.5\nnewmtl n\nKs 1 1 1\nNs 0.7\n"));
  add("duplicate-map", "a set", {{"a_Roughness.png", {bumps}}, {"a_AO.png", {bumps}}}, kWords);
  return all;
}

// A Refusal is a command line that `texremap convert` refuses, what the message proposes, and the repaired
// command line.
struct Refusal {
  std::string proposal;
  std::string refused;   // arguments
  std::string repaired;  // arguments that work
  std::function<void(const AdviceSession&)> make;
};

}  // namespace

TEST_CASE("texremap check: what each rule advises runs, and the rule is silent about the result",
          "[slow][needs]") {
  if (!fs::exists(REMAP_OIIOTOOL)) return skip("oiiotool", "not installed");
  std::set<std::string> rules_with_a_fault;
  for (const Fault& fault : faults()) {
    INFO(fault.rule + ": " + fault.what);
    rules_with_a_fault.insert(fault.rule);
    const AdviceSession session;
    fault.write(session);
    const std::vector<nlohmann::json> found = session.findings(fault.rule, fault.arguments());
    CHECK_FALSE(found.empty());
    std::set<std::string> typed;
    for (const nlohmann::json& finding : found) {
      const std::string fix = finding["fix"], command = finding["command"];
      CHECK(command.empty() == (fault.help == kWords));
      if (command.empty()) {
        for (const char* word : {"texremap convert", "oiiotool", "DIR", "FOLDER"})
          CHECK(fix.find(word) == std::string::npos);
        continue;
      }
      CHECK(fix.ends_with(": " + command));
      if (!typed.insert(command).second) continue;  // the same command fixes several findings
      const ProcessResult run = session.type(command);
      INFO(command + "\n" + run.errors);
      CHECK(run.exit_code == 0);
    }
    if (fault.help == kWords) continue;
    fs::copy(session.path("fixed"), session.path("in"),
             fs::copy_options::overwrite_existing | fs::copy_options::recursive);
    CHECK(session.findings(fault.rule, fault.arguments()).empty());
  }
  for (const Rule& rule : rules()) CHECK(rules_with_a_fault.contains(std::string(rule.name)));
}

TEST_CASE("texremap convert: what a refusal proposes is what the command lacks", "[slow]") {
  using S = const AdviceSession&;
  const std::vector<Shape>& color = kAdviceColor;
  const auto specgloss = [&](S s, int size, const std::string& more) {
    s.write({"x.png", color});
    s.write({"y.png", kAdviceGloss, "", OIIO::TypeUInt8, size});
    s.gltf(gloss_textures(more), {"x.png", "y.png"});
  };
  const std::string asset = "convert in/a.gltf --to gltf -o out", plain_asset = R"("name":"plain")";
  const std::string set = "convert in --from specular --to gltf -o out";
  const std::string one =
      "convert --from mitsuba/ward --to mitsuba/as --specular 0.04 -o out --roughness in/";
  const auto legacy_set = [&](S s) {
    s.write({"a_Diffuse.png", color});
    s.write({"a_Specular.png", color});
    s.write({"a_Glossiness.png", {opposite}});
  };
  const std::vector<Refusal> refusals = {
      {"--resample", asset, asset + " --resample", [=](S s) { specgloss(s, 24, ""); }},
      {"different KHR_texture_transform", asset, asset + " --resample",
       [=](S s) { specgloss(s, kAdviceSide, kTransform); }},
      {"--force", asset, asset + " --force",
       [=](S s) {
         s.gltf(plain_asset);
         require_success(s.texremap(asset));
       }},
      {"before the asset", asset, "convert . in/a.gltf --to gltf -o out",
       [=](S s) {
         s.write({"../x.png", color});
         s.gltf(plain_asset, {"../x.png"});
       }},
      {"without --extensions", asset + " --extensions write", asset,
       [](S s) {
         s.gltf(R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{},"KHR_materials_specular":{}})");
       }},
      {"--format glb", "convert in/a.obj --to gltf -o out", "convert in/a.obj --to gltf -o out --format glb",
       [](S s) {
         s.put("in/a.mtl", "newmtl m\nKd 1 1 1\nKs 1 1 1\nNs 50\n");
         s.put("in/a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
       }},
      {"--layout separate", set + " --layout as-inputs", set + " --layout separate", legacy_set},
      {"--layout separate", "convert in --from specular --to specular -o out --output-encoding roughness",
       "convert in --from specular --to specular -o out --output-encoding roughness --layout separate",
       legacy_set},
      {"use --type uint16", one + "a.png --type half", one + "a.png --type uint16",
       [](S s) {
         s.write({"a.png", {bumps}});
       }},
      {"--force", one + "../first/a.png", one + "../first/a.png --force",
       [](S s) {
         s.write({"a.png", {bumps}});
         require_success(
             s.texremap("convert --from mitsuba/ward --to mitsuba/as --specular 0.04 -o first "
                        "--roughness in/a.png"));
       }},
      {"--recursive", "convert . --from mitsuba/ward --to mitsuba/as --specular 0.04 -o out",
       "convert . --from mitsuba/ward --to mitsuba/as --specular 0.04 -o out --recursive",
       [](S s) {
         s.write({"a_Roughness.png", {bumps}});
       }},
      {"--assets", "convert in --from specular --to gltf -o out", "convert in --to gltf -o out --assets",
       [=](S s) { s.gltf(plain_asset); }},
  };
  for (const Refusal& refusal : refusals) {
    INFO(refusal.refused);
    const AdviceSession session;
    refusal.make(session);
    const ProcessResult refused = session.texremap(refusal.refused);
    CHECK(refused.exit_code != 0);
    INFO(refused.errors);
    CHECK(refused.errors.find(refusal.proposal) != std::string::npos);
    const ProcessResult repaired = session.texremap(refusal.repaired);
    INFO(repaired.errors);
    CHECK(repaired.exit_code == 0);
  }
}

TEST_CASE("texremap check: an image that is part of an asset has no command, and no path of a copy") {
  const AdviceSession session;
  session.write({"x.png", normals(true)});
  const std::string text = base64(session.content("in/x.png"));
  session.gltf(R"("normalTexture":{"index":0})", {"data:image/png;base64," + text});
  const std::vector<nlohmann::json> found = session.findings("normal-orientation", "in/a.gltf");
  REQUIRE(found.size() == 1);
  CHECK(found[0]["command"] == "");
  CHECK(found[0]["path"] == "in/a.gltf: image 0");
  CHECK(found[0]["fix"].get<std::string>().find(fs::temp_directory_path().string()) == std::string::npos);
}
