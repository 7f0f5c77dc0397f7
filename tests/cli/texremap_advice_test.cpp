// This file tests the advice of `texremap check`. Each printed command is run, and its result must then pass
// the rule.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "check/rules.hpp"
#include "cli/texremap_session.hpp"
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

class AdviceSession : public Session {
 public:
  AdviceSession() { fs::create_directories(path("in")); }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  void map(const std::string& name, const std::vector<Shape>& channels, const std::string& tag = "",
           OIIO::TypeDesc type = OIIO::TypeUInt8, int width = kAdviceSide, int height = kAdviceSide) const {
    const std::vector<std::string> names = channels.size() == 1 ? std::vector<std::string>{"Y"}
                                           : channels.size() == 3
                                               ? std::vector<std::string>{"R", "G", "B"}
                                               : std::vector<std::string>{"R", "G", "B", "A"};
    OIIO::ImageSpec spec = test_spec(width, height, names, type);
    if (!tag.empty()) spec.attribute("oiio:ColorSpace", tag);
    if (tag == "sRGB") spec.attribute("Exif:ColorSpace", 1);
    make(name, spec, [&](int x, int y, int c) {
      return static_cast<float>(channels[static_cast<std::size_t>(c)]((x + 0.5) / width, (y + 0.5) / height));
    });
  }
  // Writes in/a.gltf with one material. Texture i uses image i.
  void gltf(const std::string& material, const std::vector<std::string>& images = {}) const {
    std::string list, textures;
    for (std::size_t i = 0; i < images.size(); ++i) {
      list += (i > 0 ? "," : "") + std::string(R"({"uri":")") + images[i] + "\"}";
      textures += (i > 0 ? "," : "") + std::string(R"({"source":)") + std::to_string(i) + "}";
    }
    const std::string with_images =
        images.empty() ? "" : R"(,"images":[)" + list + R"(],"textures":[)" + textures + "]";
    put("in/a.gltf",
        R"({"asset":{"version":"2.0"},"materials":[{"name":"m",)" + material + "}]" + with_images + "}");
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

enum class Help { kCommand, kWords };  // how the finding can be fixed

struct Fault {
  std::string rule;
  std::string what;
  Help help = Help::kCommand;
  std::string checked;  // arguments of `texremap check`
  std::function<void(const AdviceSession&)> make;
};

const std::string kRoughTexture = R"("pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}})";
const std::string kBaseTexture =
    R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}})";
const std::string kPlasticFactor = R"("pbrMetallicRoughness":{"metallicFactor":0},)";
const std::string kGloss =
    R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},)"
    R"("specularGlossinessTexture":{"index":1}}})";

