// This file converts real texture sets: BoomBox, brass, a chess king and six tiles. Converted to the
// specular workflow and back, each texel must come back within a step of 8 bits, or the report must give a
// reason.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <vector>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/campaign.hpp"
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

}  // namespace

TEST_CASE("texremap real sets: a folder of BoomBox, brass and a chess king", "[needs][slow]") {
  const fs::path folder = shared_data("textures");
  if (folder.empty()) return;
  const Session tree;
  const ProcessResult result = require_success(tree.texremap(words(folder.string() + " --json ")));
  const auto sets = tree_report(result.output)["sets"];
  REQUIRE(sets.size() == 3);
  for (const auto& set : sets) CHECK(set["texels"] == 2048 * 2048);
  CHECK(tree.results() == Names{"BoomBox_baseColor.png", "BoomBox_occlusionRoughnessMetallic.png",
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
  const Session tree;
  const std::string pattern = (tiles / "grid.<UDIM>.png").string() + ":R";
  const ProcessResult result = require_success(tree.texremap(words("--roughness " + pattern + " --json ")));
  const auto sets = tree_report(result.output)["sets"];
  REQUIRE(sets.size() == 1);
  CHECK(sets[0]["texels"] == 6 * 512 * 512);
  CHECK(sets[0]["tiles"] == Names{"1001", "1002", "1003", "1011", "1012", "1013"});
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

namespace {

// A MaterialMaps holds the arguments of `convert` for a metallic material.
struct MaterialMaps {
  std::string name, base_color, metallic, roughness, occlusion;
};

// A RoundTrip counts the texels that come back. It also counts other texels, with and without a reason in the
// maps of the report.
struct RoundTrip {
  std::size_t texels = 0, returned = 0;
  std::size_t unlisted = 0;     // does not come back, although the report does not call it uncertain
  std::size_t unexplained = 0;  // does not come back, and also differs as a specular material
  int largest_roughness = 0;
  double most = 1.0;  // largest possible fraction of texels that come back, for any method
};

int byte(const TestImage& image, std::size_t texel, std::size_t channel) {
  return image.bytes[texel * static_cast<std::size_t>(image.spec.nchannels) + channel];
}

// Converts from steps of 8 bits, and back.
double linear(double stored) { return srgb_to_linear(stored / 255.0); }
double in_srgb(double value) { return 255.0 * linear_to_srgb(value); }

// This allows for the rounding errors of base color and metallic, which may add up.
constexpr double kMostSteps = 1.5;

bool is_seen(double a, double b) {
  constexpr double kDarkDifference = 0.5 / 255.0;  // linear: half a step of a display, as a fraction of white
  return std::abs(a - b) > kMostSteps && std::abs(linear(a) - linear(b)) > kDarkDifference;
}

// Returns diffuse and specular of a metallic material by equation (2), in steps of 8 bits in sRGB.
std::array<double, 6> specular_bytes(const std::array<int, 3>& base, int metallic, bool is_gltf) {
  const double m = metallic / 255.0;
  std::array<double, 6> result{};
  double most = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    result[3 + c] = 0.04 * (1.0 - m) + linear(base[c]) * m;
    most = std::max(most, result[3 + c]);
  }
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = linear(base[c]) * (1.0 - m) * (is_gltf ? 0.96 / std::max(1.0 - most, 1e-6) : 1.0);
  for (double& value : result) value = in_srgb(value);
  return result;
}

using Answer = std::array<int, 4>;  // base color and metallic, in steps of 8 bits

bool is_same(const Answer& a, const Answer& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](int x, int y) { return std::abs(x - y) <= 1; });
}

// Returns how many of the counted texels a single answer can satisfy.
std::size_t most_served(const std::map<Answer, std::size_t>& counts) {
  std::size_t most = 0;
  for (const auto& entry : counts)
    for (const int color : {-1, 0, 1})
      for (const int metallic : {-1, 0, 1}) {
        const Answer& own = entry.first;
        const Answer tried = {own[0] + color, own[1] + color, own[2] + color, own[3] + metallic};
        std::size_t served = 0;
        for (const auto& [answer, count] : counts) served += is_same(answer, tried) ? count : 0;
        most = std::max(most, served);
      }
  return most;
}

// Returns an upper bound for any method that only reads the stored maps, because such a method treats equal
// stored texels equally.
double most_that_return(const std::vector<Answer>& given, const TestImage& diffuse,
                        const TestImage& specular) {
  const auto bytes = [](const TestImage& image) { return image.bytes.size() / image.values.size(); };
  std::map<std::string, std::map<Answer, std::size_t>> stored;
  for (std::size_t i = 0; i < given.size(); ++i) {
    std::string key;
    for (const TestImage* image : {&diffuse, &specular}) {
      const auto channels = static_cast<std::size_t>(image->spec.nchannels);
      const auto* texel = reinterpret_cast<const char*>(image->bytes.data()) + i * channels * bytes(*image);
      key.append(texel, 3 * bytes(*image));
    }
    ++stored[key][given[i]];
  }
  std::size_t served = 0;
  for (const auto& entry : stored) served += most_served(entry.second);
  return static_cast<double>(served) / static_cast<double>(given.size());
}

std::string words_of(const std::string& file, const char* channel) { return file + channel; }

// Writes every fourth texel of a map `FILE:CHANNEL` or `FILE`, in both directions, into the folder. A full
// campaign uses the whole map.
std::string thinned(const fs::path& folder, const std::string& word) {
  constexpr int kStep = 4;
  if (is_full_campaign()) return word;
  const std::size_t colon = word.rfind(':');
  const fs::path file = word.substr(0, colon), thin = folder / (file.stem().string() + ".png");
  if (!fs::exists(thin)) {
    const TestImage image = read_image(file);
    const OIIO::ImageSpec spec = test_spec(image.spec.width / kStep, image.spec.height / kStep,
                                           image.spec.channelnames, OIIO::TypeUInt8);
    write_image(thin, spec, [&](int x, int y, int c) { return image.at(kStep * x, kStep * y, c); });
  }
  return thin.string() + (colon == std::string::npos ? "" : word.substr(colon));
}

// `type` is the pixel type of the specular maps in the middle of the round trip.
RoundTrip round_trip(const MaterialMaps& material, const std::vector<std::string>& models,
                     const std::string& type) {
  const Session session;
  const auto at = [&](const char* name) { return session.path(name); };
  const auto convert = [&](const std::string& from, const std::string& to, Words words) {
    return session.texremap(Words("convert --from " + from + " --to " + to + " --json") + words);
  };
  require_success(convert(models[0], models[1],
                          "--base-color " + material.base_color + " --metallic " + material.metallic +
                              " --roughness " + material.roughness +
                              " --input occlusion=" + material.occlusion + " --format png --type " + type +
                              " --layout specgloss -o specgloss"));
  const std::string packed = at("specgloss/specular_glossiness.png");
  const ProcessResult back = require_success(
      convert(models[1], models[0],
              "--diffuse specgloss/diffuse.png --specular " + packed + " --glossiness " +
                  words_of(packed, ":A") + " --layout separate --type uint8 --diagnose checks -o back"));
  std::cout << material.name << ", " << models[0] << " to " << models[1] << " in " << type
            << " and back: " << nlohmann::json::parse(back.output)["metallic_confidence"].dump() << "\n";
  const auto channel_of = [](const std::string& word) {
    const std::size_t colon = word.rfind(':');
    return colon == std::string::npos ? std::size_t{0} : std::string("RGB").find(word[colon + 1]);
  };
  const auto file_of = [](const std::string& word) { return word.substr(0, word.rfind(':')); };
  const TestImage base = read_image(material.base_color), base_back = read_image(at("back/base_color.png")),
                  metal = read_image(file_of(material.metallic)),
                  metal_back = read_image(at("back/metallic.png")),
                  rough = read_image(file_of(material.roughness)),
                  rough_back = read_image(at("back/roughness.png")),
                  issues = read_image(at("checks/issues.png")),
                  width = read_image(at("checks/metallic_uncertainty.png"));
  RoundTrip result;
  result.texels = metal_back.bytes.size();
  std::vector<Answer> answers(result.texels);
  for (std::size_t i = 0; i < result.texels; ++i) {
    const int before = byte(metal, i, channel_of(material.metallic));
    const int difference = std::abs(before - byte(metal_back, i, 0));
    answers[i] = {byte(base, i, 0), byte(base, i, 1), byte(base, i, 2), before};
    int color = 0;
    for (std::size_t c = 0; c < 3; ++c)
      color = std::max(color, std::abs(byte(base, i, c) - byte(base_back, i, c)));
    result.largest_roughness =
        std::max(result.largest_roughness,
                 std::abs(byte(rough, i, channel_of(material.roughness)) - byte(rough_back, i, 0)));
    const bool is_back = difference <= 1 && color <= 1;
    result.returned += is_back;
    if (is_back) continue;
    // A difference within the interval of the map metallic_uncertainty is in the report, too.
    const bool could_be = static_cast<float>(difference) <= 255.0f * width.values[i] + 1.0f;
    result.unlisted += issues.values[i] == 0.0f && !could_be;
    // A texel may differ if both materials have the same specular form within a step of 8 bits, or are too
    // dark.
    const auto stored = [&](const TestImage& image, int metallic) {
      return specular_bytes({byte(image, i, 0), byte(image, i, 1), byte(image, i, 2)}, metallic,
                            models[0] == "gltf");
    };
    const auto given = stored(base, before), found = stored(base_back, byte(metal_back, i, 0));
    for (std::size_t r = 0; r < given.size(); ++r)
      if (is_seen(given[r], found[r])) {
        ++result.unexplained;
        break;
      }
  }
  result.most = most_that_return(answers, read_image(at("specgloss/diffuse.png")), read_image(packed));
  const auto percent = [&](std::size_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(result.texels);
  };
  std::cout << "  to one step: " << percent(result.returned) << " % of the texels, at most "
            << 100.0 * result.most << " % of what is stored; " << result.texels - result.returned
            << " others, of which " << result.unlisted << " in no list of issues and " << result.unexplained
            << " seen as another material\n";
  return result;
}

}  // namespace

