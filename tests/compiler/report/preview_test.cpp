// This file tests previews. An identity looks the same, other conversions do not, and figures match the
// pictures under every light. A ball with uniform maps equals a sphere with the same numbers, and each
// texel appears at its place on the ball. Labels of sheets do not change the pictures.
#include "report/preview.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include <catch2/catch.hpp>

#include "compiler/report/scaled_fit.hpp"
#include "look/brdf.hpp"
#include "look/lit_sphere.hpp"
#include "look/scene.hpp"
#include "remap/error.hpp"
#include "report/contact_sheet.hpp"
#include "report/warp_report.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"

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

namespace {

constexpr int kBall = 48;

Environment studio() { return std::get<Environment>(preview_light("studio", 3.0, 1.0).light); }

SphereSampling coarse() {
  SphereSampling sampling;
  sampling.resolution = kBall;
  sampling.samples = 64;
  return sampling;
}

// Writes a metallic set of tiles: one quarter of it is metal.
void write_set(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder.path() / "sets");
  const auto write = [&](const std::string& name, const std::vector<std::string>& channels,
                         const TexelFunction& f) {
    write_image(folder.path() / "sets" / name, test_spec(64, 64, channels, OIIO::TypeUInt8), f);
  };
  write("tile_basecolor.png", {"R", "G", "B"}, [](int, int, int c) { return c == 0 ? 0.8f : 0.3f; });
  write("tile_metallic.png", {"Y"}, [](int x, int y, int) { return x < 32 && y < 32 ? 1.0f : 0.0f; });
  write("tile_roughness.png", {"Y"}, [](int x, int, int) { return 0.3f + 0.005f * static_cast<float>(x); });
}

SetPreview preview_of(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
  ConvertOptions options;
  options.folder = folder.path() / "sets";
  options.from = model_named(from);
  options.to = model_named(to);
  options.output = folder.path() / "out";
  options.dry_run = true;
  SetPreviewOptions shown;
  shown.light = studio();
  shown.resolution = kBall;
  shown.directions = 64;
  return preview_sets(resolve(options), shown);
}

}  // namespace

TEST_CASE("set preview: a ball of uniform maps equals the sphere of the same numbers") {
  const Environment light = studio();
  const RadiancePyramid pyramid(std::span(&light, 1), 64);
  const BrdfModel model = builtin_brdf(GENERATE("mitsuba/ggx", "mitsuba/ward", "mitsuba/as"));
  const std::array<SphereMaterial, 1> material = {{{model, 0.2, 0.6, 0.3}}};
  const std::vector<float> expected = render_spheres(pyramid, material, coarse()).radiance(0, 0);
  const TexturedBall ball{model, 3, 2, std::vector<BallTexel>(6, {0.2, {0.6, 0.6, 0.6}, {0.3, 0.3, 0.3}})};
  const std::vector<float> found = render_textured(pyramid, std::span(&ball, 1), {}, coarse()).front();
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == Approx(expected[i]).epsilon(1e-4));
}

TEST_CASE("set preview: the left of a map is at the left of the ball, its first row at the top") {
  const Environment light = exposed(builtin_environments(16)[1], 1.0);  // overcast
  const RadiancePyramid pyramid(std::span(&light, 1), 64);
  TexturedBall ball{builtin_brdf("mitsuba/ggx"), 2, 2, std::vector<BallTexel>(4, {0.5, {}, {}})};
  ball.texels[0].diffuse = {1.0, 0.0, 0.0};
  ball.texels[3].diffuse = {0.0, 1.0, 0.0};
  const std::vector<float> picture = render_textured(pyramid, std::span(&ball, 1), {}, coarse()).front();
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, kBall);
  const auto at = [&](int x, int y, std::size_t channel) {
    const auto place = std::ranges::find(pixels, static_cast<std::uint32_t>(y * kBall + x));
    REQUIRE(place != pixels.end());
    return picture[3 * static_cast<std::size_t>(place - pixels.begin()) + channel];
  };
  CHECK(at(12, 14, 0) > 2.0f * at(12, 14, 1));
  CHECK(at(35, 33, 1) > 2.0f * at(35, 33, 0));
}

TEST_CASE(
    "set preview: normals out of the surface change nothing, normals to the camera make the ball flat") {
  const Environment light = builtin_environments(16)[1];  // overcast: darker towards the ground
  const RadiancePyramid pyramid(std::span(&light, 1), 64);
  const TexturedBall ball{builtin_brdf("mitsuba/ggx"), 1, 1, {{0.5, {}, {0.8, 0.8, 0.8}}}};
  SphereSampling sampling = coarse();
  sampling.samples = 2048;
  const auto rendered = [&](const Image& normals) {
    return render_textured(pyramid, std::span(&ball, 1), normals, sampling).front();
  };
  CHECK(rendered({1, 1, 3, {0.0f, 0.0f, 1.0f}}) == rendered({}));

  // The camera's direction (0, 0, 1) in the frame of each texel: along the rows to the right, up, and out.
  constexpr int kSide = 96;
  Image facing{kSide, kSide, 3, {}};
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double polar = std::numbers::pi * (row + 0.5) / kSide,
                   azimuth = std::numbers::pi * ((column + 0.5) / kSide - 0.5);
      for (const double value :
           {-std::sin(azimuth), -std::cos(polar) * std::cos(azimuth), std::sin(polar) * std::cos(azimuth)})
        facing.values.push_back(static_cast<float>(value));
    }
  const std::vector<float> flat = rendered(facing), round = rendered({});
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, kBall);
  const auto at = [&](const std::vector<float>& picture, int y) {
    const auto place = std::ranges::find(pixels, static_cast<std::uint32_t>(y * kBall + kBall / 2));
    return picture[3 * static_cast<std::size_t>(place - pixels.begin())];
  };
  CHECK(at(round, 8) > 1.5f * at(round, kBall - 8));
  for (int y = 8; y <= kBall - 8; ++y) CHECK(at(flat, y) == Approx(at(flat, kBall / 2)).epsilon(0.05));
}

