// This file tests remapc warp: texture sets with a known result, strokes as masks and as paintings with a
// color for each pair, tables (scattering profiles in lists and maps), exact copies, and warps between
// real sets. In strokes/, metal trims and gold are red, grey plastic and jade green, black plastic and
// marble blue.
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "lower/fit_file.hpp"
#include "support/shared_data.hpp"
#include "support/test_image.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

constexpr int kSkinSize = 96;

// A Latent holds two parameters of a surface, 0 to 1. Their pattern depends on the phase.
struct Latent {
  double u, v;
};
Latent latent(double x, double y, double phase) {
  constexpr double kTurn = 6.283185307179586;
  const double u = x / 41.0 + 0.4 * std::sin(kTurn * (y / 67.0 + phase));
  const double v = (x + 2.0 * y) / (59.0 + 30.0 * phase) + phase;
  return {0.5 + 0.5 * std::sin(kTurn * u), 0.5 + 0.5 * std::sin(kTurn * v)};
}

WarpTexel source_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  return {0.1f + 0.4f * u, 0.1f + 0.1f * u * v, 0.05f, 0.04f, 0.04f, 0.04f, 0.2f + 0.3f * v * v};
}
WarpTexel template_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  return {0.05f, 0.5f - 0.4f * u, 0.1f + 0.2f * v, 0.05f, 0.05f, 0.05f, 0.5f - 0.3f * v};
}

void write_skin(const Session& session, const std::string& folder, double phase,
                const std::function<WarpTexel(const Latent&)>& texel) {
  std::filesystem::create_directories(session.path(folder));
  const auto write = [&](const char* name, const std::vector<std::string>& channels, std::size_t first) {
    write_image(session.path(folder + "/" + name), test_spec(kSkinSize, kSkinSize, channels, OIIO::TypeFloat),
                [&](int x, int y, int c) {
                  const float value = texel(latent(x, y, phase))[first + static_cast<std::size_t>(c)];
                  return first == 6 ? std::sqrt(value) : value;  // roughness is the square root of alpha
                });
  };
  write("skin_diffuse.exr", {"R", "G", "B"}, 0);
  write("skin_specular.exr", {"R", "G", "B"}, 3);
  write("skin_roughness.exr", {"Y"}, 6);
}

// Returns which of the four corners of the pattern a texel is in, or -1.
int corner_of(const Latent& at) {
  const int u = at.u < 0.15 ? 0 : at.u > 0.85 ? 1 : -1, v = at.v < 0.15 ? 0 : at.v > 0.85 ? 1 : -1;
  return u < 0 || v < 0 ? -1 : u + 2 * v;
}

// Writes a mask for each corner.
void write_strokes(const Session& session, const std::string& folder, double phase) {
  for (int k = 0; k < 4; ++k)
    write_image(session.path(folder + std::to_string(k) + ".png"),
                test_spec(kSkinSize, kSkinSize, {"Y"}, OIIO::TypeUInt8),
                [&](int x, int y, int) { return corner_of(latent(x, y, phase)) == k ? 1.0f : 0.0f; });
}

void write_materials(const Session& session) {
  write_skin(session, "wood", 0.1, source_texel);
  write_skin(session, "stone", 0.37, template_texel);
  write_strokes(session, "wood_", 0.1);
  write_strokes(session, "stone_", 0.37);
}

// Warps wood to stone, into stony.json.
ProcessResult run_warp(const Session& session, const Words& more) {
  return session.remapc("warp wood stone --force -o stony.json" + more);
}

// Returns the options for the strokes of the first `pairs` corners.
Words mask_words(std::size_t pairs = 4) {
  Words words;
  for (const char k : std::string("0123").substr(0, pairs))
    words += std::string("--stroke wood_") + k + ".png stone_" + k + ".png";
  return words;
}

