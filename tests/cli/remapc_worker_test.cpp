// This file tests remapc with a worker: sweeps that use the cache, runs that are interrupted, and what is
// listed and checked.
#include <chrono>
#include <csignal>
#include <thread>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "compiler/worker/fake_session.hpp"
#include "core/files.hpp"
#include "support/test_image.hpp"
#include "worker/folders.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

Words sweep(const FakeSession& fake, const std::string& table, const std::string& fault = "",
            const std::string& cache = "cache", int alphas = 5) {
  return "sweep --objective natural-1 --source fake/ggx --target mitsuba/ggx-plain --resolution 32 "
         "--specular-samples 2 --roughness-range 0.2,0.9 --roughness-samples " +
         std::to_string(alphas) +
         Words{"--worker", "fake=" + fake.command(fault), "--cache", cache, "-o", table};
}

// Counts the folders that --worker-folder left in the session's folder.
std::ptrdiff_t folders_of_pictures(const Session& session) {
  const std::filesystem::directory_iterator entries(session.path("."));
  return std::count_if(begin(entries), end(entries), [](const auto& entry) {
    return entry.path().filename().string().starts_with("remap-pictures-");
  });
}

// Waits until the workers have made `count` pictures.
void wait_for_pictures(const FakeSession& fake, std::size_t count) {
  for (int i = 0; i < 1200 && fake.pictures() < count; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  REQUIRE(fake.pictures() >= count);
}

}  // namespace

TEST_CASE("remapc sweep: a worker is the source, and the second run is from the cache", "[slow]") {
  const Session session;
  const FakeSession fake;
  const ProcessResult first = require_success(session.remapc(sweep(fake, "a.csv")));
  const std::size_t pictures = fake.pictures();
  CHECK_THAT(first.errors, Contains(std::to_string(pictures) + " pictures rendered and "));
  const std::string table = session.content("a.csv");
  CHECK_THAT(session.content("a.csv.json"), Contains("\"renderer\": \"Fake 1; remapc "));
  CHECK_THAT(table, Contains("\n0.9,0.5,0.89999999"));  // the conversion is the identity
  const ProcessResult second = require_success(session.remapc(sweep(fake, "b.csv")));
  CHECK_THAT(second.errors, Contains(", 0 pictures rendered and "));
  CHECK(fake.pictures() == pictures);
  CHECK(session.content("b.csv") == table);
  CHECK(fake.nobody_is_left());
}

TEST_CASE("remapc sweep: the time of the whole sweep is estimated once, after ten pictures", "[slow]") {
  const Session session;
  const FakeSession fake;
  const std::string line = "remapc: sweep fake/ggx -> mitsuba/ggx-plain: about ";
  const ProcessResult loud = require_success(session.remapc(sweep(fake, "a.csv") + "--jobs 1"));
  const std::size_t place = loud.errors.find(line);
  REQUIRE(place != std::string::npos);
  CHECK(loud.errors.find(" in all\n", place) != std::string::npos);
  CHECK(loud.errors.find(line, place + 1) == std::string::npos);
  CHECK(require_success(session.remapc(sweep(fake, "b.csv") + "--jobs 1 --quiet")).errors.empty());
}

TEST_CASE("remapc preview: a worker shows the maps of a set as the built-in renderer shows them",
          "[slow][needs]") {
  const Session session;
  const FakeSession fake;
  const auto write = [&](const std::string& name, const std::vector<std::string>& channels,
                         const TexelFunction& f) {
    std::filesystem::create_directories(session.path("sets"));
    write_image(session.path("sets/" + name), test_spec(32, 32, channels, OIIO::TypeUInt8), f);
  };
  write("tile_roughness.png", {"Y"}, [](int x, int, int) { return x < 16 ? 0.4f : 0.8f; });
  write("tile_specular.png", {"R", "G", "B"},
        [](int, int y, int c) { return y < 16 ? 0.9f : 0.2f + 0.2f * static_cast<float>(c); });
  const auto preview = [&](const std::string& fault, const std::string& more) {
    return session.remapc("preview sets --resolution 32 --directions 64 --json " + more +
                          Words{"--worker", "mitsuba3=" + fake.command(fault, "--model mitsuba3/ggx")});
  };
  // Both have the same lobe, so that copied numbers give the same picture.
  const std::string pair = "--from mitsuba/ggx-plain --to mitsuba3/ggx --renderer-after mitsuba3 ";
  const auto figure = [&](const std::string& fault, const std::string& more) {
    return nlohmann::json::parse(require_success(preview(fault, more)).output);
  };
  CHECK(figure("textures", pair + "-o sheet.png")["figures"][0]["copied"]["rms"].get<double>() < 2e-3);
  CHECK(std::filesystem::exists(session.path("sheet.png")));
  CHECK(figure("textures-flipped", pair)["figures"][0]["copied"]["rms"].get<double>() > 0.05);
  const nlohmann::json other =
      figure("textures",
             "--from mitsuba/as --to mitsuba3/ggx --renderer-before mitsuba3 --renderer-after mitsuba3 ");
  CHECK(other["notes"][0] == "mitsuba/as is shown as mitsuba3/ggx, the closest model of mitsuba3");
  CHECK(fake.nobody_is_left());
  check_failure(preview("", pair), 2, "--renderer-after mitsuba3: this renderer shows no maps (choose");
}

