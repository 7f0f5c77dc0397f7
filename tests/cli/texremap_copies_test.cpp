// This file tests files of a material that are copied byte for byte, without conversion.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_tree.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr int kCopySize = 24;

void write_map(const Session& session, const std::string& name, const std::vector<std::string>& channels,
               int size = kCopySize) {
  fs::create_directories(fs::path(session.path(name)).parent_path());
  session.make(name, test_spec(size, size, channels, OIIO::TypeUInt8), noise);
}

// Writes a whole material: maps to convert and maps to copy.
void write_set(const Session& session, const std::string& folder) {
  write_map(session, folder + "/wood_Roughness.png", {"Y"});
  write_map(session, folder + "/wood_Specular.png", {"R", "G", "B"});
  write_map(session, folder + "/wood_BaseColor.png", {"R", "G", "B", "A"}, 2 * kCopySize);
  write_map(session, folder + "/wood_Normal.png", {"R", "G", "B"});
  write_map(session, folder + "/wood_AmbientOcclusion.png", {"Y"});
}

ProcessResult convert_copies(const Session& session, Words words) {
  return session.texremap(Words("convert") + words + "--from mitsuba/ward --to mitsuba/as -o out");
}

bool same_bytes(const Session& session, const std::string& a, const std::string& b) {
  return session.content(a) == session.content(b);
}

}  // namespace

TEST_CASE("texremap copies: base color of any size is copied under its name") {
  const Session session;
  write_set(session, "in");
  const ProcessResult result = require_success(
      convert_copies(session,
                     "--roughness in/wood_Roughness.png --specular 0.04 --only roughness --base-color "
                     "in/wood_BaseColor.png --input occlusion=in/wood_AmbientOcclusion.png --json"));
  CHECK(session.file_count() == 3);
  CHECK(same_bytes(session, "in/wood_BaseColor.png", "out/wood_BaseColor.png"));
  CHECK(same_bytes(session, "in/wood_AmbientOcclusion.png", "out/wood_AmbientOcclusion.png"));
  CHECK(nlohmann::json::parse(result.output).at("copies").size() == 2);
}

TEST_CASE("texremap copies: layouts that name their files name the copies, too", "[slow]") {
  const Session session;
  write_set(session, "in");
  const std::string layout = GENERATE("separate", "orm", "specgloss");
  const std::string option = GENERATE("--diffuse", "--base-color");
  require_success(
      convert_copies(session, "--roughness in/wood_Roughness.png --specular in/wood_Specular.png " + option +
                                  " in/wood_BaseColor.png --layout " + layout));
  const std::string name = option == "--diffuse" ? "diffuse" : "base_color";
  CHECK(same_bytes(session, "in/wood_BaseColor.png", "out/" + name + ".png"));
}

TEST_CASE("texremap copies: specgloss writes separate files for parameters without a channel") {
  const Session session;
  write_set(session, "in");
  require_success(
      convert_copies(session,
                     "--roughness in/wood_Roughness.png --specular in/wood_Specular.png --input occlusion="
                     "in/wood_AmbientOcclusion.png --metallic 0.5 --layout specgloss"));
  CHECK(session.file_count() == 3);
  const TestImage occlusion = session.image("in/wood_AmbientOcclusion.png"),
                  copied = session.image("out/occlusion.png"), metallic = session.image("out/metallic.png");
  CHECK(copied.at(3, 5, 0) == occlusion.at(3, 5, 0));
  CHECK(metallic.at(3, 5, 0) == as_stored(0.5f, OIIO::TypeUInt8));
}