// Returns the RMS error of the warp of `given` texels, relative to the variation of the template. A constant
// result has 1.
double error_of(const WarpMapFit& fit, const std::function<WarpTexel(const Latent&)>& given) {
  double squares = 0.0, spread = 0.0;
  for (int y = 0; y < kSkinSize; ++y)
    for (int x = 0; x < kSkinSize; ++x) {
      const Latent at = latent(x, y, 0.1);
      const WarpTexel found = evaluate_warp(fit.warp, given(at)), truth = template_texel(at),
                      middle = template_texel({0.5, 0.5});
      for (const std::size_t p : {std::size_t{1}, std::size_t{2}, std::size_t{6}}) {
        squares += std::pow(static_cast<double>(found[p] - truth[p]), 2);
        spread += std::pow(static_cast<double>(truth[p] - middle[p]), 2);
      }
    }
  return std::sqrt(squares / spread);
}

WarpMapFit read_warp(const Session& session) {
  AnyFit any = load_any_fit(session.path("stony.json"));
  REQUIRE(std::holds_alternative<WarpMapFit>(any));
  return std::get<WarpMapFit>(std::move(any));
}

// Returns a Lambertian material, which is what a single diffuse map describes.
WarpTexel albedo_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  return {0.1f + 0.4f * u, 0.1f + 0.3f * v * v, 0.05f + 0.1f * u * v, 0, 0, 0, 1};
}
WarpTexel grey_albedo_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u);
  return {0.1f + 0.4f * u, 0.1f + 0.4f * u, 0.1f + 0.4f * u, 0, 0, 0, 1};
}

void keep_diffuse_alone(const Session& session, const std::string& folder) {
  std::filesystem::remove(session.path(folder + "/skin_specular.exr"));
  std::filesystem::remove(session.path(folder + "/skin_roughness.exr"));
}

}  // namespace

TEST_CASE("remapc warp: strokes at the corners of a pattern give every texel its correct reflectance") {
  const Session session;
  write_materials(session);
  const ProcessResult result = require_success(run_warp(session, mask_words() + "--json"));
  const auto found = nlohmann::json::parse(result.output)["diagnostics"];
  CHECK(found["dimensions"] == 2);
  CHECK(found["fixed_directions"] == 2);
  CHECK(found["fold_share"] == 0.0);
  CHECK(found["template_used"] > 0.8);
  const WarpMapFit fit = read_warp(session);
  CHECK(fit.id == "stony");
  CHECK(error_of(fit, source_texel) < 0.25);
  const ProcessResult card = session.remapc("show stony.json");
  CHECK(card.exit_code == 0);
  CHECK(card.output.find("warp") != std::string::npos);
}

TEST_CASE(
    "remapc warp: a fit becomes a header, alone and with its folder; the data of converters has none of it",
    "[slow]") {
  const Session session;
  write_materials(session);
  const ProcessResult made = require_success(run_warp(session, mask_words() + "--exact --json"));
  const auto json = nlohmann::json::parse(made.output);
  CHECK(json["copy_rms_error"] > 0.0);
  CHECK(json["copy_rms_error"] < 0.05);
  const WarpMapFit fit = load_warp_fit(session.path("stony.json"));
  CHECK_THROWS_WITH(load_warp_fit(REMAP_SOURCE_DIR "/fits/mitsuba_ward_to_mitsuba_as.json"),
                    Catch::Contains("not the fit of a warp"));
  CHECK(fit.copy_rms_error == json["copy_rms_error"]);
  CHECK(std::holds_alternative<CopiedNodes>(fit.warp.table.entries));
  const std::string card = session.remapc("show stony.json").output;
  CHECK(card.find("256 nodes each, exact") != std::string::npos);
  CHECK(card.find("difference to an exact copy") != std::string::npos);

  require_success(session.remapc("emit stony.json -o alone"));
  const std::string header = session.content("alone/stony.hpp");
  CHECK(header.find("kCopyRmsError") != std::string::npos);
  session.write("fits/stony.json", session.content("stony.json"));
  session.write("fits/manifest.json", kEmptyManifest);
  const auto run_with = [&](const Words& command) {
    return session.remapc(command + "--fits fits -o generated");
  };
  CHECK(run_with("emit --all --check").exit_code == 1);
  CHECK(run_with("emit --all").exit_code == 0);
  CHECK(session.content("generated/stony.hpp") == header);
  CHECK(session.content("generated/converters.json").find("stony") == std::string::npos);
  CHECK(run_with("build").exit_code == 0);
  CHECK(run_with("build --check").exit_code == 0);
  CHECK(session.content("fits/README.md").find("[stony](stony.json)") != std::string::npos);
  CHECK(run_with("emit --all --check").exit_code == 0);
  session.write("generated/stony.hpp", "");
  const ProcessResult stale = run_with("build --check");
  CHECK(stale.exit_code == 1);
  CHECK((stale.output + stale.errors).find("stony.hpp is out of date with its fit") != std::string::npos);
  CHECK(session.remapc("list --fits fits").output.find("from an exact copy") != std::string::npos);
}

