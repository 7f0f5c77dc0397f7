// Previews under an environment: an exact conversion looks like the source, copied numbers do not, and the
// sheet shows both.
#include <catch2/catch.hpp>

#include "compiler/report/scaled_fit.hpp"
#include "remap/error.hpp"
#include "report/contact_sheet.hpp"
#include "report/preview.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

LitPreviewOptions small_preview() {
  LitPreviewOptions options;
  options.alphas = {0.2, 0.5};
  options.specular = {0.9, 0.6, 0.2};
  options.resolution = 32;
  options.directions = 64;
  return options;
}

float pixel(const Image& sheet, int x, int y, int channel) {
  return sheet.values[static_cast<std::size_t>(3 * (y * sheet.width + x) + channel)];
}

}  // namespace

TEST_CASE("lit preview: a conversion that changes nothing looks like the source") {
  const LitPreview preview = make_lit_preview(scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0),
                                              environment_for_preview("studio", 1.0), small_preview());
  REQUIRE(preview.figures.size() == 2);
  for (const LitFigure& figure : preview.figures) {
    CHECK(figure.converted.rms == 0.0);
    CHECK(figure.converted.ssim == Approx(1.0));
    CHECK(figure.copied.rms == 0.0);
    CHECK(figure.in_domain);
  }
}

TEST_CASE("lit preview: copied numbers and a wrong conversion look different from the source") {
  const Environment sky = environment_for_preview("sky", 1.0);
  const LitPreview models =
      make_lit_preview(scaled_fit("mitsuba/ward", "mitsuba/as", 1.0), sky, small_preview());
  CHECK(models.figures[0].copied.rms > 0.01);
  CHECK(models.figures[0].copied.rms == models.figures[0].converted.rms);
  const LitPreview widths =
      make_lit_preview(scaled_fit("mitsuba/ggx", "mitsuba/ggx", 2.0), sky, small_preview());
  CHECK(widths.figures[0].target_alpha == Approx(0.4));
  CHECK(widths.figures[0].copied.rms == 0.0);
  CHECK(widths.figures[0].converted.rms > 0.01);
  CHECK(widths.figures[0].converted.ssim < 0.999);
}

TEST_CASE("lit preview: the sheet has a row for each alpha and three spheres of that color") {
  const LitPreview preview = make_lit_preview(scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0),
                                              environment_for_preview("overcast", 1.0), small_preview());
  REQUIRE(preview.sheet.width == 3 * 34);  // a margin of a twentieth on each side
  REQUIRE(preview.sheet.height == 2 * 34);
  CHECK(pixel(preview.sheet, 0, 0, 0) == kSheetBackground);
  for (int column = 0; column < 3; ++column) {
    const int middle = 34 * column + 17;
    CHECK(pixel(preview.sheet, middle, 13, 0) > pixel(preview.sheet, middle, 13, 2));
    CHECK(pixel(preview.sheet, middle, 13, 0) > kSheetBackground);
  }
}

TEST_CASE("lit preview: environments have the mean luminance of the exposure") {
  CHECK(mean_luminance(environment_for_preview("sky", 1.0)) == Approx(1.0));
  CHECK(mean_luminance(environment_for_preview("overcast", 0.25)) == Approx(0.25));
}

TEST_CASE(
    "lit preview: unknown environments, models without a lobe and values out of range are usage errors") {
  const Environment sky = environment_for_preview("sky", 1.0);
  const Fit fit = scaled_fit("mitsuba/ggx", "mitsuba/ggx", 1.0);
  CHECK_THROWS_WITH(environment_for_preview("skye", 1.0),
                    Contains("unknown environment 'skye'") && Contains("sky, overcast, studio"));
  CHECK_THROWS_WITH(environment_for_preview("sky", 0.0), Contains("--exposure: 0 is not above 0"));
  CHECK_THROWS_AS(make_lit_preview(scaled_fit("cycles-5/ggx", "mitsuba/ggx", 1.0), sky, small_preview()),
                  Error);
  LitPreviewOptions options = small_preview();
  options.specular = {0.5, 0.5};
  CHECK_THROWS_WITH(make_lit_preview(fit, sky, options), Contains("2 values"));
  options = small_preview();
  options.alphas = {0.0};
  CHECK_THROWS_WITH(make_lit_preview(fit, sky, options), Contains("--alpha: 0 is outside 0 to 1"));
  options = small_preview();
  options.diffuse = 2.0;
  CHECK_THROWS_WITH(make_lit_preview(fit, sky, options), Contains("--diffuse: 2 is outside 0 to 1"));
}