TEST_CASE("texremap copies: a tree with all maps is copied and resumed", "[slow]") {
  const Session session;
  write_set(session, "in/a");
  write_set(session, "in/b/c");
  const Words words = "in --recursive ";
  require_success(convert_copies(session, words));
  for (const std::string folder : {"a", "b/c"}) {
    for (const std::string map : {"BaseColor", "Normal", "AmbientOcclusion"}) {
      const std::string name = folder + "/wood_" + map + ".png";
      CHECK(same_bytes(session, "in/" + name, "out/" + name));
    }
    CHECK_FALSE(
        same_bytes(session, "in/" + folder + "/wood_Roughness.png", "out/" + folder + "/wood_Roughness.png"));
  }

  const auto states = [&] {
    return set_states(require_success(convert_copies(session, words + "--json")).output);
  };
  CHECK(states() == "dd");
  fs::remove(session.path("out/a/wood_Normal.png"));
  CHECK(states() == "cd");
  write_map(session, "in/b/c/wood_Normal.png", {"R", "G", "B"}, 2 * kCopySize);
  CHECK(states() == "dc");
  for (const char* name : {"a/wood_Normal.png", "b/c/wood_Normal.png"})
    CHECK(same_bytes(session, std::string("in/") + name, std::string("out/") + name));
}

TEST_CASE("texremap copies: a packed map is not copied as well") {
  const Session session;
  write_set(session, "in");
  require_success(convert_copies(session, "in --layout orm"));
  CHECK(fs::exists(session.path("out/wood_orm.png")));
  CHECK(fs::exists(session.path("out/wood_Normal.png")));
  CHECK_FALSE(fs::exists(session.path("out/wood_AmbientOcclusion.png")));
}

TEST_CASE("texremap copies: each tile copies the same tile of other maps") {
  const Session session;
  for (const std::string tile : {"1001", "1002"}) {
    write_map(session, "r." + tile + ".png", {"Y"});
    write_map(session, "ao." + tile + ".png", {"Y"});
    write_map(session, "d." + tile + ".png", {"R", "G", "B"});
  }
  require_success(
      convert_copies(session,
                     "--roughness r.<UDIM>.png --specular 0.04 --input occlusion=ao.<UDIM>.png --diffuse "
                     "d.<UDIM>.png --layout orm"));
  CHECK(same_bytes(session, "d.1002.png", "out/diffuse.1002.png"));
  CHECK(session.image("out/orm.1002.png").at(2, 3, 0) == session.image("ao.1002.png").at(2, 3, 0));
}

TEST_CASE(
    "texremap copies: a preset turns green of normal maps whose names say that it points the other way") {
  const Session session;
  for (const std::string name :
       {"wood_BaseColor.png", "wood_Normal_OpenGL.png", "tin_BaseColor.png", "tin_Normal.png",
        "oak_BaseColor.png", "oak_NormalGL.png", "oak_NormalDX.png"})
    write_map(session, "in/" + name, {"R", "G", "B"});
  for (const std::string set : {"wood", "tin", "oak"})
    for (const std::string map : {"Roughness", "Metallic"})
      write_map(session, "in/" + set + "_" + map + ".png", {"Y"});
  const Words words = "convert in --from metallic --to";
  const ProcessResult down = require_success(session.texremap(words + "unreal -o unreal"));
  CHECK_THAT(
      down.errors,
      Contains("wood_Normal_OpenGL.png: green is inverted in the copy wood_Normal_DirectX.png, because "
               "its name means OpenGL (green up), but unreal reads DirectX (green down)") &&
          Contains("tin_Normal.png: green is kept, because neither the file name nor --from shows"));
  CHECK_FALSE(fs::exists(session.path("unreal/wood_Normal_OpenGL.png")));
  const TestImage before = session.image("in/wood_Normal_OpenGL.png"),
                  after = session.image("unreal/wood_Normal_DirectX.png");
  CHECK(after.at(3, 5, 0) == before.at(3, 5, 0));
  CHECK(after.at(3, 5, 1) == Approx(1.0f - before.at(3, 5, 1)));
  CHECK(same_bytes(session, "in/tin_Normal.png", "unreal/tin_Normal.png"));
  for (const std::string name : {"oak_NormalGL.png", "oak_NormalDX.png"})
    CHECK(same_bytes(session, "in/" + name, "unreal/" + name));

  const ProcessResult up = require_success(session.texremap(words + "gltf -o gltf"));
  CHECK_THAT(up.errors, !Contains("inverted"));
  CHECK(same_bytes(session, "in/wood_Normal_OpenGL.png", "gltf/wood_Normal_OpenGL.png"));
  CHECK_THAT(require_success(session.texremap(words + "unreal -o planned --dry-run")).output,
             Contains("green inverted"));
}