TEST_CASE("remapc warp: strokes that share most of a region give a warning") {
  const Session session;
  write_materials(session);
  const ProcessResult result = require_success(run_warp(
      session, "--box 0,0,20,10 0,0,20,10 --box 5,0,40,10 50,50,70,60 --box 0,60,30,90 10,70,40,90"));
  CHECK(result.errors.find("stroke 2 covers 75 % of stroke 1 in the source") != std::string::npos);
}

TEST_CASE("remapc warp: --report writes one HTML file with its pictures and warnings", "[slow]") {
  const Session session;
  write_materials(session);
  require_success(run_warp(session, mask_words() + "--report report.html"));
  const std::string html = session.content("report.html");
  CHECK(count_of(html, "data:image/png;base64,iVBORw0KGgo") == 9);
  CHECK(html.find("http") == std::string::npos);  // the page loads nothing from elsewhere
  CHECK(html.find("<h1>Warp stony</h1>") != std::string::npos);
  CHECK(html.find("<td>part of the source inside folds</td><td>0 %</td>") != std::string::npos);
  CHECK(html.ends_with("</html>\n"));
  require_success(run_warp(session, "--box 0,0,20,20 0,0,20,20 --report report.html"));
  CHECK(session.content("report.html").find("class=\"warning\">strokes do not determine direction 1") !=
        std::string::npos);
}

TEST_CASE("remapc warp: a single diffuse map is a source, distinguished by its color", "[slow]") {
  const Session session;
  write_materials(session);
  write_skin(session, "wood", 0.1, albedo_texel);
  keep_diffuse_alone(session, "wood");
  const ProcessResult result = require_success(run_warp(session, mask_words()));
  CHECK(result.errors.find("the source has only a diffuse map") != std::string::npos);
  const WarpMapFit fit = read_warp(session);
  CHECK(is_of_diffuse_alone(fit));
  CHECK(error_of(fit, albedo_texel) < 0.25);
  const ProcessResult card = session.remapc("show stony.json");
  CHECK(card.output.find("source_maps") != std::string::npos);

  write_skin(session, "wood", 0.1, grey_albedo_texel);
  keep_diffuse_alone(session, "wood");
  CHECK(require_success(run_warp(session, mask_words()))
            .errors.find("the source varies in 1 dimension and the template in 2") != std::string::npos);
}

