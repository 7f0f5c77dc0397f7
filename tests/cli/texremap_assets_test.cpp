// This file tests `texremap convert` of glTF files from the command line.
#include <fstream>

#include "cli/texremap_session.hpp"
#include "core/json_field.hpp"
#include "support/shared_data.hpp"

using namespace remap;
using Catch::Matchers::Contains;

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

// Returns a glTF file of one material, which uses these images.
std::string textured(const std::string& diffuse, const std::string& specgloss, const std::string& factor) {
  return R"({"asset":{"version":"2.0"},"materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":)"
         R"({"diffuseFactor":[)" +
         factor + R"(,1,1,1],"diffuseTexture":{"index":0},"specularGlossinessTexture":{"index":1}}}}],)" +
         R"("textures":[{"source":0},{"source":1}],"images":[{"uri":")" + diffuse + R"("},{"uri":")" +
         specgloss + R"("}]})";
}

}  // namespace

TEST_CASE("An asset is converted, and its resources are copied", "[assets]") {
  const Session session;
  session.put("in/paint.gltf", kPaint);
  session.put("in/a b.bin", "1234");
  const ProcessResult run = session.texremap("convert in/paint.gltf --to gltf -o out/deep");
  CHECK(run.exit_code == 0);
  CHECK(run.errors.find("glossinessFactor 2 is outside of 0 to 1 and becomes 1") != std::string::npos);
  CHECK(run.errors.find("in/paint.gltf: 2 materials converted, 1 unchanged") != std::string::npos);
  CHECK(session.content("out/deep/paint.gltf") == kPaintConverted);
  CHECK(session.content("out/deep/a b.bin") == "1234");
  CHECK(session.content("in/paint.gltf") == kPaint);

  CHECK(session.texremap("convert out/deep/paint.gltf --to gltf -o again").exit_code == 0);
  CHECK(session.content("again/paint.gltf") == kPaintConverted);
  CHECK(session.texremap("convert in/paint.gltf --to gltf -o in/paint.gltf --force --quiet").exit_code == 0);
  CHECK(session.content("in/paint.gltf") == kPaintConverted);
}

TEST_CASE("A dry run tells what each material would become", "[assets]") {
  const Session session;
  session.put("paint.gltf", kPaint);
  const ProcessResult run = session.texremap("convert paint.gltf --to gltf -o out --dry-run --json");
  CHECK(run.exit_code == 0);
  CHECK(run.errors.find("material 0 \"paint\": would become base color 1 1 1, metallic 1, roughness 0") !=
        std::string::npos);
  CHECK(run.errors.find("refers to a b.bin, which was not found") != std::string::npos);
  CHECK_FALSE(session.exists("out"));
  const Json json = parse_json(run.output, "output");
  CHECK(*json.find("state")->text() == "planned");
  CHECK((*json.find("materials")->entries())[1].find("metallic")->number() == 1.0);
}

TEST_CASE("Other assets go on after a failure", "[assets]") {
  const Session session;
  session.put("a.gltf", "{}");
  session.put("b.gltf", R"({"asset":{"version":"2.0"}, "odd" : 1.50})");
  const ProcessResult run =
      session.texremap("convert a.gltf b.gltf --from specgloss --to gltf -o out --json");
  CHECK(run.exit_code == 1);
  CHECK(run.errors.find("1 of 2 assets failed") != std::string::npos);
  CHECK(session.content("out/b.gltf") == session.content("b.gltf"));
  CHECK(session.file_count() == 1);
  CHECK(std::count(run.output.begin(), run.output.end(), '\n') ==
        4);  // one line each for the conversion, two assets and the summary
}

