// This file tests what a run of a folder leaves for the next run: the journal, resumed and repeated runs,
// simultaneous runs, and what a killed run has reported.
#include <csignal>
#include <fstream>
#include <set>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void write_sets(const Session& tree, int count, const std::string& extension, int size = kMapSize) {
  for (int i = 0; i < count; ++i)
    tree.write_set("in/s" + std::to_string(i), extension, OIIO::TypeUInt8, size);
}

Words command(const std::string& target, const Words& more = {}) {
  return "convert in --from mitsuba/ward --to " + target + " -o out" + more;
}

// Returns the states of the sets in a resumed run, or its messages if it has no sets.
std::string states(const Session& tree, const Words& more, const std::string& target = "mitsuba/as") {
  const ProcessResult result = tree.texremap(command(target, "--json" + more));
  INFO(result.errors);
  const std::string letters = set_states(result.output);
  return letters.empty() ? result.errors : letters;
}

// Writes the shipped converters, but scales the numbers of Ward to AS. The id stays the same.
void write_other_converters(const std::string& path, double scale) {
  auto json =
      nlohmann::ordered_json::parse(read_file(fs::path(REMAP_SOURCE_DIR) / "generated/converters.json"));
  for (auto& converter : json["converters"]) {
    if (converter["id"] != "mitsuba_ward_to_mitsuba_as") continue;
    for (auto& row : converter["specular"])
      for (auto& number : row) number = static_cast<float>(number.get<double>() * scale);
    for (auto& golden : converter["golden"]) golden[4] = golden[5] = 1e6;
  }
  write_file(path, json.dump());
}

}  // namespace

TEST_CASE("texremap nights: sets whose names hold control characters are resumed") {
  const Session tree;
  tree.write_set("in/a\tb", "png");
  CHECK(states(tree, {}) == "c");
  CHECK(states(tree, {}) == "d");
}

TEST_CASE("texremap nights: maps of diagnoses are results of a folder of their own", "[slow]") {
  const Session tree;
  for (const std::string name : {"wood", "deep/wall"}) {
    tree.map("in/" + name + "_diffuse.png", kColor);
    tree.map("in/" + name + "_specular.png", kColor);
    tree.map("in/" + name + "_glossiness.png", kGrey);
  }
  // this path is absolute and below the inputs, but --output is a relative path
  const fs::path checks = tree.path("in/checks");
  const auto convert = [&](const Words& more) {
    return tree.texremap("convert in --from gltf-specgloss --to gltf -r --json -o out --diagnose " +
                         checks.string() + more);
  };
  const auto letters = [&](const Words& more) { return set_states(convert(more).output); };
  const auto planned = tree_report(require_success(convert("--dry-run")).output);
  CHECK(planned["sets"][1]["results"].size() == 7);
  CHECK(planned["sets"][1]["issues"] == (checks / "wood_issues.png").string());
  CHECK_FALSE(fs::exists(checks));
  CHECK(letters({}) == "cc");
  for (const char* name : {"wood_mask.png", "wood_residual.png", "wood_metallic_uncertainty.png",
                           "wood_issues.png", "deep/wall_mask.png", "deep/wall_issues.png"})
    CHECK(fs::exists(checks / name));
  CHECK(tree.results().size() == 6);
  CHECK(letters({}) == "dd");
  const std::string before = read_file(checks / "wood_issues.png");
  write_file(checks / "wood_issues.png", "no image");
  CHECK(letters({}) == "dc");
  CHECK(read_file(checks / "wood_issues.png") == before);
  write_file(checks / "wood_mask.png", "of nobody");
  fs::remove(tree.path("out/" + std::string(kJournal)));
  CHECK(letters({}) == "ff");
  CHECK(read_file(checks / "wood_mask.png") == "of nobody");
  CHECK(letters("--force") == "cc");
  require_success(convert("--force --format exr --type half"));
  CHECK(read_image(checks / "wood_residual.exr").spec.format == OIIO::TypeHalf);
}

