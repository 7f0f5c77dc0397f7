// Previews: an identity looks the same, other conversions do not, and figures match the pictures.
#include "report/preview.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "compiler/report/scaled_fit.hpp"
#include "remap/error.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

PreviewOptions small_preview() {
  PreviewOptions options;
  options.alphas = {0.2, 0.5};
  options.specular = {0.9, 0.6, 0.2};
  options.resolution = 48;
  return options;
}

}  // namespace

TEST_CASE("preview: the identity looks the same on every shape") {
  const Preview preview =
      make_preview(*make_builtin_renderer(), scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0), small_preview());
  REQUIRE(preview.figures.size() == 4);
  for (const PreviewFigure& figure : preview.figures) {
    CHECK(figure.ssim == Approx(1.0).margin(1e-6));
    CHECK(figure.rms < 1e-6);
    CHECK(figure.in_domain);
    CHECK(figure.target_alpha == Approx(figure.alpha));
    CHECK(figure.target_specular[2] == Approx(0.2));
  }
  CHECK(preview.figures[0].shape == Shape::kSphere);
  CHECK(preview.figures[3].shape == Shape::kTorus);
  CHECK(preview.sheet.width == 2 * 48);
  CHECK(preview.sheet.height == 6 * 48);
}

TEST_CASE("preview: shows the domain by default") {
  Fit fit = scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0);
  fit.domain = {{0.01, 1.0}, {0.0, 0.08}};
  PreviewOptions options = small_preview();
  options.alphas.clear();
  options.specular.clear();
  const Preview preview = make_preview(*make_builtin_renderer(), fit, options);
  CHECK(preview.specular == std::vector<double>{0.04});
  REQUIRE(preview.figures.size() == 8);
  CHECK(preview.figures[0].alpha == Approx(0.1));
  CHECK(preview.figures[1].alpha / preview.figures[0].alpha == Approx(std::cbrt(7.0)));
  CHECK(preview.figures[3].alpha == Approx(0.7));
  for (const PreviewFigure& figure : preview.figures) CHECK(figure.in_domain);
  CHECK(preview_alphas({{0.3, 0.6}, {0.0, 1.0}}).front() == 0.3);
  CHECK(preview_alphas({{0.8, 0.9}, {0.0, 1.0}}).back() == Approx(0.9));
}

TEST_CASE("preview: a larger error of the conversion gives less similar pictures") {
  const auto renderer = make_builtin_renderer();
  double ssim = 1.0, rms = 0.0;
  for (const double scale : {1.1, 1.4, 2.0}) {
    const Preview preview =
        make_preview(*renderer, scaled_fit("mitsuba/ggx", "mitsuba/ggx", scale), small_preview());
    const PreviewFigure& figure = preview.figures.front();
    CHECK(figure.ssim < ssim);
    CHECK(figure.rms > rms);
    ssim = figure.ssim;
    rms = figure.rms;
  }
  CHECK(ssim < 0.95);
}

TEST_CASE("preview: an index is shown as the F0 of the fit, and light of another strength is scaled") {
  const auto renderer = make_builtin_renderer();
  PreviewOptions options = small_preview();
  options.specular = {0.04};
  for (const PreviewFigure& figure :
       make_preview(*renderer, scaled_fit("mitsuba/ggx", "mitsuba/ggx-ior", 1.0), options).figures)
    CHECK(figure.ssim == Approx(1.0).margin(1e-5));
  Fit dimmed = scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0);
  dimmed.table.comments["irradiance_scale"] = "0.25";
  CHECK(make_preview(*renderer, dimmed, options).figures.front().rms > 0.01);
}

TEST_CASE("preview: a fit of a model with fixed parameters is shown with them") {
  Fit fit = scaled_fit("mitsuba/ggx-metallic", "mitsuba/ggx", 1.0);
  fit.source.roughness = RoughnessConvention::kRoughness;
  fit.source.specular = "base_color";
  fit.table.comments = {{"source_specular", "base_color"}, {"source_fixed", "metallic=1,specular=0.5"}};
  const auto renderer = make_builtin_renderer();
  for (const PreviewFigure& figure : make_preview(*renderer, fit, small_preview()).figures)
    CHECK(figure.ssim == Approx(1.0).margin(1e-6));
  fit.table.comments["source_fixed"] = "metallic=0,specular=0.5";
  for (const PreviewFigure& figure : make_preview(*renderer, fit, small_preview()).figures)
    CHECK(figure.ssim < 0.95);
}

TEST_CASE("preview: invalid options are refused") {
  const auto refused = [](const std::string& source, const PreviewOptions& options,
                          const std::string& message) {
    CHECK_THROWS_WITH(make_preview(*make_builtin_renderer(), scaled_fit(source, "mitsuba/ggx", 1.0), options),
                      Contains(message));
  };
  refused("mitsuba/ggxx", small_preview(), "did you mean mitsuba/ggx?");
  PreviewOptions options = small_preview();
  options.specular = {0.1, 0.2};
  refused("mitsuba/ggx", options, "specular must have 1 or 3 values, not 2");
  options = small_preview();
  options.shapes.clear();
  refused("mitsuba/ggx", options, "at least one shape is required");
}
