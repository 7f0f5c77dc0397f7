// This file compares generated headers with the interpreter. They are built by gcc and clang with and without
// optimisation and AVX2, and run on a grid, at random and on edges.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <regex>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/emit.hpp"
#include "fit/network/fit_network.hpp"
#include "fit/svr/svr.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "support/campaign.hpp"
#include "support/header_flags.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

struct Build {
  std::string compiler;
  std::string flags;
};

bool succeeds(const std::string& command) { return std::system(command.c_str()) == 0; }

// Returns every compiler that is installed. CI has both.
std::vector<std::string> compilers() {
  std::vector<std::string> found;
  for (const std::string compiler : {"g++", "clang++"})
    if (has_program(compiler)) found.push_back(compiler);
  return found;
}

// A compiler may fuse products with sums in rows, but not in single texels (decision 014). Vectorised code
// with little or no optimisation is only tested in full campaigns. Sanitizers check the emitter, not its
// headers, so they need only one build.
std::vector<Build> builds() {
  const bool avx2 = has_avx2();
  std::vector<Build> all;
  for (const std::string& compiler : compilers())
    for (const std::string level : {"-O0", "-O2", "-O3"}) {
      if (kSlowBuild && level != "-O0") continue;
      for (const std::string vectors :
           {"", " -mavx2", " -march=x86-64-v3 -ffp-contract=off -fno-tree-slp-vectorize"})
        if (vectors.empty() || (avx2 && (level == "-O3" || is_full_campaign())))
          all.push_back({compiler, level + vectors});
    }
  return all;
}

Fit committed_fit() {
  return load_fit(fs::path(REMAP_SOURCE_DIR) / "fits" / "mitsuba_ward_to_mitsuba_as_sztrajman_2019.json");
}

// A MadeModel is a header under test: the fit, and what the header promises.
struct MadeModel {
  Fit fit;
  double alpha_within = 2e-6, specular_within = 2e-6;
};

MadeModel lowered(Fit fit) {
  add_converter(&fit);
  return {fit, fit.converter->alpha_bound, fit.converter->specular_bound};
}

// Returns rows of a smooth table, for regressions.
std::vector<TableRow> rows_of(const Parametric& form, const Domain& domain) {
  std::vector<TableRow> rows;
  for (int i = 0; i <= 12; ++i)
    for (int j = 0; j <= 8; ++j) {
      TableRow row;
      row.alpha1 = domain.alpha.min + (domain.alpha.max - domain.alpha.min) * i / 12.0;
      row.specular1 = domain.specular.min + (domain.specular.max - domain.specular.min) * j / 8.0;
      const MappedTexel target = evaluate_mapping(form, row.alpha1, row.specular1);
      row.alpha2 = target.alpha;
      row.specular2 = target.specular;
      rows.push_back(row);
    }
  return rows;
}

// If a mapping does not vanish with specular, its domain must begin above 0.
constexpr Domain kBright = {{0.2, 0.95}, {0.15, 0.6}};

