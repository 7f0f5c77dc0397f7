// This file tests conversions in parts: the manifest of a tree, parts and their reports, and what a part
// leaves for the next run.
#include <cerrno>
#include <fstream>
#include <set>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr const char* kParts = ".texremap-parts";
// A plan contains the path of the program, so texremap is started by its path here.
const Words kByItsFile = "/usr/bin/env " REMAP_TEXREMAP;
const std::string kOfManifest = "convert --manifest sets.jsonl --from mitsuba/ward --to mitsuba/as -o ";

// Writes sets of several sizes, folders and formats, and one with tiles.
void write_library(const Session& tree) {
  for (int i = 0; i < 7; ++i) {
    const std::string name = "in/f" + std::to_string(i % 3) + "/s" + std::to_string(i);
    tree.write_set(name, i % 2 == 0 ? "png" : "tga", OIIO::TypeUInt8, 8 + 8 * i);
  }
  for (const char* tile : {"1001", "1002"}) {
    tree.map(std::string("in/tiled/t_rough.") + tile + ".exr", kGrey, OIIO::TypeHalf);
    tree.map(std::string("in/tiled/t_spec.") + tile + ".exr", kColor, OIIO::TypeHalf);
  }
}

void index(const Session& tree) { REQUIRE(tree.texremap("index in -o sets.jsonl --force").exit_code == 0); }

ProcessResult part(const Session& tree, const std::string& which, const Words& more = {}) {
  return tree.texremap(kOfManifest + "out --json --part " + which + more);
}

nlohmann::json merged(const Session& tree, int exit_code) {
  const ProcessResult result = tree.texremap("merge-reports out --json");
  INFO(result.errors);
  CHECK(result.exit_code == exit_code);
  std::string last;
  std::istringstream lines(result.output);
  for (std::string line; std::getline(lines, line);) last = line;
  return last.empty() ? nlohmann::json() : nlohmann::json::parse(last)["summary"];
}

}  // namespace

TEST_CASE("texremap parts: the union of the parts is what one process makes", "[slow]") {
  const Session tree;
  write_library(tree);
  index(tree);
  REQUIRE(tree.texremap(kOfManifest + "one").exit_code == 0);
  CHECK(tree.texremap("convert in --recursive --from mitsuba/ward --to mitsuba/as -o walked").exit_code == 0);
  std::multiset<std::string> names;
  for (int i = 1; i <= 4; ++i) {
    const ProcessResult result = part(tree, std::to_string(i) + "/4");
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const nlohmann::json report = tree_report(result.output);
    for (const auto& set : report["sets"]) names.insert(set["name"].get<std::string>());
    CHECK(tree.exists("out/" + std::string(kParts) + "/part-000" + std::to_string(i) + "-of-0004.jsonl"));
  }
  CHECK(names.size() == 8);
  CHECK(std::set(names.begin(), names.end()).size() == 8);
  const auto one = tree.contents("one");
  CHECK(one.size() == 18);
  CHECK(tree.contents("out") == one);
  CHECK(tree.contents("walked") == one);
  const auto summary = merged(tree, 0);
  CHECK(summary["converted"] == 8);
  CHECK(summary["parts"] == 4);
}

TEST_CASE("texremap parts: a manifest is the same however the tree is listed, and holds every file once") {
  const Session tree;
  write_library(tree);
  index(tree);
  const std::string first = tree.content("sets.jsonl");
  index(tree);
  CHECK(tree.content("sets.jsonl") == first);
  std::istringstream lines(first);
  std::string line;
  std::getline(lines, line);
  const auto head = nlohmann::json::parse(line);
  std::uint64_t cost = 0, bytes = 0, sets = 0;
  while (std::getline(lines, line)) {
    const auto set = nlohmann::json::parse(line);
    cost += set["cost"].get<std::uint64_t>();
    bytes += set["bytes"].get<std::uint64_t>();
    ++sets;
  }
  CHECK(head["sets"] == sets);
  CHECK(head["files"] == 18);
  CHECK(head["cost"] == cost);
  CHECK(head["bytes"] == bytes);
}