namespace {

using Color = std::array<float, 4>;  // RGBA
constexpr Color kBlack = {0, 0, 0, 1}, kWhite = {1, 1, 1, 1}, kClear = {0, 0, 0, 0}, kRed = {1, 0, 0, 1},
                kGreen = {0, 0.8f, 0, 1}, kBlue = {0, 0, 1, 1}, kYellow = {1, 1, 0, 1};

struct Paint {
  std::array<Color, 4> corners = {kRed, kGreen, kBlue, kYellow};
  Color background = kBlack;
  bool smooth = false;  // blended edges, as an antialiased brush makes them
};

// Returns the value of a texel: if edges are smooth, the mean over 16 positions.
float painted(const Paint& paint, double phase, int x, int y, int channel) {
  const int steps = paint.smooth ? 4 : 1;
  float sum = 0.0f;
  for (int i = 0; i < steps * steps; ++i) {
    const double step = paint.smooth ? 0.25 : 0.0;
    const int corner = corner_of(latent(x + i % steps * step, y + i / steps * step, phase));
    const Color& color = corner < 0 ? paint.background : paint.corners[static_cast<std::size_t>(corner)];
    sum += color[static_cast<std::size_t>(channel)];
  }
  return sum / static_cast<float>(steps * steps);
}

std::string paint_image(const Session& session, const std::string& name, double phase, const Paint& paint) {
  std::vector<std::string> channels = {"R", "G", "B"};
  if (paint.background[3] < 1.0f) channels.push_back("A");
  OIIO::ImageSpec spec = test_spec(kSkinSize, kSkinSize, channels, OIIO::TypeUInt8);
  spec.attribute("CompressionQuality", 85);
  write_image(session.path(name), spec, [&](int x, int y, int c) { return painted(paint, phase, x, y, c); });
  return name;
}

// Runs `remapc warp` with two painted images.
ProcessResult run_painted(const Session& session, const Paint& from, const Paint& to,
                          const std::string& extension = ".png") {
  return run_warp(session, "--strokes " + paint_image(session, "from" + extension, 0.1, from) + " " +
                               paint_image(session, "to" + extension, 0.37, to) + " --json");
}

}  // namespace

TEST_CASE("remapc warp: two paintings with a color for each region give the same result as eight masks",
          "[slow]") {
  const Session session;
  write_materials(session);
  const auto [background, smooth, extension] =
      GENERATE(table<Color, bool, std::string>({{kBlack, false, ".png"},
                                                {kWhite, true, ".png"},
                                                {kClear, true, ".png"},
                                                {kWhite, true, ".jpg"},
                                                {kBlack, true, ".jpg"}}));
  CAPTURE(background[0], background[3], smooth, extension);
  const Paint paint = {.background = background, .smooth = smooth};
  const ProcessResult result = require_success(run_painted(session, paint, paint, extension));
  const auto json = nlohmann::json::parse(result.output)["diagnostics"];
  CAPTURE(json.dump());
  CHECK(json["strokes"].size() == 4);
  if (!smooth)  // strokes are sorted by the place of their first texels
    CHECK(json["strokes"] ==
          nlohmann::json({"stroke #ffff00", "stroke #0000ff", "stroke #00cc00", "stroke #ff0000"}));
  CHECK(json["fixed_directions"] == 2);
  CHECK(json["template_used"] > 0.8);
  CHECK(error_of(read_warp(session), source_texel) < 0.25);
}

TEST_CASE(
    "remapc warp: two paintings may have different backgrounds and slightly different colors; messages "
    "name strokes by their color") {
  const Session session;
  write_materials(session);
  Paint from, to;
  to.background = kClear;
  to.corners = {Color{0.9f, 0.05f, 0.1f, 1}, kGreen, Color{0.1f, 0.1f, 0.9f, 1}, kBlack};
  from.background = kWhite;
  from.corners[3] = kBlack;
  require_success(run_painted(session, from, to));
  CHECK(error_of(read_warp(session), source_texel) < 0.25);
  std::swap(to.corners[0], to.corners[2]);
  const ProcessResult swapped = require_success(run_painted(session, from, to));
  CHECK(nlohmann::json::parse(swapped.output)["warnings"].dump().find("stroke #") != std::string::npos);
}

