// This file tests fitting and comparing from the command line, with small tables and small networks.
#include <filesystem>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "lower/fit_file.hpp"

using namespace remap;
namespace fs = std::filesystem;

TEST_CASE("remapc fit: auto prints the table that it decided from and keeps it in the fit", "[slow]") {
  const Session session;
  require_success(session.remapc(session.sweep("t.csv")));
  const ProcessResult fitted = require_success(session.remapc("fit t.csv -o fits --plot plot.svg"));
  for (const std::string word : {"1 x 1 ", "RMSE %", "one light", "chosen"})
    CHECK(fitted.errors.find(word) != std::string::npos);
  CHECK(fitted.output.empty());
  CHECK(fitted.errors.find('\r') == std::string::npos);  // only terminals show progress
  const Fit fit = load_fit(session.path("fits/mitsuba_ward_to_mitsuba_as.json"));
  CHECK(fit.candidates.size() >= 3);
  const ProcessResult shown = session.remapc("show mitsuba_ward_to_mitsuba_as --fits fits");
  CHECK(shown.output.find("Compared with") != std::string::npos);
  // The fit keeps the table of candidates, so `show` prints the same lines.
  const std::string table = fitted.errors.substr(0, fitted.errors.rfind('\n', fitted.errors.size() - 2));
  CHECK(shown.output.find(table) != std::string::npos);
  CHECK(shown.output.find("chosen by: pictures of other materials under other lights") != std::string::npos);

  const std::string plot = session.content("plot.svg");
  CHECK(plot.starts_with("<?xml"));
  for (const std::string word : {"compact, rms", "Error of each fit in f0", "alpha of mitsuba/ward"})
    CHECK(plot.find(word) != std::string::npos);
}

TEST_CASE("remapc fit: each kind of regression can be asked for, and a form", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(12, 4));
  const auto fit = [&](const Words& more) { return session.remapc("fit t.csv --force -o fits" + more); };
  const auto kind = [&] {
    return kind_name(load_fit(session.path("fits/made_ward_to_made_as.json")).mapping);
  };
  CHECK(fit("--model svr").exit_code == 0);
  CHECK(kind() == "svr");
  CHECK(session.remapc("show made_ward_to_made_as --fits fits").output.find("Gaussians of alpha") !=
        std::string::npos);
  CHECK(fit("--model mlp --layers 4 --starts 1").exit_code == 0);
  CHECK(kind() == "mlp");
  CHECK(fit("--model parametric --form paper+pole").errors.find("parametric paper+pole") !=
        std::string::npos);
  CHECK(kind() == "parametric");
}

TEST_CASE("remapc fit: a fit that cannot be lowered is kept with a warning, and has no header", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(12, 4));
  const std::string path = session.path("fits/made_ward_to_made_as.json");
  const auto fit = [&](const std::string& tolerance) {
    return require_success(session.remapc("fit t.csv --model parametric --form paper --lower " + tolerance +
                                          " --force -o fits"));
  };
  CHECK(fit("1e-12").errors.find("warning: made_ward_to_made_as: texremap and remapc emit cannot") !=
        std::string::npos);
  CHECK_FALSE(load_fit(path).converter.has_value());
  CHECK(session.remapc("show " + path).output.find("No header, because") != std::string::npos);
  CHECK(session.remapc("emit " + path + " -o headers").exit_code == 1);
  CHECK_FALSE(fs::exists(session.path("headers")));
  CHECK(fit("1e-3").errors.find("warning") == std::string::npos);
  const ConverterData loose = *load_fit(path).converter;
  fit("1e-4");
  const ConverterData close = *load_fit(path).converter;
  CHECK(loose.alpha_bound <= 1e-3);
  CHECK(close.alpha_bound <= 1e-4);
}

