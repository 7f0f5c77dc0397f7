// This file compares the streaming pass with the converter applied to each texel.
#include "texture/texture_pass.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "remap/shipped_converters.hpp"
#include "remap/workflow.hpp"
#include "support/error_of.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"
#include "texture/target_plan.hpp"

using namespace remap;

namespace {

constexpr int kPassWidth = 150, kPassHeight = 301;

struct Scene {
  TemporaryFolder folder;
  std::filesystem::path roughness = folder.path() / "r.exr", specular = folder.path() / "s.exr";
  std::filesystem::path roughness_out = folder.path() / "out/r.exr",
                        specular_out = folder.path() / "out/s.exr";

  explicit Scene(int tile = 0) {
    auto spec = test_spec(kPassWidth, kPassHeight, {"Y"}, OIIO::TypeFloat);
    write_image(roughness, spec, noise);
    spec = test_spec(kPassWidth, kPassHeight, {"R", "G", "B", "A", "mask"}, OIIO::TypeFloat);
    spec.tile_width = spec.tile_height = tile;
    write_image(specular, spec, [](int x, int y, int c) { return noise(x, y, c + 1); });
  }
  MapStatistics pass(const Converter& converter, const PassOptions& options) const {
    TextureSetRequest request;
    request.parameters[Parameter::kRoughness].source = MapName{roughness, {}};
    request.parameters[Parameter::kSpecular].source = MapName{specular, {}};
    TextureSet set = open_texture_set(request);
    TargetChoice choice;
    choice.folder = folder.path() / "out";
    std::vector<TargetMap> targets = open_targets(set, plan_targets(set, choice));
    return run_texture_pass(set, targets, converter, options);
  }
};

std::optional<WorkflowEnd> workflow_end(const char* name) {
  const WorkflowModel* model = find_workflow_model(name);
  return model != nullptr ? std::optional(model->end) : std::nullopt;
}

// Counts texels instead of asserting each. A hundred converters would make 30 million assertions.
void check_every_texel(const Scene& scene, const Converter& converter) {
  const TestImage in = read_image(scene.specular), width_in = read_image(scene.roughness);
  const TestImage out = read_image(scene.specular_out), width_out = read_image(scene.roughness_out);
  REQUIRE(out.spec.channelnames == in.spec.channelnames);
  int wrong = 0;
  for (int y = 0; y < kPassHeight; ++y) {
    for (int x = 0; x < kPassWidth; ++x) {
      const auto expected =
          converted_texel(converter, width_in.at(x, y, 0), {in.at(x, y, 0), in.at(x, y, 1), in.at(x, y, 2)});
      bool is_right = width_out.at(x, y, 0) == expected[0];
      for (int c = 0; c < 3; ++c)
        is_right = is_right && out.at(x, y, c) == expected[static_cast<std::size_t>(c) + 1];
      for (int c = 3; c < 5; ++c) is_right = is_right && out.at(x, y, c) == in.at(x, y, c);
      if (!is_right && ++wrong <= 3)
        UNSCOPED_INFO("texel (" << x << ", " << y << "): roughness " << width_out.at(x, y, 0) << ", specular "
                                << out.at(x, y, 0) << " " << out.at(x, y, 1) << " " << out.at(x, y, 2)
                                << "; expected " << expected[0] << ", " << expected[1] << " " << expected[2]
                                << " " << expected[3]);
    }
  }
  REQUIRE(wrong == 0);
}

}  // namespace

TEST_CASE("texture pass: equals the converter for each texel, for any threads and bands", "[slow]") {
  const auto converter = make_interpreted_converter(example_fit());
  const int tile = GENERATE(0, 48);
  const Scene scene(tile);
  for (const int threads : {1, 2, 5}) {
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{200'000}, std::size_t{64} << 20}) {
      PassOptions options;
      options.thread_count = threads;
      options.band_bytes = bytes;
      double last = 0.0;
      options.progress = [&](double share) {
        CHECK(share > last);
        last = share;
      };
      const MapStatistics statistics = scene.pass(*converter, options);
      CHECK(statistics.texel_count == kPassWidth * kPassHeight);
      CHECK(last == 1.0);
      check_every_texel(scene, *converter);
    }
  }
}

TEST_CASE("texture pass: compiled converters give the same results in a map as on rows", "[slow]") {
  const Scene scene;
  // the pass only depends on both conventions, so each pair is tested once
  std::set<std::pair<RoughnessEncoding, RoughnessEncoding>> seen;
  for (const auto& converter : shipped_converters()) {
    const ConverterInfo& info = converter->info();
    if (!seen.emplace(info.source.roughness, info.target.roughness).second) continue;
    scene.pass(*converter, {});
    check_every_texel(scene, *converter);
  }
}

