// This file tests renderers with noise, with clamped widths, and with a mirror at narrow widths.
#include <cmath>
#include <cstdint>

#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "compiler/renderer/disguised_renderer.hpp"
#include "measure/picture_taker.hpp"
#include "remap/error.hpp"
#include "renderer/renderer.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

// Returns a number from -1 to 1 that only depends on the arguments.
double random_number(std::uint64_t seed, std::uint64_t pixel) {
  std::uint64_t x = (seed * 0x9E3779B97F4A7C15u) ^ (pixel + 0xD1B54A32D192ED03u);
  for (int i = 0; i < 3; ++i) x = (x ^ (x >> 31)) * 0xBF58476D1CE4E5B9u;
  return static_cast<double>(x >> 11) * 0x1p-52 - 1.0;
}

struct Habits {
  double noise = 0.0;                // relative noise of a pixel, uniform from -noise to noise
  double least = 0.0, most = 1e300;  // widths outside of this range are clamped
  double mirror = 0.0;               // widths up to this value have no highlight
  double paint = 1.0;                // factor of diffuse
  bool dark = false;                 // pictures are black
};

// A StrangeRenderer has the built-in models, and `strange/ggx` of another program, which is mitsuba/ggx-plain
// with faults.
class StrangeRenderer final : public DisguisedRenderer {
 public:
  explicit StrangeRenderer(Habits habits) : habits_(habits) {}

 private:
  ModelDescription disguise() const override {
    ModelDescription model = builtin().model("mitsuba/ggx-plain");
    model.name = "strange/ggx";
    model.is_external = true;
    return model;
  }
  Image render_disguise(const Material& material, const Scene& scene) const override {
    Material inner = material;
    inner.model = "mitsuba/ggx-plain";
    double& alpha = inner.parameters.at("alpha").front();
    if (alpha <= habits_.mirror) inner.parameters.at("specular") = {0.0};
    alpha = std::clamp(alpha, habits_.least, habits_.most);
    inner.parameters.at("diffuse").front() *= habits_.paint;
    Image image = builtin().render(inner, scene);
    const auto seed = static_cast<std::uint64_t>(scene.seed);
    if (habits_.dark) std::fill(image.values.begin(), image.values.end(), 0.0f);
    for (std::size_t i = 0; i < image.values.size(); ++i)
      image.values[i] *= static_cast<float>(1.0 + habits_.noise * random_number(seed, i));
    return image;
  }

  Habits habits_;
};

Table strange_sweep(const Habits& habits, const std::string& source, const std::string& target,
                    std::vector<MappedTexel> samples) {
  return sweep(StrangeRenderer(habits), sweep_options(source, target, "natural", std::move(samples), 96));
}

const std::vector<MappedTexel> kSamples = {{0.15, 0.4}, {0.15, 0.8}, {0.4, 0.4}, {0.4, 0.8}, {0.8, 0.8}};

}  // namespace

TEST_CASE("noise: its level is measured, whatever the description claims") {
  const StrangeRenderer renderer({0.1});
  const SteadyRenderer steady(renderer, {"strange/ggx", "mitsuba/ggx"}, {60.0, 3.0});
  // Noise that is uniform from -0.1 to 0.1 has an RMS of 0.1 / sqrt(3).
  CHECK(steady.noise("strange/ggx").level == Approx(0.1 / std::sqrt(3.0)).epsilon(0.1));
  CHECK(steady.noise("strange/ggx").pictures == Approx(33).margin(6));
  CHECK_FALSE(steady.measured("mitsuba/ggx"));
  const Material material{"strange/ggx", {{"alpha", {0.3}}, {"specular", {1.0}}, {"diffuse", {0.0}}}};
  const Scene scene{48, 1, {60.0, 3.0}};
  const Image mean = steady.render(material, scene), single = renderer.render(material, scene);
  const Image exact = StrangeRenderer({}).render(material, scene);
  double left = 0.0, before = 0.0, power = 0.0;
  for (std::size_t i = 0; i < exact.values.size(); ++i) {
    left += std::pow(mean.values[i] - exact.values[i], 2.0);
    before += std::pow(single.values[i] - exact.values[i], 2.0);
    power += std::pow(exact.values[i], 2.0);
  }
  CHECK(std::sqrt(before / power) > 0.05);
  CHECK(std::sqrt(left / power) < 1.2 * kSteadyNoise);
}

TEST_CASE("noise: pictures without noise are taken once, and the table says so") {
  const Table table = strange_sweep({}, "strange/ggx", "mitsuba/ggx-plain", kSamples);
  CHECK(comment(table, "source_noise") == "0");
  CHECK(comment(table, "source_averaged").empty());
  CHECK(comment(table, "target_noise").empty());
}

