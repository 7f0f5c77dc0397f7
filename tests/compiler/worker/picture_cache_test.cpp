// This file tests the picture cache (versions, requests, damaged files, threads), and that
// adapters/check.py finds each fault of the fake worker, and no fault in a correct worker.
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "compiler/worker/fake_session.hpp"
#include "core/parallel.hpp"
#include "support/process.hpp"
#include "worker/renderer_set.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> pictures_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".picture") files.push_back(entry.path());
  return files;
}

}  // namespace

TEST_CASE("picture cache: a picture is rendered once over several runs") {
  const FakeSession session;
  std::vector<float> first;
  for (int run = 0; run < 2; ++run) {
    const WorkerRenderer renderer(session.entry(), session.settings(true));
    const Image image = renderer.render(fake_material(), kSmallScene);
    if (run == 0) first = image.values;
    CHECK(image.values == first);
    renderer.render(fake_material(), kSmallScene);
    CHECK(renderer.pictures().rendered == (run == 0 ? 1u : 0u));
    CHECK(renderer.pictures().cached == (run == 0 ? 1u : 2u));
    CHECK(renderer.remarks().empty());
  }
  CHECK(session.pictures() == 1);
}

TEST_CASE("picture cache: every part of a request counts") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry(), session.settings(true));
  renderer.render(fake_material(), kSmallScene);
  for (const Scene& scene : {Scene{33, 1, {}}, Scene{32, 2, {}}, Scene{32, 1, {60.0, 3.0}},
                             Scene{32, 1, {0.0, 4.0}}, Scene{32, 1, {}, 1}})
    renderer.render(fake_material(), scene);
  renderer.render(fake_material(0.2000000001), kSmallScene);
  CHECK(session.pictures() == 7);
  CHECK(renderer.pictures().cached == 0);
}

TEST_CASE("picture cache: another version of the renderer renders again, and reports it") {
  const FakeSession session;
  { WorkerRenderer(session.entry(), session.settings(true)).render(fake_material(), kSmallScene); }
  const WorkerRenderer renderer(session.entry("", "--version 2"), session.settings(true));
  renderer.render(fake_material(), kSmallScene);
  CHECK(session.pictures() == 2);
  REQUIRE(renderer.remarks().size() == 1);
  CHECK_THAT(renderer.remarks()[0], Contains("pictures of Fake-1-") && Contains("is now Fake 2"));
}

TEST_CASE("picture cache: a damaged picture is rendered again, and said once") {
  const FakeSession session;
  WorkerSettings settings = session.settings(true);
  std::vector<std::string> warnings;
  settings.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  const auto render = [&] {
    const WorkerRenderer renderer(session.entry(), settings);
    return renderer.render(fake_material(), kSmallScene).values;
  };
  const std::vector<float> good = render();
  const auto files = pictures_below(session.path("cache"));
  REQUIRE(files.size() == 1);
  const std::string whole = read_file(files[0]);
  const auto flipped = [&](std::size_t place) {
    std::string content = whole;
    content[place] = static_cast<char>(content[place] ^ 1);
    return content;
  };
  const std::size_t key = whole.find("0.2"), checksum = whole.find('\n') + 3, picture = whole.size() - 500;
  std::size_t rendered = 1;
  for (const std::string& content :
       {flipped(key), flipped(checksum), flipped(picture), flipped(whole.size() - 1), whole + "x",
        whole.substr(0, whole.size() - 1), whole.substr(0, 20), std::string()}) {
    write_file(files[0], content);
    warnings.clear();
    CHECK(render() == good);
    CHECK(session.pictures() == ++rendered);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("worker fake: cache: " + files[0].string() + ": ") &&
                                Contains("(the picture is rendered again)"));
    CHECK(read_file(files[0]) == whole);  // the file is repaired
  }
}

