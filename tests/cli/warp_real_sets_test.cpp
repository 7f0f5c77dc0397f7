// This file tests warps between real texture sets: BoomBox and a chess king, with strokes painted over their
// maps. In strokes/, metal trims and gold are red, grey plastic and jade green, black plastic and marble
// blue.
#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "support/shared_data.hpp"
#include "support/test_image.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

constexpr int kSize = 512, kShrink = 4;

// Writes the means of blocks of texels, in stored values.
void write_small(const fs::path& from, const std::string& to) {
  const TestImage image = read_image(from);
  REQUIRE(image.spec.width == kSize * kShrink);
  const int channels = image.spec.nchannels;
  write_image(
      to,
      test_spec(kSize, kSize,
                channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"},
                OIIO::TypeUInt8),
      [&](int x, int y, int c) {
        float sum = 0.0f;
        for (int i = 0; i < kShrink * kShrink; ++i)
          sum += image.at(kShrink * x + i % kShrink, kShrink * y + i / kShrink, std::min(c, channels - 1));
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
