// This file compares headers of appearance warps with the library, bit for bit. All kinds of coordinates and
// tables are in one file, built as a library that the test loads.
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/emit.hpp"
#include "stages/kernels.hpp"
#include "support/header_flags.hpp"
#include "support/random_warp.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"
#include "support/warp_rows.hpp"

using namespace remap;

namespace {

constexpr std::size_t kCount = 1000;

// An Entry is what the library exports for each header.
struct Entry {
  bool (*self_test)();
  std::size_t (*rows)(std::size_t, const std::array<const float*, 7>&, const std::array<float*, 7>&);
  void (*one)(const float* in, float* out);
  bool (*in_domain)(const float* in);
  double copy_rms_error;
};

constexpr const char* kExports = R"(
struct Entry {
  bool (*self_test)();
  std::size_t (*rows)(std::size_t, const std::array<const float*, 7>&, const std::array<float*, 7>&);
  void (*one)(const float* in, float* out);
  bool (*in_domain)(const float* in);
  double copy_rms_error;
};
#define ENTRY(ID)                                                                                    \
  {remap::ID::self_test,                                                                             \
   [](std::size_t count, const std::array<const float*, 7>& in, const std::array<float*, 7>& out) {  \
     return remap::ID::evaluate_batch(count, {{in[0], in[1], in[2]}, {in[3], in[4], in[5]}, in[6]},  \
                                      {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}, out[6]}); \
   },                                                                                                \
   [](const float* in, float* out) {                                                                 \
     remap::ID::Input texel{};                                                                       \
     std::memcpy(&texel, in, sizeof texel);                                                          \
     const remap::ID::Output result = remap::ID::evaluate(texel);                                    \
     std::memcpy(out, &result, sizeof result);                                                       \
   },                                                                                                \
   [](const float* in) {                                                                             \
     remap::ID::Input texel{};                                                                       \
     std::memcpy(&texel, in, sizeof texel);                                                          \
     return remap::ID::in_domain(texel);                                                             \
   },                                                                                                \
   remap::ID::kCopyRmsError},
)";

std::vector<WarpMapFit> probed_models() {
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

// Returns null if the compiler is not installed.
const Entry* build(const TemporaryFolder& folder, const std::vector<WarpMapFit>& fits,
                   const std::string& compiler, const std::string& flags) {
  if (!has_program(compiler)) return nullptr;
  std::string includes, entries;
  for (const WarpMapFit& fit : fits) {
    write_file(folder.path() / (fit.id + ".hpp"), emit_header(fit));
    includes += "#include \"" + fit.id + ".hpp\"\n";
    entries += "ENTRY(" + fit.id + ")\n";
  }
  const std::string name = (folder.path() / "headers").string();
  write_file(name + ".cpp", includes + kExports +
                                "extern \"C\" const Entry entries[];\nconst Entry entries[] = {\n" + entries +
                                "};\n");
  REQUIRE(std::system((compiler + " -std=c++17 -fPIC -shared" + kHeaderFlags + flags + " " + name +
                       ".cpp -o " + name + ".so")
                          .c_str()) == 0);
  void* library = ::dlopen((name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
  REQUIRE(library != nullptr);
  return static_cast<const Entry*>(::dlsym(library, "entries"));
}

void check_single_texels(const Entry& entry, const WarpRows& in, const WarpRows& all, std::size_t outside) {
  WarpRows single(kCount);
  std::size_t outside_one = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const WarpTexel texel = in.texel(i);
    WarpTexel result{};
    entry.one(texel.data(), result.data());
    for (std::size_t r = 0; r < kWarpParameters; ++r) single.row[r][i] = result[r];
    outside_one += entry.in_domain(texel.data()) ? 0 : 1;
  }
  CHECK(same_rows(single, all));
  CHECK(outside_one == outside);
}

// With `fuses`, products and sums are fused, so the last bits differ from the library's.
void check_headers(const std::string& compiler, const std::string& flags, bool fuses) {
  const TemporaryFolder folder;
  const std::vector<WarpMapFit> fits = probed_models();
  const Entry* entries = build(folder, fits, compiler, flags);
  if (entries == nullptr) return;
  const WarpRows in = odd_rows(kCount);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    INFO(fits[i].id << " by " << compiler << " " << flags);
    CHECK(entries[i].self_test());
    CHECK(entries[i].copy_rms_error == 0.0125);
    WarpRows out(kCount), expected(kCount);
    const std::size_t outside = entries[i].rows(kCount, in.sources(), out.targets());
    CHECK(outside == kernels(InstructionSet::kBaseline)
                         .warp(packed(fits[i].warp), kCount, in.sources(), expected.targets()));
    if (!fuses) CHECK(same_rows(out, expected));
    CHECK(wrong_texels(fits[i].warp, in, out) == 0);
    check_single_texels(entries[i], in, out, outside);
    WarpRows in_place = in;
    entries[i].rows(kCount, in_place.sources(), in_place.targets());
    CHECK(same_rows(in_place, out));
  }
}

}  // namespace

TEST_CASE("warp headers: the bits of the library by gcc", "[needs][slow]") {
  check_headers("g++", "-O2", false);
}
TEST_CASE("warp headers: the bits of the library by clang", "[needs][slow]") {
  check_headers("clang++", "-O2", false);
}
TEST_CASE("warp headers: rows as single texels where products and sums are fused", "[needs][slow]") {
  if (has_avx2()) check_headers("g++", "-O2 -march=x86-64-v3", true);
}