TEST_CASE("texremap parts: a part goes on where it ended, and finds what another part has done", "[slow]") {
  const Session tree;
  write_library(tree);
  index(tree);
  const auto states = [&](const std::string& which) {
    const ProcessResult result = part(tree, which, "");
    INFO(result.errors);
    CHECK(result.exit_code == 0);
    return set_states(result.output);
  };
  const std::string first = states("1/2"), second = states("2/2");
  CHECK(first.size() + second.size() == 8);
  CHECK(states("1/2") == std::string(first.size(), 'd'));
  fs::remove(tree.path("out/f0/s0_rough.png"));
  CHECK(states("1/2").find('c') != std::string::npos);
  // With three parts, other parts have the sets, but nothing is made again.
  CHECK(states("1/3") + states("2/3") + states("3/3") == "dddddddd");
  tree.write_set("in/a", "png");
  index(tree);
  std::string all = states("1/2") + states("2/2");
  std::sort(all.begin(), all.end());
  CHECK(all == "cdddddddd");
  CHECK(tree.texremap(kOfManifest + "out --quiet").exit_code == 0);
  // A different conversion is refused, whichever part it is in.
  const ProcessResult other =
      tree.texremap("convert --manifest sets.jsonl --from mitsuba/ward --to mitsuba/ggx -o out --part 7/9");
  CHECK(other.exit_code == 1);
  CHECK_THAT(other.errors, Contains("holds results of another conversion"));
}

TEST_CASE("texremap parts: a part of a manifest that has changed since is named", "[slow]") {
  const Session tree;
  write_library(tree);
  index(tree);
  for (const char* which : {"1/2", "2/2"}) CHECK(part(tree, which).exit_code == 0);
  CHECK(merged(tree, 0)["problems"].empty());
  tree.write_set("in/zz/z", "png");
  index(tree);
  CHECK(part(tree, "2/2", "").exit_code == 0);
  CHECK_THAT(merged(tree, 1)["problems"][0].get<std::string>(), Contains("part-0002-of-0002: has manifest"));
  CHECK(part(tree, "1/2", "").exit_code == 0);
  CHECK(merged(tree, 0)["problems"].empty());
}

TEST_CASE("texremap parts: schedulers tell the part by their variables", "[slow]") {
  const Session tree;
  write_library(tree);
  index(tree);
  const auto note = [&](const std::string& environment, const std::string& which) {
    const ProcessResult result =
        require_success(tree.run(Words("/usr/bin/env " + environment) + REMAP_TEXREMAP + kOfManifest +
                                 Words("out --dry-run --part " + which)));
    const std::size_t place = result.errors.find(" is part ") + 9;
    return result.errors.substr(place, result.errors.find('\n', place) - place);
  };
  const std::string slurm = "SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_MAX=8 ";
  CHECK(note(slurm + "SLURM_ARRAY_TASK_COUNT=4", "auto") == "3 of 4");
  CHECK(note(slurm + "SLURM_ARRAY_TASK_COUNT=4", "auto/20") == "7 of 20");
  CHECK(note("AWS_BATCH_JOB_ARRAY_INDEX=0 AWS_BATCH_JOB_ARRAY_SIZE=12", "auto") == "1 of 12");
  CHECK(note("AWS_BATCH_JOB_ARRAY_INDEX=1", "auto/4") == "2 of 4");
  CHECK(note("JOB_COMPLETION_INDEX=4", "auto/5") == "5 of 5");
  CHECK(note("SGE_TASK_ID=3 SGE_TASK_FIRST=1 SGE_TASK_LAST=4 SGE_TASK_STEPSIZE=1", "auto") == "3 of 4");
  CHECK(note("PBS_ARRAY_INDEX=2", "auto/6") == "2 of 6");
  CHECK(note("LSB_JOBINDEX=2 LSB_JOBINDEX_END=6 LSB_JOBINDEX_STEP=1", "auto") == "2 of 6");
  CHECK(note("LSB_JOBINDEX=2 SGE_TASK_ID=undefined", "auto/4") == "2 of 4");
  CHECK(note("PARALLEL_SEQ=9", "auto/9") == "9 of 9");
}

