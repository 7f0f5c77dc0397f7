// remapc warp on texture sets whose right answer is known.
#include <cmath>
#include <functional>

#include <nlohmann/json.hpp>

#include "cli/remapc_session.hpp"
#include "model/fit_json.hpp"
#include "support/test_image.hpp"

using namespace remap;

namespace {

constexpr int kSize = 96;

// Two parameters of a surface, 0 to 1, in a pattern of its own for each phase.
struct Latent {
  double u, v;
};
Latent latent(int x, int y, double phase) {
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

void write_set(const Session& session, const std::string& folder, double phase,
               const std::function<WarpTexel(const Latent&)>& texel) {
  std::filesystem::create_directories(session.path(folder));
  const auto write = [&](const char* name, const std::vector<std::string>& channels, std::size_t first) {
    write_image(session.path(folder + "/" + name), test_spec(kSize, kSize, channels, OIIO::TypeFloat),
                [&](int x, int y, int c) {
                  const float value = texel(latent(x, y, phase))[first + static_cast<std::size_t>(c)];
                  return first == 6 ? std::sqrt(value) : value;  // roughness, of which alpha is the square
                });
  };
  write("skin_diffuse.exr", {"R", "G", "B"}, 0);
  write("skin_specular.exr", {"R", "G", "B"}, 3);
  write("skin_roughness.exr", {"Y"}, 6);
}

// The four corners of the pattern.
void write_strokes(const Session& session, const std::string& folder, double phase) {
  for (int k = 0; k < 4; ++k)
    write_image(session.path(folder + std::to_string(k) + ".png"),
                test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8), [&](int x, int y, int) {
                  const Latent at = latent(x, y, phase);
                  const bool u = k % 2 == 0 ? at.u < 0.15 : at.u > 0.85,
                             v = k / 2 == 0 ? at.v < 0.15 : at.v > 0.85;
                  return u && v ? 1.0f : 0.0f;
                });
}

void write_materials(const Session& session) {
  write_set(session, "wood", 0.1, source_texel);
  write_set(session, "stone", 0.37, template_texel);
  write_strokes(session, "wood_", 0.1);
  write_strokes(session, "stone_", 0.37);
}

std::vector<std::string> warp_words(const Session& session, const std::vector<std::string>& more) {
  std::vector<std::string> words = {"warp", session.path("wood"), session.path("stone"), "-o",
                                    session.path("stony.json")};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<std::string> strokes(const Session& session) {
  std::vector<std::string> words;
  for (const char* k : {"0", "1", "2", "3"})
    words.insert(words.end(), {"--stroke", session.path("wood_" + std::string(k) + ".png"),
                               session.path("stone_" + std::string(k) + ".png")});
  return words;
}

}  // namespace

TEST_CASE("remapc warp: strokes at the corners of a pattern give every texel the reflectance that is meant") {
  const Session session;
  write_materials(session);
  std::vector<std::string> words = strokes(session);
  words.push_back("--json");
  const ProcessResult result = session.remapc(warp_words(session, words));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["diagnostics"]["dimensions"] == 2);
  CHECK(json["diagnostics"]["fixed_directions"] == 2);
  CHECK(json["diagnostics"]["fold_share"] == 0.0);
  CHECK(json["diagnostics"]["template_used"] > 0.8);
  const AnyFit any = load_any_fit(session.path("stony.json"));
  const auto* fit = std::get_if<WarpMapFit>(&any);
  REQUIRE(fit != nullptr);
  CHECK(fit->id == "stony");
  double squares = 0.0, spread = 0.0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Latent at = latent(x, y, 0.1);
      const WarpTexel found = evaluate_warp(fit->warp, source_texel(at)), truth = template_texel(at),
                      middle = template_texel({0.5, 0.5});
      for (const std::size_t p : {std::size_t{1}, std::size_t{2}, std::size_t{6}}) {
        squares += std::pow(static_cast<double>(found[p] - truth[p]), 2);
        spread += std::pow(static_cast<double>(truth[p] - middle[p]), 2);
      }
    }
  CAPTURE(std::sqrt(squares / spread));
  CHECK(squares < 0.25 * 0.25 * spread);
  const ProcessResult card = session.remapc({"show", session.path("stony.json")});
  CHECK(card.exit_code == 0);
  CHECK(card.output.find("warp") != std::string::npos);
}

