// This file tests failing workers: their error messages, and that no process or file remains.
#include <map>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "compiler/worker/fake_session.hpp"
#include "core/files.hpp"
#include "core/parallel.hpp"
#include "core/plain_text.hpp"
#include "support/error_of.hpp"
#include "worker/child_process.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

std::string render_error(const FakeSession& session, const std::string& fault, double seconds = 60.0) {
  WorkerSettings settings = session.settings();
  settings.seconds = seconds;
  return input_error([&] {
    const WorkerRenderer renderer(session.entry(fault), settings);
    renderer.render(fake_material(), kSmallScene);
  });
}

const std::string kPlace =
    "worker fake, request fake/ggx alpha 0.2, diffuse 0, specular 0.5, tint 0.5, headlight, 32 x 32: ";

}  // namespace

TEST_CASE("worker: a picture equals the renderer's, in one channel and in three") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry(), session.settings());
  CHECK(renderer.version() == "Fake 1");
  Material material = fake_material();
  const Scene scene{32, 2, {60.0, 3.0}};
  const auto expected = make_builtin_renderer()->render(
      {"mitsuba/ggx-plain", {{"alpha", {0.2}}, {"specular", {0.5}}, {"diffuse", {0.0}}}}, scene);
  CHECK(renderer.render(material, scene).values == expected.values);
  material.parameters["specular"] = {0.5, 0.25, 0.125};
  const Image colored = renderer.render(material, scene);
  REQUIRE(colored.channels == 3);
  CHECK(colored.values[3 * (32 * 16 + 20)] == expected.values[32 * 16 + 20]);
}

TEST_CASE("worker: the error for one that dies has its request and the end of its log") {
  const FakeSession session;
  const std::string message = render_error(session, "die");
  CHECK_THAT(message, Contains(kPlace + "died with signal 9; last lines of its log: rendering number 0"));
  CHECK_THAT(render_error(session, "exit"), Contains("ended with exit code 3"));
  CHECK(session.nobody_is_left());
}

TEST_CASE("worker: one that hangs is killed after the timeout, with its children", "[slow]") {
  const FakeSession session;
  CHECK_THAT(render_error(session, "hang", 1.5), Contains(kPlace + "no answer within 1.5 s"));
  CHECK_THAT(render_error(session, "launcher", 1.5), Contains("no answer within 1.5 s"));
  CHECK(session.log_lines("told").size() == 3);
  CHECK(session.nobody_is_left());
}

TEST_CASE("worker: one that does not answer describe is killed") {
  const FakeSession session;
  CHECK_THAT(render_error(session, "mute", 0.5), Contains("request describe: no answer within 0.5 s"));
  CHECK(session.nobody_is_left());
}

TEST_CASE("worker: answers that violate the protocol are reported") {
  const FakeSession session;
  CHECK_THAT(render_error(session, "garbage"),
             Contains(kPlace + "answered \"Saved: picture.exr\", which is not a line of JSON"));
  CHECK_THAT(render_error(session, "wrong-id"), Contains("without the id 2 of the request"));
  CHECK_THAT(render_error(session, "flood"), Contains("wrote a line of more than 16 MB"));
  CHECK_THAT(render_error(session, "no-file"), Contains("the picture was not written"));
  CHECK_THAT(render_error(session, "pipe"), Contains("is a named pipe, not a file"));
  CHECK_THAT(render_error(session, "short"),
             Contains("the picture has 4092 bytes (must have 4096: 32 x 32 pixels of 1 floats)"));
  CHECK_THAT(render_error(session, "nan"), Contains("the picture is nan in row 16, column 16"));
  CHECK_THAT(render_error(session, "protocol"), Contains("protocol: is version 2 (must be 1)"));
  CHECK_THAT(render_error(session, "prefix"), Contains("is \"other/ggx\" (must be fake/MODEL)"));
  CHECK_THAT(render_error(session, "convention"), Contains("expected alpha, roughness, exponent"));
  CHECK(session.nobody_is_left());
}

