// Generated headers against the interpreter: built by gcc and clang with and without optimisation and AVX2,
// on a grid, at random and on edges.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>
#include <regex>

#include <catch2/catch.hpp>

#include "emit/emit.hpp"
#include "files.hpp"
#include "model/fit_json.hpp"
#include "model/interpreter.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

const std::string kWarnings = " -Wall -Wextra -Wshadow -Wconversion -Wpedantic -Werror ";

struct Build {
  std::string compiler;
  std::string flags;
};

bool runs(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

// Every compiler that is there; both in CI.
std::vector<std::string> compilers() {
  std::vector<std::string> found;
  for (const std::string compiler : {"g++", "clang++"}) {
    if (runs(compiler + " --version"))
      found.push_back(compiler);
    else
      std::cout << "skipped: " << compiler << " is not installed\n";
  }
  return found;
}

std::vector<Build> builds() {
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (!avx2) std::cout << "skipped: this processor has no AVX2\n";
  std::vector<Build> all;
  for (const std::string& compiler : compilers())
    for (const std::string level : {"-O0", "-O2", "-O3"})
      for (const std::string vectors : {"", " -mavx2", " -march=x86-64-v3"})
        if (vectors.empty() || avx2) all.push_back({compiler, level + vectors});
  return all;
}

Fit committed_fit() {
  return load_fit(fs::path(REMAP_SOURCE_DIR) / "fits" / "mitsuba_ward_to_mitsuba_as.json");
}

// The forms and conventions that no committed fit has.
std::vector<Fit> fits() {
  const Fit base = committed_fit();
  std::vector<Fit> all = {base};
  const auto add = [&](const std::string& id, RoughnessConvention source, RoughnessConvention target,
                       const Parametric& form) {
    Fit fit = base;
    fit.id = id;
    fit.source.roughness = source;
    fit.target.roughness = target;
    fit.target.specular = id == "same_names" ? fit.source.specular : fit.target.specular;
    fit.mapping = form;
    fit.domain = {{0.02, 0.95}, {0.0, 0.6}};
    all.push_back(fit);
  };
  const auto committed = std::get<Parametric>(base.mapping);
  Parametric steep = committed;  // a narrow step near 0, as the sub-pixel row of the published table makes it
  steep.ramp = -26.6;
  steep.ramp_rate = 86.0;
  steep.start = 1.29;
  Parametric extreme = committed;
  extreme.bump = -900.0;
  extreme.bump_rate = 3000.0;
  extreme.start = 0.9;
  const auto kAlpha = RoughnessConvention::kAlpha;
  add("steep_slope", kAlpha, kAlpha, steep);
  add("extreme_slope", kAlpha, kAlpha, extreme);
  add("same_names", kAlpha, kAlpha, Parametric{{0.9, 0.0, 0.0, 0.0}, 0.7, 0.0, 0.0, 0.0, 0.0});
  add("from_roughness", RoughnessConvention::kRoughness, RoughnessConvention::kGlossiness, committed);
  add("from_glossiness", RoughnessConvention::kGlossiness, RoughnessConvention::kRoughness, committed);
  add("to_exponent", kAlpha, RoughnessConvention::kExponent, committed);
  add("from_exponent", RoughnessConvention::kExponent, kAlpha, committed);
  return all;
}

// Planar texels: width, then three channels.
std::vector<float> texels(const Fit& fit) {
  const Range own = own_roughness_range(fit), specular = specular_range(fit);
  const float low = static_cast<float>(own.min), high = static_cast<float>(own.max),
              top = static_cast<float>(specular.max);
  std::vector<std::array<float, 4>> rows;
  for (int i = 0; i <= 256; ++i)
    for (int j = 0; j <= 8; ++j) {
      const float s = top * static_cast<float>(j) / 8.0f;
      rows.push_back({low + (high - low) * static_cast<float>(i) / 256.0f, s, 0.5f * s, top - s});
    }
  std::mt19937 random(7);
  std::uniform_real_distribution<float> share(-0.5f, 1.5f);
  for (int i = 0; i < 4000; ++i)
    rows.push_back({high * share(random), top * share(random), top * share(random), top * share(random)});
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const float edges[] = {0.0f,
                         -0.0f,
                         low,
                         high,
                         std::nextafter(low, 0.0f),
                         std::nextafter(high, 2.0f * high),
                         top,
                         std::nextafter(top, 2.0f),
                         1e-42f,
                         -1e-42f,
                         3.4e38f,
                         infinity,
                         -infinity,
                         nan,
                         -nan,
                         -1.0f};
  for (const float width : edges)
    for (const float channel : edges) rows.push_back({width, channel, 0.25f * top, channel});
  std::vector<float> planar(4 * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t c = 0; c < 4; ++c) planar[c * rows.size() + i] = rows[i][c];
  return planar;
}

void write_floats(const fs::path& path, const std::vector<float>& values) {
  write_file(path, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

std::vector<float> read_floats(const fs::path& path) {
  const std::string bytes = read_file(path);
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

// 1e-6 times `scale`, or four units in the last place of a float where that is more.
bool close(float value, double expected, double scale = 1.0) {
  if (std::isnan(expected)) return std::isnan(value);
  if (std::isinf(expected) || std::fabs(expected) > 3.4e38)
    return std::isinf(value) || std::fabs(value) > 3.3e38f;
  const double ulp =
      std::nextafter(static_cast<float>(std::fabs(expected)), std::numeric_limits<float>::infinity()) -
      static_cast<float>(std::fabs(expected));
  return std::fabs(static_cast<double>(value) - expected) <= std::max(1e-6 * scale, 4.0 * ulp);
}

// An exponent is 2 / alpha^2 - 2: it doubles the relative error of alpha, so it is judged as the alpha it
// stands for.
bool close_width(const Fit& fit, float value, double expected) {
  if (fit.target.roughness != RoughnessConvention::kExponent || std::isnan(expected))
    return close(value, expected);
  return close(static_cast<float>(to_alpha(RoughnessConvention::kExponent, value)),
               to_alpha(RoughnessConvention::kExponent, expected));
}

void check_against_interpreter(const Fit& fit, const std::vector<float>& in, const std::vector<float>& out) {
  const std::size_t count = in.size() / 4;
  REQUIRE(out.size() == in.size() + 1);
  std::size_t outside = 0, wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<double, 3> specular = {in[count + i], in[2 * count + i], in[3 * count + i]};
    std::array<double, 3> expected{};
    bool inside = true;
    const double width = evaluate_texel(fit, in[i], specular, expected, &inside);
    outside += inside ? 0 : 1;
    bool right = close_width(fit, out[i], width);
    for (std::size_t c = 0; c < 3; ++c) {
      // Extrapolation scales what the edge of the domain gives, and its error with it.
      const double scale =
          std::isfinite(specular[c]) ? std::max(1.0, std::fabs(specular[c]) / fit.domain.specular.max) : 1.0;
      right = right && close(out[(c + 1) * count + i], expected[c], scale);
    }
    if (!right && ++wrong <= 3)
      UNSCOPED_INFO("texel " << in[i] << " " << specular[0] << " " << specular[1] << ": header " << out[i]
                             << " " << out[count + i] << " " << out[2 * count + i] << ", interpreter "
                             << width << " " << expected[0] << " " << expected[1]);
  }
  CHECK(wrong == 0);
  CHECK(out.back() == static_cast<float>(outside));
}

std::string compile_command(const Build& build, const fs::path& folder, const std::string& id,
                            const fs::path& program) {
  return build.compiler + " -std=c++17 " + build.flags + kWarnings + "-I" + folder.string() +
         " -DHEADER='\"" + id + ".hpp\"' -DNAMESPACE=remap::" + id + " " + REMAP_SOURCE_DIR +
         "/tests/parity/driver.cpp -o " + program.string();
}

}  // namespace

TEST_CASE("generated header: agrees with the interpreter for every compiler and instruction set", "[slow]") {
  const TemporaryFolder folder;
  for (const Fit& fit : fits()) {
    write_file(folder.path() / (fit.id + ".hpp"), remapc::emit_header(fit));
    const std::vector<float> in = texels(fit);
    write_floats(folder.path() / "in", in);
    for (const Build& build : builds()) {
      // Every build of the committed fit; of the others one with and one without optimisation for each
      // compiler.
      const bool committed = fit.id == "mitsuba_ward_to_mitsuba_as";
      if (!committed && build.flags != "-O0" && build.flags != "-O3 -march=x86-64-v3") continue;
      INFO(fit.id << " " << build.compiler << " " << build.flags);
      const fs::path program = folder.path() / "driver";
      REQUIRE(std::system(compile_command(build, folder.path(), fit.id, program).c_str()) == 0);
      REQUIRE(std::system((program.string() + " " + (folder.path() / "in").string() + " " +
                           (folder.path() / "out").string())
                              .c_str()) == 0);
      check_against_interpreter(fit, in, read_floats(folder.path() / "out"));
    }
  }
}

TEST_CASE("generated header: self_test fails when any one coefficient is changed", "[slow]") {
  const TemporaryFolder folder;
  const Fit fit = committed_fit();
  const std::string header = remapc::emit_header(fit);
  write_file(folder.path() / "main.cpp", "#include \"" + fit.id + ".hpp\"\nint main() { return remap::" +
                                             fit.id + "::self_test() ? 0 : 3; }\n");
  const auto exit_code = [&](const std::string& text) {
    write_file(folder.path() / (fit.id + ".hpp"), text);
    const std::string program = (folder.path() / "main").string();
    REQUIRE(std::system(("g++ -std=c++17 " + program + ".cpp -o " + program).c_str()) == 0);
    return WEXITSTATUS(std::system(program.c_str()));
  };
  REQUIRE(exit_code(header) == 0);

  // Every float between the start of target_alpha and the end of specular_slope, made 1 % larger.
  const std::size_t start = header.find("inline float target_alpha"),
                    end = header.find("// What the width alone decides");
  REQUIRE(start < end);
  const std::string code = header.substr(start, end - start);
  const std::regex literal("-?[0-9]+\\.?[0-9]*(e-?[0-9]+)?f");
  int coefficients = 0;
  for (std::sregex_iterator it(code.begin(), code.end(), literal); it != std::sregex_iterator(); ++it) {
    const double value = std::stod(it->str());
    std::string changed = header;
    changed.replace(start + static_cast<std::size_t>(it->position()), static_cast<std::size_t>(it->length()),
                    std::to_string(value * 1.01 + 1e-4) + "f");
    INFO("coefficient " << it->str());
    CHECK(exit_code(changed) == 3);
    ++coefficients;
  }
  CHECK(coefficients >= 8);
}

TEST_CASE("generated header: compiles alone, twice, beside another and in two files, as C++17, 20 and 23",
          "[slow]") {
  const TemporaryFolder folder;
  const auto all = fits();
  std::string includes;
  for (const Fit& fit : all) {
    write_file(folder.path() / (fit.id + ".hpp"), remapc::emit_header(fit));
    includes += "#include \"" + fit.id + ".hpp\"\n#include \"" + fit.id + ".hpp\"\n";
  }
  write_file(folder.path() / "registry.hpp", remapc::emit_registry(all));
  write_file(folder.path() / "one.cpp",
             includes + "bool test_one() { return remap::" + all[0].id + "::self_test(); }\n");
  write_file(folder.path() / "two.cpp",
             "#include \"registry.hpp\"\nbool test_one();\nint main() {\n  bool passed = test_one();\n"
             "  for (const auto& entry : remap::kConverters) passed = passed && entry.self_test();\n"
             "  return passed ? 0 : 1;\n}\n");
  for (const std::string& compiler : compilers()) {
    for (const std::string standard : {"c++17", "c++20", "c++2b"}) {
      const std::string program = (folder.path() / "both").string();
      INFO(compiler << " " << standard);
      REQUIRE(std::system((compiler + " -std=" + standard + kWarnings + "-O1 " +
                           (folder.path() / "one.cpp").string() + " " + (folder.path() / "two.cpp").string() +
                           " -o " + program)
                              .c_str()) == 0);
      CHECK(std::system(program.c_str()) == 0);
    }
  }
}

TEST_CASE("generated header: stays right under fast-math flags of its user", "[slow]") {
  const TemporaryFolder folder;
  const Fit fit = committed_fit();
  write_file(folder.path() / (fit.id + ".hpp"), remapc::emit_header(fit));
  // NaN, infinity, denormals and the sign of 0 are what those flags give up; the rest has to hold.
  std::vector<float> in = texels(fit);
  for (float& value : in)
    if (!std::isnormal(value)) value = 0.5f;
  write_floats(folder.path() / "in", in);
  for (const std::string& compiler : compilers()) {
    const fs::path program = folder.path() / "driver";
    REQUIRE(std::system(
                compile_command({compiler, "-O3 -ffast-math"}, folder.path(), fit.id, program).c_str()) == 0);
    REQUIRE(std::system((program.string() + " " + (folder.path() / "in").string() + " " +
                         (folder.path() / "out").string())
                            .c_str()) == 0);
    check_against_interpreter(fit, in, read_floats(folder.path() / "out"));
  }
}
