// This file converts real texture sets: BoomBox, brass, a chess king and six tiles.
#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_tree.hpp"
#include "support/shared_data.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr float kSpecular = 0.04f;

// Returns the converted value for each of the 256 values of a roughness map (square root of alpha).
std::array<float, 256> converted_roughness() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float roughness = static_cast<float>(i) / 255.0f;
    table[i] = std::sqrt(converted_texel(roughness * roughness, {kSpecular, kSpecular, kSpecular})[0]);
  }
  return table;
}

// Returns the largest and the mean difference between channel `channel` of `out` and the converted channel of
// `in`.
std::pair<double, double> difference(const TestImage& in, const TestImage& out, std::size_t channel) {
  REQUIRE(in.bytes.size() == out.bytes.size());
  const std::array<float, 256> expected = converted_roughness();
  const auto channels = static_cast<std::size_t>(in.spec.nchannels);
  double largest = 0.0, sum = 0.0;
  for (std::size_t i = channel; i < in.bytes.size(); i += channels) {
    const double texel = std::abs(static_cast<double>(expected[in.bytes[i]]) - out.bytes[i] / 255.0);
    largest = std::max(largest, texel);
    sum += texel;
  }
  return {largest, sum / static_cast<double>(in.bytes.size() / channels)};
}

// rounding to 8 bits gives half a step, and floats add a small error
constexpr double kHalfStep = 0.501 / 255.0;

Words words(const std::string& maps) {
  return kConversion + " --specular 0.04 --only roughness --roughness-encoding roughness " + maps;
}

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("texremap real sets: a folder of BoomBox, brass and a chess king", "[needs][slow]") {
  const fs::path folder = shared_data("textures");
  if (folder.empty()) return;
  const Tree tree;
  const ProcessResult result = require_success(tree.texremap(words(folder.string() + " --json ")));
  const auto sets = tree_report(result.output)["sets"];
  REQUIRE(sets.size() == 3);
  for (const auto& set : sets) CHECK(set["texels"] == 2048 * 2048);
  CHECK(tree.results() == std::vector<std::string>{"BoomBox_baseColor.png",
                                                   "BoomBox_occlusionRoughnessMetallic.png",
                                                   "brass_roughness.jpg", "king_black_base_color.jpg",
                                                   "king_black_roughness.jpg"});
  // The metallic map of the king belongs to both kings, so it is not a set.
  CHECK_THAT(result.errors, Contains("/king_shared: no roughness or glossiness map found"));
  for (const char* name : {"brass", "king_black"})
    CHECK_THAT(result.errors,
               Contains(std::string(name) + "_roughness.jpg: jpeg compression changes values (--format png"));
  // the PNG needs no warning about compression
  CHECK(count_of(result.errors, "compression changes values") == 2);

  const auto in = [&](const char* name) { return read_image(folder / name); };
  const auto out = [&](const char* name) { return tree.image(std::string("out/") + name); };
  const char* box = "BoomBox_occlusionRoughnessMetallic.png";
  const TestImage packed = in(box), packed_out = out(box);
  CHECK(same_channel(packed, packed_out, 0));
  CHECK(same_channel(packed, packed_out, 2));
  CHECK(difference(packed, packed_out, 1).first <= kHalfStep);
  // JPEG at quality 100 rounds 64 coefficients of 8 x 8 cosines by half a step with random signs. The sum is
  // at most 4 steps.
  for (const char* name : {"brass_roughness.jpg", "king_black_roughness.jpg"}) {
    const auto [largest, mean] = difference(in(name), out(name), 0);
    CHECK(largest <= kHalfStep + 4.0 / 255.0);
    CHECK(mean <= 0.5 / 255.0);
  }
}

TEST_CASE("texremap real sets: six tiles are one set, converted tile by tile", "[needs]") {
  const fs::path tiles = shared_data("textures/grid_udim");
  if (tiles.empty()) return;
  const Tree tree;
  const std::string pattern = (tiles / "grid.<UDIM>.png").string() + ":R";
  const ProcessResult result = require_success(tree.texremap(words("--roughness " + pattern + " --json ")));
  const auto sets = tree_report(result.output)["sets"];
  REQUIRE(sets.size() == 1);
  CHECK(sets[0]["texels"] == 6 * 512 * 512);
  CHECK(sets[0]["tiles"] == std::vector<std::string>{"1001", "1002", "1003", "1011", "1012", "1013"});
  CHECK(count_of(result.errors, " texels in ") == 1);
  for (const auto& entry : fs::directory_iterator(tiles)) {
    INFO(entry.path());
    const TestImage in = read_image(entry.path()),
                    out = tree.image("out/" + entry.path().filename().string());
    CHECK(difference(in, out, 0).first <= kHalfStep);
    CHECK(same_channel(in, out, 1));
    CHECK(same_channel(in, out, 2));
  }
}