TEST_CASE("worker: one that floods its output while nobody reads is killed") {
  ChildProcess process("exec yes");
  const auto deadline = ChildProcess::Clock::now() + std::chrono::seconds(60);
  while (process.ending() == "closed its input" && ChildProcess::Clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(process.ending() == "wrote more than 64 MB of lines that no request asked for");
  std::string line;
  CHECK(process.read_line(deadline, &line) == ChildProcess::Reading::kEnded);
}

TEST_CASE("worker: a reported error is passed on, and the worker stays in use") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry("refuse", "--after 0"), session.settings());
  for (int i = 0; i < 2; ++i)
    CHECK(input_error([&] { renderer.render(fake_material(), kSmallScene); }) == kPlace + "no licence left");
  CHECK(session.log_lines("process").size() == 1);
}

namespace {

std::vector<Image> twelve_pictures(const Renderer& renderer) {
  std::vector<Image> images(12);
  run_parallel(images.size(), 4, [&](std::size_t i) {
    images[i] = renderer.render(fake_material(0.2 + 0.05 * static_cast<double>(i)), kSmallScene);
  });
  return images;
}

}  // namespace

TEST_CASE("worker: those that are lost cost nothing but their processes", "[slow]") {
  const FakeSession good;
  const std::vector<Image> expected = twelve_pictures(WorkerRenderer(good.entry(), good.settings()));
  for (const std::string fault : {"die", "exit", "half", "hang", "deaf"}) {
    INFO(fault);
    const FakeSession session;
    WorkerSettings settings = session.settings();
    settings.seconds = fault == "hang" || fault == "deaf" ? 2.0 : 60.0;
    std::mutex mutex;
    std::vector<std::string> warnings;
    settings.on_warning = [&](const std::string& message) {
      const std::lock_guard lock(mutex);
      warnings.push_back(message);
    };
    const WorkerRenderer renderer(session.entry(fault, "--after 3"), settings);
    const std::vector<Image> found = twelve_pictures(renderer);
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].values == expected[i].values);
    const std::size_t lost = renderer.pictures().lost_workers;
    CHECK(lost >= 2);
    CHECK(session.pictures() == 12);
    const std::vector<std::string> files = session.log_lines("file");
    CHECK(std::set(files.begin(), files.end()).size() == 12);  // each picture has its own file name
    // the third process for a picture is new
    CHECK(session.log_lines("process").size() <= 2 + lost + lost / 2);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("worker fake, request fake/ggx alpha ") &&
                                Contains("last lines of its log: ") &&
                                Contains("rendering number 3 (another process renders the picture)"));
    CHECK(renderer.remarks() ==
          std::vector<std::string>{"worker fake: " + std::to_string(lost) +
                                   " processes were lost; other processes rendered their pictures"});
    for (const std::string& count : session.log_lines("crowd")) CHECK(std::stoi(count) <= 2);
  }
}

TEST_CASE("worker: one picture may cost three processes") {
  for (const char* after : {"0", "1"}) {
    const FakeSession session;
    const WorkerRenderer renderer(session.entry("die", std::string("--of all --after ") + after),
                                  session.settings());
    if (after == std::string("1")) renderer.render(fake_material(0.1), kSmallScene);
    const std::string message = input_error([&] { renderer.render(fake_material(), kSmallScene); });
    CHECK_THAT(message, Contains(kPlace + "died with signal 9; last lines of its log: rendering number ") &&
                            Contains("; lost 3 processes over one picture"));
    CHECK(session.log_lines("process").size() == 3);
    CHECK(session.nobody_is_left());
  }
}

TEST_CASE("worker: a picture that meets the end of two processes is rendered by a new one") {
  const FakeSession session;
  WorkerSettings settings = session.settings();
  settings.processes = 3;
  const WorkerRenderer renderer(session.entry("exit", "--after 1"), settings);
  // Three processes run. Each has already made the one good picture that it can make.
  run_parallel(3, 3, [&](std::size_t i) {
    renderer.render(fake_material(0.1 + 0.1 * static_cast<double>(i)), kSmallScene);
  });
  renderer.render(fake_material(0.5), kSmallScene);
  CHECK(session.pictures() == 4);
}

TEST_CASE("worker: one of another version does not take over") {
  const FakeSession session;
  const WorkerRenderer renderer(
      session.entry("die", "--after 1 --version $(wc -l < " + session.path("log") + ")"), session.settings());
  renderer.render(fake_material(0.1), kSmallScene);
  CHECK_THAT(input_error([&] { renderer.render(fake_material(), kSmallScene); }),
             Contains("worker fake: its version changed during the run, from Fake "));
}