TEST_CASE("Textures of an asset become new files beside the old ones", "[assets][slow]") {
  const Session session;
  session.map("in/d.png", kColor);
  session.map("in/s.png", kWithAlpha, OIIO::TypeUInt16);
  session.put("in/wood.gltf", textured("d.png", "s.png", "1"));
  const ProcessResult run = session.texremap("convert in/wood.gltf --to gltf -o out --json");
  CHECK(run.exit_code == 0);
  CHECK(run.errors.find("1 material converted in ") != std::string::npos);
  CHECK(run.errors.find("plus 2 new files") != std::string::npos);
  CHECK(session.file_count() == 3);
  const TestImage base = session.image("out/d_baseColor.png");
  CHECK(base.spec.nchannels == 3);
  CHECK(session.image("out/s_metallicRoughness.png").spec.format == OIIO::TypeUInt16);
  CHECK(session.texremap("convert in/wood.gltf --to gltf -o out --force --quiet").exit_code == 0);
  session.put("in/other.gltf", session.content("in/wood.gltf"));
  CHECK(session.texremap("convert in/wood.gltf in/other.gltf --to gltf -o both").exit_code == 0);
  // The compression level of PNG changes the size of the file, but not its texels.
  const auto wavy = [](int x, int y, int c) { return static_cast<float>((x * y + 5 * c) % 23) / 23.0f; };
  session.make("in/d.png", test_spec(128, 64, {"R", "G", "B"}, OIIO::TypeUInt8), wavy);
  session.make("in/s.png", test_spec(128, 64, {"R", "G", "B", "A"}, OIIO::TypeUInt8), wavy);
  for (const std::string level : {"1", "9"})
    CHECK(session.texremap("convert in/wood.gltf --to gltf -o l" + level + " --compression " + level)
              .exit_code == 0);
  CHECK(session.content("l1/d_baseColor.png").size() > session.content("l9/d_baseColor.png").size());
  CHECK(session.image("l1/d_baseColor.png").values == session.image("l9/d_baseColor.png").values);
}

namespace {

// Writes two assets that share images of another folder, an asset whose image is missing, and a plain asset.
void put_library(const Session& session) {
  session.map("lib/maps/d.png", kColor);
  session.map("lib/maps/s.png", kWithAlpha);
  session.put("lib/chairs/a b.gltf", textured("../maps/d.png", "../maps/s.png", "1"));
  session.put("lib/chairs/c.gltf", textured("../maps/d.png", "../maps/s.png", "0.5"));
  session.put("lib/plain.gltf", R"({"asset":{"version":"2.0"}, "odd" : 1.50})");
}

}  // namespace

TEST_CASE("A folder of assets is converted as a tree, and goes on where it ended", "[assets][slow]") {
  const Session session;
  put_library(session);
  session.put("lib/broken.gltf", textured("maps/none.png", "maps/s.png", "1"));
  const std::string command = "convert lib --assets --recursive --to gltf -o out";
  const ProcessResult dry = session.texremap(command + " --dry-run --json");
  CHECK(dry.exit_code == 1);
  CHECK_THAT(dry.errors, Contains("material 0: would become base color map times"));
  CHECK_FALSE(session.exists("out"));

  const ProcessResult run = session.texremap(command + " --json");
  CHECK(run.exit_code == 1);
  CHECK(run.last_error() == "texremap: 1 of 4 assets failed");
  CHECK_THAT(run.output,
             Contains(R"({"summary":{)") && Contains(R"("done_before":0)") && Contains(R"("converted":3)"));
  CHECK(session.content("out/plain.gltf") == session.content("lib/plain.gltf"));
  CHECK_FALSE(session.exists("out/maps/d.png"));  // nothing uses this image any more
  // Without a prefix, both assets would add maps/d_baseColor.png, with different content.
  CHECK_THAT(session.content("out/chairs/a b.gltf"), Contains(R"("uri":"../maps/a%20b_d_baseColor.png")"));
  CHECK(session.exists("out/maps/a b_d_baseColor.png"));
  CHECK(session.exists("out/maps/c_d_baseColor.png"));

  const std::string whole = session.content("out/chairs/c.gltf");
  session.put("out/chairs/c.gltf", "damaged");
  session.put("lib/plain.gltf", R"({"asset":{"version":"2.0"}})");
  session.map("lib/maps/none.png", kColor);
  const ProcessResult resumed = session.texremap(command);
  CHECK(resumed.exit_code == 0);
  CHECK_THAT(resumed.errors, Contains("3 assets converted in ") && Contains(" s, 0 failed, 1 done before"));
  CHECK(session.content("out/chairs/c.gltf") == whole);
  CHECK(session.content("out/plain.gltf") == session.content("lib/plain.gltf"));
  CHECK_THAT(session.texremap(command).errors,
             Contains("0 assets converted in ") && Contains(" s, 0 failed, 4 done before"));
  CHECK_THAT(session.texremap(command + " --extensions write").last_error(),
             Contains("holds results of another conversion"));
  // A run with one thread into a new folder gives the same bytes.
  CHECK(session.texremap("convert lib --assets --recursive --to gltf -o one --threads 1").exit_code == 0);
  for (const char* name : {"chairs/a b.gltf", "chairs/c.gltf", "maps/a b_d_baseColor.png"})
    CHECK(session.content(std::string("one/") + name) == session.content(std::string("out/") + name));
}