TEST_CASE("set preview: a set that does not change looks the same, and Blender's set in three.js nearly so",
          "[needs]") {
  const TemporaryFolder folder;
  write_set(folder);
  const SetPreview same = preview_of(folder, "gltf", "gltf");
  REQUIRE(same.figures.size() == 1);
  CHECK(same.figures[0].name == "tile");
  CHECK(same.figures[0].converted.rms < 1e-6);
  CHECK(same.notes.empty());

  const SetPreview other = preview_of(folder, "blender", "threejs");
  REQUIRE(other.figures[0].copied);
  CHECK(other.figures[0].converted.rms < 0.5 * other.figures[0].copied->rms);
  CHECK(other.labels.columns.size() == 3);
  REQUIRE(other.notes.size() == 2);
  CHECK_THAT(other.notes[0], Contains("is shown as mitsuba/ggx"));

  // The set has only roughness and specular, without a diffuse lobe.
  std::filesystem::rename(folder.path() / "sets/tile_basecolor.png",
                          folder.path() / "sets/tile_specular.png");
  const SetPreview lobe = preview_of(folder, "mitsuba/ward", "mitsuba/as");
  CHECK(lobe.figures[0].converted.rms < lobe.figures[0].copied->rms);
  std::filesystem::rename(folder.path() / "sets/tile_specular.png",
                          folder.path() / "sets/tile_basecolor.png");

  const SetPreview across = preview_of(folder, "gltf", "gltf-specgloss");
  CHECK_FALSE(across.figures[0].copied);
  CHECK(across.labels.columns.size() == 2);
  CHECK(across.figures[0].converted.rms < 0.02);
}

TEST_CASE("pictures of maps: sizes, and what a pixel shows") {
  const PictureGrid small = picture_grid(4, 2, 8);
  CHECK(small.width == 8);
  CHECK(small.height == 4);
  CHECK(small.samples == 1);
  CHECK(small.texels[0] == small.texels[1]);  // texels are repeated
  const PictureGrid large = picture_grid(4096, 1024, 512);
  CHECK(large.width == 512);
  CHECK(large.height == 128);
  CHECK(large.texels.size() == 9 * 512 * 128);
  CHECK(*std::max_element(large.texels.begin(), large.texels.end()) < 4096u * 1024u);
  // A white diffuse map is brightest where it faces the key light, and stays grey.
  const PictureGrid grid = picture_grid(16, 16, 16);
  const WarpTexel white = {1, 1, 1, 0, 0, 0, 0.5f};
  const Image lit = shaded_map(grid, std::vector<WarpTexel>(256, white), {Brdf::kGgx, Fresnel::kNone});
  CHECK(lit.values[0] == lit.values[2]);
  CHECK(lit.values[0] > lit.values[3 * 255]);
  CHECK(lit.values[0] > 0.9f);
}

namespace {

// Returns the part of `picture` below `top` and right of `left`.
std::vector<float> part_of(const Image& picture, int left, int top) {
  std::vector<float> values;
  for (int y = top; y < picture.height; ++y)
    for (int x = 3 * left; x < 3 * picture.width; ++x)
      values.push_back(picture.values[static_cast<std::size_t>(3 * y * picture.width + x)]);
  return values;
}

}  // namespace

TEST_CASE("sheet labels: stand above and left of a sheet that stays as it is") {
  const Image sheet = blank_picture(200, 100, 0.5f);
  const Image picture = labelled(sheet, {{"source", "target"}, {"alpha 0.2\nspecular 0.5"}});
  const int left = picture.width - sheet.width, top = picture.height - sheet.height;
  CHECK(left > 20);
  CHECK(top > 8);
  CHECK(part_of(picture, left, top) == sheet.values);
  std::size_t inked = 0;
  for (const float value : picture.values)
    if (value == Approx(0.9f)) ++inked;
  CHECK(inked > 300);
}

TEST_CASE("sheet labels: letters are as large as the pictures allow") {
  const SheetLabels labels{{"source"}, {"row"}};
  const int small = labelled(blank_picture(128, 128, 0.0f), labels).height - 128;
  CHECK(labelled(blank_picture(512, 512, 0.0f), labels).height - 512 == 4 * small);
}

TEST_CASE("sheet labels: a line breaks at a space where it is too long") {
  const Image sheet = blank_picture(128, 128, 0.5f);
  CHECK(labelled(sheet, {{"equation (2) and the mean of three"}, {"row"}}).values ==
        labelled(sheet, {{"equation (2) and the\nmean of three"}, {"row"}}).values);
}

TEST_CASE("sheet labels: a long line is cut, whatever its characters and the size of the pictures") {
  const std::string name(5000, 'm');
  for (const int side : {1, 16, 128, 400}) {
    const Image sheet = blank_picture(side, side, 0.5f);
    const Image picture = labelled(sheet, {{name}, {name + "\n\xc3\xbc\n\x01"}});
    const int left = picture.width - side, top = picture.height - side;
    CHECK(left <= 180 * std::max(1, side / 128));
    CHECK(part_of(picture, left, top) == sheet.values);
    CHECK(labelled(sheet, {{name + "x"}, {name + "xyz\n??\n?"}}).values == picture.values);
  }
}
