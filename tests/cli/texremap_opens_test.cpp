// This file counts how often texremap opens a file. On the storage of a render farm, each open is a request
// to a server.
#include <fstream>
#include <map>

#include <catch2/catch.hpp>

#include "cli/texremap_tree.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

const Words kOfTree = "convert in --recursive --from mitsuba/ward --to mitsuba/as -o out --threads 2 --quiet";
const Words kOfManifest =
    "convert --manifest sets.jsonl --from mitsuba/ward --to mitsuba/as -o out --part 1/1 --quiet";

// Writes a file of two parts, of which one is the specular color.
void write_parts(const std::string& path) {
  OIIO::ImageSpec color = test_spec(kTreeMapSize, kTreeMapSize, kColor, OIIO::TypeHalf);
  std::vector<OIIO::ImageSpec> specs = {color,
                                        test_spec(kTreeMapSize, kTreeMapSize, {"U", "V"}, OIIO::TypeFloat)};
  specs[0].attribute("oiio:subimagename", "specular");
  specs[1].attribute("oiio:subimagename", "depth");
  const auto output = OIIO::ImageOutput::create(path);
  REQUIRE(output->open(path, 2, specs.data()));
  for (int part = 0; part < 2; ++part) {
    if (part > 0) REQUIRE(output->open(path, specs[1], OIIO::ImageOutput::AppendSubimage));
    const std::vector<float> texels(static_cast<std::size_t>(kTreeMapSize * kTreeMapSize *
                                                             specs[static_cast<std::size_t>(part)].nchannels),
                                    0.3f);
    REQUIRE(output->write_image(OIIO::TypeFloat, texels.data()));
  }
  REQUIRE(output->close());
}

// Writes a set of each format: two maps that are converted, and a normal map that is not.
void write_library(const Tree& tree) {
  for (const std::string format : {"png", "tga", "jpg", "bmp", "exr", "tif"}) {
    const auto type = format == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8;
    tree.map("in/" + format + "_rough." + format, kGrey, type);
    tree.map("in/" + format + "_spec." + format, kColor, type);
    tree.map("in/" + format + "_normal." + format, kColor, type);
  }
  tree.map("in/parts_rough.exr", kGrey, OIIO::TypeHalf);
  write_parts(tree.path("in/parts_spec.exr"));
}

// Returns the number of opens of each file in `in` and `out`. A result is counted under its final name.
std::map<std::string, int> opens(const Tree& tree, const Words& words) {
  fs::remove(tree.path("opens.txt"));
  const ProcessResult result =
      tree.run(Words("/usr/bin/env LD_PRELOAD=" REMAP_FAULTY_STORAGE) +
               Words{"OPENS_LOG=" + tree.path("opens.txt")} + REMAP_TEXREMAP + words);
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  std::map<std::string, int> counts;
  std::ifstream lines(tree.path("opens.txt"));
  for (std::string line; std::getline(lines, line);) {
    const fs::path path = line;
    const std::string folder = path.parent_path().filename().string();
    std::string name = path.filename().string();
    if (name.empty() || name.starts_with(".texremap") || (folder != "in" && folder != "out")) continue;
    if (const std::size_t mark = name.find(".unfinished-"); mark != std::string::npos)
      name = name.substr(1, mark - 1) + path.extension().string();
    ++counts[folder + "/" + name];
  }
  return counts;
}

}  // namespace

// The writers of TIFF, and of EXR with several parts, open the file again through its descriptor.
TEST_CASE("texremap opens: every input once and every result once by its name") {
  const Tree tree;
  write_library(tree);
  const std::map<std::string, int> counts = opens(tree, kOfTree);
  CHECK(counts.size() == 40);
  for (const auto& [name, count] : counts) {
    INFO(name);
    CHECK(count == 1);
  }
  // In a second run, each finished file is read once, to compare it.
  for (const auto& [name, count] : opens(tree, kOfTree + "")) {
    INFO(name);
    CHECK(count == 1);
  }
}

TEST_CASE("texremap opens: a set of a manifest and a turned normal map are opened once") {
  const Tree tree;
  tree.map("in/a_rough.png", kGrey);
  tree.map("in/a_spec.png", kColor);
  REQUIRE(tree.texremap("index in -o sets.jsonl").exit_code == 0);
  const std::map<std::string, int> counts = opens(tree, kOfManifest);
  for (const auto& [name, count] : counts) UNSCOPED_INFO(name << " " << count);
  CHECK(counts ==
        std::map<std::string, int>{
            {"in/a_rough.png", 1}, {"in/a_spec.png", 1}, {"out/a_rough.png", 1}, {"out/a_spec.png", 1}});
  fs::remove_all(tree.path("in"));
  for (const char* name : {"in/wood_BaseColor.png", "in/wood_Normal_OpenGL.png"}) tree.map(name, kColor);
  for (const char* name : {"in/wood_Roughness.png", "in/wood_Metallic.png"}) tree.map(name, kGrey);
  for (const auto& [name, count] :
       opens(tree, "convert in --from metallic --to unreal -o out --force --quiet")) {
    INFO(name);
    CHECK(count == 1);
  }
}