TEST_CASE("picture cache: numbers that no picture may hold are not used, even with a checksum that fits") {
  const FakeSession session;
  const PictureRequest request = picture_request(fake_material(), kSmallScene);
  const PictureCache cache(session.path("cache"), "fake", "Fake 1");
  Image image{32, 32, 1, std::vector<float>(32 * 32, 0.5f)};
  cache.keep(request, image);
  std::string damage;
  CHECK(cache.find(request, damage).has_value());
  CHECK(damage.empty());
  for (const float bad : {std::nanf(""), std::numeric_limits<float>::infinity(), 1e38f, -1.0f}) {
    image.values[32 * 3 + 5] = bad;
    cache.keep(request, image);
    CHECK_FALSE(cache.find(request, damage).has_value());
    CHECK_THAT(damage, Contains("in row 3, column 5"));
  }
}

TEST_CASE("picture cache: several damaged pictures are one warning and one remark") {
  const FakeSession session;
  WorkerSettings settings = session.settings(true);
  int warnings = 0;
  settings.on_warning = [&](const std::string&) { ++warnings; };
  const auto render = [](const WorkerRenderer& renderer) {
    for (const double alpha : {0.1, 0.2, 0.3}) renderer.render(fake_material(alpha), kSmallScene);
  };
  render(WorkerRenderer(session.entry(), settings));
  for (const fs::path& file : pictures_below(session.path("cache"))) fs::resize_file(file, 99);
  const WorkerRenderer renderer(session.entry(), settings);
  render(renderer);
  CHECK(warnings == 1);
  REQUIRE(renderer.remarks().size() == 1);
  CHECK_THAT(renderer.remarks()[0], Contains("3 pictures of the cache"));
}

TEST_CASE("picture cache: one that cannot be written is one warning, and the run goes on") {
  const FakeSession session;
  write_file(session.path("cache"), "not a folder");
  WorkerSettings settings = session.settings(true);
  std::vector<std::string> warnings;
  settings.on_warning = [&](const std::string& message) { warnings.push_back(message); };
  const WorkerRenderer renderer(session.entry(), settings);
  for (const double alpha : {0.1, 0.2, 0.3})
    CHECK(renderer.render(fake_material(alpha), kSmallScene).width == 32);
  CHECK(session.pictures() == 3);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("worker fake: cache: ") && Contains("(further pictures are not kept)"));
}

TEST_CASE("picture cache: threads that need the same picture render it once") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry(), session.settings(true));
  run_parallel(8, 8, [&](std::size_t) { renderer.render(fake_material(), kSmallScene); });
  CHECK(session.pictures() == 1);
  CHECK(renderer.pictures().cached == 7);
}

TEST_CASE("renderer set: a worker is started when one of its models is requested") {
  const FakeSession session;
  const RendererSet renderers({session.entry()}, session.settings());
  CHECK(renderers.model("mitsuba/ggx").name == "mitsuba/ggx");
  CHECK(session.log_lines("process").empty());
  CHECK_THROWS_WITH(renderers.model("fakee/ggx"), Contains("or of a connected renderer"));
  CHECK(renderers.model("fake/ggx").name == "fake/ggx");
  CHECK(session.log_lines("process").size() == 1);
  CHECK(renderers.version_of("fake/ggx") == "Fake 1");
  CHECK_THAT(renderers.version_of("mitsuba/ggx"), Contains("remapc"));
  CHECK(renderers.render(fake_material(), kSmallScene).width == 32);
  CHECK(renderers.pictures().rendered == 1);
}

TEST_CASE("worker list: the user's entries precede shipped ones, and errors name the place") {
  const FakeSession session;
  const fs::path list = session.path("workers.json");
  remap::write_file(list, R"({"workers": [{"name": "ours", "command": "run", "install": "ask"}]})");
  const auto entries = read_worker_list(list);
  REQUIRE(entries.size() == 1);
  CHECK(entries[0].install == "ask");
  CHECK(entries[0].folder == list.parent_path().string());
  remap::write_file(list, R"({"workers": [{"name": "a/b", "command": "run"}]})");
  CHECK_THROWS_WITH(read_worker_list(list), Contains("workers[0].name: expected a name without /"));
  CHECK_THROWS_WITH(parse_worker("ours"), Contains("is not of the form NAME=COMMAND"));
  CHECK_THROWS_WITH(known_workers({"a=b", "a=c"}), Contains("a was given twice"));
  const auto known = known_workers({"mitsuba3=mine --fast"});
  const auto mine =
      std::find_if(known.begin(), known.end(), [](const auto& entry) { return entry.name == "mitsuba3"; });
  REQUIRE(mine != known.end());
  CHECK(mine->command == "mine --fast");
}