TEST_CASE("texremap nights: another converter of the same name is another conversion", "[slow]") {
  const Session tree;
  write_sets(tree, 1, "png");
  write_other_converters(tree.path("c1.json"), 1.0);
  write_other_converters(tree.path("c2.json"), 0.5);
  CHECK(states(tree, "--converters c1.json") == "c");
  CHECK(states(tree, "--converters c1.json") == "d");
  const ProcessResult refused = tree.texremap(command("mitsuba/as", "--converters c2.json"));
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.last_error(),
             Contains("holds results of another conversion, from mitsuba/ward to mitsuba/as") &&
                 Contains("numbers of the converter"));
  CHECK(states(tree, "--converters c2.json --force") == "c");
  const std::string forced = tree.content("out/s0_spec.png");
  fs::remove_all(tree.path("out"));
  CHECK(states(tree, "--converters c2.json") == "c");
  CHECK(tree.content("out/s0_spec.png") == forced);
}

TEST_CASE("texremap nights: --force makes another conversion in a folder") {
  const Session tree;
  write_sets(tree, 1, "png");
  CHECK(states(tree, {}) == "c");
  CHECK(states(tree, {"--force"}, "mitsuba/ggx") == "c");
  CHECK(states(tree, {}, "mitsuba/ggx") == "d");
}

TEST_CASE("texremap nights: maps without metadata are not converted twice", "[slow]") {
  const Session tree;
  const std::string extension = GENERATE("tga", "bmp");
  write_sets(tree, 1, extension);
  // The path of the folder may be written in different ways.
  Words words = command("mitsuba/as");
  words.back() += GENERATE("", "/", "/../out");
  fs::create_directories(tree.path("out"));
  require_success(tree.texremap(words));
  CHECK(states(tree, {}) == "d");
  const Words again = "convert out --from mitsuba/ward --to mitsuba/as -o twice";
  const ProcessResult tree_again = tree.texremap(again);
  CHECK(tree_again.exit_code == 1);
  CHECK_THAT(tree_again.errors, Contains("already converted to mitsuba/as"));
  const ProcessResult single =
      tree.texremap("convert --from mitsuba/ward --to mitsuba/ggx --roughness out/s0_rough." + extension +
                    " --specular 0.04 -o single");
  CHECK(single.exit_code == 2);
  CHECK_THAT(single.last_error(), Contains("already converted to mitsuba/as"));
  // If a new file of the same name replaces it, it may be converted.
  write_sets(tree, 1, extension);
  fs::copy(tree.path("in"), tree.path("out"),
           fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  CHECK(tree.texremap(again).exit_code == 0);
}

TEST_CASE("texremap nights: the exit code is 1 if every set is skipped, and 0 if some are converted") {
  const Session tree;
  for (const char* map : {"Diffuse", "Reflection", "ReflectionGlossiness"})
    tree.map(std::string("in/deep/Robot_") + map + ".png", kColor);
  const Words words = command("mitsuba/as", "--recursive");
  const ProcessResult result = tree.texremap(words);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.errors, Contains("skipped: in/deep/Robot: no roughness or glossiness map"));
  CHECK_THAT(result.errors, Contains("Robot_ReflectionGlossiness.png contains squared glossiness"));
  CHECK_THAT(result.last_error(), Contains("1 set skipped"));
  tree.map("in/deep/wood_roughness.png", kGrey);
  tree.map("in/deep/wood_specular.png", kColor);
  CHECK(tree.texremap(words).exit_code == 0);
}

