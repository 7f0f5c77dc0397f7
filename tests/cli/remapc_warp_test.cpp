// This file tests remapc warp on texture sets with a known result.
#include <nlohmann/json.hpp>

#include "cli/warp_materials.hpp"

using namespace remap;
using namespace remap::warp_cli;

namespace {

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
  Words words = mask_words();
  words.push_back("--json");
  const ProcessResult result = require_success(run_warp(session, words));
  const auto json = nlohmann::json::parse(result.output);
  CHECK(json["diagnostics"]["dimensions"] == 2);
  CHECK(json["diagnostics"]["fixed_directions"] == 2);
  CHECK(json["diagnostics"]["fold_share"] == 0.0);
  CHECK(json["diagnostics"]["template_used"] > 0.8);
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
  Words words = mask_words();
  words += "--exact --json";
  const ProcessResult made = require_success(run_warp(session, words));
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
  std::filesystem::create_directories(session.path("fits"));
  std::filesystem::copy_file(session.path("stony.json"), session.path("fits/stony.json"));
  session.write("fits/manifest.json",
                R"({"format": "remap-manifest", "version": 1, "published": [], "sweeps": [], "inverses": [],
                    "chains": []})");
  const Words folders = "--fits fits -o generated";
  const auto run_with = [&](Words command) {
    command += folders;
    return session.remapc(command);
  };
  CHECK(run_with("emit --all --check").exit_code == 1);
  CHECK(run_with("emit --all").exit_code == 0);
  CHECK(session.content("generated/stony.hpp") == header);
  CHECK(session.content("generated/converters.json").find("stony") == std::string::npos);
  CHECK(run_with({"build"}).exit_code == 0);
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
  std::size_t pictures = 0;
  for (std::size_t at = html.find("data:image/png;base64,iVBORw0KGgo"); at != std::string::npos;
       at = html.find("data:image/png;base64,iVBORw0KGgo", at + 1))
    ++pictures;
  CHECK(pictures == 9);
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
  write_set(session, "wood", 0.1, albedo_texel);
  keep_diffuse_alone(session, "wood");
  const ProcessResult result = require_success(run_warp(session, mask_words()));
  CHECK(result.errors.find("the source has only a diffuse map") != std::string::npos);
  const WarpMapFit fit = read_warp(session);
  CHECK(is_of_diffuse_alone(fit));
  CHECK(error_of(fit, albedo_texel) < 0.25);
  const ProcessResult card = session.remapc("show stony.json");
  CHECK(card.output.find("source_maps") != std::string::npos);

  write_set(session, "wood", 0.1, grey_albedo_texel);
  keep_diffuse_alone(session, "wood");
  CHECK(require_success(run_warp(session, mask_words()))
            .errors.find("the source varies in 1 dimension and the template in 2") != std::string::npos);
}