namespace {

ProcessResult check(const std::string& command) {
  return run({"/usr/bin/env", "python3", REMAP_SOURCE_DIR "/compiler/adapters/check.py", "--json",
              "--resolution", "24", command});
}

// Returns the results of all failed checks, `check: words`, one per line.
std::string wrong_words(const std::string& fault) {
  const FakeSession session;
  const ProcessResult result = check(session.command(fault));
  INFO(result.errors);
  CHECK(result.exit_code == 1);
  CHECK(session.nobody_is_left());
  std::string text;
  const nlohmann::json found = nlohmann::json::parse(result.output);
  for (const nlohmann::json& finding : found["findings"])
    if (finding["verdict"] == "wrong")
      text += finding["check"].get<std::string>() + ": " + finding["words"].get<std::string>() + "\n";
  return text;
}

}  // namespace

TEST_CASE("check.py: a good worker passes every check", "[slow]") {
  const FakeSession session;
  const ProcessResult result = check(session.command());
  INFO(result.output << result.errors);
  CHECK(result.exit_code == 0);
  const nlohmann::json found = nlohmann::json::parse(result.output);
  CHECK(found["renderer"] == "Fake 1");
  CHECK(found["wrong"] == 0);
  CHECK(found["findings"].size() >= 14);
  for (const nlohmann::json& finding : found["findings"]) {
    CHECK(finding["model"] == "fake/ggx");
    CHECK(finding["verdict"] == "good");
  }
}

TEST_CASE("check.py: a worker that shows maps passes, and maps and light in wrong places are found",
          "[slow]") {
  const FakeSession session;
  const ProcessResult result = check(session.command("textures"));
  INFO(result.output << result.errors);
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("light front"));
  CHECK_THAT(wrong_words("textures-flipped"), Contains("map top: the top of a map is not at the top"));
  CHECK_THAT(wrong_words("textures-behind"), Contains("light front: the +z of an environment"));
}

TEST_CASE("check.py: the example passes") {
  CHECK(check("python3 " REMAP_SOURCE_DIR "/examples/lambert_worker.py").exit_code == 0);
}

TEST_CASE("check.py: each fault is explained", "[slow]") {
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"bright", "light scale: diffuse light is 3.142 times as strong as it should be (pi)"},
      {"no-square", "inverse square: a light twice as far is 1 times as bright"},
      {"gamma", "linearity: half the diffuse gives 0.73"},
      {"eight-bit", "precision: values have 8 bits"},
      {"grey-background", "background: pixels outside the sphere are up to 0.0"},
      {"mirrored", "orientation: a light at +60 degrees lights the left of the picture"},
      {"transposed", "rows and columns are exchanged"},
      {"shifted", "symmetry: under a headlight the upper and lower halves differ"},
      {"jitter", "pixel centres: pixels differ by"},
      {"unrepeatable", "repeatability: the same request gives pictures that differ"},
      {"noise", "noise: another seed gives a picture that differs"},
      {"channels", "color: channel 0 differs"},
      {"inverted", "width: highlights do not widen"},
  };
  for (const auto& [fault, words] : faults) {
    INFO(fault);
    CHECK_THAT(wrong_words(fault), Contains(words));
  }
}

TEST_CASE("check.py: a worker that dies, answers nonsense or refuses is named with what it said", "[slow]") {
  CHECK_THAT(wrong_words("die"), Contains("answer: died with signal 9; last lines of its log: rendering"));
  CHECK_THAT(wrong_words("garbage"), Contains("this is not the answer to request 2: 'Saved: picture.exr'"));
  CHECK_THAT(wrong_words("refuse"), Contains("answer: no licence left"));
  CHECK_THAT(wrong_words("nan"), Contains("must be finite"));
  CHECK_THAT(wrong_words("short"), Contains("values, not 576"));
}
