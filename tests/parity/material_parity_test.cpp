// This file compares headers of workflow conversions and of appearance warps with the library: bit for bit,
// by gcc and clang, on random texels and on edges. Each build is a library that the test loads.
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <limits>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/emit.hpp"
#include "lower/fit_file.hpp"
#include "parity/material_entry.hpp"
#include "runtime/stages/materials.hpp"
#include "stages/kernels.hpp"
#include "support/campaign.hpp"
#include "support/header_flags.hpp"
#include "support/random_warp.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"
#include "support/warp_rows.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

using Rows = std::vector<std::vector<float>>;

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
std::vector<WorkflowFit> workflow_fits() {
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
Rows texels(std::size_t row_count) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const float edges[] = {0.0f,  -0.0f, 1.0f, 0.04f, 1e-40f,   -1e-40f,  std::nextafter(1.0f, 2.0f),
                         1e30f, -1.0f, nan,  -nan,  infinity, -infinity};
  std::mt19937 random(17);
  std::uniform_real_distribution<float> share(0.0f, 1.0f), wide(-0.5f, 1.5f);
  Rows rows(row_count);
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

// All NaN are treated as equal. With a tolerance, values may differ, but NaN must be in the same places.
bool same(const Rows& a, const Rows& b, float tolerance = 0.0f) {
  for (std::size_t r = 0; r < a.size() && r < b.size(); ++r)
    for (std::size_t i = 0; i < a[r].size(); ++i) {
      const float x = a[r][i], y = b[r][i];
      if (std::isnan(x) && std::isnan(y)) continue;
      if (tolerance > 0.0f ? !(std::fabs(x - y) <= tolerance) : std::memcmp(&x, &y, sizeof x) != 0)
        return false;
    }
  return true;
}

// Calls `run` with pointers to the texels of the rows from `first` on.
template <typename Run>
std::size_t with_pointers(const Rows& in, Rows& out, std::size_t first, const Run& run) {
  std::vector<const float*> from;
  std::vector<float*> to;
  for (const auto& row : in) from.push_back(row.data() + first);
  for (auto& row : out) to.push_back(row.data() + first);
  return run(from, to);
}

// Headers holds emitted headers in a separate folder, with headers.hpp, which includes them.
class Headers {
 public:
  template <typename AnyFit>
  explicit Headers(const std::vector<AnyFit>& fits) {
    std::string includes, entries;
    for (const AnyFit& fit : fits) {
      write_file(folder_.path() / (fit.id + ".hpp"), emit_header(fit));
      files_ += " " + (folder_.path() / (fit.id + ".hpp")).string();
      includes += "#include \"" + fit.id + ".hpp\"\n";
      entries += " ENTRY(" + fit.id + ")";
    }
    write_file(folder_.path() / "headers.hpp", includes + "#define CONVERTERS(ENTRY)" + entries + "\n");
  }
  const std::string& files() const { return files_; }

  // Returns the entries in the order of the fits. They stay valid as long as the program runs.
  const MaterialEntry* built(const Build& build) {
    const std::string library = folder_.path() / ("build_" + std::to_string(++builds_) + ".so");
    REQUIRE(std::system((build.compiler + " -std=c++17 -fPIC -shared " + build.flags + kHeaderFlags + "-I" +
                         folder_.path().string() +
                         " -I" REMAP_SOURCE_DIR "/tests " REMAP_SOURCE_DIR
                         "/tests/parity/material_entries.cpp -o " +
                         library)
                            .c_str()) == 0);
    void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(handle != nullptr);
    const auto* entries = static_cast<const MaterialEntry*>(::dlsym(handle, "entries"));
    REQUIRE(entries != nullptr);
    return entries;
  }

 private:
  TemporaryFolder folder_;
  std::string files_;
  int builds_ = 0;
};

// Converts rows as texels of three and of four elements, apart and in place.
void check_texels(const MaterialEntry& entry, const Rows& in, const Rows& all, std::size_t outside) {
  const std::size_t count = in[0].size();
  struct Texels {
    std::vector<float> color, rest;
    float& element(std::size_t row, std::size_t i) {
      return row < 3 ? color[3 * i + row] : rest[4 * i + row - 3];
    }
  };
  Texels from{std::vector<float>(3 * count), std::vector<float>(4 * count)}, to = from;
  for (std::size_t r = 0; r < in.size(); ++r)
    for (std::size_t i = 0; i < count; ++i) from.element(r, i) = in[r][i];
  for (Texels* out : {&to, &from}) {
    CHECK(entry.evaluate_texels(count, from.color.data(), from.rest.data(), out->color.data(),
                                out->rest.data()) == outside);
    Rows rows = all;
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t i = 0; i < count; ++i) rows[r][i] = out->element(r, i);
    CHECK(same(rows, all));
  }
}