TEST_CASE("texremap parts: files that are gone or have another size fail their set alone") {
  const Session tree;
  write_library(tree);
  index(tree);
  fs::remove(tree.path("in/f0/s0_spec.png"));
  tree.map("in/f1/s1_rough.tga", kGrey, OIIO::TypeUInt8, 40);
  fs::rename(tree.path("in"), tree.path("moved"));
  CHECK_THAT(tree.texremap(kOfManifest + "out").errors, Contains("give its new path as DIR"));
  const ProcessResult result = tree.texremap(kOfManifest + "out moved --json");
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.errors, Contains("s0_spec.png: is in the manifest, but cannot be read: No such file or "
                                     "directory (run texremap index again)") &&
                                Contains("but the manifest lists"));
  std::string states = set_states(result.output);
  std::sort(states.begin(), states.end());
  CHECK(states == "ccccccff");
}

TEST_CASE("texremap parts: storage that does not answer is asked again, a full one ends with 75", "[slow]") {
  const Session tree;
  write_library(tree);
  index(tree);
  const auto with_faults = [&](const std::string& name, int count, int code) {
    return tree.run(Words("/usr/bin/env LD_PRELOAD=" REMAP_FAULTY_STORAGE " FAULT_NAME=" + name +
                          " FAULT_COUNT=" + std::to_string(count) + " FAULT_CODE=" + std::to_string(code)) +
                    REMAP_TEXREMAP + kOfManifest + Words("out --part 1/1 --json"));
  };
  for (const int code : {ESTALE, EIO}) {
    const ProcessResult result = with_faults("s0_rough.png", 3, code);
    INFO(result.errors);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.output, Contains("tried again after") && Contains("s0_rough.png"));
    fs::remove_all(tree.path("out"));
  }
  const ProcessResult lost = with_faults("s0_rough.png", 1000, ESTALE);
  CHECK(lost.exit_code == 75);
  CHECK_THAT(lost.errors, Contains("Stale file handle"));
  CHECK(set_states(lost.output) == "fccccccc");
  const ProcessResult full = with_faults(".s0_spec.unfinished", 1000, ENOSPC);
  CHECK(full.exit_code == 75);
  CHECK_THAT(full.errors, Contains("No space left on device"));
  CHECK(with_faults("none", 0, 0).exit_code == 0);
}

TEST_CASE("texremap parts: plans name every part") {
  const Session tree;
  write_library(tree);
  index(tree);
  const Words options = Words("-- --from mitsuba/ward --to mitsuba/as -o") + Words{std::string("o u t")};
  const Words plan_words = "plan commands --manifest sets.jsonl --parts 3 -o plan";
  const ProcessResult plan = tree.run(kByItsFile + plan_words + options);
  INFO(plan.errors);
  CHECK(plan.exit_code == 0);
  CHECK_FALSE(tree.exists("o u t"));
  std::istringstream lines(tree.content("plan/commands.txt"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    tree.put("line.sh", line + "\n");
    const ProcessResult result = tree.run("/bin/sh line.sh");
    INFO(line << "\n" << result.errors);
    CHECK(result.exit_code == 0);
  }
  CHECK(count == 3);
  CHECK(tree.run("/bin/sh plan/merge.sh").exit_code == 0);
  CHECK(tree.contents("o u t").size() == 18);
  CHECK(tree.exists("plan/report.jsonl"));
  CHECK_THAT(tree.texremap(plan_words + options).errors, Contains("already exists (--force overwrites)"));
}

namespace {

const std::string kOfAssets = "convert --manifest assets.jsonl --to gltf -o ";

// Writes a file whose material has one texture for diffuse and one for specular and glossiness.
void write_asset(const Session& tree, const std::string& name, const std::string& image) {
  tree.put(
      name,
      R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],)"
      R"("materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0},)"
      R"("specularGlossinessTexture":{"index":1}}}}],"textures":[{"source":0},{"source":1}],)"
      R"("images":[{"uri":")" +
          image + R"(_d.png"},{"uri":")" + image + R"(_s.png"}]})");
}