TEST_CASE("noise: a noisy source or target is matched by mean pictures", "[slow]") {
  const bool is_source = GENERATE(true, false);
  const std::string noisy = "strange/ggx", plain = "mitsuba/ggx-plain";
  const Table table = strange_sweep({0.1}, is_source ? noisy : plain, is_source ? plain : noisy, kSamples);
  const std::string side = is_source ? "source" : "target";
  CHECK(std::stod(comment(table, side + "_noise")) == Approx(0.058).epsilon(0.15));
  CHECK_THAT(comment(table, side + "_averaged"), Contains("pictures each"));
  for (const TableRow& row : table.rows) {
    CHECK(row.status == RowStatus::kOk);
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(0.01));
    CHECK(row.specular2 == Approx(row.specular1).epsilon(0.01));
  }
}

TEST_CASE("noise: more than means can remove is refused with the reason") {
  CHECK_THROWS_WITH(
      strange_sweep({0.9}, "strange/ggx", "mitsuba/ggx-plain", kSamples),
      Contains("strange/ggx: pictures of two seeds differ by 5") && Contains("the limit is 64"));
}

TEST_CASE("widths: clamped widths are found, and their rows marked") {
  const std::vector<MappedTexel> samples = {{0.05, 0.5}, {0.1, 0.5}, {0.2, 0.5}, {0.5, 0.5}, {0.9, 0.5}};
  const Table table = strange_sweep({0.0, 0.13, 0.7}, "strange/ggx", "mitsuba/ggx-plain", samples);
  CHECK_THAT(comment(table, "source_effective_alpha"), Contains("0.13") && Contains(" to 0.69"));
  for (const TableRow& row : table.rows) {
    const bool clamped = row.alpha1 < 0.13 || row.alpha1 > 0.7;
    CHECK(row.status == (clamped ? RowStatus::kClamped : RowStatus::kOk));
    CHECK(row.alpha2 == Approx(std::clamp(row.alpha1, 0.13, 0.7)).epsilon(1e-5));
  }
}

TEST_CASE("widths: a target is not searched where its width is clamped or a mirror") {
  const std::vector<MappedTexel> samples = {{0.05, 0.5}, {0.2, 0.5}, {0.5, 0.5}};
  for (const Habits& habits : {Habits{0.0, 0.13}, Habits{0.0, 0.0, 1e300, 0.13}}) {
    const Table table = strange_sweep(habits, "mitsuba/ggx-plain", "strange/ggx", samples);
    CHECK_THAT(comment(table, "target_effective_alpha"), Contains("0.13") && Contains(" to 1"));
    CHECK(table.rows[0].status == RowStatus::kClamped);
    CHECK(table.rows[0].alpha2 == Approx(0.13).epsilon(5e-3));
    CHECK(table.rows[1].status == RowStatus::kOk);
    CHECK(table.rows[1].alpha2 == Approx(0.2).epsilon(1e-5));
  }
}

TEST_CASE("widths: a mirror as the source is flat") {
  const std::vector<MappedTexel> samples = {{0.05, 0.5}, {0.2, 0.5}, {0.5, 0.5}};
  const Table table = strange_sweep({0.0, 0.0, 1e300, 0.13}, "strange/ggx", "mitsuba/ggx-plain", samples);
  CHECK_THAT(comment(table, "source_effective_alpha"), Contains("0.13") && Contains(" to 0.5"));
  CHECK(table.rows[0].status == RowStatus::kFlat);
  CHECK(table.rows[1].status == RowStatus::kOk);
}

TEST_CASE("sweep: a black target is refused") {
  CHECK_THROWS_WITH(
      strange_sweep({0.0, 0.0, 1e300, 0.0, 1.0, true}, "mitsuba/ggx-plain", "strange/ggx", kSamples),
      Contains("strange/ggx: no width"));
  // This diffuse parameter has no effect.
  Habits black_paint;
  black_paint.paint = 0.0;
  CHECK_THROWS_WITH(strange_sweep(black_paint, "mitsuba/ggx-plain", "strange/ggx", kSamples),
                    Contains("a diffuse picture is black"));
}

TEST_CASE("widths: a model whose width has no effect is refused") {
  const std::vector<MappedTexel> samples = {{0.05, 0.5}, {0.2, 0.5}, {0.5, 0.5}};
  CHECK_THROWS_WITH(strange_sweep({0.0, 0.3, 0.3}, "strange/ggx", "mitsuba/ggx-plain", samples),
                    Contains("strange/ggx: no width from alpha 0.05 to 0.5 changes its picture"));
}
