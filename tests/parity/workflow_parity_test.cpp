// Headers of workflow conversions against the library: bit for bit, by gcc and clang, on random texels and on
// edges.
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <limits>

#include <catch2/catch.hpp>

#include "emit/emit.hpp"
#include "fit_file/fit_json.hpp"
#include "support/temporary_folder.hpp"
#include "system/files.hpp"
#include "workflow/materials.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

struct Build {
  std::string compiler, flags;
  bool fuses = false;  // products and sums: other last bits than the library's
};

bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

std::vector<Build> builds() {
  std::vector<Build> all;
  for (const std::string compiler : {"g++", "clang++"}) {
    if (!runs(compiler + " --version")) {
      std::cout << "skipped: " << compiler << " is not installed\n";
      continue;
    }
    for (const std::string flags : {"-O0", "-O2", "-O3"}) all.push_back({compiler, flags, false});
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      all.push_back({compiler, "-O3 -mavx2", false});
      all.push_back({compiler, "-O3 -march=x86-64-v3", true});
    }
  }
  return all;
}

// What ships, and conventions that nothing shipped has.
std::vector<WorkflowFit> probed_models() {
  std::vector<WorkflowFit> all;
  for (const auto& entry : fs::directory_iterator(fs::path(REMAP_SOURCE_DIR) / "fits"))
    if (entry.path().extension() == ".json" && entry.path().filename() != "manifest.json")
      if (const AnyFit fit = load_any_fit(entry.path()); std::holds_alternative<WorkflowFit>(fit))
        all.push_back(std::get<WorkflowFit>(fit));
  REQUIRE(all.size() >= 8);
  // The network that ships has one hidden layer.
  all.push_back({"random_network", workflow_test::gltf(workflow_test::random_network()), {}, {}, "0"});
  WorkflowFit mixed{"mixed_conventions", workflow_test::gltf(Projection{kNoisyPrior}), {}, {}, "0"};
  mixed.conversion.specular.diffuse = DiffuseConvention::kPlain;
  mixed.conversion.specular.width = RoughnessConvention::kAlpha;
  mixed.conversion.metallic.width = RoughnessConvention::kGlossiness;
  WorkflowFit black{"black_dielectric", workflow_test::plain(Projection{0.0}, 0.0), {}, {}, "0"};
  black.conversion.metallic.width = RoughnessConvention::kAlpha;
  all.push_back(mixed);
  all.push_back(black);
  return all;
}

// `row_count` rows of texels, a count that no block divides: random ones, some beyond 0 to 1, and edges in
// all places.
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
  for (int i = 0; i < 3000; ++i) add([&](std::size_t) { return share(random); });
  for (int i = 0; i < 500; ++i) add([&](std::size_t) { return wide(random); });
  for (int i = 0; i < 500; ++i) add([&](std::size_t) { return 0.06f * share(random); });
  for (const float edge : edges) {
    add([&](std::size_t) { return edge; });
    for (std::size_t place = 0; place < row_count; ++place)
      add([&](std::size_t r) { return r == place ? edge : share(random); });
  }
  while (rows[0].size() % 128 != 77) add([&](std::size_t) { return share(random); });
  return rows;
}

// Rows one after the other, then the number of texels outside.
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

// NaN equals NaN whatever its bits.
bool same(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::memcmp(&a[i], &b[i], sizeof(float)) != 0 && !(std::isnan(a[i]) && std::isnan(b[i])))
      return false;
  return true;
}

// Networks are held against the interpreter in double precision: sums of 300 products of floats err by some
// 1e-6. NaN stands in the same places.
bool close(const std::vector<float>& a, const std::vector<float>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::isnan(a[i]) != std::isnan(b[i]) || std::fabs(a[i] - b[i]) > 2e-5f) return false;
  return true;
}

}  // namespace

TEST_CASE(
    "workflow headers: the bits of the library from gcc and clang, rows as single texels, in place too") {
  const TemporaryFolder folder;
  const std::string warnings = " -Wall -Wextra -Wshadow -Wconversion -Wpedantic -Werror ";
  for (const WorkflowFit& fit : probed_models()) {
    const fs::path header = folder.path() / (fit.id + ".hpp"), in = folder.path() / "in",
                   out = folder.path() / "out", program = folder.path() / "program";
    write_file(header, remapc::emit_header(fit));
    const auto rows = texels(fit.conversion.is_to_metallic() ? 7 : 5);
    std::string bytes;
    for (const auto& row : rows)
      bytes.append(reinterpret_cast<const char*>(row.data()), row.size() * sizeof(float));
    write_file(in, bytes);
    const std::vector<float> expected = by_library(fit.conversion, rows);
    for (const Build& build : builds()) {
      INFO(fit.id << " by " << build.compiler << " " << build.flags);
      REQUIRE(std::system((build.compiler + " -std=c++17 " + build.flags + warnings +
                           "-DCONVERTER=" + fit.id + " '-DHEADER=\"" + header.string() + "\"' " +
                           REMAP_SOURCE_DIR + "/tests/parity/workflow_driver.cpp -o " + program.string())
                              .c_str()) == 0);
      REQUIRE(std::system((program.string() + " " + in.string() + " " + out.string()).c_str()) == 0);
      const std::vector<float> result = floats_of(out);
      if (is_learned(fit.conversion.formula))
        CHECK(close(result, expected));
      else if (!build.fuses)
        CHECK(same(result, expected));
      CHECK(result.back() == expected.back());
    }
  }
}

TEST_CASE("workflow headers: what ships is what its fits give") {
  const fs::path root = REMAP_SOURCE_DIR;
  for (const WorkflowFit& fit : probed_models())
    if (const fs::path header = root / "generated" / (fit.id + ".hpp"); fs::exists(header)) {
      INFO(fit.id);
      CHECK((read_file(header) == remapc::emit_header(fit)));
    }
}
