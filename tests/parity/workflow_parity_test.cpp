// This file compares headers of workflow conversions with the library: bit for bit, by gcc and clang, on
// random texels and on edges.
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/emit.hpp"
#include "lower/fit_file.hpp"
#include "runtime/stages/materials.hpp"
#include "support/campaign.hpp"
#include "support/header_flags.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

struct Build {
  std::string compiler, flags;
  bool fuses = false;  // fuses products and sums, so the last bits differ from the library's
};

// In full campaigns, every compiler is tested with every set of flags. Otherwise one compiler is tested with
// every set of flags. Sanitizers check the emitter, not its headers.
std::vector<Build> builds() {
  const bool has_both = has_program("g++") && has_program("clang++"), avx2 = has_avx2();
  std::vector<Build> all;
  for (const std::string compiler : {"g++", "clang++"}) {
    if (!has_program(compiler)) continue;
    const auto add = [&](const std::string& flags, const std::string& alone, bool fuses = false) {
      if (is_full_campaign() || !has_both || alone == compiler) all.push_back({compiler, flags, fuses});
    };
    add("-O0", "clang++");
    if (kSlowBuild) continue;
    add("-O2", "g++");
    if (is_full_campaign()) add("-O3", "");
    if (!avx2) continue;
    add("-O3 -mavx2", "clang++");
    add("-O3 -march=x86-64-v3", "g++", true);
  }
  return all;
}

// Returns the fits that ship, and fits with conventions that no shipped fit has.
std::vector<WorkflowFit> probed_models() {
  std::vector<WorkflowFit> all;
  for (const auto& entry : fs::directory_iterator(fs::path(REMAP_SOURCE_DIR) / "fits"))
    if (entry.path().extension() == ".json" && entry.path().filename() != "manifest.json")
      if (const AnyFit fit = load_any_fit(entry.path()); std::holds_alternative<WorkflowFit>(fit))
        all.push_back(std::get<WorkflowFit>(fit));
  REQUIRE(all.size() >= 8);
  // The shipped network has one hidden layer.
  all.push_back({"random_network", workflow_test::gltf(workflow_test::random_network()), {}, {}, "0"});
  WorkflowFit mixed{"mixed_conventions", workflow_test::gltf(Projection{kNoisyPrior}), {}, {}, "0"};
  mixed.conversion.specular.diffuse = DiffuseConvention::kPlain;
  mixed.conversion.specular.width = RoughnessEncoding::kAlpha;
  mixed.conversion.metallic.width = RoughnessEncoding::kGlossiness;
  WorkflowFit black{"black_dielectric", workflow_test::plain(Projection{0.0}, 0.0), {}, {}, "0"};
  black.conversion.metallic.width = RoughnessEncoding::kAlpha;
  all.push_back(mixed);
  all.push_back(black);
  return all;
}

// Returns `row_count` rows of texels: random texels, some beyond 0 to 1, and edge values in all places. Their
// number is not divisible by any block.
std::vector<std::vector<float>> texels(std::size_t row_count) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const float edges[] = {0.0f,  -0.0f, 1.0f, 0.04f, 1e-40f,   -1e-40f,  std::nextafter(1.0f, 2.0f),
                         1e30f, -1.0f, nan,  -nan,  infinity, -infinity};
  std::mt19937 random(17);
  std::uniform_real_distribution<float> share(0.0f, 1.0f), wide(-0.5f, 1.5f);
  std::vector<std::vector<float>> rows(row_count);
  const auto add = [&](const auto& value) {
    for (std::size_t r = 0; r < row_count; ++r) rows[r].push_back(value(r));
  };
  for (int i = 0; i < campaign_length(3000); ++i) add([&](std::size_t) { return share(random); });
  for (int i = 0; i < campaign_length(1000); ++i) add([&](std::size_t) { return wide(random); });
  for (int i = 0; i < campaign_length(1000); ++i) add([&](std::size_t) { return 0.06f * share(random); });
  for (const float edge : edges) {
    add([&](std::size_t) { return edge; });
    for (std::size_t place = 0; place < row_count; ++place)
      add([&](std::size_t r) { return r == place ? edge : share(random); });
  }
  while (rows[0].size() % 128 != 77) add([&](std::size_t) { return share(random); });
  return rows;
}

