// This file compares every shipped header, and headers of random forms, as a user's compiler builds them,
// with texremap's pass of the same converter as data. Results must be equal bit for bit on every instruction
// set. Each run of the compiler builds many headers, because one run per header would take minutes.
// lowered_converter_test tests that converters stay within their bound.
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>
#include <map>
#include <optional>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "core/parallel.hpp"
#include "emit/emit.hpp"
#include "remap/shipped_converters.hpp"
#include "runtime/convert/texel_rows.hpp"
#include "support/campaign.hpp"
#include "support/fitted_converter.hpp"
#include "support/header_flags.hpp"
#include "support/random_models.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;

namespace {

constexpr std::size_t kBatches = 4;

using Grey = std::size_t (*)(std::size_t, const float*, const std::array<const float*, 1>&, float*,
                             const std::array<float*, 1>&);
using Rgb = std::size_t (*)(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                            const std::array<float*, 3>&);

// The source file of a batch declares the same struct.
struct Entry {
  const char* id;
  Grey grey;
  Rgb rgb;
  bool (*self_test)();
};

struct Header {
  Entry entry;

  std::size_t convert(std::size_t count, const float* width, std::span<const float* const> specular,
                      float* width_out, std::span<float* const> specular_out) const {
    if (specular.size() == 1) return entry.grey(count, width, {specular[0]}, width_out, {specular_out[0]});
    return entry.rgb(count, width, {specular[0], specular[1], specular[2]}, width_out,
                     {specular_out[0], specular_out[1], specular_out[2]});
  }
};

std::string batch_source(const std::vector<std::string>& ids) {
  std::string text = "#include <cstddef>\n#include <array>\n", entries;
  for (const std::string& id : ids) {
    text += "#include \"" + id + ".hpp\"\n";
    entries += "  {\"" + id + "\", rows<remap::" + id + ", 1>, rows<remap::" + id + ", 3>, remap::" + id +
               "::self_test},\n";
  }
  // This template accepts any header.
  return text +
         "template <class Converter, std::size_t N> std::size_t rows(std::size_t count, const float* width,\n"
         "    const std::array<const float*, N>& specular, float* width_out, const std::array<float*, N>& "
         "out) {\n"
         "  return Converter::template evaluate_batch<N>(count, {width, specular}, {width_out, out});\n}\n"
         "template <std::size_t N> using Run = std::size_t (*)(std::size_t, const float*,\n"
         "    const std::array<const float*, N>&, float*, const std::array<float*, N>&);\n"
         "struct Entry { const char* id; Run<1> grey; Run<3> rgb; bool (*self_test)(); };\n"
         "extern \"C\" const Entry batch_entries[] = {\n" +
         entries + "  {nullptr, nullptr, nullptr, nullptr}};\n";
}

std::filesystem::path library(const std::filesystem::path& folder, std::size_t batch) {
  return folder / ("batch_" + std::to_string(batch) + ".so");
}

// Returns true if a polynomial is still a separate function. Compilers keep long functions separate. A loop
// that calls one is not vectorised, so it is four to six times slower.
bool calls_functions_of_texels(const std::filesystem::path& library) {
  const std::string symbols = "nm --demangle " + library.string();
  return std::system(
             (symbols + " | grep -E '::(target|wide|bright|specular)_(alpha|specular|slope)\\('").c_str()) ==
         0;
}

// Compiles headers of `includes` into libraries in `folder`. The entries stay valid as long as the program
// runs.
std::map<std::string, Entry> compiled_headers(const std::filesystem::path& folder,
                                              const std::filesystem::path& includes,
                                              const std::vector<std::string>& ids) {
  std::vector<std::vector<std::string>> batches(kBatches);
  for (std::size_t i = 0; i < ids.size(); ++i) batches[i % kBatches].push_back(ids[i]);
  std::vector<int> results(kBatches, -1);
  run_parallel(kBatches, 2, [&](std::size_t b) {
    const auto source = folder / ("batch_" + std::to_string(b) + ".cpp");
    write_file(source, batch_source(batches[b]));
    results[b] =
        std::system((std::string("g++ -std=c++17 -O1 -ffp-contract=off -shared -fPIC") + kHeaderFlags +
                     "-I " + includes.string() + " " + source.string() + " -o " + library(folder, b).string())
                        .c_str());
  });
  std::map<std::string, Entry> entries;
  for (std::size_t b = 0; b < kBatches; ++b) {
    REQUIRE(results[b] == 0);
    void* const handle = dlopen(library(folder, b).c_str(), RTLD_NOW);
    REQUIRE(handle != nullptr);
    const auto* entry = static_cast<const Entry*>(dlsym(handle, "batch_entries"));
    REQUIRE(entry != nullptr);
    for (; entry->id != nullptr; ++entry) entries.emplace(entry->id, *entry);
  }
  return entries;
}

void check_header(const Entry& entry, const Converter& converter, std::size_t texels) {
  INFO(converter.info().id << " on " << instruction_set_name(converter.info().instructions));
  CHECK(entry.self_test());
  CHECK(same_bits(converter, Header{entry}, odd_and_random_texels(converter.info(), texels)));
}

}  // namespace