TEST_CASE("worker: an interruption ends the pause after a loss") {
  const FakeSession session;
  std::atomic<bool> cancelled{false};
  WorkerSettings settings = session.settings();
  settings.cancelled = &cancelled;
  settings.pause = std::chrono::hours(1);
  settings.on_warning = [&](const std::string&) { cancelled = true; };
  const WorkerRenderer renderer(session.entry("die"), settings);
  CHECK_THROWS_WITH(renderer.render(fake_material(), kSmallScene), "worker fake: interrupted");
}

TEST_CASE("worker: pictures go through the folder, which several runs share and none leaves anything in") {
  const FakeSession session;
  const std::filesystem::path folder = session.path("shared");
  std::filesystem::create_directory(folder);
  WorkerSettings settings = session.settings();
  settings.folder = folder;
  const auto content = [&] {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      names.push_back(entry.path().filename());
    return names;
  };
  {
    const WorkerRenderer one(session.entry("half", "--after 3"), settings), other(session.entry(), settings);
    CHECK(content().size() == 2);
    const std::vector<Image> found = twelve_pictures(one), expected = twelve_pictures(other);
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].values == expected[i].values);
    for (const std::string& name : content())
      CHECK((name.ends_with(".f32") || name.find(owner_tag()) < name.size()));
    CHECK(content().size() == 2 + one.pictures().lost_workers);
  }
  CHECK(content().empty());
}

TEST_CASE("worker: a folder that cannot be used is an error that says what to do") {
  const FakeSession session;
  WorkerSettings settings = session.settings();
  settings.folder = session.path("missing");
  CHECK_THROWS_WITH(
      WorkerRenderer(session.entry(), settings),
      session.path("missing") + ": is not a writable folder (create it, or choose another folder)");
  CHECK(session.log_lines("process").empty());
  for (const char* fault : {"elsewhere", "no-file"})
    CHECK_THAT(
        render_error(session, fault),
        Contains("/remap-pictures-") &&
            Contains(
                "; a worker on another machine needs a folder that both can write to (--worker-folder "));
}

TEST_CASE("worker: the error for a missing command has the shell's message and how to install it") {
  const FakeSession session;
  const std::string message = input_error([&] {
    WorkerRenderer({"fake", "/no/such/program", "", "scripts/renderers fake"}, session.settings());
  });
  CHECK_THAT(message, Contains("request describe: ended with exit code 127; last lines of its log: "));
  CHECK_THAT(message, Contains("/no/such/program") && Contains(" (install it with: scripts/renderers fake)"));
}

TEST_CASE("worker: banners before the first answer are skipped") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry("banner"), session.settings());
  CHECK(renderer.render(fake_material(), kSmallScene).width == 32);
}

TEST_CASE("worker: children are killed with it, in its group or not, and so is one that does not end") {
  for (const char* fault : {"child", "daemon"}) {
    const FakeSession session;
    {
      const WorkerRenderer renderer(session.entry(fault), session.settings());
      renderer.render(fake_material(), kSmallScene);
      REQUIRE(session.log_lines("process").size() == 2);
      for (const std::string& id : session.log_lines("process")) CHECK_FALSE(is_gone(std::stoi(id)));
    }
    if (fault == std::string("child")) CHECK(session.nobody_is_left());
    for (const std::string& id : session.log_lines("process")) CHECK(is_gone(std::stoi(id)));
  }
  const FakeSession session;
  { const WorkerRenderer renderer(session.entry("stays"), session.settings()); }
  CHECK(session.nobody_is_left());
}

TEST_CASE("worker: the end of a thread does not end a worker") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry(), session.settings());
  const auto render_some = [&](double offset) {
    run_parallel(4, 4, [&](std::size_t i) {
      renderer.render(fake_material(offset + 0.1 * static_cast<double>(i)), kSmallScene);
    });
  };
  render_some(0.1);
  render_some(0.55);
  CHECK(session.pictures() == 8);
  CHECK(session.log_lines("process").size() <= 2);
}

