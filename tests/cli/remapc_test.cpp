// This file tests remapc as a user runs it: a chain of commands, and runs that are interrupted.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"

using namespace remap;
namespace fs = std::filesystem;

TEST_CASE("remapc: sweep, check, fit, emit, eval, list and show work in a row") {
  const Session session;
  ProcessResult result =
      require_success(session.remapc(session.sweep("t.csv", "mitsuba/as-ior", "mitsuba/beckmann-ior")));
  CHECK(session.content("t.csv").starts_with(kHeader));  // plain CSV without comments
  CHECK(session.content("t.csv.json").find("\"source\": \"mitsuba/as-ior\",\n") != std::string::npos);
  CHECK(result.errors.find("36 rows (3 clamped, 33 ok)") != std::string::npos);
  CHECK(session.remapc("check t.csv").exit_code == 0);
  require_success(session.remapc(session.fit("t.csv")));
  const std::string fit = session.path("fits/mitsuba_as_ior_to_mitsuba_beckmann_ior.json");
  CHECK(load_fit(fit).table.comments.at("objective") == "natural-2");
  require_success(session.remapc("emit --all --fits fits -o generated"));
  CHECK(fs::exists(session.path("generated/converters.json")));
  result = session.remapc("eval " + fit + " t.csv --json");
  CHECK(result.exit_code == 0);
  CHECK(result.output.find("\"rows\": 36") != std::string::npos);
  CHECK(result.output.find("\"fitted_from_this_table\": true") != std::string::npos);
  CHECK(session.remapc("list --fits fits").output.find("parametric") != std::string::npos);
  result = session.remapc("show mitsuba_as_ior_to_mitsuba_beckmann_ior --fits fits");
  CHECK(result.output.find("mitsuba/beckmann-ior (alpha, f0)") != std::string::npos);
}

TEST_CASE("remapc eval --grid: prints what the interpreter gives over the domain, without a table") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  require_success(session.remapc(session.fit("t.csv")));
  const std::string path = session.path("fits/made_ward_to_made_as.json");
  const Fit fit = load_fit(path);
  std::string expected = "source_alpha,source_specular,target_alpha,target_f0\n";
  const Range widths = own_roughness_range(fit), speculars = specular_range(fit);
  for (const double width : {widths.min, (widths.min + widths.max) / 2.0, widths.max})
    for (const double specular : {speculars.min, (speculars.min + speculars.max) / 2.0, speculars.max}) {
      double out = 0.0;
      const double target = evaluate_texel(fit, width, {&specular, 1}, {&out, 1});
      for (const double value : {width, specular, target}) expected += number_text(value) + ",";
      expected += number_text(out) + "\n";
    }
  CHECK(session.remapc("eval " + path + " --grid 3").output == expected);
  const std::string file = session.path("new/grid.csv");
  CHECK(session.remapc("eval " + path + " --grid 3 -o " + file).output.empty());
  CHECK(read_file(file) == expected);
}

TEST_CASE("remapc: a result that exists is refused, and replaced with --force") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  require_success(session.remapc(session.fit("t.csv")));
  const std::string fit = session.path("fits/made_ward_to_made_as.json");
  require_success(session.remapc("emit " + fit + " -o ."));
  // emit only replaces files that are marked as generated
  require_success(session.remapc("emit " + fit + " -o ."));
  for (const std::string name :
       {"s.exr", "grid.csv", "p.png", "c.json", "plain.csv", "own/made_ward_to_made_as.hpp"})
    session.write(name, "mine");
  const auto check = [&](const Words& words, const std::string& name) {
    const std::string before = session.content(name);
    check_failure(session.remapc(words), 1, name + ": already exists (--force overwrites)");
    CHECK(session.content(name) == before);
    require_success(session.remapc(words + "--force"));
    CHECK((session.content(name) != before || name.starts_with("fits")));
  };
  check(session.fit("t.csv"), "fits/made_ward_to_made_as.json");
  check("emit " + fit + " -o own", "own/made_ward_to_made_as.hpp");
  check("eval " + fit + " --grid 3 -o grid.csv", "grid.csv");
  check("preview mitsuba_ward_to_mitsuba_ggx --resolution 16 -o p.png --fits " REMAP_SOURCE_DIR "/fits",
        "p.png");
  check("chain mitsuba_ward_to_mitsuba_ggx mitsuba_ggx_to_cycles_2_7_ggx --id c -o . --fits " REMAP_SOURCE_DIR
        "/fits",
        "c.json");
  check("export t.csv -o plain.csv", "plain.csv");
  check("render --model mitsuba/ggx --set alpha=0.3 --set f0=0.9 --resolution 8 -o s.exr", "s.exr");
}

TEST_CASE("remapc list: a folder without fits says so") {
  const Session session;
  session.write("empty/readme.txt", "");
  const ProcessResult result = session.remapc("list --fits empty");
  CHECK(result.exit_code == 0);
  CHECK(result.errors.find("no fits (*.json) in this folder") != std::string::npos);
}

TEST_CASE("remapc sweep: killed or interrupted it leaves nothing under the final name") {
  const Session session;
  for (const int signal : {SIGKILL, SIGTERM}) {
    auto arguments = session.sweep("broken.csv");
    arguments[6] = "512";  // large enough to run for seconds
    arguments[8] = "400";
    Process process = session.start(REMAPC_PROGRAM + arguments);
    while (process.is_running() && !process.catches(SIGTERM))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    process.send(signal);
    const ProcessResult result = process.wait();
    CAPTURE(signal, result.signal, result.exit_code, result.errors);
    CHECK((signal == SIGKILL ? result.signal == SIGKILL : result.exit_code == 1));
    CHECK_FALSE(fs::exists(session.path("broken.csv")));
  }
}

TEST_CASE("remapc render: writes an EXR that OpenImageIO's own tools read") {
  const Session session;
  const ProcessResult result = require_success(session.remapc(
      "render --model mitsuba/ggx --set alpha=0.3 --set f0=0.9,0.6,0.2 --light 45 --resolution 32 -o s.exr"));
  const ProcessResult info = session.run("/usr/bin/oiiotool --info -v s.exr");
  CHECK(info.output.find("32 x   32, 3 channel, float openexr") != std::string::npos);
  CHECK(info.output.find("remap:model: \"mitsuba/ggx\"") != std::string::npos);
}