TEST_CASE("Assets read what lies below their root", "[assets][slow]") {
  const Session session;
  put_library(session);
  CHECK(session.texremap("convert lib lib/chairs/c.gltf --to gltf -o out").exit_code == 0);
  CHECK(session.exists("out/chairs/c.gltf"));
  CHECK(session.exists("out/maps/d_baseColor.png"));
}

TEST_CASE("Materials go to spec-gloss and back", "[assets]") {
  const Session session;
  session.put("a.gltf",
              R"({"asset":{"version":"2.0"}, "materials":[{"pbrMetallicRoughness":{"baseColorFactor":)"
              R"([1.0,0.77,0.34,1],"metallicFactor":1,"roughnessFactor":0.25}}]})");
  CHECK(session.texremap("convert a.gltf --to gltf-specgloss -o there").exit_code == 0);
  CHECK_THAT(session.content("there/a.gltf"),
             Contains(R"("glossinessFactor":0.75)") && Contains(R"("specularFactor":[1.0,0.77,0.34])"));
  CHECK(session.texremap("convert there/a.gltf --to gltf-specgloss -o again").exit_code == 0);
  CHECK(session.content("again/a.gltf") == session.content("there/a.gltf"));
  CHECK(session.texremap("convert there/a.gltf --to gltf -o back").exit_code == 0);
  CHECK_THAT(session.content("back/a.gltf"), Contains(R"("baseColorFactor":[1.0,0.77,0.34,1])") ||
                                                 Contains(R"("baseColorFactor":[1,0.77,0.34,1])"));
  CHECK(session.content("back/a.gltf").find("pbrSpecularGlossiness") == std::string::npos);
}

TEST_CASE("MTL files keep their other lines, and OBJ files become glTF", "[assets]") {
  const Session session;
  session.put("o/a.mtl", "# by hand\r\nnewmtl paint\r\nNs 96.08\r\nKs .5 .5 .5\r\nKd .64 .64 .64\r\n");
  session.put("o/a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl paint\nf 1 2 3\n");
  CHECK(session.texremap("convert o/a.mtl --to gltf -o m").exit_code == 0);
  CHECK_THAT(session.content("m/a.mtl"),
             Catch::Matchers::StartsWith("# by hand\r\nnewmtl paint\r\nNs 96.08\r\nKs .5 .5 .5\r\n") &&
                 Contains("\r\nPr ") && Contains("\r\nPm 0\r\n"));
  CHECK(session.texremap("convert o --assets --to gltf --format gltf -o g").exit_code == 0);
  CHECK(session.exists("g/a.gltf"));
  CHECK(session.exists("g/a.bin"));
  CHECK_THAT(session.texremap("convert o --assets --to gltf --format gltf -o g").errors,
             Contains("1 done before"));
  CHECK(session.texremap("convert o/a.obj --to gltf -o a.glb").exit_code == 0);
  CHECK(session.content("a.glb").starts_with("glTF"));
}

TEST_CASE("A folder of sets leaves out its assets", "[assets][slow]") {
  const Session session;
  put_library(session);
  session.map("lib/w_diffuse.png", kColor);
  session.map("lib/w_specularGlossiness.png", kWithAlpha);
  CHECK_THAT(require_success(session.texremap("convert lib --to gltf -o out")).errors,
             Contains("1 asset skipped"));
}

// Converts a material of real files, and compares it with a conversion of the maps of the same material.
TEST_CASE("Public assets are converted whole", "[assets][slow][needs]") {
  const std::filesystem::path folder = shared_data("assets");
  if (folder.empty()) return;
  const Session session;
  for (const char* name :
       {"box_specgloss/BoxTextured.gltf", "made/nut_specgloss.glb", "made/nut_shared_factors.glb",
        "made/nut_specgloss_webp.glb", "made/boombox_specgloss.glb"}) {
    CAPTURE(name);
    const std::filesystem::path file = folder / name;
    CHECK(session.texremap("convert " + file.string() + " --to gltf -o out --quiet").exit_code == 0);
    const std::string once = "out/" + file.filename().string();
    CHECK(session.texremap("convert " + once + " --to gltf -o again --quiet").exit_code == 0);
    CHECK(session.content(once) == session.content("again/" + file.filename().string()));
  }
}
