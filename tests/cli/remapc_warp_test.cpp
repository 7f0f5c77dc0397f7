// remapc warp on texture sets whose right answer is known.
#include <nlohmann/json.hpp>

#include "cli/warp_materials.hpp"

using namespace remap;
using namespace remap::warp_cli;

TEST_CASE("remapc warp: strokes at the corners of a pattern give every texel the reflectance that is meant") {
  const Session session;
  write_materials(session);
  std::vector<std::string> words = mask_words(session);
  words.push_back("--json");
  const ProcessResult result = session.remapc(warp_words(session, words));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["diagnostics"]["dimensions"] == 2);
  CHECK(json["diagnostics"]["fixed_directions"] == 2);
  CHECK(json["diagnostics"]["fold_share"] == 0.0);
  CHECK(json["diagnostics"]["template_used"] > 0.8);
  const WarpMapFit fit = read_warp(session);
  CHECK(fit.id == "stony");
  CHECK(error_of(fit, source_texel) < 0.25);
  const ProcessResult card = session.remapc({"show", session.path("stony.json")});
  CHECK(card.exit_code == 0);
  CHECK(card.output.find("warp") != std::string::npos);
}

TEST_CASE("remapc warp: what cannot be a stroke is refused, and no file is written") {
  const Session session;
  write_materials(session);
  const auto mask = [&](const char* name, int size, float value) {
    write_image(session.path(name), test_spec(size, size, {"Y"}, OIIO::TypeUInt8),
                [value](int, int, int) { return value; });
    return session.path(name);
  };
  const auto refused = [&](const std::vector<std::string>& more, int exit_code, const std::string& message) {
    const ProcessResult result = session.remapc(warp_words(session, more));
    CAPTURE(message, result.errors);
    CHECK(result.exit_code == exit_code);
    CHECK(result.errors.find(message) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(session.path("stony.json")));
  };
  const std::string good = session.path("stone_0.png");
  refused({"--stroke", mask("small.png", 8, 1.0f), good}, 1, "is 8 x 8; expected 96 x 96");
  refused({"--stroke", mask("black.png", kSize, 0.0f), good}, 1, "marks no texel");
  refused({"--stroke", mask("white.png", kSize, 1.0f), good}, 1, "is it inverted?");
  refused({"--stroke", session.path("none.png"), good}, 1, "none.png");
  refused({}, 2, "no stroke");
  refused({"--box", "0,0,500,10", "0,0,9,9"}, 2, "--box: is 0,0,500,10; expected x0,y0,x1,y1 within 96 x 96");
  refused({"--box", "5,5,5,9", "0,0,9,9"}, 2, "--box: is 5,5,5,9");
  const ProcessResult lost = session.remapc({"warp", session.path("nothing"), session.path("stone"), "--box",
                                             "0,0,9,9", "0,0,9,9", "-o", session.path("stony.json")});
  CHECK(lost.exit_code != 0);
  CHECK(lost.errors.find("nothing") != std::string::npos);
}

TEST_CASE("remapc warp: strokes that share most of a region are warned of") {
  const Session session;
  write_materials(session);
  const ProcessResult result =
      session.remapc(warp_words(session, {"--box", "0,0,20,10", "0,0,20,10", "--box", "5,0,40,10",
                                          "50,50,70,60", "--box", "0,60,30,90", "10,70,40,90"}));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  CHECK(result.errors.find("stroke 2 covers 75 % of stroke 1 in the source") != std::string::npos);
}