// Returns models of the kinds, forms and conventions that no committed fit has.
std::vector<MadeModel> subjects() {
  const Fit base = committed_fit();
  std::vector<MadeModel> all = {lowered(base)};
  const auto add = [&](const std::string& id, RoughnessEncoding source, RoughnessEncoding target,
                       const MappingKind& mapping) {
    Fit fit = base;
    fit.id = id;
    fit.source.roughness = source;
    fit.target.roughness = target;
    fit.target.specular = id == "same_names" ? fit.source.specular : fit.target.specular;
    fit.mapping = mapping;
    fit.domain = {{0.02, 0.95}, {0.0, 0.6}};
    if (!is_proportional(mapping)) fit.domain = kBright;
    all.push_back(lowered(fit));
  };
  const Parametric paper{{{1.06, -0.63, 0.06, 0.09}}, {{1, {0.74, -0.19, 0.0, -1.03, 3.6, 0.0}}}};
  const Parametric full{{{1.06, -0.63}, {0.05, -0.02}},
                        {{0, {0.02, 0.1, 2.0, 0.0, 0.0, 0.0}},
                         {1, {0.74, -0.19, 0.0, -0.6, 3.6, 1e-4}},
                         {1, {0.05, 0.0, 0.0, 0.1, 9.0, 0.0}},
                         {2, {0.2, 0.3, 1.5, 0.0, 0.0, 0.0}}}};
  const auto kAlpha = RoughnessEncoding::kAlpha;
  add("all_powers", kAlpha, kAlpha, full);
  add("same_names", kAlpha, kAlpha, Parametric{{{0.9}}, {{1, {0.7, 0.0, 0.0, 0.0, 0.0, 0.0}}}});
  const std::vector<TableRow> rows = rows_of(full, kBright);
  const SvrHyperParameters smooth{100.0, 0.5, 1e-4, 1.0, 0.0};
  add("vectors", kAlpha, kAlpha, fit_svr(rows, {1, 1, smooth, smooth}).mapping);
  for (const Activation activation : {Activation::kTanh, Activation::kSilu}) {
    TrainingOptions options;
    options.activation = activation;
    options.hidden = {6};
    options.starts = 1;
    add("network_" + std::string(activation_name(activation)), kAlpha, kAlpha,
        fit_mlp(rows, options).mapping);
  }
  add("from_roughness", RoughnessEncoding::kRoughness, RoughnessEncoding::kGlossiness, paper);
  add("from_glossiness", RoughnessEncoding::kGlossiness, RoughnessEncoding::kRoughness, full);
  add("to_squared", kAlpha, RoughnessEncoding::kSquared, paper);
  add("from_squared", RoughnessEncoding::kSquared, kAlpha, full);
  add("to_exponent", kAlpha, RoughnessEncoding::kExponent, paper);
  add("from_exponent", RoughnessEncoding::kExponent, kAlpha, full);
  Fit capped = base;  // the target is at both limits and has no hinge
  capped.id = "capped";
  capped.mapping = Parametric{{{1.3}}, {{1, {1.4, 0.0, 0.0, 0.0, 0.0, 0.0}}}};
  capped.domain = {{0.02, 0.95}, {0.0, 1.0}};
  capped.limits.specular = 1.0;
  all.push_back(lowered(capped));
  CompactForm form;
  form.pole = 0.3f;
  form.alpha = {{1.3f, -0.1f, 0.02f}, {0.05f}};
  form.specular = {{1.8f, -0.3f}, {0.2f, 0.01f}, {0.03f}};
  add("compact", kAlpha, kAlpha, form);
  form.alpha_limit = form.specular_limit = 1.0f;
  form.hinge = {-0.3f, 0.1f, 0.2f, 0.4f};
  add("hinged", kAlpha, kAlpha, form);
  add("hinged_roughness", RoughnessEncoding::kRoughness, RoughnessEncoding::kExponent, form);
  return all;
}

// Returns planar texels: width, then three channels.
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
  const float below = std::nextafter(low, 0.0f), above = std::nextafter(high, 2.0f * high),
              brighter = std::nextafter(top, 2.0f);
  const float edges[] = {0.0f,   -0.0f,   low,     high,     below,     above, top,  brighter,
                         1e-42f, -1e-42f, 3.4e38f, infinity, -infinity, nan,   -nan, -1.0f};
  // In floats, this product overflows, so it differs from the product of doubles. Such texels are left out.
  for (const float width : edges)
    for (const float channel : edges)
      if (channel != 3.4e38f) rows.push_back({width, channel, 0.25f * top, channel});
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

// Returns true if the difference is at most `within`, or at most four units in the last place of a float.
bool close(float value, double expected, double within) {
  if (std::isnan(expected)) return std::isnan(value);
  if (std::isinf(expected) || std::fabs(expected) > 3.4e38)
    return std::isinf(value) || std::fabs(value) > 3.3e38f;
  const double ulp =
      std::nextafter(static_cast<float>(std::fabs(expected)), std::numeric_limits<float>::infinity()) -
      static_cast<float>(std::fabs(expected));
  return std::fabs(static_cast<double>(value) - expected) <= std::max(within, 4.0 * ulp);
}

// Compares widths as alpha. An exponent is 2 / alpha^2 - 2, which doubles its relative error. A square root
// does not double it, but is steep at 0. Adjacent floats of the parameter limit how close the result can be.
bool close_width(const MadeModel& subject, float value, double expected) {
  const RoughnessEncoding convention = subject.fit.target.roughness;
  if (convention == RoughnessEncoding::kAlpha || !std::isfinite(expected))
    return close(value, expected, subject.alpha_within);
  return close(static_cast<float>(to_alpha(convention, value)), to_alpha(convention, expected),
               subject.alpha_within + 1e-6);
}

