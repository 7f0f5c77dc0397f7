// Headers of random models against their lowered form, bit for bit; that this is the interpreter's within its
// bound is proven and tested where it is made (lower_test), and the rule of the domain is tested in
// parity_test. Many headers share a file, built as a library that the test loads.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <dlfcn.h>
#include <future>
#include <iostream>
#include <random>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/emit.hpp"
#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "support/build_speed.hpp"
#include "support/campaign.hpp"
#include "support/example_fit.hpp"
#include "support/header_flags.hpp"
#include "support/random_models.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;

namespace {

constexpr int kModelsInFile = 25;
constexpr std::size_t kTexels = 600;

// What a library of headers exports, an entry a header.
struct Entry {
  bool (*self_test)();
  std::size_t (*evaluate)(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                          const std::array<float*, 3>&);
};

constexpr const char* kExports = R"(
struct Entry {
  bool (*self_test)();
  std::size_t (*evaluate)(std::size_t, const float*, const std::array<const float*, 3>&, float*,
                          const std::array<float*, 3>&);
};
template <class Converter>
std::size_t evaluate(std::size_t count, const float* width, const std::array<const float*, 3>& specular, float* width_out,
                     const std::array<float*, 3>& specular_out) {
  return Converter::evaluate_batch(count, {width, specular}, {width_out, specular_out});
}
)";

struct Header {
  Fit fit;
  std::string text;
  CompactForm form;
};

Fit random_fit(const std::string& kind, std::uint64_t seed) {
  Fit fit = example_fit();
  fit.id = "random_" + kind + "_" + std::to_string(seed);
  fit.target.roughness = RoughnessConvention::kAlpha;
  const RandomModel model = random_model(kind, 2000 + seed);
  fit.mapping = model.mapping;
  fit.domain = model.domain;
  fit.limits.alpha = 1e30;  // random mappings take no heed of it
  return fit;
}

// Those that are not refused.
std::vector<Header> lowered_headers(const std::string& kind, int models) {
  std::vector<Header> headers;
  const LoweringOptions options{1e-2, 1e-2};
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(models); ++seed) {
    Fit fit = random_fit(kind, seed);
    try {
      add_converter(&fit, options);
      headers.push_back({fit, emit_header(fit), fit.converter->form});
    } catch (const Error& error) {
      REQUIRE(error.kind() == ErrorKind::kNumeric);
    }
  }
  return headers;
}

// Headers from `first` on in one file, built as a library; its entries.
const Entry* build(const TemporaryFolder& folder, const std::vector<Header>& headers, std::size_t first) {
  std::string includes, entries;
  const std::size_t last = std::min(first + kModelsInFile, headers.size());
  for (std::size_t i = first; i < last; ++i) {
    const std::string& id = headers[i].fit.id;
    write_file(folder.path() / (id + ".hpp"), headers[i].text);
    includes += "#include \"" + id + ".hpp\"\n";
    entries += "    {remap::" + id + "::self_test, evaluate<remap::" + id + ">},\n";
  }
  const std::string name = (folder.path() / ("headers_" + std::to_string(first))).string();
  write_file(name + ".cpp", includes + kExports +
                                "extern \"C\" const Entry entries[];\nconst Entry entries[] = {\n" + entries +
                                "};\n");
  const std::string command = std::string("g++ -std=c++17 -O1 -ffp-contract=off -fPIC -shared") +
                              kHeaderFlags + name + ".cpp -o " + name + ".so";
  if (std::system(command.c_str()) != 0) return nullptr;
  void* library = ::dlopen((name + ".so").c_str(), RTLD_NOW | RTLD_LOCAL);
  return library == nullptr ? nullptr : static_cast<const Entry*>(::dlsym(library, "entries"));
}

// One entry a header; two compilers run at a time.
std::vector<Entry> build_all(const TemporaryFolder& folder, const std::vector<Header>& headers) {
  std::vector<Entry> all(headers.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    bool built = true;
    for (std::size_t first = next.fetch_add(kModelsInFile); first < headers.size();
         first = next.fetch_add(kModelsInFile)) {
      const Entry* entries = build(folder, headers, first);
      built = built && entries != nullptr;
      for (std::size_t i = first; entries != nullptr && i < std::min(first + kModelsInFile, all.size()); ++i)
        all[i] = entries[i - first];
    }
    return built;
  };
  auto other = std::async(std::launch::async, work);
  const bool built = work();
  REQUIRE((other.get() && built));
  return all;
}