TEST_CASE("shipped headers: bit for bit what texremap gives of the same converters as data", "[slow]") {
  const TemporaryFolder folder;
  std::vector<std::string> ids;
  for (const auto& converter : shipped_converters()) ids.push_back(converter->info().id);
  const auto headers = compiled_headers(folder.path(), REMAP_SOURCE_DIR "/generated", ids);
  REQUIRE(headers.size() == ids.size());
  for (std::size_t b = 0; b < kBatches; ++b)
    CHECK_FALSE(calls_functions_of_texels(library(folder.path(), b)));
  for (const InstructionSet set : instruction_sets())
    for (const auto& converter : shipped_converters(set))
      check_header(headers.at(converter->info().id), *converter, 5000);
}

TEST_CASE("generated headers: random forms give the bits of their converters", "[slow][campaign]") {
  const TemporaryFolder folder;
  std::vector<Fit> fits;
  std::vector<std::string> ids;
  const auto seeds = static_cast<std::uint64_t>(campaign_length(200));
  for (std::uint64_t seed = 0; seed < seeds; ++seed)
    if (const std::optional<Fit> fit = random_form_fit(seed)) {
      fits.push_back(lowered_fit(*fit));
      ids.push_back(fit->id);
      write_file(folder.path() / (fit->id + ".hpp"), emit_header(fits.back()));
    }
  CHECK(fits.size() >= seeds / 4);
  const auto headers = compiled_headers(folder.path(), folder.path(), ids);
  for (const InstructionSet set : instruction_sets())
    for (const Fit& fit : fits) check_header(headers.at(fit.id), *make_lowered_converter(fit, set), 600);
}

TEST_CASE(
    "shipped headers: templates wrap headers of each kind, without a warning under the flags of engines",
    "[slow]") {
  for (const std::string compiler : {"g++", "clang++"})
    if (has_program(compiler))
      CHECK(std::system((compiler + " -std=c++17 -fsyntax-only -ffast-math" + kHeaderFlags +
                         "-I " REMAP_SOURCE_DIR "/generated " REMAP_SOURCE_DIR
                         "/tests/parity/wrapped_headers.cpp")
                            .c_str()) == 0);
}

TEST_CASE("shipped headers: the flags of texels out of domain are those that are counted") {
  for (const auto& converter : shipped_converters()) {
    const TestTexels texels = odd_and_random_texels(converter->info(), 701);
    const std::size_t count = texels.roughness.size();
    std::vector<float> width(count), red(count), green(count), blue(count);
    std::vector<std::uint8_t> flags(count, 7);
    const std::array<const float*, 3> in = {texels.specular[0].data(), texels.specular[1].data(),
                                            texels.specular[2].data()};
    const std::array<float*, 3> out = {red.data(), green.data(), blue.data()};
    INFO(converter->info().id);
    const std::size_t outside =
        converter->convert(count, texels.roughness.data(), in, width.data(), out, flags.data());
    std::size_t flagged = 0;
    for (std::size_t i = 0; i < count; ++i) {
      float ignored = 0.0f;
      std::array<float, 3> values{};
      const std::array<const float*, 3> one = {&in[0][i], &in[1][i], &in[2][i]};
      const std::array<float*, 3> to = {&values[0], &values[1], &values[2]};
      if (converter->convert(1, &texels.roughness[i], one, &ignored, to) != flags[i])
        FAIL_CHECK("texel " << i);
      flagged += flags[i];
    }
    CHECK(flagged == outside);
  }
}
