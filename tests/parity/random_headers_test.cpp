// Headers of random forms against the formula in floats, bit for bit; that a form is its fit's within a bound
// is proven and tested where it is made (lower_test), and the rule of the domain is tested in parity_test.
// Many headers share a file, built as a library that the test loads.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <dlfcn.h>
#include <future>
#include <iostream>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "emit/emit.hpp"
#include "lower/form_fit.hpp"
#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "support/build_speed.hpp"
#include "support/campaign.hpp"
#include "support/example_fit.hpp"
#include "support/header_flags.hpp"
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
};

// Of a factor near 1, with terms that get smaller.
FactorTerms random_factor(std::mt19937_64& random) {
  std::normal_distribution<float> normal;
  FactorTerms factor(1 + random() % 5);
  for (std::size_t j = 0; j < factor.size(); ++j)
    for (std::size_t i = 1 + random() % 6; i-- > 0;)
      factor[j].push_back(0.3f * normal(random) / static_cast<float>(1 + i + j));
  factor[0][0] = 1.0f + 0.5f * normal(random);
  return factor;
}

Fit random_fit(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  Fit fit = example_fit();
  fit.id = "random_" + std::to_string(seed);
  fit.target.roughness = RoughnessEncoding::kAlpha;
  fit.domain = {{0.01 + 0.2 * static_cast<double>(share(random)), 1.0},
                {0.0, std::pow(10.0, static_cast<double>(share(random) - 0.5f))}};
  CompactForm form;
  form.pole = std::pow(10.0f, 2.0f * share(random) - 1.5f);
  form.alpha = random_factor(random);
  form.specular = random_factor(random);
  if (seed % 3 != 0) form.specular_limit = 0.2f + share(random);
  if (seed % 3 == 1) form.alpha_limit = 0.5f + 0.5f * share(random);
  if (seed % 3 != 0) form.hinge = {share(random) - 0.5f, share(random) - 0.5f, share(random), share(random)};
  fit.mapping = form;
  return fit;
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

// Inside the domain nothing is done but the formula: the same bits.
void check_bits(const Header& header, const std::vector<float>& in, const std::vector<float>& out) {
  const Range own = own_roughness_range(header.fit), specular = specular_range(header.fit);
  const CompactForm form = std::get<CompactForm>(header.fit.mapping);
  const float no_limit = std::numeric_limits<float>::infinity();
  const float alpha_limit = form.alpha_limit.value_or(no_limit),
              specular_limit = form.specular_limit.value_or(no_limit);
  const auto over = [](float value, float limit) { return std::max(value * (1.0f / limit) - 1.0f, 0.0f); };
  int wrong = 0;
  for (std::size_t i = 0; i < kTexels; ++i) {
    const float alpha = in[i], channels[] = {in[kTexels + i], in[2 * kTexels + i], in[3 * kTexels + i]};
    if (!own.contains(static_cast<double>(alpha)) ||
        !std::ranges::all_of(channels, [&](float s) { return specular.contains(static_cast<double>(s)); }))
      continue;
    const auto share = [&](float s) { return s / (s + form.pole); };
    std::array<float, 3> expected{};
    for (std::size_t c = 0; c < 3; ++c)
      expected[c] = channels[c] * factor_in_floats(form.specular, alpha, share(channels[c]));
    const float top = *std::max_element(channels, channels + 3);
    const float free = alpha * factor_in_floats(form.alpha, alpha, share(top));
    const float excess = over(top * factor_in_floats(form.specular, alpha, share(top)), specular_limit);
    const float cut = excess / (1.0f + form.hinge.bend * excess);
    const float turned = free + alpha * cut * (form.hinge.turn + form.hinge.turn_by_alpha * alpha);
    wrong += out[i] == std::min(std::max(turned, 0.0f), alpha_limit) ? 0 : 1;
    const float more = 1.0f + form.hinge.spread * over(free, alpha_limit);
    for (std::size_t c = 0; c < 3; ++c)
      wrong += out[(c + 1) * kTexels + i] == std::min(expected[c] * more, specular_limit) ? 0 : 1;
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("generated headers: random forms give the bits of the formula", "[slow][campaign]") {
  std::vector<Header> headers;
  for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(campaign_length(200)); ++seed) {
    Fit fit = random_fit(seed);
    if (!is_sound(std::get<CompactForm>(fit.mapping), fit.domain)) continue;
    add_converter(&fit);
    headers.push_back({fit, emit_header(fit)});
  }
  CHECK(headers.size() >= static_cast<std::size_t>(campaign_length(200)) / 4);
  const TemporaryFolder folder;
  std::vector<Entry> entries;
  const double seconds = seconds_of([&] { entries = build_all(folder, headers); });
  for (std::size_t i = 0; i < headers.size(); ++i) {
    INFO(headers[i].fit.id);
    CHECK(entries[i].self_test());
    const std::vector<float> in = random_texels(headers[i].fit, i), out = converted(entries[i], in);
    check_bits(headers[i], in, out);
  }
  std::cout << headers.size() << " headers built in " << seconds << " s\n";
}