void check_against_interpreter(const MadeModel& subject, const std::vector<float>& in,
                               const std::vector<float>& out) {
  const std::size_t count = in.size() / 4;
  REQUIRE(out.size() == in.size() + 1);
  std::size_t outside = 0, wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<double, 3> specular = {in[count + i], in[2 * count + i], in[3 * count + i]};
    std::array<double, 3> expected{};
    bool inside = true;
    const double width = evaluate_texel(subject.fit, in[i], specular, expected, &inside);
    outside += inside ? 0 : 1;
    bool right = close_width(subject, out[i], width);
    double scale = 1.0;  // extrapolation multiplies the result at the edge of the domain, and also its error
    for (const double channel : specular)
      if (std::isfinite(channel)) scale = std::max(scale, channel / subject.fit.domain.specular.max);
    for (std::size_t c = 0; c < 3; ++c)
      right = right && close(out[(c + 1) * count + i], expected[c], subject.specular_within * scale);
    if (!right && ++wrong <= 3)
      UNSCOPED_INFO("texel " << in[i] << " " << specular[0] << " " << specular[1] << " " << specular[2]
                             << ": header " << out[i] << " " << out[count + i] << " " << out[2 * count + i]
                             << " " << out[3 * count + i] << ", interpreter " << width << " " << expected[0]
                             << " " << expected[1] << " " << expected[2]);
  }
  CHECK(wrong == 0);
  CHECK(out.back() == static_cast<float>(outside));
}

// Headers holds the headers of `subjects`, their texels and headers.hpp, in a separate folder.
class Headers {
 public:
  explicit Headers(const std::vector<MadeModel>& made) : subjects_(made) {
    std::string includes, entries;
    for (const MadeModel& subject : subjects_) {
      const std::string& id = subject.fit.id;
      write_file(path(id + ".hpp"), emit_header(subject.fit));
      inputs_.push_back(texels(subject.fit));
      includes += "#include \"" + id + ".hpp\"\n";
      entries += " ENTRY(" + id + ")";
    }
    write_file(path("headers.hpp"), includes + "#define HEADER_COUNT " + std::to_string(subjects_.size()) +
                                        "\n#define CONVERTERS(ENTRY)" + entries + "\n");
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  // Replaces zeros, denormals, infinities and NaN by 0.5.
  void keep_normal_texels() {
    for (std::vector<float>& values : inputs_)
      for (float& value : values)
        if (!std::isnormal(value)) value = 0.5f;
  }

  // Runs the compiler once and the program once, for all headers.
  void check(const Build& build) const {
    INFO(build.compiler << " " << build.flags);
    REQUIRE(succeeds(build.compiler + " -std=c++17 " + build.flags + kHeaderFlags + "-I" +
                     folder_.path().string() + " " + REMAP_SOURCE_DIR + "/tests/parity/driver.cpp -o " +
                     path("driver")));
    for (std::size_t i = 0; i < subjects_.size(); ++i)
      write_floats(path(subjects_[i].fit.id + ".in"), inputs_[i]);
    REQUIRE(succeeds(path("driver") + " " + folder_.path().string()));
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      INFO(subjects_[i].fit.id);
      check_against_interpreter(subjects_[i], inputs_[i], read_floats(path(subjects_[i].fit.id + ".out")));
    }
  }

 private:
  TemporaryFolder folder_;
  std::vector<MadeModel> subjects_;
  std::vector<std::vector<float>> inputs_;
};

}  // namespace

TEST_CASE("generated header: agrees with the interpreter for every compiler and instruction set",
          "[slow][campaign]") {
  const Headers headers({lowered(committed_fit())});
  for (const Build& build : builds()) headers.check(build);
}

// Each compiler builds once with and once without optimisation.
TEST_CASE("generated header: every kind, form and convention agrees with the interpreter", "[slow]") {
  const Headers headers(subjects());
  for (const Build& build : builds())
    if (build.flags == "-O0" ||
        build.flags == "-O3 -march=x86-64-v3 -ffp-contract=off -fno-tree-slp-vectorize")
      headers.check(build);
}

// In other tests a header follows other headers, which may include what it lacks. One compiler is enough,
// because both use the same standard library.
TEST_CASE("generated header: needs no other header before it", "[slow]") {
  const Headers headers(subjects());
  std::string files;
  for (const MadeModel& subject : subjects()) files += " " + headers.path(subject.fit.id + ".hpp");
  const std::vector<std::string> found = compilers();
  REQUIRE(!found.empty());
  CHECK(succeeds(found[0] + " -std=c++17 -fsyntax-only -x c++" + files));
}