TEST_CASE("texture pass: whole materials do not depend on threads and bands", "[slow]") {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, std::vector<std::string> channels, const TexelFunction& texel) {
    write_image(folder.path() / name, test_spec(kPassWidth, kPassHeight, channels, OIIO::TypeFloat), texel);
    return MapName{folder.path() / name, {}};
  };
  // The texels are dark, with undetermined metallic, in stripes between metal and plastic.
  TextureSetRequest request;
  request.parameters[Parameter::kDiffuse].source = write("d.exr", {"R", "G", "B"}, [](int, int y, int c) {
    return y % 60 < 20 ? 0.0f : y % 60 < 40 ? 0.015f : 0.2f + 0.1f * noise(y, 0, c);
  });
  request.parameters[Parameter::kSpecular].source = write("s.exr", {"R", "G", "B"}, [](int x, int y, int c) {
    return y % 60 < 20   ? 0.5f + 0.4f * noise(x, y, c)
           : y % 60 < 40 ? 0.039f + 0.002f * noise(x, y, 0)
                         : 0.04f;
  });
  request.parameters[Parameter::kRoughness].source = write("r.exr", {"Y"}, noise);
  WorkflowStages stages;
  stages.source = *workflow_end("specular");
  stages.target = *workflow_end("metallic");
  const auto converter = make_workflow_converter(stages);
  TargetChoice choice;
  choice.layout = separate();
  choice.parameters = {Parameter::kRoughness, Parameter::kBaseColor, Parameter::kMetallic};
  choice.diagnoses = {ConvertedChannel{Parameter::kMetallicIssues}};
  std::optional<MapStatistics> first;
  for (const int threads : {1, 3})
    for (const std::size_t bytes : {std::size_t{64} << 20, std::size_t{1}}) {
      PassOptions options;
      options.thread_count = threads;
      options.band_bytes = bytes;
      options.metallic_statistics = true;
      choice.folder = choice.diagnosis_folder = folder.path() / (first ? "again" : "first");
      TextureSet set = open_texture_set(request);
      std::vector<TargetMap> targets = open_targets(set, plan_targets(set, choice));
      const MapStatistics statistics = run_texture_pass(set, targets, *converter, options);
      if (!first) {
        first = statistics;
        CHECK(statistics.metallic.undetermined.count > 1000);
        continue;
      }
      for (const char* name : {"base_color.exr", "metallic.exr", "issues.exr"})
        REQUIRE(read_image(folder.path() / "again" / name).bytes ==
                read_image(folder.path() / "first" / name).bytes);
      CHECK(statistics.metallic.residual_squares == first->metallic.residual_squares);
      CHECK(statistics.metallic.undetermined.count == first->metallic.undetermined.count);
      REQUIRE(statistics.metallic.undetermined.first);
      CHECK(statistics.metallic.undetermined.first->x == first->metallic.undetermined.first->x);
      CHECK(statistics.metallic.undetermined.first->y == first->metallic.undetermined.first->y);
    }
}

TEST_CASE("texture pass: odd values are counted by texel") {
  const Scene scene;
  const float inf = std::numeric_limits<float>::infinity();
  write_image(scene.roughness, test_spec(kPassWidth, kPassHeight, {"Y"}, OIIO::TypeFloat),
              [&](int x, int y, int) {
                if (y == 7) return x < 3 ? NAN : x < 5 ? inf : x < 6 ? -inf : 0.5f;
                return 0.5f;
              });
  write_image(scene.specular, test_spec(kPassWidth, kPassHeight, {"R", "G", "B"}, OIIO::TypeFloat),
              [&](int x, int y, int c) {
                if (y == 9 && c > 0 && x < 4) return -1.0f;  // two channels of four texels
                if (y == 7 && c == 0 && x < 4) return NAN;   // three of them also have a NaN roughness
                return 0.25f;
              });
  const auto converter = make_interpreted_converter(example_fit());
  const MapStatistics statistics = scene.pass(*converter, {});
  REQUIRE(statistics.first_bad.has_value());
  CHECK(statistics.first_bad->x == 0);
  CHECK(statistics.first_bad->y == 7);
  CHECK(statistics.nan_count == 4);
  CHECK(statistics.infinite_count == 3);
  CHECK(statistics.negative_count == 5);
  CHECK(statistics.out_of_domain_count == 10);
  CHECK(statistics.clipped_count == 0);
  const TestImage out = read_image(scene.specular_out);
  CHECK(std::isnan(out.at(0, 7, 1)));
  CHECK(std::isfinite(out.at(0, 8, 1)));
}

TEST_CASE("texture pass: a cancelled pass throws and leaves no file") {
  const Scene scene;
  const auto converter = make_interpreted_converter(example_fit());
  const std::atomic<bool> cancelled{true};
  PassOptions options;
  options.thread_count = GENERATE(1, 2);
  options.cancelled = &cancelled;
  CHECK(error_of([&] { scene.pass(*converter, options); }, ErrorKind::kInterrupted) != "");
  CHECK(std::filesystem::is_empty(scene.folder.path() / "out"));
}

TEST_CASE("texture pass: a roughness map that is not grey is refused with the texel") {
  const Scene scene;
  write_image(scene.roughness, test_spec(kPassWidth, kPassHeight, {"R", "G", "B"}, OIIO::TypeFloat),
              [](int x, int y, int c) { return x == 12 && y == 300 && c == 2 ? 0.75f : 0.5f; });
  const auto converter = make_interpreted_converter(example_fit());
  CHECK_THROWS_WITH(scene.pass(*converter, {}),
                    Catch::Matchers::Contains("texel (12, 300) is not grey: G is 0.5 and B is 0.75"));
}

TEST_CASE("texture pass: a grey roughness map stays grey in all its channels") {
  const Scene scene;
  write_image(scene.roughness, test_spec(kPassWidth, kPassHeight, {"R", "G", "B", "A"}, OIIO::TypeFloat),
              [](int x, int y, int c) { return noise(x, y, c == 3 ? 1 : 0); });
  const auto converter = make_interpreted_converter(example_fit());
  scene.pass(*converter, {});
  const TestImage in = read_image(scene.roughness), out = read_image(scene.roughness_out);
  for (int x = 0; x < kPassWidth; ++x) {
    const float expected = converted_texel(*converter, in.at(x, 5, 0), {0.0f, 0.0f, 0.0f})[0];
    for (int c = 0; c < 3; ++c) CHECK(out.at(x, 5, c) == expected);
    CHECK(out.at(x, 5, 3) == in.at(x, 5, 3));
  }
}