TEST_CASE("remapc preview: finds the worker of a model in the user's list", "[slow]") {
  const Session session;
  const FakeSession fake;
  require_success(session.remapc(sweep(fake, "a.csv", "", "cache", 8)));
  require_success(session.remapc(session.fit("a.csv")));
  const Words preview =
      "preview fits/fake_ggx_to_mitsuba_ggx_plain.json --resolution 16 --alpha 0.3 --shape sphere --no-cache";
  check_failure(session.remapc(preview), 2, "--worker \"fake=COMMAND\" connects another renderer");
  session.write("remap/workers.json",
                R"({"workers": [{"name": "fake", "command": ")" + fake.command() + R"("}]})");
  const Words with_list = Words{"/usr/bin/env", "XDG_CONFIG_HOME=" + session.path("")};
  const ProcessResult result = require_success(session.run(with_list + (REMAPC_PROGRAM + preview)));
  CHECK_THAT(result.output, Contains("45 degrees  sphere"));
  CHECK(result.errors.empty());
}

TEST_CASE("remapc sweep: broken off by a worker and run again it ends in the same table", "[slow]") {
  const Session session;
  const FakeSession fake;
  require_success(session.remapc(sweep(fake, "whole.csv")));
  const std::size_t pictures = fake.pictures();
  auto broken = sweep(fake, "a.csv", "die' --of 'all' --after '" + std::to_string(pictures + 28), "other");
  broken += "--jobs 1";
  check_failure(session.remapc(broken), 1, "died with signal 9; last lines of its log: ");
  CHECK_FALSE(std::filesystem::exists(session.path("a.csv")));
  require_success(session.remapc(sweep(fake, "a.csv", "", "other")));
  CHECK(session.content("a.csv") == session.content("whole.csv"));
  CHECK(fake.pictures() == 2 * pictures);  // no picture was rendered twice
}

TEST_CASE("remapc sweep: workers that are lost are replaced, and said and counted", "[slow]") {
  const Session session;
  const FakeSession fake;
  require_success(session.remapc(sweep(fake, "whole.csv") + "--no-cache"));
  const std::size_t pictures = fake.pictures();
  const ProcessResult result =
      require_success(session.remapc(sweep(fake, "a.csv", "die' --after '20") +
                                     "--no-cache --json --worker-folder ." + "--worker-processes 1"));
  CHECK(session.content("a.csv") == session.content("whole.csv"));
  CHECK(fake.pictures() == 2 * pictures);
  CHECK_THAT(result.output, Contains("\"workers_lost\": " + std::to_string((pictures - 1) / 20)));
  CHECK_THAT(result.errors, Contains("remapc: warning: worker fake, request fake/ggx alpha ") &&
                                Contains("(another process renders the picture)"));
  CHECK(folders_of_pictures(session) == 0);
}

TEST_CASE("remapc sweep: no worker stays behind when it is killed, and the next run clears up") {
  const Session session;
  const FakeSession fake;
  Process process =
      session.start(REMAPC_PROGRAM + sweep(fake, "a.csv", "hang' --after '4") + "--worker-folder .");
  wait_for_pictures(fake, 4);
  process.send(SIGKILL);
  process.wait();
  CHECK(fake.nobody_is_left());
  CHECK(folders_of_pictures(session) == 1);
  { const PrivateFolder next(session.path(".")); }
  CHECK(folders_of_pictures(session) == 0);
}