TEST_CASE("remapc fit: a fit that leaves nothing, and one of black, can be plotted", "[slow]") {
  const Session session;
  session.write("exact.csv", made_table(12, 4));  // this table has exactly the paper's form
  CHECK(session.remapc(session.fit("exact.csv") + "--plot exact.svg").exit_code == 0);
  CHECK(session.content("exact.svg").find("parametric paper, rms ") != std::string::npos);
  require_success(session.remapc(session.fit("exact.csv") + "--force --plot exact.png"));
  CHECK(session.content("exact.png").starts_with("\x89PNG"));
  std::string black = "# source: a/b\n# target: c/d\n" + kHeader;
  for (int i = 10; i < 40; ++i)
    for (const std::string specular : {"0.2", "0.5"})
      black += "0." + std::to_string(i) + "," + specular + ",0." + std::to_string(i) + ",0,0,ok\n";
  session.write("black.csv", black);
  const ProcessResult result = session.remapc("fit black.csv --model svr -o fits --plot black.svg");
  INFO(result.errors);
  CHECK(result.exit_code == 0);
  CHECK(fs::exists(session.path("black.svg")));
}

TEST_CASE("remapc fit: gnuplot's failure is shown", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(12, 4));
  session.write("bin/gnuplot",
                "#!/bin/sh\n[ \"$1\" = --version ] || { echo 'line 3: no such thing' >&2; exit 1; }\n");
  fs::permissions(session.path("bin/gnuplot"), fs::perms::owner_all);
  const Words fit = REMAPC_PROGRAM + session.fit("t.csv") + "--plot plot.svg";
  check_failure(session.run("/usr/bin/env PATH=" + session.path("bin") + fit), 1,
                "gnuplot failed (1): line 3: no such thing");
  CHECK_FALSE(fs::exists(session.path("plot.svg")));
}

TEST_CASE("remapc fit: the name of a table is only text for gnuplot", "[slow]") {
  const Session session;
  const std::string table = "it's`>RUN`.csv";
  session.write(table, made_table(12, 4));
  require_success(session.remapc("fit " + table + " --model parametric -o fits --plot plot.svg"));
  CHECK_FALSE(fs::exists(session.path("RUN")));
  CHECK(session.content("plot.svg").find("it's`>RUN`.csv") != std::string::npos);
}

TEST_CASE("remapc compare: fits and the formulas of today stand side by side", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(12, 4));
  require_success(session.remapc(session.fit("t.csv")));
  const ProcessResult result = require_success(session.remapc("compare t.csv --fits fits"));
  CHECK(result.output.find("made_ward_to_made_as (parametric") != std::string::npos);
  CHECK(result.output.find("fitted from this table, training rows included") != std::string::npos);
  CHECK(result.output.find("alpha and specular unchanged") != std::string::npos);
  CHECK(result.output.find("FBX2glTF, Yocto, Blender OBJ, assimp, obj2gltf (made/ward has alpha, not "
                           "an exponent)") != std::string::npos);
  CHECK(result.output.find("at edge") == std::string::npos);  // the column has no figures, so it is omitted

  const ProcessResult json = session.remapc("compare t.csv fits/made_ward_to_made_as.json --json");
  CHECK(json.output.find("\"fitted_from_this_table\": true") != std::string::npos);
  CHECK(json.output.find("\"name\": \"pbrt-v3\"") != std::string::npos);
  CHECK(json.output.find("does not apply: made/ward has alpha, not roughness") != std::string::npos);
}

TEST_CASE("remapc compare: a table without models is compared with formulas that need none") {
  const Session session;
  session.write("t.csv", kHeader + "0.1,0.2,0.3,0.4,0,ok\n");
  CHECK(require_success(session.remapc("compare t.csv --fits none"))
            .output.find("pbrt-v3 (the table's model has alpha, not "
                         "roughness)") != std::string::npos);
}

TEST_CASE("remapc compare: fits of one id are told apart by their files", "[slow]") {
  const Session session;
  session.write("t.csv", made_table(8, 3));
  require_success(session.remapc(session.fit("t.csv", "a")));
  require_success(session.remapc(session.fit("t.csv", "b")));
  const std::string a = session.path("a/made_ward_to_made_as.json");
  const std::string b = session.path("b/made_ward_to_made_as.json");
  const ProcessResult both = session.remapc("compare t.csv " + a + " " + b);
  CHECK(both.output.find(a + " (parametric") != std::string::npos);
  CHECK(both.output.find(b + " (parametric") != std::string::npos);
  CHECK(session.remapc("compare t.csv " + a).output.find(a) == std::string::npos);
}