// Returns the rows one after the other, then the number of texels outside.
std::vector<float> by_library(const WorkflowConversion& conversion,
                              const std::vector<std::vector<float>>& rows) {
  const std::size_t count = rows[0].size(), out_rows = conversion.is_to_metallic() ? 5 : 7;
  std::vector<float> result(out_rows * count + 1);
  std::vector<const float*> in;
  std::vector<float*> out;
  for (const auto& row : rows) in.push_back(row.data());
  for (std::size_t r = 0; r < out_rows; ++r) out.push_back(&result[r * count]);
  result.back() = static_cast<float>(convert_workflow(conversion, count, in, out));
  return result;
}

std::vector<float> floats_of(const fs::path& path) {
  const std::string bytes = read_file(path);
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

// All NaN are treated as equal.
bool same(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::memcmp(&a[i], &b[i], sizeof(float)) != 0 && !(std::isnan(a[i]) && std::isnan(b[i])))
      return false;
  return true;
}

// Networks are compared with the interpreter in double precision, because sums of 300 products of floats have
// errors of about 1e-6. NaN must be in the same places.
bool close(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isnan(a[i]) != std::isnan(b[i]) || std::fabs(a[i] - b[i]) > 2e-5f) return false;
  return true;
}

struct Expected {
  WorkflowFit fit;
  std::vector<float> rows;  // results of the library
};

// Writes the headers, headers.hpp and their texels to a folder.
std::vector<Expected> write_headers(const fs::path& folder) {
  std::vector<Expected> all;
  std::string includes, entries;
  for (const WorkflowFit& fit : probed_models()) {
    write_file(folder / (fit.id + ".hpp"), emit_header(fit));
    const auto rows = texels(fit.conversion.is_to_metallic() ? 7 : 5);
    std::string bytes;
    for (const auto& row : rows)
      bytes.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(float));
    write_file(folder / (fit.id + ".in"), bytes);
    includes += "#include \"" + fit.id + ".hpp\"\n";
    entries += " ENTRY(" + fit.id + ")";
    all.push_back({fit, by_library(fit.conversion, rows)});
  }
  write_file(folder / "headers.hpp", includes + "#define CONVERTERS(ENTRY)" + entries + "\n");
  return all;
}

}  // namespace

TEST_CASE("workflow headers: the bits of the library from gcc and clang, rows as single texels, in place too",
          "[slow][campaign]") {
  const TemporaryFolder folder;
  const std::vector<Expected> all = write_headers(folder.path());
  const std::string program = folder.path() / "program";
  for (const Build& build : builds()) {
    INFO(build.compiler << " " << build.flags);
    REQUIRE(std::system((build.compiler + " -std=c++17 " + build.flags + kHeaderFlags + "-I" +
                         folder.path().string() + " " + REMAP_SOURCE_DIR +
                         "/tests/parity/workflow_driver.cpp -o " + program)
                            .c_str()) == 0);
    REQUIRE(std::system((program + " " + folder.path().string()).c_str()) == 0);
    for (const Expected& expected : all) {
      INFO(expected.fit.id);
      const std::vector<float> result = floats_of(folder.path() / (expected.fit.id + ".out"));
      if (is_learned(expected.fit.conversion.formula))
        CHECK(close(result, expected.rows));
      else if (!build.fuses)
        CHECK(same(result, expected.rows));
      CHECK(result.back() == expected.rows.back());
      fs::remove(folder.path() / (expected.fit.id + ".out"));
    }
  }
}

// In the test above a header follows other headers, which may include what it lacks.
TEST_CASE("workflow headers: need no other header before them", "[slow]") {
  const TemporaryFolder folder;
  std::string files;
  for (const Expected& expected : write_headers(folder.path()))
    files += " " + (folder.path() / (expected.fit.id + ".hpp")).string();
  CHECK(std::system(("g++ -std=c++17 -fsyntax-only -x c++" + files).c_str()) == 0);
}

TEST_CASE("workflow headers: what ships is what its fits give") {
  const fs::path root = REMAP_SOURCE_DIR;
  for (const WorkflowFit& fit : probed_models())
    if (const fs::path header = root / "generated" / (fit.id + ".hpp"); fs::exists(header)) {
      INFO(fit.id);
      CHECK((read_file(header) == emit_header(fit)));
    }
}
