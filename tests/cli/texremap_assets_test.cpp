// `texremap convert` of glTF files, from the command line.
#include <fstream>

#include "cli/texremap_session.hpp"
#include "core/json.hpp"
#include "support/shared_data.hpp"

using namespace remap;

namespace {

const std::string kPaint =
    R"({"asset":{"version":"2.0"}, "buffers":[{"uri":"a%20b.bin","byteLength":4}],)"
    R"("extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],"materials":[{"name":"paint","extensions":)"
    R"({"KHR_materials_pbrSpecularGlossiness":{}}},{"name":"wood","extensions":{"KHR_materials_pbrSpecularGlossiness":)"
    R"({"glossinessFactor":2}}},{}]})";
const std::string kPaintConverted =
    R"({"asset":{"version":"2.0"}, "buffers":[{"uri":"a%20b.bin","byteLength":4}],)"
    R"("materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":1,)"
    R"("roughnessFactor":0}},{"name":"wood","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":1,)"
    R"("roughnessFactor":0}},{}]})";

class AssetSession : public Session {
 public:
  void put(const std::string& name, const std::string& content) const { write_file(path(name), content); }
  std::string content(const std::string& name) const { return read_file(path(name)); }
};

}  // namespace

TEST_CASE("An asset is converted, and its resources are copied", "[assets]") {
  const AssetSession session;
  session.put("in/paint.gltf", kPaint);
  session.put("in/a b.bin", "1234");
  const ProcessResult run = session.texremap("convert in/paint.gltf --to gltf -o out/deep");
  CHECK(run.exit_code == 0);
  CHECK(run.errors.find("glossinessFactor 2 is outside of 0 to 1 and becomes 1") != std::string::npos);
  CHECK(run.errors.find("in/paint.gltf: 2 materials converted, 1 left as it is") != std::string::npos);
  CHECK(session.content("out/deep/paint.gltf") == kPaintConverted);
  CHECK(session.content("out/deep/a b.bin") == "1234");
  CHECK(session.content("in/paint.gltf") == kPaint);

  CHECK(session.texremap("convert out/deep/paint.gltf --to gltf -o again").exit_code == 0);
  CHECK(session.content("again/paint.gltf") == kPaintConverted);
  CHECK(session.texremap("convert in/paint.gltf --to gltf -o in/paint.gltf --force --quiet").exit_code == 0);
  CHECK(session.content("in/paint.gltf") == kPaintConverted);
}

TEST_CASE("A dry run tells what each material would become", "[assets]") {
  const AssetSession session;
  session.put("paint.gltf", kPaint);
  const ProcessResult run = session.texremap("convert paint.gltf --to gltf -o out --dry-run --json");
  CHECK(run.exit_code == 0);
  CHECK(run.errors.find("material 0 \"paint\": would become base color 1 1 1, metallic 1, roughness 0") !=
        std::string::npos);
  CHECK(run.errors.find("names a b.bin, which is not there") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(session.path("out")));
  const Json json = std::get<Json>(json_of(run.output));
  CHECK(json.find("converted")->whole() == 2);
  CHECK((*json.find("materials")->entries())[1].find("metallic")->number() == 1.0);
}

TEST_CASE("Other assets go on after a failure", "[assets]") {
  const AssetSession session;
  session.put("a.gltf", "{}");
  session.put("b.gltf", R"({"asset":{"version":"2.0"}, "odd" : 1.50})");
  const ProcessResult run =
      session.texremap("convert a.gltf b.gltf --from specgloss --to gltf -o out --json");
  CHECK(run.exit_code == 1);
  CHECK(run.errors.find("1 of 2 assets failed") != std::string::npos);
  CHECK(session.content("out/b.gltf") == session.content("b.gltf"));
  CHECK(session.file_count() == 1);
  CHECK(std::count(run.output.begin(), run.output.end(), '\n') == 2);
}

TEST_CASE("Textures of an asset become new files beside the old ones", "[assets][slow]") {
  const AssetSession session;
  std::filesystem::create_directories(session.path("in"));
  session.make("in/d.png", test_spec(16, 8, {"R", "G", "B"}, OIIO::TypeUInt8), noise);
  session.make("in/s.png", test_spec(16, 8, {"R", "G", "B", "A"}, OIIO::TypeUInt16), noise);
  session.put(
      "in/wood.gltf",
      R"({"asset":{"version":"2.0"},"materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":)"
      R"({"diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1}}}}],)"
      R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"d.png"},{"uri":"s.png"}]})");
  const ProcessResult run = session.texremap("convert in/wood.gltf --to gltf -o out --json");
  CHECK(run.exit_code == 0);
  CHECK(run.errors.find("1 material converted in ") != std::string::npos);
  CHECK(run.errors.find("plus 2 images and 2 copied files") != std::string::npos);
  CHECK(session.file_count() == 5);
  const TestImage base = session.image("out/d_baseColor.png");
  CHECK(base.spec.nchannels == 3);
  CHECK(session.image("out/s_metallicRoughness.png").spec.format == OIIO::TypeUInt16);
  CHECK(session.texremap("convert in/wood.gltf --to gltf -o out").last_error() ==
        "texremap: out/wood.gltf: already exists (--force overwrites)");
  CHECK(session.texremap("convert in/wood.gltf --to gltf -o out --force --quiet").exit_code == 0);
  session.put("in/other.gltf", session.content("in/wood.gltf"));
  CHECK(session.texremap("convert in/wood.gltf in/other.gltf --to gltf -o both").exit_code == 0);
}

// A material of real files by the maps of the same material.
TEST_CASE("Public assets are converted whole", "[assets][slow][needs]") {
  const std::filesystem::path folder = shared_data("assets");
  if (folder.empty()) return;
  const AssetSession session;
  for (const char* name : {"box_specgloss/BoxTextured.gltf", "made/nut_specgloss.glb",
                           "made/nut_shared_factors.glb", "made/boombox_specgloss.glb"}) {
    CAPTURE(name);
    const std::filesystem::path file = folder / name;
    CHECK(session.texremap("convert " + file.string() + " --to gltf -o out --quiet").exit_code == 0);
    const std::string once = "out/" + file.filename().string();
    CHECK(session.texremap("convert " + once + " --to gltf -o again --quiet").exit_code == 0);
    CHECK(session.content(once) == session.content("again/" + file.filename().string()));
  }
  // Its colors would be multiplied by glossiness.
  const ProcessResult webp =
      session.texremap("convert " + (folder / "made/nut_specgloss_webp.glb").string() + " --to gltf -o out");
  CHECK(webp.exit_code == 1);
  CHECK_THAT(webp.errors, Catch::Matchers::Contains("is WebP with alpha"));
}