// Planar: width and three channels, within the domain, and at its ends.
std::vector<float> random_texels(const Fit& fit, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const Range own = own_roughness_range(fit), specular = specular_range(fit);
  std::vector<float> planar(4 * kTexels);
  for (std::size_t i = 0; i < planar.size(); ++i) {
    const Range& range = i < kTexels ? own : specular;
    const double q = i % kTexels < 2 ? static_cast<double>(i % kTexels) : share(random);
    planar[i] = static_cast<float>(range.min + (range.max - range.min) * q);
  }
  return planar;
}

std::vector<float> converted(const Entry& entry, const std::vector<float>& in) {
  std::vector<float> out(in.size());
  entry.evaluate(kTexels, &in[0], {&in[kTexels], &in[2 * kTexels], &in[3 * kTexels]}, &out[0],
                 {&out[kTexels], &out[2 * kTexels], &out[3 * kTexels]});
  return out;
}

// In the order of operations of headers.
float factor_in_floats(const FactorTerms& factor, float alpha, float t) {
  float sum = 0.0f;
  for (std::size_t j = factor.size(); j-- > 0;) {
    float row = factor[j].back();
    for (std::size_t i = factor[j].size() - 1; i-- > 0;) row = row * alpha + factor[j][i];
    sum = j + 1 == factor.size() ? row : sum * t + row;
  }
  return sum;
}

// Inside the domain nothing is done but the polynomials: the same bits.
void check_bits(const Header& header, const std::vector<float>& in, const std::vector<float>& out) {
  const Range own = own_roughness_range(header.fit), specular = specular_range(header.fit);
  int wrong = 0;
  for (std::size_t i = 0; i < kTexels; ++i) {
    const float channels[] = {in[kTexels + i], in[2 * kTexels + i], in[3 * kTexels + i]};
    const float largest = *std::max_element(channels, channels + 3);
    if (!own.contains(static_cast<double>(in[i])) || !specular.contains(static_cast<double>(largest)))
      continue;
    const auto share = [&](float s) { return s / (s + header.form.pole); };
    wrong += out[i] == in[i] * factor_in_floats(header.form.alpha, in[i], share(largest)) ? 0 : 1;
    for (std::size_t c = 0; c < 3; ++c)
      wrong += out[(c + 1) * kTexels + i] ==
                       channels[c] * factor_in_floats(header.form.specular, in[i], share(channels[c]))
                   ? 0
                   : 1;
  }
  CHECK(wrong == 0);
}

void check_headers(const std::string& what, const std::vector<Header>& headers) {
  const TemporaryFolder folder;
  std::vector<Entry> entries;
  const double seconds = seconds_of([&] { entries = build_all(folder, headers); });
  for (std::size_t i = 0; i < headers.size(); ++i) {
    INFO(what << " " << headers[i].fit.id);
    CHECK(entries[i].self_test());
    const std::vector<float> in = random_texels(headers[i].fit, i), out = converted(entries[i], in);
    check_bits(headers[i], in, out);
  }
  std::cout << what << ": " << headers.size() << " headers built in " << seconds << " s\n";
}

void check_lowered(const std::string& kind, int models = campaign_length(200)) {
  const std::vector<Header> headers = lowered_headers(kind, models);
  CHECK(headers.size() >= static_cast<std::size_t>(models) / 5);
  check_headers("lowered " + kind, headers);
}

}  // namespace

TEST_CASE("lowered headers: random parametric fits give the bits of the lowered form", "[slow][campaign]") {
  check_lowered("parametric");
}
TEST_CASE("lowered headers: random sums of Gaussians give the bits of the lowered form", "[slow][campaign]") {
  check_lowered("svr");
}
TEST_CASE("lowered headers: random networks give the bits of the lowered form", "[slow][campaign]") {
  check_lowered("mlp");
}