TEST_CASE("texremap nights: a killed run has told what it did", "[slow]") {
  const Session tree;
  write_sets(tree, 60, "png", 256);
  const std::string text = tree.path("lines.txt"), json = tree.path("lines.json");
  write_file(json, "");
  const pid_t child = ::fork();
  if (child == 0) {
    if (std::freopen(json.c_str(), "w", stdout) == nullptr ||
        std::freopen(text.c_str(), "w", stderr) == nullptr)
      ::_exit(9);
    const std::string in = tree.path("in"), out = tree.path("out");
    ::execl(REMAP_TEXREMAP, "texremap", "convert", in.c_str(), "--from", "mitsuba/ward", "--to", "mitsuba/as",
            "-o", out.c_str(), "--threads", "1", "--json", nullptr);
    ::_exit(9);
  }
  // The run is killed when the tenth line has appeared.
  const auto lines = [](const std::string& path) { return count_of(read_file(path), "\n"); };
  while (lines(json) < 10 && ::waitpid(child, nullptr, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  std::set<std::string> told;
  std::istringstream whole(read_file(json));
  for (std::string line; std::getline(whole, line) && !whole.eof();) {
    const auto object = nlohmann::json::parse(line);
    if (object.contains("set")) told.insert(object["set"]["name"].get<std::string>());
    if (object.contains("set")) CHECK_FALSE(object["set"].dump().find("histogram") != std::string::npos);
  }
  REQUIRE(told.size() >= 9);
  CHECK(told.size() < 60);
  CHECK(lines(text) >= 9);
  for (const std::string& name : told)
    CHECK(fs::exists(tree.path("out/" + fs::path(name).filename().string() + "_spec.png")));
  // Only sets that were being converted when the run was killed may be finished without a report.
  CHECK(tree.results().size() <= 2 * (told.size() + 2));
  CHECK(tree.texremap(command("mitsuba/as", "")).exit_code == 0);
}

TEST_CASE("texremap nights: two runs into one folder", "[slow]") {
  const Session tree;
  const int count = 40;
  write_sets(tree, count, "png", 32);
  const auto run_both = [&](const Words& a, const Words& b) {
    std::array<ProcessResult, 2> results;
    std::thread other([&] { results[1] = tree.texremap(b); });
    results[0] = tree.texremap(a);
    other.join();
    return results;
  };
  std::map<std::string, std::map<std::string, std::string>> alone;
  for (const std::string target : {"mitsuba/as", "mitsuba/ggx"}) {
    fs::remove_all(tree.path("out"));
    require_success(tree.texremap(command(target)));
    alone[target] = tree.contents();
  }
  for (int round = 0; round < 5; ++round) {
    // Two runs of the same conversion succeed, with complete and equal results.
    fs::remove_all(tree.path("out"));
    const Words same = command("mitsuba/as", "");
    for (const ProcessResult& result : run_both(same, same)) require_success(result);
    CHECK(tree.contents() == alone["mitsuba/as"]);
    // If two different conversions run at once, one is refused. With --force, the last one owns the folder.
    // No set mixes results of both.
    for (const Words& more : {Words{}, Words{"--force"}}) {
      fs::remove_all(tree.path("out"));
      run_both(command("mitsuba/as", more), command("mitsuba/ggx", more));
      const auto files = tree.contents();
      for (int i = 0; i < count; ++i) {
        const std::string rough = "s" + std::to_string(i) + "_rough.png",
                          spec = "s" + std::to_string(i) + "_spec.png";
        if (!files.contains(rough) || !files.contains(spec)) {
          CHECK(files.contains(rough) == files.contains(spec));
          continue;
        }
        const bool is_as = files.at(rough) == alone["mitsuba/as"].at(rough);
        const auto& expected = alone[is_as ? "mitsuba/as" : "mitsuba/ggx"];
        CHECK(files.at(rough) == expected.at(rough));
        CHECK(files.at(spec) == expected.at(spec));
      }
    }
  }
}

TEST_CASE("texremap nights: a damaged journal line is ignored") {
  const Session tree;
  write_sets(tree, 2, "tga");
  const fs::path journal = tree.path("out/" + std::string(kJournal));
  const auto append = [&](const char* text) { std::ofstream(journal, std::ios::app) << text; };
  const char* unfinished = R"({"set": "s0", "fil)";
  CHECK(states(tree, {}) == "cc");
  append(unfinished);
  CHECK(states(tree, {}) == "dd");
  append("\n[[[\n{\"files\": 5}\n");
  CHECK(states(tree, {}) == "dd");
  // A line that has no end does not swallow the next line.
  append(unfinished);
  tree.write_set("in/s1", "tga", OIIO::TypeUInt8, 2 * kMapSize);
  CHECK(states(tree, {}) == "dc");
  CHECK_THAT(read_file(journal), Contains("\"fil\n{\"begun\""));
}