// A changed header gets another name, so that one program can include all of them.
TEST_CASE("generated header: self_test fails when any one coefficient is changed", "[slow]") {
  // One target has alpha. The other has an exponent, whose golden texels range from 0 to thousands.
  const std::string id = GENERATE("mitsuba_ward_to_mitsuba_as", "mitsuba_as_to_threejs_r187_phong");
  const TemporaryFolder folder;
  Fit fit = load_fit(REMAP_SOURCE_DIR "/fits/" + id + ".json");
  fit.id = "original";
  const std::string header = emit_header(fit);
  std::string text, tests;
  const auto add = [&](const std::string& name, const std::string& changed) {
    text += std::regex_replace(std::regex_replace(changed, std::regex("ORIGINAL_HPP"), name + "_HPP"),
                               std::regex("original"), name);
    tests += "  std::putchar(remap::" + name + "::self_test() ? '1' : '0');\n";
  };
  add("original", header);

  // Changes every number of the polynomials by more than the header's bound.
  const std::size_t start = header.find("static float alpha_factor"), end = header.find("static float held");
  REQUIRE(start < end);
  const std::string code = header.substr(start, end - start);
  const std::regex literal("-?[0-9]+\\.?[0-9]*(e-?[0-9]+)?f");
  std::vector<std::string> coefficients;
  for (std::sregex_iterator it(code.begin(), code.end(), literal); it != std::sregex_iterator(); ++it) {
    std::string changed = header;
    changed.replace(start + static_cast<std::size_t>(it->position()), static_cast<std::size_t>(it->length()),
                    std::to_string(std::stod(it->str()) * 1.5 + 0.01) + "f");
    coefficients.push_back(it->str());
    add("changed_" + std::to_string(coefficients.size()), changed);
  }
  REQUIRE(coefficients.size() >= 8);
  const std::string program = (folder.path() / "main").string(), out = (folder.path() / "out").string();
  write_file(program + ".cpp", text + "#include <cstdio>\nint main() {\n" + tests + "}\n");
  REQUIRE(succeeds("g++ -std=c++17 " + program + ".cpp -o " + program));
  REQUIRE(succeeds(program + " >" + out));
  const std::string passed = read_file(out);
  REQUIRE(passed.size() == coefficients.size() + 1);
  CHECK(passed[0] == '1');
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    INFO("coefficient " << i << ": " << coefficients[i]);
    CHECK(passed[i + 1] == '0');
  }
}

TEST_CASE(
    "generated header: compiles on its own, twice, beside another and in two files, as C++17, 20 and 23",
    "[slow]") {
  const TemporaryFolder folder;
  std::vector<Fit> all;
  std::string includes, tests;
  for (const MadeModel& subject : subjects()) {
    const Fit& fit = all.emplace_back(subject.fit);
    write_file(folder.path() / (fit.id + ".hpp"), emit_header(fit));
    includes += "#include \"" + fit.id + ".hpp\"\n#include \"" + fit.id + ".hpp\"\n";
    tests += "  passed = passed && remap::" + fit.id + "::self_test();\n";
  }
  write_file(folder.path() / "one.cpp",
             includes + "bool test_one() { return remap::" + all[0].id + "::self_test(); }\n");
  write_file(folder.path() / "two.cpp", includes +
                                            "bool test_one();\nint main() {\n  bool passed = test_one();\n" +
                                            tests + "  return passed ? 0 : 1;\n}\n");
  const std::string one = (folder.path() / "one.cpp").string(), two = (folder.path() / "two.cpp").string(),
                    program = (folder.path() / "both").string();
  for (const std::string& compiler : compilers()) {
    INFO(compiler);
    REQUIRE(succeeds(compiler + " -std=c++17" + kHeaderFlags + "-O0 " + one + " " + two + " -o " + program));
    CHECK(succeeds(program));
    for (const std::string standard : {"c++20", "c++2b"}) {
      INFO(standard);
      CHECK(succeeds(compiler + " -std=" + standard + kHeaderFlags + "-fsyntax-only " + two));
    }
  }
}

TEST_CASE("generated header: stays right under fast-math flags of its user", "[slow]") {
  Headers headers({lowered(committed_fit())});
  // These flags give up NaN, infinity, denormals and the sign of 0. Everything else must hold.
  headers.keep_normal_texels();
  for (const std::string& compiler : compilers()) headers.check({compiler, "-O3 -ffast-math"});
}