namespace {

constexpr int kEdge = 24;
constexpr int kRadii = 40;
constexpr double kStep = 0.1;

// Returns one of the two parameters of a wax, which vary along rows and columns.
double share(int place) { return static_cast<double>(place) / (kEdge - 1); }

// Returns albedo * exp(-r / length) / (2 pi length^2).
double profile(double albedo, double length, int radius) {
  return albedo * std::exp(-kStep * (radius + 1) / length) / (2.0 * std::numbers::pi * length * length);
}
double blue_wax(int x, int y, int radius) {
  return profile(0.3 + 0.5 * share(x), 0.5 + 0.3 * share(y), radius);
}
double yellow_wax(int x, int y, int radius) {
  return profile(0.9 - 0.4 * share(x), 0.4 + 0.35 * share(y) * share(y), radius);
}

std::vector<std::string> radius_names(const std::string& colors) {
  std::vector<std::string> names;
  for (const char color : colors)
    for (int radius = 0; radius < kRadii; ++radius)
      names.push_back(std::string(1, color) + "@" +
                      number_text(std::round(10.0 * kStep * (radius + 1)) / 10.0));
  return names;
}

// Writes a list with one grey profile per row, and the map of their numbers.
template <typename Profile>
void write_list(const Session& session, const std::string& folder, const Profile& value) {
  std::string text;
  for (const std::string& name : radius_names("Y")) text += (text.empty() ? "" : ",") + name;
  text += "\n";
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x)
      for (int radius = 0; radius < kRadii; ++radius)
        text += number_text(value(x, y, radius)) + (radius + 1 < kRadii ? "," : "\n");
  session.write(folder + "/profiles.csv", text);
  write_image(session.path(folder + "/index.png"), test_spec(kEdge, kEdge, {"Y"}, OIIO::TypeUInt16),
              [](int x, int y, int) { return static_cast<float>(y * kEdge + x) / 65535.0f; });
}

template <typename Profile>
void write_map(const Session& session, const std::string& folder, const Profile& value) {
  std::filesystem::create_directories(session.path(folder));
  write_image(session.path(folder + "/profiles.exr"),
              test_spec(kEdge, kEdge, radius_names("RGB"), OIIO::TypeFloat),
              [&](int x, int y, int c) { return static_cast<float>(value(x, y, c % kRadii)); });
}

// These boxes mark the four corners, which correspond to each other.
const std::string kCorners =
    " --box 0,0,6,6 0,0,6,6 --box 18,0,24,6 18,0,24,6 --box 0,18,6,24 0,18,6,24 --box 18,18,24,24 "
    "18,18,24,24";

ProcessResult warp(const Session& session, const std::string& source, const std::string& target,
                   const Words& more) {
  return session.remapc("warp " + source + " " + target + kCorners + more);
}

// Returns the RMS distance between the position of a texel and the position that it was copied from, relative
// to the width of the map. The correct distance is 0.
double place_error(const TestImage& places) {
  const int column = places.channel("X"), row = places.channel("Y");
  double sum = 0.0;
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x)
      sum += std::pow(places.at(x, y, column) - static_cast<float>(x), 2) +
             std::pow(places.at(x, y, row) - static_cast<float>(y), 2);
  return std::sqrt(sum / (kEdge * kEdge)) / kEdge;
}

}  // namespace

TEST_CASE("remapc warp: profiles of a list are replaced by those of another list", "[slow]") {
  const Session session;
  write_list(session, "blue", blue_wax);
  write_list(session, "yellow", yellow_wax);
  const ProcessResult result = require_success(warp(session, "blue", "yellow", "--copy copied --json"));
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["diagnostics"]["dimensions"] == 2);
  CHECK(json["files"].size() == 3);
  const TestImage index = read_image(session.path("copied/index.exr")),
                  places = read_image(session.path("copied/template_texel.exr"));
  REQUIRE(index.spec.width == kEdge);
  const int column = places.channel("X"), row = places.channel("Y");
  for (int y = 0; y < kEdge; ++y)
    for (int x = 0; x < kEdge; ++x)
      CHECK(index.at(x, y, 0) == places.at(x, y, row) * kEdge + places.at(x, y, column));
  CHECK(place_error(places) < 0.15);  // unrelated positions would give 0.58
  CHECK(session.content("copied/profiles.csv") == session.content("yellow/profiles.csv"));
  // The copy is a valid set, which can be warped back.
  CHECK(warp(session, "copied", "blue", "--copy back").exit_code == 0);
}