std::vector<Fault> faults() {
  using S = const AdviceSession&;
  const std::vector<Shape> color = {bumps, opposite, patches};
  std::vector<Fault> all;
  for (const std::string extension : {"png", "jpg", "tif"})
    all.push_back({"srgb-data", "a tag in " + extension, Help::kCommand, "in",
                   [=](S s) { s.map("in/a_Roughness." + extension, {bumps}, "sRGB"); }});
  all.insert(
      all.end(),
      {{"srgb-data", "a tag in an asset", Help::kCommand, "in/a.gltf",
        [](S s) {
          s.map("in/x.png", {flat(1), bumps, patches}, "sRGB");
          s.gltf(kRoughTexture, {"x.png"});
        }},
       {"srgb-data", "a map alone", Help::kCommand, "in/a_Roughness.png",
        [](S s) { s.map("in/a_Roughness.png", {bumps}, "sRGB"); }},
       {"srgb-data", "maps of one name in two folders", Help::kCommand, "in",
        [](S s) {
          for (const std::string folder : {"in/a", "in/b/c"}) {
            fs::create_directories(s.path(folder));
            s.map(folder + "/roughness.png", {bumps}, "sRGB");
            s.map(folder + "/basecolor.png", {bumps, opposite, patches});
          }
        }},
       {"srgb-data", "a texture of an asset in a folder of its own", Help::kCommand, "in",
        [](S s) {
          fs::create_directories(s.path("in/textures"));
          s.map("in/textures/x.png", {flat(1), bumps, patches}, "sRGB");
          s.gltf(kRoughTexture, {"textures/x.png"});
        }},
       {"srgb-data", "a name that a shell would split", Help::kCommand, "in",
        [](S s) { s.map("in/it's a_Roughness.png", {bumps}, "sRGB"); }},
       {"srgb-data", "stored through the curve", Help::kCommand, "in",
        [](S s) {
          s.map("in/rock_rough_2k.png", {through_srgb});
          s.map("in/rock_arm_2k.png", {flat(1), bumps, patches});
        }},
       {"srgb-data", "stored through the curve in an asset", Help::kCommand, "in",
        [](S s) {
          s.map("in/x.png", {through_srgb, through_srgb, through_srgb});
          s.map("in/a_Roughness.png", {bumps});
          s.gltf(R"("pbrMetallicRoughness":{"metallicFactor":0,"metallicRoughnessTexture":{"index":0}})",
                 {"x.png"});
        }},
       {"linear-color", "a set", Help::kCommand, "in",
        [=](S s) { s.map("in/a_BaseColor.png", color, "Linear"); }},
       {"linear-color", "an asset", Help::kCommand, "in/a.gltf",
        [=](S s) {
          s.map("in/x.png", color, "Linear");
          s.gltf(kBaseTexture, {"x.png"});
        }},
       {"gloss-as-roughness", "a set", Help::kCommand, "in",
        [](S s) {
          s.map("in/a_Roughness.png", {bumps});
          s.map("in/a_Glossiness.png", {bumps});
        }},
       {"gloss-as-roughness", "an asset beside its source", Help::kCommand, "in",
        [](S s) {
          s.map("in/x.png", {flat(1), opposite, patches});
          s.map("in/a_Roughness.png", {bumps});
          s.gltf(kRoughTexture, {"x.png"});
        }},
       {"alpha-as-roughness", "alpha of a set", Help::kCommand, "in",
        [](S s) {
          s.map("in/a_Roughness.png", {power_of(2.0)});
          s.map("in/a_Glossiness.png", {opposite});
        }},
       {"alpha-as-roughness", "a gloss map of alpha", Help::kCommand, "in",
        [](S s) {
          s.map("in/a_Roughness.exr", {bumps}, "", OIIO::TypeHalf);
          s.map("in/a_Glossiness.exr", {[](double x, double y) { return 1.0 - std::pow(bumps(x, y), 2.0); }},
                "", OIIO::TypeHalf);
        }},
       {"alpha-as-roughness", "squared twice beside roughness", Help::kCommand, "in",
        [](S s) {
          s.map("in/a_Roughness.exr", {bumps}, "", OIIO::TypeHalf);
          s.map("in/a_Alpha.exr", {power_of(4.0)}, "", OIIO::TypeHalf);
        }},
       {"alpha-as-roughness", "an asset beside its source", Help::kCommand, "in",
        [](S s) {
          s.map("in/x.png", {flat(1), power_of(2.0), patches});
          s.map("in/a_Roughness.png", {bumps});
          s.gltf(kRoughTexture, {"x.png"});
        }},
       {"channel-order", "a set", Help::kCommand, "in",
        [](S s) {
          s.map("in/T_a_ORM.png", {flat(1), patches, bumps});
        }},
       {"channel-order", "an image with alpha", Help::kCommand, "in",
        [](S s) {
          s.map("in/T_a_ORM.png", {flat(1), patches, bumps, power_of(0.5)});
        }},
       {"channel-order", "an asset", Help::kCommand, "in/a.gltf",
        [](S s) {
          s.map("in/x.png", {patches, bumps, flat(0)});
          s.gltf(kRoughTexture, {"x.png"});
        }},
       {"specgloss-channels", "a set", Help::kWords, "in",
        [=](S s) { s.map("in/a_SpecularGlossiness.png", color); }},
       {"sizes", "a set of three sizes", Help::kCommand, "in",
        [=](S s) {
          s.map("in/a_BaseColor.png", color, "", OIIO::TypeUInt8, 32, 32);
          s.map("in/a_Roughness.png", {bumps}, "", OIIO::TypeUInt8, 64, 64);
          s.map("in/a_Metallic.png", {patches}, "", OIIO::TypeUInt8, 64, 32);
        }},
       {"wrong-texture", "a set", Help::kWords, "in",
        [](S s) { s.map("in/a_BaseColor.png", normals(false)); }},
       {"metallic-greys", "a set", Help::kWords, "in", [](S s) { s.map("in/a_Metallic.png", {bumps}); }},
       {"factor-zero", "roughness", Help::kWords, "in/a.gltf",
        [](S s) {
          s.map("in/x.png", {flat(1), bumps, patches});
          s.gltf(R"("pbrMetallicRoughness":{"roughnessFactor":0,"metallicRoughnessTexture":{"index":0}})",
                 {"x.png"});
        }},
       {"factor-ignored", "metallic of 0", Help::kWords, "in/a.gltf --for unity",
        [](S s) {
          s.map("in/x.png", {flat(1), bumps, patches});
          s.gltf(R"("pbrMetallicRoughness":{"metallicFactor":0,"metallicRoughnessTexture":{"index":0}})",
                 {"x.png"});
        }},
       {"normal-space", "a set", Help::kWords, "in",
        [](S s) {
          s.map("in/a_Normal.png",
                {[](double x, double) { return 0.5 + 0.5 * std::cos(6.28 * x); }, flat(0.5),
                 [](double x, double) { return 0.5 + 0.5 * std::sin(6.28 * x); }});
        }},
       {"normal-orientation", "a set", Help::kCommand, "in",
        [](S s) { s.map("in/a_NormalGL.png", normals(true)); }},
       {"normal-orientation", "an image with alpha", Help::kCommand, "in",
        [](S s) {
          std::vector<Shape> channels = normals(true);
          channels.push_back(power_of(0.5));
          s.map("in/a_NormalGL.png", channels);
        }},
       {"normal-orientation", "a map for a reader", Help::kCommand, "in --for unreal",
        [](S s) { s.map("in/a_Normal.png", normals(false)); }},
       {"normal-orientation", "an asset", Help::kCommand, "in/a.gltf",
        [](S s) {
          s.map("in/x.png", normals(true));
          s.gltf(R"("normalTexture":{"index":0})", {"x.png"});
        }},
       {"specular-color", "a set", Help::kWords, "in",
        [](S s) {
          const auto linear = [](double, double y) { return y < 0.9 ? 0.04 : 0.9; };
          s.map("in/a_Specular.png", {linear, linear, linear});
        }},
       {"constant-map", "a set", Help::kWords, "in", [](S s) { s.map("in/a_Roughness.png", {flat(0.5)}); }},
       {"banding", "a set", Help::kWords, "in",
        [](S s) { s.map("in/a_Roughness.png", {[](double x, double) { return 0.01 + 0.03 * x; }}); }},
       {"bad-values", "a set", Help::kCommand, "in",
        [](S s) {
          s.map("in/a_Roughness.exr", {[](double x, double y) { return y < 0.1 ? NAN : 1.5 * x - 0.2; }}, "",
                OIIO::TypeHalf);
        }},
       {"bad-values", "NaN in heights", Help::kCommand, "in",
        [](S s) {
          s.map("in/a_Height.exr", {[](double x, double y) { return y < 0.1 ? NAN : 3.0 * x - 1.0; }}, "",
                OIIO::TypeFloat);
        }},
       {"bad-values", "an asset", Help::kCommand, "in/a.mtl",
        [](S s) {
          s.map("in/x.exr", {[](double x, double) { return 1.5 * x - 0.2; }}, "", OIIO::TypeHalf);
          s.put("in/a.mtl", "newmtl m\nKd 1 1 1\nmap_Pr x.exr\n");
        }},
       {"ior", "an asset", Help::kWords, "in/a.gltf",
        [](S s) { s.gltf(kPlasticFactor + R"("extensions":{"KHR_materials_ior":{"ior":1000}})"); }},
       {"ignored-by-reader", "specular-glossiness", Help::kCommand, "in/a.gltf --for threejs",
        [](S s) {
          s.gltf(R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.5}})");
        }},
       {"ignored-by-reader", "two assets of one name", Help::kCommand, "in --for threejs",
        [](S s) {
          s.gltf(R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"glossinessFactor":0.5}})");
          for (const std::string folder : {"in/b", "in/c"}) {
            fs::create_directories(s.path(folder));
            fs::copy(s.path("in/a.gltf"), s.path(folder + "/a.gltf"));
          }
        }},
       {"ignored-by-reader", "maps of two sizes", Help::kCommand, "in/a.gltf --for threejs",
        [=](S s) {
          s.map("in/x.png", color);
          s.map("in/y.png", {bumps, bumps, bumps, opposite}, "", OIIO::TypeUInt8, 24, 24);
          s.gltf(kGloss, {"x.png", "y.png"});
        }},
       {"ignored-by-reader", "maps in two places", Help::kCommand, "in/a.gltf --for threejs",
        [=](S s) {
          s.map("in/x.png", color);
          s.map("in/y.png", {bumps, bumps, bumps, opposite});
          s.gltf(
              R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},)"
              R"("specularGlossinessTexture":{"index":1,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}}})",
              {"x.png", "y.png"});
        }},
       {"ignored-by-reader", "specular and ior", Help::kCommand, "in/a.gltf --for godot",
        [](S s) {
          s.gltf(kPlasticFactor +
                 R"("extensions":{"KHR_materials_specular":{"specularColorFactor":[1.5,1.5,1.5]},)"
                 R"("KHR_materials_ior":{"ior":1.4}})");
        }},
       {"ignored-by-reader", "materials of all kinds", Help::kCommand, "in/a.gltf --for gltf",
        [=](S s) {
          s.map("in/x.png", color);
          s.map("in/y.png", {bumps, bumps, bumps, opposite}, "", OIIO::TypeUInt8, 24, 24);
          s.gltf(kGloss + "},{" + kPlasticFactor +
                     R"("extensions":{"KHR_materials_specular":{"specularColorFactor":[1.5,1.5,1.5]}})",
                 {"x.png", "y.png"});
        }},
       {"ignored-by-reader", "ior of a volume", Help::kWords, "in/a.gltf --for godot",
        [](S s) {
          s.gltf(kPlasticFactor +
                 R"("extensions":{"KHR_materials_ior":{"ior":1.4},"KHR_materials_volume":{}})");
        }},
       {"ignored-by-reader", "clearcoat", Help::kWords, "in/a.gltf --for godot",
        [](S s) { s.gltf(R"("extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1}})"); }},
       {"unreadable-statement", "an asset", Help::kWords, "in/a.mtl",
        [](S s) { s.put("in/a.mtl", "newmtl a\nKd .5 .5 .5\nNs shiny\n"); }},
       {"exponent-range", "an asset", Help::kWords, "in/a.mtl",
        [](S s) { s.put("in/a.mtl", "newmtl m\nKs 1 1 1\nNs 0.5\nnewmtl n\nKs 1 1 1\nNs 0.7\n"); }},
       {"duplicate-map", "a set", Help::kWords, "in", [](S s) {
          s.map("in/a_Roughness.png", {bumps});
          s.map("in/a_AO.png", {bumps});
        }}});
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
    fault.make(session);
    const std::vector<nlohmann::json> found = session.findings(fault.rule, fault.checked);
    CHECK_FALSE(found.empty());
    std::set<std::string> typed;
    for (const nlohmann::json& finding : found) {
      const std::string fix = finding["fix"], command = finding["command"];
      CHECK(command.empty() == (fault.help == Help::kWords));
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
    if (fault.help == Help::kWords) continue;
    fs::copy(session.path("fixed"), session.path("in"),
             fs::copy_options::overwrite_existing | fs::copy_options::recursive);
    CHECK(session.findings(fault.rule, fault.checked).empty());
  }
  for (const Rule& rule : rules()) CHECK(rules_with_a_fault.contains(std::string(rule.name)));
}

