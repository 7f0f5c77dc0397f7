// This file tests remapc warp with strokes painted in one image, one color for each pair.
#include <array>

#include <nlohmann/json.hpp>

#include "cli/warp_materials.hpp"

using namespace remap;
using namespace remap::warp_cli;

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
  const std::vector<std::string> channels = paint.background[3] < 1.0f
                                                ? std::vector<std::string>{"R", "G", "B", "A"}
                                                : std::vector<std::string>{"R", "G", "B"};
  OIIO::ImageSpec spec = test_spec(kSize, kSize, channels, OIIO::TypeUInt8);
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
  Paint paint;
  paint.background = background;
  paint.smooth = smooth;
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