namespace {

// Counts the folders for pictures whose processes have ended.
std::size_t abandoned_folders() {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PrivateFolder().path().parent_path())) {
    const std::string name = entry.path().filename(), opening = "remap-pictures-";
    if (name.starts_with(opening) &&
        is_stale_owner(name.substr(opening.size(), name.rfind('-') - opening.size())))
      ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("remapc: a signal that ends a run with workers leaves no process and no folder of pictures") {
  const Session session;
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    for (const bool is_sweep : {true, false}) {
      const FakeSession fake;
      auto arguments = sweep(fake, "a.csv", "hang' --after '4");
      if (!is_sweep)
        arguments = "render --model fake/ggx --set alpha=0.2 --set specular=0.5 --no-cache -o a.exr" +
                    Words{"--worker", "fake=" + fake.command("hang")};
      const std::size_t before = abandoned_folders();
      Process process = session.start(REMAPC_PROGRAM + arguments);
      wait_for_pictures(fake, is_sweep ? 4 : 0);
      for (int i = 0; i < 200 && fake.log_lines("process").empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      process.send(signal);
      const ProcessResult result = process.wait();
      INFO(signal << " " << result.errors);
      CHECK(result.signal == 0);
      CHECK(result.exit_code == 1);
      CHECK_THAT(result.errors, Contains("interrupted"));
      CHECK(fake.nobody_is_left());
      CHECK(abandoned_folders() == before);
      CHECK_FALSE(std::filesystem::exists(session.path(is_sweep ? "a.csv" : "a.exr")));
    }
  }
}

TEST_CASE("remapc: light that is rescaled is an error of sweep and fit, and said by check, show and --json",
          "[slow]") {
  const Session session;
  const FakeSession fake;
  auto arguments = sweep(fake, "a.csv", "oren-nayar");
  for (std::string& word : arguments)
    if (word == "5") word = "8";  // a fit needs more alphas and, below, more speculars
  std::replace(arguments.begin(), arguments.end(), std::string("2"), std::string("3"));
  const std::string words = ": diffuse matches only if the light of the source is multiplied by 1.";
  ProcessResult result = session.remapc(arguments);
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.errors, Contains("fake/ggx to mitsuba/ggx-plain" + words) && Contains("--accept-light"));
  CHECK_FALSE(std::filesystem::exists(session.path("a.csv")));
  arguments += "--accept-light --json";
  result = require_success(session.remapc(arguments));
  CHECK_THAT(result.errors, Contains("remapc: warning: a.csv" + words));
  CHECK_THAT(result.output, Contains("\"irradiance_scale\": 1.") && Contains("\"diffuse_error\": 0.") &&
                                Contains("\"light_warning\": \"diffuse matches only"));
  result = session.remapc("check a.csv");
  CHECK(result.exit_code == 0);
  CHECK_THAT(result.output, Contains("warning: light" + words));

  session.write("b.csv", session.content("a.csv"));
  std::string made = session.content("a.csv.json");
  made.erase(made.find("\"light_accepted"), std::string("\"light_accepted\": \"yes\",").size());
  session.write("b.csv.json", made);
  result = session.remapc("check --json b.csv");
  CHECK(result.exit_code == 1);
  CHECK_THAT(result.output, Contains("\"kind\": \"light\"") && Contains("\"severity\": \"error\""));
  CHECK(session.remapc("check --accept-light b.csv").exit_code == 0);
  auto fit = session.fit("b.csv");
  CHECK_THAT(session.remapc(fit).errors, Contains("light" + words));
  fit.push_back("--accept-light");
  require_success(session.remapc(fit));
  for (const std::string form : {"", " --json"}) {
    result = session.remapc("show fake_ggx_to_mitsuba_ggx_plain --fits fits" + form);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.errors, Contains("remapc: warning: fake_ggx_to_mitsuba_ggx_plain" + words));
    CHECK_THAT(result.output, Contains("irradiance_scale"));
  }
}

TEST_CASE("remapc renderers: what is there is listed, and why the rest is not", "[slow]") {
  const Session session;
  const FakeSession fake;
  const ProcessResult result = require_success(session.remapc(
      "renderers --json --worker gone=/no/such/program" + Words{"--worker", "fake=" + fake.command()}));
  CHECK_THAT(result.output, Contains("\"version\": \"Fake 1\"") && Contains("\"model\": \"fake/ggx\""));
  CHECK_THAT(result.output, Contains("worker gone, request describe: ended with exit code 127"));
}
