// This file tests previews. An identity looks the same, other conversions do not, and figures match the
// pictures under every light.
#include "report/preview.hpp"

#include <cmath>
#include <mutex>

#include <catch2/catch.hpp>

#include "compiler/report/scaled_fit.hpp"
#include "remap/error.hpp"
#include "report/contact_sheet.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

PreviewOptions small_preview(const std::vector<std::string>& lights = {"45"}) {
  PreviewOptions options;
  for (const std::string& light : lights) options.lights.push_back(preview_light(light, 3.0, 1.0));
  options.alphas = {0.2, 0.5};
  options.specular = {0.9, 0.6, 0.2};
  options.resolution = 48;
  options.directions = 64;
  return options;
}

Preview preview_of(const Fit& fit, const PreviewOptions& options = small_preview()) {
  return make_preview(*make_builtin_renderer(), fit, options);
}

Fit identity() { return scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0); }

float pixel(const Image& sheet, int x, int y, int channel) {
  return sheet.values[static_cast<std::size_t>(3 * (y * sheet.width + x) + channel)];
}

}  // namespace

TEST_CASE("preview: the identity looks the same under every light, on every shape it lights") {
  const Preview preview = preview_of(identity(), small_preview({"45", "studio"}));
  REQUIRE(preview.figures.size() == 6);
  for (const PreviewFigure& figure : preview.figures) {
    for (const PictureError& similarity : {figure.copied, figure.converted}) {
      CHECK(similarity.ssim == Approx(1.0).margin(1e-6));
      CHECK(similarity.rms < 1e-6);
    }
    CHECK(figure.in_domain);
    CHECK(figure.target_alpha == Approx(figure.alpha));
    CHECK(figure.target_specular[2] == Approx(0.2));
  }
  CHECK(preview.figures[1].shape == Shape::kSphere);
  CHECK(preview.figures[2].shape == Shape::kTorus);
  CHECK(preview.figures[3].light == "45 degrees");
  CHECK(preview.figures[4].light == "studio");
  CHECK(preview.figures[5].shape == Shape::kSphere);
  CHECK(preview.labels.rows.size() == 6);
}

TEST_CASE("preview: the sheet has a row for each figure and three pictures of that color") {
  const Preview preview = preview_of(identity(), small_preview({"headlight", "overcast"}));
  constexpr int kCell = 48 + 2 * 2;  // a picture and its margin of a twentieth on each side
  REQUIRE(preview.sheet.width == 3 * kCell);
  REQUIRE(preview.sheet.height == 6 * kCell);
  CHECK(pixel(preview.sheet, 0, 0, 0) == kSheetBackground);
  // These rows show the tube of a torus, and spheres.
  for (const int row : {0, 4, 5})
    for (int column = 0; column < 3; ++column) {
      const int x = kCell * column + kCell / 2, y = kCell * row + kCell / 2 - 4;
      CHECK(pixel(preview.sheet, x, y, 0) > pixel(preview.sheet, x, y, 2));
      CHECK(pixel(preview.sheet, x, y, 0) > kSheetBackground);
    }
}

TEST_CASE("preview: shows the domain by default") {
  Fit fit = identity();
  fit.domain = {{0.01, 1.0}, {0.0, 0.08}};
  PreviewOptions options = small_preview();
  options.alphas.clear();
  options.specular.clear();
  const Preview preview = preview_of(fit, options);
  CHECK(preview.specular == std::vector<double>{0.04});
  REQUIRE(preview.figures.size() == 8);
  CHECK(preview.figures[0].alpha == Approx(0.1));
  CHECK(preview.figures[1].alpha / preview.figures[0].alpha == Approx(std::cbrt(7.0)));
  CHECK(preview.figures[3].alpha == Approx(0.7));
  for (const PreviewFigure& figure : preview.figures) CHECK(figure.in_domain);
  CHECK(preview_alphas({{0.3, 0.6}, {0.0, 1.0}}).front() == 0.3);
  CHECK(preview_alphas({{0.8, 0.9}, {0.0, 1.0}}).back() == Approx(0.9));
}

TEST_CASE("preview: a larger error of the conversion gives less similar pictures; copying is no part of it") {
  for (const std::string light : {"45", "sky"}) {
    PictureError last{1.0, 0.0};
    for (const double scale : {1.1, 1.4, 2.0}) {
      const Preview preview =
          preview_of(scaled_fit("mitsuba/ggx", "mitsuba/ggx", scale), small_preview({light}));
      const PreviewFigure& figure = preview.figures.front();
      CHECK(figure.target_alpha == Approx(0.2 * scale));
      CHECK(figure.copied.rms == 0.0);
      CHECK(figure.converted.ssim < last.ssim);
      CHECK(figure.converted.rms > last.rms);
      last = figure.converted;
    }
    CHECK(last.ssim < 0.97);
    CHECK(last.rms > 0.01);
  }
}

TEST_CASE("preview: a fit that changes no number is as far from the source as copying") {
  for (const std::string light : {"45", "sky"}) {
    const PreviewFigure figure =
        preview_of(scaled_fit("mitsuba/ward", "mitsuba/as", 1.0), small_preview({light})).figures.front();
    CHECK(figure.copied.rms > 0.01);
    CHECK(figure.converted.rms == figure.copied.rms);
  }
}