TEST_CASE("remapc warp: a fit becomes a header, alone and with the registry of its folder") {
  const Session session;
  write_materials(session);
  std::vector<std::string> words = strokes(session);
  words.insert(words.end(), {"--exact", "--json"});
  const ProcessResult made = session.remapc(warp_words(session, words));
  INFO(made.errors);
  REQUIRE(made.exit_code == 0);
  const auto json = nlohmann::json::parse(made.output);
  CHECK(json["copy_rms_error"] > 0.0);
  CHECK(json["copy_rms_error"] < 0.05);
  const auto fit = std::get<WarpMapFit>(load_any_fit(session.path("stony.json")));
  CHECK(fit.copy_rms_error == json["copy_rms_error"]);
  CHECK(std::holds_alternative<CopiedNodes>(fit.warp.table.entries));
  const std::string card = session.remapc({"show", session.path("stony.json")}).output;
  CHECK(card.find("256 nodes each, nearest copied") != std::string::npos);
  CHECK(card.find("spread from an exact copy") != std::string::npos);

  REQUIRE(session.remapc({"emit", session.path("stony.json"), "-o", session.path("alone")}).exit_code == 0);
  const std::string header = read_file(session.path("alone/stony.hpp"));
  CHECK(header.find("kCopyRmsError") != std::string::npos);
  std::filesystem::create_directories(session.path("fits"));
  std::filesystem::copy_file(session.path("stony.json"), session.path("fits/stony.json"));
  session.write("fits/manifest.json",
                R"({"format": "remap-manifest", "version": 1, "published": [], "sweeps": [], "inverses": [],
                    "chains": []})");
  const std::vector<std::string> folders = {"--fits", session.path("fits"), "-o", session.path("generated")};
  const auto run_with = [&](std::vector<std::string> command) {
    command.insert(command.end(), folders.begin(), folders.end());
    return session.remapc(command);
  };
  CHECK(run_with({"emit", "--all", "--check"}).exit_code == 1);
  CHECK(run_with({"emit", "--all"}).exit_code == 0);
  CHECK(read_file(session.path("generated/stony.hpp")) == header);
  CHECK(read_file(session.path("generated/registry.hpp")).find("MaterialConverterEntry, 1>") !=
        std::string::npos);
  CHECK(run_with({"build"}).exit_code == 0);
  CHECK(run_with({"build", "--check"}).exit_code == 0);
  CHECK(read_file(session.path("fits/README.md")).find("[stony](stony.json)") != std::string::npos);
  CHECK(run_with({"emit", "--all", "--check"}).exit_code == 0);
  session.write("generated/stony.hpp", "");
  const ProcessResult stale = run_with({"build", "--check"});
  CHECK(stale.exit_code == 1);
  CHECK((stale.output + stale.errors).find("stony.hpp is not what its fit gives") != std::string::npos);
  CHECK(session.remapc({"list", "--fits", session.path("fits")}).output.find("from an exact copy") !=
        std::string::npos);
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

TEST_CASE("remapc warp: --report writes one HTML file with its pictures, or one PNG") {
  const Session session;
  write_materials(session);
  std::vector<std::string> words = strokes(session);
  words.insert(words.end(), {"--report", session.path("report.html")});
  const ProcessResult result = session.remapc(warp_words(session, words));
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const std::string html = read_file(session.path("report.html"));
  std::size_t pictures = 0;
  for (std::size_t at = html.find("data:image/png;base64,iVBORw0KGgo"); at != std::string::npos;
       at = html.find("data:image/png;base64,iVBORw0KGgo", at + 1))
    ++pictures;
  CHECK(pictures == 9);
  CHECK(html.find("http") == std::string::npos);  // nothing from elsewhere
  CHECK(html.find("<h1>Warp stony</h1>") != std::string::npos);
  CHECK(html.find("<td>folds</td><td>0 %</td>") != std::string::npos);
  CHECK(html.ends_with("</html>\n"));
  words.back() = session.path("report.png");
  REQUIRE(session.remapc(warp_words(session, words)).exit_code == 0);
  const TestImage sheet = read_image(session.path("report.png"));
  CHECK(sheet.spec.width == 3 * 518 + 6);  // pictures of 512 pixels, gaps of 6
  CHECK(sheet.spec.height > 2 * 518);
  CHECK(sheet.spec.nchannels == 3);
}

TEST_CASE("remapc warp: a report has warnings in it, and is refused under another name before the work") {
  const Session session;
  write_materials(session);
  const std::vector<std::string> few = {"--box", "0,0,20,20", "0,0,20,20", "--report"};
  std::vector<std::string> words = few;
  words.push_back(session.path("report.html"));
  REQUIRE(session.remapc(warp_words(session, words)).exit_code == 0);
  CHECK(read_file(session.path("report.html")).find("class=\"warning\">strokes do not fix direction 1") !=
        std::string::npos);
  std::filesystem::remove(session.path("stony.json"));
  words.back() = session.path("report.pdf");
  check_failure(session.remapc(warp_words(session, words)), 2, "expected a name that ends in .html or .png");
  CHECK_FALSE(std::filesystem::exists(session.path("stony.json")));
}