// Converts rows by every entry point, which must agree: as a whole, in parts, texel by texel, interleaved and
// in place.
Rows converted(const MaterialEntry& entry, const Rows& in, std::size_t& outside) {
  const std::size_t count = in[0].size();
  REQUIRE(entry.input_rows == in.size());
  CHECK(entry.self_test());
  const auto run = [&](const Rows& from, Rows& to, std::size_t first, std::size_t texel_count) {
    return with_pointers(from, to, first, [&](const auto& a, const auto& b) {
      return entry.evaluate_batch(texel_count, a.data(), b.data());
    });
  };
  Rows all(entry.output_rows, std::vector<float>(count)), parts = all, single = all;
  outside = run(in, all, 0, count);
  std::size_t sum = 0, outside_one = 0;
  for (std::size_t first = 0, size = 1; first < count; first += size, size = size % 37 + 1)
    sum += run(in, parts, first, std::min(size, count - first));
  CHECK(sum == outside);
  CHECK(same(parts, all));
  std::vector<float> from(in.size()), to(all.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t r = 0; r < in.size(); ++r) from[r] = in[r][i];
    entry.evaluate(from.data(), to.data());
    for (std::size_t r = 0; r < all.size(); ++r) single[r][i] = to[r];
    outside_one += entry.in_domain(from.data()) ? 0u : 1u;
  }
  CHECK(same(single, all));
  CHECK(outside_one == outside);
  check_texels(entry, in, all, outside);
  Rows in_place = in;
  in_place.resize(std::max(in.size(), all.size()), std::vector<float>(count));
  run(in_place, in_place, 0, count);
  CHECK(same(in_place, all));
  return all;
}

std::vector<WarpMapFit> warp_fits() {
  std::vector<WarpMapFit> fits;
  for (const bool quadratic : {false, true})
    for (const bool copied : {false, true})
      for (std::size_t dimension = 1; dimension <= 3; ++dimension) {
        WarpMapFit& fit = fits.emplace_back();
        fit.id = std::string(quadratic ? "quadratic" : "separable") + (copied ? "_copied_" : "_blended_") +
                 std::to_string(dimension);
        fit.source_model = fit.template_model = "mitsuba/ggx";
        fit.warp = random_warp({dimension, quadratic, copied}, static_cast<unsigned>(31 + fits.size()));
        fit.copy_rms_error = 0.0125;
        fit.method = {{"source", "a folder\\"}};  // the backslash must not continue the comment
        fit.tool_version = "0";
      }
  return fits;
}

}  // namespace

TEST_CASE("workflow headers: the bits of the library from gcc and clang, rows as single texels, in place too",
          "[slow][campaign]") {
  const std::vector<WorkflowFit> fits = workflow_fits();
  Headers headers(fits);
  for (const Build& build : builds()) {
    const MaterialEntry* entry = headers.built(build);
    for (const WorkflowFit& fit : fits) {
      INFO(fit.id << " by " << build.compiler << " " << build.flags);
      const Rows in = texels(fit.conversion.is_to_metallic() ? 7 : 5);
      std::size_t outside = 0;
      const Rows found = converted(*entry++, in, outside);
      Rows expected = found;
      CHECK(with_pointers(in, expected, 0, [&](const auto& from, const auto& to) {
              return convert_workflow(fit.conversion, in[0].size(), from, to);
            }) == outside);
      // Networks are compared with the interpreter in double precision, because sums of 300 products of
      // floats have errors of about 1e-6.
      if (is_learned(fit.conversion.formula))
        CHECK(same(found, expected, 2e-5f));
      else if (!build.fuses)
        CHECK(same(found, expected));
    }
  }
}

// In the test above a header follows other headers, which may include what it lacks.
TEST_CASE("workflow headers: need no other header before them", "[slow]") {
  const Headers headers(workflow_fits());
  CHECK(std::system(("g++ -std=c++17 -fsyntax-only -x c++" + headers.files()).c_str()) == 0);
}

TEST_CASE("workflow headers: what ships is what its fits give") {
  const fs::path root = REMAP_SOURCE_DIR;
  for (const WorkflowFit& fit : workflow_fits())
    if (const fs::path header = root / "generated" / (fit.id + ".hpp"); fs::exists(header)) {
      INFO(fit.id);
      CHECK((read_file(header) == emit_header(fit)));
    }
}

TEST_CASE("warp headers: the bits of the library from gcc and clang, rows as single texels, in place too",
          "[needs][slow]") {
  const std::vector<WarpMapFit> fits = warp_fits();
  Headers headers(fits);
  const WarpRows in = odd_rows(1000);
  for (const Build& build :
       {Build{"g++", "-O2"}, Build{"clang++", "-O2"}, Build{"g++", "-O2 -march=x86-64-v3", true}}) {
    if (!has_program(build.compiler) || (build.fuses && !has_avx2())) continue;
    const MaterialEntry* entry = headers.built(build);
    for (const WarpMapFit& fit : fits) {
      INFO(fit.id << " by " << build.compiler << " " << build.flags);
      std::size_t outside = 0;
      const Rows found = converted(*entry++, Rows(in.row.begin(), in.row.end()), outside);
      WarpRows out(1000), expected(1000);
      std::copy(found.begin(), found.end(), out.row.begin());
      CHECK(
          outside ==
          kernels(InstructionSet::kBaseline).warp(packed(fit.warp), 1000, in.sources(), expected.targets()));
      if (!build.fuses) CHECK(same_rows(out, expected));
      CHECK(wrong_texels(fit.warp, in, out) == 0);
      CHECK_THAT(emit_header(fit), Catch::Contains("kCopyRmsError = 0.0125"));
    }
  }
}
