// What comes from other tools and goes to them, as a person meets it: libsvm models in, lookup tables out;
// and what `list` and `show` say of each kind of fit.
#include <filesystem>
#include <sstream>

#include <catch2/catch.hpp>

#include "cli/remapc_session.hpp"
#include "model/interpreter.hpp"
#include "remap/fit_file.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

const std::string kModel =
    "svm_type epsilon_svr\nkernel_type rbf\ngamma 0.5\nnr_class 2\ntotal_sv 2\nrho -0.25\nSV\n";

// A description with its two model files, as a user has them.
void write_models(const Session& session) {
  session.write("alpha.model", kModel + "1.5 1:0.25 \n-1.4 1:0 \n");
  session.write("specular.model", kModel + "1.5 1:0.25 2:0.75 \n-1.4 2:0.5 \n");
  session.write("d.json", R"({
    "id": "my_svr",
    "source": {"model": "mitsuba/ward", "roughness": "alpha", "specular": "specular"},
    "target": {"model": "mitsuba/as", "roughness": "roughness", "specular": "f0"},
    "domain": {"alpha": [0.05, 1], "specular": [0, 0.9]},
    "alpha": {"model_file": "alpha.model", "inputs": [{"name": "alpha", "offset": 0, "scale": 1}],
              "output": {"offset": 0.1, "scale": 1}},
    "specular": {"model_file": "specular.model",
                 "inputs": [{"name": "alpha", "offset": 0, "scale": 1},
                            {"name": "specular", "offset": 0, "scale": 1}],
                 "output": {"offset": 0.1, "scale": 1}}
  })");
}

std::vector<std::string> data_lines(const std::string& file) {
  std::vector<std::string> lines;
  std::istringstream stream(read_file(file));
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("#")) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("remapc import: models of libsvm become a fit that list, show and emit take", "[slow]") {
  const Session session;
  write_models(session);
  const ProcessResult result =
      require_success(session.remapc({"import", session.path("d.json"), "-o", session.path("fits")}));
  CHECK(result.errors.find("2 vectors for alpha, 2 for f0; errors unknown (--table measures them)") !=
        std::string::npos);
  const Fit fit = load_fit(session.path("fits/my_svr.json"));
  // 0.25 + 1.5 exp(0) - 1.4 exp(-0.5 / 16), behind the output's offset.
  CHECK(evaluate_mapping(fit.mapping, 0.25, 0.5).alpha ==
        Approx(0.1 + 0.25 + 1.5 - 1.4 * std::exp(-0.03125)).epsilon(1e-12));
  CHECK(session.remapc({"list", "--fits", session.path("fits")}).output.find("svr        errors unknown") !=
        std::string::npos);
  const ProcessResult shown = session.remapc({"show", "my_svr", "--fits", session.path("fits")});
  CHECK(shown.output.find("unknown (no rows held out)") != std::string::npos);
  CHECK(shown.output.find("2 Gaussians of alpha and specular") != std::string::npos);
  CHECK(shown.output.find("imported: libsvm model files") != std::string::npos);
}

TEST_CASE("remapc import: a table measures the errors") {
  const Session session;
  write_models(session);
  session.write("t.csv", made_table(8, 3));
  const ProcessResult result =
      require_success(session.remapc({"import", session.path("d.json"), "--table", session.path("t.csv"),
                                      "-o", session.path("fits"), "--json"}));
  CHECK(result.output.find("\"rows\": 24") != std::string::npos);
  CHECK(load_fit(session.path("fits/my_svr.json")).alpha_error.rms > 0.0);
  const ProcessResult shown = session.remapc({"show", "my_svr", "--fits", session.path("fits")});
  CHECK(shown.output.find("24 rows (trained elsewhere)") != std::string::npos);
}

TEST_CASE("remapc export: a parametric fit is a table over its width, an imported one over both", "[slow]") {
  const Session session;
  write_models(session);
  session.write("t.csv", made_table(8, 3));
  auto fit = session.fit("t.csv");
  fit.insert(fit.end(), {"--form", "paper"});
  require_success(session.remapc(fit));
  require_success(session.remapc({"import", session.path("d.json"), "-o", session.path("fits")}));
  const std::string table = session.path("lut/one.csv");
  ProcessResult result = require_success(session.remapc(
      {"export", "mitsuba_ward_to_mitsuba_as", "--fits", session.path("fits"), "--size", "5", "-o", table}));
  CHECK(result.output.empty());
  CHECK(result.errors.find("linear lookup deviates from the fit by at most") != std::string::npos);
  CHECK(read_file(table).starts_with("# format: remap-lookup\n# format_version: 1\n"));
  CHECK(data_lines(table)[0] == "source_alpha,target_alpha,target_f0_factor");
  CHECK(data_lines(table).size() == 6);

  result = session.remapc({"export", session.path("fits/my_svr.json"), "--size", "5", "--size-specular", "3",
                           "--json", "-o", table});
  CHECK(result.output.find("\"name\": \"target_roughness\"") != std::string::npos);
  CHECK(result.output.find("\"lookup_error\"") != std::string::npos);
  CHECK(data_lines(table)[0] == "source_alpha,source_specular,target_roughness,target_f0");
  CHECK(data_lines(table).size() == 16);  // the table of before was replaced
  const Fit svr = load_fit(session.path("fits/my_svr.json"));
  const std::array<double, 1> specular = {0.0};
  std::array<double, 1> out{};
  const double roughness = evaluate_texel(svr, 1.0, specular, out);
  CHECK(data_lines(table)[13] == "1,0," + number_text(roughness) + "," + number_text(out[0]));

  CHECK(session.remapc({"export", session.path("fits/my_svr.json"), "--only", "roughness", "-o", table})
            .exit_code == 0);
  CHECK(data_lines(table)[0] == "source_alpha,target_roughness");
}

TEST_CASE("remapc list: a folder without fits says so") {
  const Session session;
  session.write("empty/readme.txt", "");
  const ProcessResult result = session.remapc({"list", "--fits", session.path("empty")});
  CHECK(result.exit_code == 0);
  CHECK(result.errors.find("no fits (*.json) in this folder") != std::string::npos);
}