TEST_CASE("texremap round trips: BoomBox and a chess king return from the specular workflow",
          "[needs][slow][campaign]") {
  const fs::path folder = shared_data("textures");
  if (folder.empty()) return;
  const TemporaryFolder thin;
  const auto file = [&](const std::string& name) { return thinned(thin.path(), (folder / name).string()); };
  const std::string orm = "BoomBox_occlusionRoughnessMetallic.png";
  const MaterialMaps box{"BoomBox", file("BoomBox_baseColor.png"), file(orm + ":B"), file(orm + ":G"),
                         file(orm + ":R")};
  const MaterialMaps king{"chess king", file("king_black_base_color.jpg"), file("king_shared_metallic.jpg"),
                          file("king_black_roughness.jpg"), "1"};
  for (const MaterialMaps* given : {&box, &king})
    for (const std::vector<std::string>& models : {Names{"gltf", "gltf-specgloss"}, {"metallic", "specular"}})
      for (const char* type : {"uint8", "uint16"}) {
        if (type == std::string("uint16") && models[0] == "gltf")
          continue;  // skipped to save time, because it equals the other pair
        const RoundTrip result = round_trip(*given, models, type);
        // The goal is 99.9 %. It is lower if many texels are equal in the stored maps, as in BoomBox with its
        // 8 bits.
        CHECK(result.returned >= result.texels * (result.most > 0.999 ? 999 : 996) / 1000);
        CHECK(result.unlisted == 0);
        CHECK(result.unexplained <= (given == &box ? result.texels / 5000 : 0));
        CHECK(result.largest_roughness <= 1);
      }
}