TEST_CASE("worker: another shape is sent as a mesh to a worker that accepts meshes") {
  const FakeSession session;
  const Scene scene{32, 1, {45.0, 3.0}, 0, Shape::kTorus};
  const WorkerRenderer renderer(session.entry("meshes"), session.settings());
  const Image found = renderer.render(fake_material(), scene);
  const Image expected = make_builtin_renderer()->render(
      {"mitsuba/ggx-plain", {{"alpha", {0.2}}, {"specular", {0.5}}, {"diffuse", {0.0}}}}, scene);
  CHECK(found.values == expected.values);
  CHECK(session.log_lines("mesh") == std::vector<std::string>{"torus complete exact"});

  const WorkerRenderer sphere_only(session.entry(), session.settings());
  CHECK_THROWS_WITH(sphere_only.render(fake_material(), scene),
                    "worker fake: renders spheres only, not a torus (use --shape sphere)");
}

TEST_CASE("worker: materials are checked before a request") {
  const FakeSession session;
  const WorkerRenderer renderer(session.entry(), session.settings());
  Material material = fake_material(2.0);
  CHECK_THROWS_WITH(renderer.render(material, kSmallScene),
                    "fake/ggx: alpha = 2 is out of range (1e-04 to 1)");
  material = fake_material();
  material.parameters["speculer"] = {1.0};
  CHECK_THROWS_WITH(renderer.render(material, kSmallScene), Contains("did you mean specular?"));
  CHECK_THROWS_WITH(renderer.model("fake/gxx"), Contains("did you mean fake/ggx?"));
  CHECK(grey_material(renderer.model("fake/ggx"), 0.2, 0.5, 0.0).parameters.at("tint")[0] == 0.5);
  CHECK(session.pictures() == 0);
}

TEST_CASE("worker: a wait ends when the program is asked to stop") {
  const FakeSession session;
  std::atomic<bool> cancelled{false};
  WorkerSettings settings = session.settings();
  settings.cancelled = &cancelled;
  const WorkerRenderer renderer(session.entry("hang"), settings);
  cancelled = true;
  CHECK(error_of([&] { renderer.render(fake_material(), kSmallScene); }, ErrorKind::kInterrupted) != "");
}

TEST_CASE("worker: every message names the worker, is short, and has no control characters") {
  const FakeSession session;
  const std::map<std::string, std::string> words = {
      {"error-number", "expected a text, found 5"},
      {"error-long", std::string(900, 'x')},
      {"error-lines", "line 1 line 2 \\x1b[31m\\u202e"},
      {"deep", "nested deeper than 100 levels"},
      {"talkative", "ended with exit code 3; last lines of its log: ..."},
      {"negative", "in row 16, column 16 (values must not be negative)"},
      {"huge", "the picture is 1e+38 in row 16, column 16 (values must not be above 1e18)"}};
  for (const auto& [fault, part] : words) {
    const std::string message = render_error(session, fault);
    INFO(fault);
    CHECK(message.starts_with(kPlace));
    CHECK(message.find(kPlace, 1) == std::string::npos);
    CHECK_THAT(message, Contains(part));
    CHECK(message.size() <= kLongestMessage);
    CHECK(is_plain_text(message));
  }
  CHECK_THAT(render_error(session, "talkative"), Contains(" [31m the end"));
  CHECK(render_error(session, "rounding") == "");
  CHECK(session.nobody_is_left());
}

TEST_CASE("private folder: those of processes that have ended are deleted at once, all others stay") {
  std::filesystem::path parent;
  { parent = PrivateFolder().path().parent_path(); }
  const std::string tag = owner_tag().substr(0, 9);
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  int status = 0;
  REQUIRE(::waitpid(dead, &status, 0) == dead);
  const auto folder_of = [&](const std::string& mark) {
    return parent / ("remap-pictures-" + mark + "-aBc123");
  };
  const std::filesystem::path left = folder_of(tag + std::to_string(dead)), own = folder_of(owner_tag()),
                              foreign = folder_of("00000000-" + std::to_string(dead));
  for (const auto& folder : {left, own, foreign}) std::filesystem::create_directory(folder);
  std::ofstream(left / "0.f32") << "x";
  { const PrivateFolder another; }
  CHECK_FALSE(std::filesystem::exists(left));
  for (const auto& folder : {own, foreign}) {
    CHECK(std::filesystem::exists(folder));
    std::filesystem::remove(folder);
  }
}