TEST_CASE("preview: an index is shown as the F0 of the fit, and light of another strength is scaled") {
  PreviewOptions options = small_preview();
  options.specular = {0.04};
  for (const PreviewFigure& figure :
       preview_of(scaled_fit("mitsuba/ggx", "mitsuba/ggx-ior", 1.0), options).figures)
    CHECK(figure.converted.ssim == Approx(1.0).margin(1e-5));
  Fit dimmed = identity();
  dimmed.table.comments["irradiance_scale"] = "0.25";
  CHECK(preview_of(dimmed, options).figures.front().converted.rms > 0.01);
}

TEST_CASE("preview: a fit of a model with fixed parameters is shown with them") {
  Fit fit = scaled_fit("mitsuba/ggx-metallic", "mitsuba/ggx", 1.0);
  fit.source.roughness = RoughnessEncoding::kRoughness;
  fit.source.specular = "base_color";
  fit.table.comments = {{"source_specular", "base_color"}, {"source_fixed", "metallic=1,specular=0.5"}};
  for (const PreviewFigure& figure : preview_of(fit).figures)
    CHECK(figure.converted.ssim == Approx(1.0).margin(1e-6));
  fit.table.comments["source_fixed"] = "metallic=0,specular=0.5";
  for (const PreviewFigure& figure : preview_of(fit).figures) CHECK(figure.converted.ssim < 0.95);
}

TEST_CASE("preview: the default light is a studio, and a lamp for what no environment lights") {
  const auto light = [](const char* source, const char* target, const std::vector<Shape>& shapes) {
    return default_light(scaled_fit(source, target, 1.0), shapes);
  };
  CHECK(light("mitsuba/ward", "mitsuba/ggx", {Shape::kSphere, Shape::kTorus}) == "studio");
  CHECK(light("mitsuba/ward", "mitsuba/ggx", {Shape::kTorus}) == "45");
  CHECK(light("mitsuba3/ggx", "mitsuba/ggx", {Shape::kSphere}) == "45");
  CHECK(light("mitsuba/ggx", "mitsuba/ggx-ior", {Shape::kSphere}) == "45");
}

TEST_CASE("preview: progress rises to the whole, and what it throws ends the preview") {
  for (const std::string light : {"45", "studio"}) {
    PreviewOptions options = small_preview({light});
    std::mutex mutex;
    std::vector<double> shares;
    options.progress = [&](double share) {
      const std::lock_guard lock(mutex);
      shares.push_back(share);
    };
    preview_of(identity(), options);
    CHECK(shares.size() > options.alphas.size());
    CHECK(shares.back() == 1.0);
    for (const double share : shares) CHECK((share > 0.0 && share <= 1.0));
    options.progress = [](double) { throw Error(ErrorKind::kInterrupted, "interrupted"); };
    CHECK_THROWS_WITH(preview_of(identity(), options), "interrupted");
  }
}

TEST_CASE("preview: the rim of a sphere under an environment is smooth and as bright as what it bounds") {
  PreviewOptions options = small_preview({"overcast"});
  options.diffuse = 1.0;
  const Preview preview = preview_of(identity(), options);
  // These are the columns of the first picture in the row through its middle: background, rim, sphere.
  const int row = 2 + 24;
  CHECK(pixel(preview.sheet, 1, row, 1) == kSheetBackground);
  CHECK(pixel(preview.sheet, 4, row, 1) > 2.0f * kSheetBackground);
  for (int x = 2; x < 50; ++x) CHECK(pixel(preview.sheet, x, row, 1) >= kSheetBackground - 1e-6f);
}

TEST_CASE("preview: environments have the mean luminance of the exposure") {
  const auto luminance = [](const char* name, double exposure) {
    return mean_luminance(std::get<Environment>(preview_light(name, 3.0, exposure).light));
  };
  CHECK(luminance("sky", 1.0) == Approx(1.0));
  CHECK(luminance("overcast", 0.25) == Approx(0.25));
}

TEST_CASE("preview: invalid options are refused") {
  const auto refused = [](const std::string& source, const PreviewOptions& options,
                          const std::string& message) {
    CHECK_THROWS_WITH(preview_of(scaled_fit(source, "mitsuba/ggx", 1.0), options), Contains(message));
  };
  CHECK_THROWS_WITH(preview_light("skye", 3.0, 1.0),
                    Contains("unknown light 'skye'") && Contains("sky, overcast, studio"));
  CHECK_THROWS_WITH(preview_light("200", 3.0, 1.0), Contains("200 is outside -180 to 180 degrees"));
  refused("mitsuba/ggxx", small_preview(), "did you mean mitsuba/ggx?");
  refused("cycles-5/ggx", small_preview({"sky"}),
          "--light sky: cannot light cycles-5/ggx, which is not a built-in model");
  PreviewOptions options = small_preview({"sky"});
  options.shapes = {Shape::kTorus};
  refused("mitsuba/ggx", options, "--light sky: lights spheres only");
  options = small_preview();
  options.specular = {0.1, 0.2};
  refused("mitsuba/ggx", options, "2 values given");
  options = small_preview();
  options.alphas = {0.0};
  refused("mitsuba/ggx", options, "--alpha: 0 is outside 0 to 1");
  options = small_preview();
  options.diffuse = 2.0;
  refused("mitsuba/ggx", options, "--diffuse: 2 is outside 0 to 1");
  options.diffuse = 0.1;
  refused("mitsuba/ggx-metallic", options,
          "--diffuse: mitsuba/ggx-metallic has no diffuse reflectance (remove this option)");
  options = small_preview();
  options.shapes.clear();
  refused("mitsuba/ggx", options, "at least one light and one shape are required");
  refused("mitsuba/ggx", small_preview({}), "at least one light and one shape are required");
}