TEST_CASE("remapc warp: a map of profiles is replaced by profiles of a list, and the reverse", "[slow]") {
  const Session session;
  write_map(session, "blue", blue_wax);
  write_list(session, "yellow", yellow_wax);
  const ProcessResult there = require_success(warp(session, "blue", "yellow", "--copy there"));
  CHECK(place_error(read_image(session.path("there/template_texel.exr"))) < 0.15);
  const ProcessResult back = require_success(warp(session, "yellow", "blue", "--copy back"));
  const TestImage profiles = read_image(session.path("back/profiles.exr")),
                  places = read_image(session.path("back/template_texel.exr"));
  CHECK(place_error(places) < 0.15);
  const int first = profiles.channel("G@0.1");
  REQUIRE(first >= 0);
  const int x = static_cast<int>(places.at(5, 7, places.channel("X"))),
            y = static_cast<int>(places.at(5, 7, places.channel("Y")));
  CHECK(profiles.at(5, 7, first) == static_cast<float>(blue_wax(x, y, 0)));
}

namespace {

constexpr int kRealSize = 512, kShrink = 4;

// Writes the means of blocks of texels, in stored values.
void write_small(const fs::path& from, const std::string& to) {
  const TestImage image = read_image(from);
  REQUIRE(image.spec.width == kRealSize * kShrink);
  const OIIO::ImageSpec spec = test_spec(kRealSize, kRealSize, image.spec.channelnames, OIIO::TypeUInt8);
  write_image(to, spec, [&](int x, int y, int c) {
    float sum = 0.0f;
    for (int i = 0; i < kShrink * kShrink; ++i)
      sum += image.at(kShrink * x + i % kShrink, kShrink * y + i / kShrink, c);
    return sum / static_cast<float>(kShrink * kShrink);
  });
}

void write_sets(const Session& session, const fs::path& textures) {
  for (const char* folder : {"box", "king"}) fs::create_directories(session.path(folder));
  for (const char* map : {"BoomBox_baseColor.png", "BoomBox_occlusionRoughnessMetallic.png"})
    write_small(textures / map, session.path(std::string("box/") + map));
  write_small(textures / "king_black_base_color.jpg", session.path("king/king_base_color.png"));
  write_small(textures / "king_black_roughness.jpg", session.path("king/king_roughness.png"));
  write_small(textures / "king_shared_metallic.jpg", session.path("king/king_metallic.png"));
}

}  // namespace

TEST_CASE("warps of real sets: BoomBox and a chess king, in both directions", "[needs][slow]") {
  const fs::path textures = shared_data("textures");
  if (textures.empty()) return;
  const Session session;
  write_sets(session, textures);
  const fs::path strokes = fs::path(REMAP_SOURCE_DIR) / "tests/cli/strokes";
  struct Direction {
    std::string source, source_strokes, target, target_strokes;
    double folds, used;  // upper limit of `folds`, lower limit of `used`
  };
  for (const Direction& way : {Direction{"box", "boom_box.png", "king", "king.png", 0.005, 0.4},
                               Direction{"king", "king.png", "box", "boom_box.png", 0.15, 0.25}}) {
    CAPTURE(way.source);
    const std::string fit = "as_" + way.target + ".json";
    const ProcessResult warp = require_success(session.remapc(
        "warp " + way.source + " " + way.target + " --strokes " + (strokes / way.source_strokes).string() +
        " " + (strokes / way.target_strokes).string() + " --json -o " + fit));
    const auto report = nlohmann::json::parse(warp.output);
    const auto& found = report["diagnostics"];
    CAPTURE(found.dump());
    CHECK(found["strokes"].size() == 3);
    CHECK(found["fixed_directions"] == 2);
    CHECK(found["fold_share"] < way.folds);
    CHECK(found["stroke_distance"] < 0.5);
    CHECK(found["template_used"] > way.used);
    // The gold of the king varies more than the few flat colors of BoomBox can represent. A warning must
    // report this.
    const bool warned = report["warnings"].dump().find("is folded by the warp") != std::string::npos;
    CHECK(warned == (found["fold_share"] > 0.005));
  }
}