TEST_CASE("texremap convert: what a refusal proposes is what the command lacks", "[slow]") {
  using S = const AdviceSession&;
  const std::vector<Shape> color = {bumps, opposite, patches};
  const auto specgloss = [color](S s, int size, const std::string& more) {
    s.map("in/x.png", color);
    s.map("in/y.png", {bumps, bumps, bumps, opposite}, "", OIIO::TypeUInt8, size, size);
    s.gltf(R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},)"
           R"("specularGlossinessTexture":{"index":1)" +
               more + "}}}",
           {"x.png", "y.png"});
  };
  const std::string asset = "convert in/a.gltf --to gltf -o out", plain_asset = R"("name":"plain")";
  const std::string set = "convert in --from specular --to gltf -o out";
  const std::string one =
      "convert --from mitsuba/ward --to mitsuba/as --specular 0.04 -o out --roughness in/";
  const auto legacy_set = [color](S s) {
    s.map("in/a_Diffuse.png", color);
    s.map("in/a_Specular.png", color);
    s.map("in/a_Glossiness.png", {opposite});
  };
  const std::vector<Refusal> refusals = {
      {"--resample", asset, asset + " --resample", [=](S s) { specgloss(s, 24, ""); }},
      {"different KHR_texture_transform", asset, asset + " --resample",
       [=](S s) { specgloss(s, kAdviceSide, R"(,"extensions":{"KHR_texture_transform":{"scale":[2,2]}})"); }},
      {"--force", asset, asset + " --force",
       [=](S s) {
         s.gltf(plain_asset);
         require_success(s.texremap(asset));
       }},
      {"before the asset", asset, "convert . in/a.gltf --to gltf -o out",
       [=](S s) {
         s.map("x.png", color);
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
       [](S s) { s.map("in/a.png", {bumps}); }},
      {"--force", one + "../first/a.png", one + "../first/a.png --force",
       [](S s) {
         s.map("in/a.png", {bumps});
         require_success(
             s.texremap("convert --from mitsuba/ward --to mitsuba/as --specular 0.04 -o first "
                        "--roughness in/a.png"));
       }},
      {"--recursive", "convert . --from mitsuba/ward --to mitsuba/as --specular 0.04 -o out",
       "convert . --from mitsuba/ward --to mitsuba/as --specular 0.04 -o out --recursive",
       [](S s) { s.map("in/a_Roughness.png", {bumps}); }},
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
  session.map("x.png", normals(true));
  const std::string bytes = session.content("x.png");
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0u;
    };
    const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int shift = 18; shift >= 0; shift -= 6) text += kDigits[bits >> shift & 63u];
  }
  for (std::size_t i = 0; i < (3 - bytes.size() % 3) % 3; ++i) text[text.size() - 1 - i] = '=';
  session.gltf(R"("normalTexture":{"index":0})", {"data:image/png;base64," + text});
  const std::vector<nlohmann::json> found = session.findings("normal-orientation", "in/a.gltf");
  REQUIRE(found.size() == 1);
  CHECK(found[0]["command"] == "");
  CHECK(found[0]["path"] == "in/a.gltf: image 0");
  CHECK(found[0]["fix"].get<std::string>().find(fs::temp_directory_path().string()) == std::string::npos);
}