// Writes four assets in two folders. Two of them share the images of a third folder, and the images of one
// are missing.
void write_assets(const Session& tree) {
  for (const char* image : {"in/maps/wood", "in/a/own"}) {
    tree.map(std::string(image) + "_d.png", kColor, OIIO::TypeUInt8, 16);
    tree.map(std::string(image) + "_s.png", kWithAlpha, OIIO::TypeUInt8, 16);
  }
  fs::create_directories(tree.path("in/b"));
  write_asset(tree, "in/a/table.gltf", "../maps/wood");
  write_asset(tree, "in/b/chair.gltf", "../maps/wood");
  write_asset(tree, "in/a/lamp.gltf", "own");
  tree.put("in/b/paint.mtl", "newmtl paint\nKd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 50\n");
}

}  // namespace

TEST_CASE("texremap parts: the union of the parts of assets is what one process makes", "[slow]") {
  const Session tree;
  write_assets(tree);
  const ProcessResult index = tree.texremap("index in --assets -o assets.jsonl --json");
  INFO(index.errors);
  REQUIRE(index.exit_code == 0);
  CHECK(nlohmann::json::parse(index.output)["assets"] == 4);
  CHECK(nlohmann::json::parse(index.output)["files"] == 10);  // shared images are counted for each asset
  CHECK(tree.texremap("convert in --assets --recursive --to gltf -o walked").exit_code == 0);
  CHECK(tree.texremap(kOfAssets + "one").exit_code == 0);
  const auto states = [&](const std::string& more) {
    std::string all;
    for (const char* which : {"1/3", "2/3", "3/3"}) {
      const ProcessResult result = tree.texremap(kOfAssets + "out --json --part " + which + Words(more));
      INFO(result.errors);
      CHECK(result.exit_code == 0);
      std::istringstream lines(result.output);
      for (std::string line; std::getline(lines, line);) {
        const auto json = nlohmann::json::parse(line);
        if (json.contains("asset")) all += json["asset"]["state"] == "done before" ? 'd' : 'c';
      }
    }
    return all;
  };
  CHECK(states("") == "cccc");
  const auto one = tree.contents("one");
  CHECK(one.size() == 10);  // 4 assets and 6 new images; shared images become new images of each asset
  CHECK(tree.contents("out") == one);
  CHECK(tree.contents("walked") == one);
  const auto summary = merged(tree, 0);
  CHECK(summary["assets"] == 4);
  CHECK(summary["converted"] == 4);
  CHECK(states("") == "dddd");
  fs::remove(tree.path("out/b/chair.gltf"));
  CHECK(states("").find('c') != std::string::npos);
}

TEST_CASE("texremap parts: an asset that fails is named, and files that changed fail their asset alone") {
  const Session tree;
  write_assets(tree);
  tree.put("in/b/broken.gltf", "{");
  REQUIRE(tree.texremap("index in --assets -o assets.jsonl").exit_code == 0);
  tree.map("in/a/own_s.png", kWithAlpha, OIIO::TypeUInt8, 32);
  for (const char* which : {"1/2", "2/2"}) tree.texremap(kOfAssets + "out --quiet --part " + which);
  const auto summary = merged(tree, 1);
  CHECK(summary["assets"] == 5);
  CHECK(summary["converted"] == 3);
  CHECK(summary["failed"] == 2);
  const std::string errors = tree.texremap("merge-reports out").errors;
  CHECK_THAT(errors,
             Contains("broken.gltf: ") && Contains("lamp.gltf: ") && Contains("but the manifest lists"));
  CHECK_FALSE(tree.exists("out/a/lamp.gltf"));
  CHECK(tree.exists("out/b/chair.gltf"));
}

TEST_CASE("texremap parts: plans hand out assets as they hand out sets") {
  const Session tree;
  write_assets(tree);
  REQUIRE(tree.texremap("index in --assets -o assets.jsonl").exit_code == 0);
  const ProcessResult plan =
      tree.run(kByItsFile + "plan commands --manifest assets.jsonl --parts 2 -o plan -- --to gltf -o out");
  INFO(plan.errors);
  REQUIRE(plan.exit_code == 0);
  CHECK_THAT(plan.errors, Contains("4 assets in 2 parts"));
  CHECK(tree.run("/bin/sh plan/commands.txt").exit_code == 0);
  CHECK(tree.run("/bin/sh plan/merge.sh").exit_code == 0);
  CHECK(tree.contents("out").size() == 10);
}
