#include "lights/pair_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "lights/display_curve.hpp"
#include "look/brdf.hpp"
#include "look/environment.hpp"
#include "look/lit_sphere.hpp"
#include "renderer/renderer.hpp"

namespace remap {
namespace {

constexpr int kResolution = 32, kSamples = 256, kMapHeight = 64;
constexpr std::size_t kWidthCount = 40;
constexpr Range kWidths{0.01, 1.0};
constexpr double kLeastWidth = 0.05;  // narrower highlights are smaller than a pixel
constexpr std::array kChoosingSpeculars = {0.04, 0.2, 0.6, 1.0}, kJudgingSpeculars = {0.1, 0.3, 0.5, 0.9};
// This is the weight of one per cent of error under point lights. One per cent under environments has the
// weight 1. With 0.5, forms are at least as good as regressions of the rows under both kinds of lights
// (docs/decisions/079-one-form.md).
constexpr double kPointWeight = 0.5;
constexpr double kPointDistance = 3.0;
constexpr int kPointSamples = 8;  // along each side of a pixel, because highlights are narrower than pixels
constexpr double kWidthStep = 0.04;  // relative step of difference quotients

// Turns an environment about the vertical axis, by this fraction of a circle.
Environment turned(const Environment& environment, double share) {
  Environment result = environment;
  const Image& map = environment.map;
  const auto width = static_cast<std::size_t>(map.width), channels = static_cast<std::size_t>(map.channels);
  const auto shift = static_cast<std::size_t>(share * static_cast<double>(width));
  for (std::size_t y = 0; y < static_cast<std::size_t>(map.height); ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < channels; ++c)
        result.map.values[(y * width + (x + shift) % width) * channels + c] =
            map.values[(y * width + x) * channels + c];
  return result;
}

using Picture = std::vector<float>;  // linear RGB of the pixels that show the sphere

const Renderer& builtin_renderer() {
  static const std::unique_ptr<Renderer> renderer = make_builtin_renderer();
  return *renderer;
}

// Returns widths with equal ratios, within the range of the model.
std::vector<double> widths_of(const std::string& model) {
  const Range range = builtin_renderer().model(model).alpha;
  const double low = std::max(kWidths.min, range.min), high = std::min(kWidths.max, range.max);
  std::vector<double> values;
  for (std::size_t i = 0; i < kWidthCount; ++i)
    values.push_back(std::min(
        high, low * std::pow(high / low, static_cast<double>(i) / static_cast<double>(kWidthCount - 1))));
  return values;
}

}  // namespace

// A LobePictures holds pictures of the lobe of one model. A picture is linear in specular, and smooth in
// alpha. So these pictures give the picture of every material with this lobe.
struct LobePictures {
  std::vector<double> alphas;  // ascending
  // The indices are [alpha][light]. `dark` is the picture at specular 0, and `slope` what specular 1 adds.
  std::vector<std::vector<Picture>> dark, slope;

  // Alpha is clamped to `alphas`, and interpolated between them by its logarithm.
  Picture at(std::size_t light, const MappedTexel& texel) const {
    Picture picture(dark[0][light].size(), 0.0f);
    const double clamped = std::clamp(texel.alpha, alphas.front(), alphas.back());
    const auto above = std::ranges::upper_bound(alphas, clamped);
    const auto high = static_cast<std::size_t>(std::min(above, alphas.end() - 1) - alphas.begin());
    const std::size_t low = high == 0 ? 0 : high - 1;
    const double share =
        high == low ? 0.0 : std::log(clamped / alphas[low]) / std::log(alphas[high] / alphas[low]);
    for (const auto& [index, weight] : {std::pair(low, 1.0 - share), std::pair(high, share)}) {
      if (weight == 0.0) continue;
      const Picture &own_dark = dark[index][light], &own_slope = slope[index][light];
      const auto by_slope = static_cast<float>(weight * texel.specular), by_dark = static_cast<float>(weight);
      for (std::size_t i = 0; i < picture.size(); ++i)
        picture[i] += by_dark * own_dark[i] + by_slope * own_slope[i];
    }
    return picture;
  }
};

namespace {

// A Half is half of the lights: environments, and after these point lights. It keeps the pictures of all
// models that were requested. Under a point light, a white diffuse sphere has radiance 1 at its closest
// point, if this faces the light. Angles are in degrees from the camera.
class Half {
 public:
  Half(std::vector<Environment> environments, std::vector<double> angles, unsigned jobs)
      : environments_(std::move(environments)), angles_(std::move(angles)), jobs_(jobs) {}

  std::size_t environment_count() const { return environments_.size(); }
  std::size_t count() const { return environments_.size() + angles_.size(); }
  const LobePictures& of(const std::string& model) {
    const std::lock_guard lock(mutex_);
    if (const auto found = pictures_.find(model); found != pictures_.end()) return found->second;
    return pictures_.emplace(model, pictures_of(model)).first->second;
  }

 private:
  LobePictures pictures_of(const std::string& model) const {
    LobePictures result{widths_of(model), {}, {}};
    const RadiancePyramid pyramid(environments_);
    const BrdfModel brdf = builtin_brdf(model);
    const auto difference = [](Picture a, const Picture& b) {
      for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
      return a;
    };
    for (const double alpha : result.alphas) {
      const std::array materials = {SphereMaterial{brdf, alpha, 0.0, 0.0},
                                    SphereMaterial{brdf, alpha, 1.0, 0.0}};
      const SpherePictures pictures =
          render_spheres(pyramid, materials, {kResolution, kSamples, jobs_, {}, nullptr});
      std::vector<Picture>&dark = result.dark.emplace_back(), &slope = result.slope.emplace_back();
      for (std::size_t light = 0; light < environments_.size(); ++light) {
        dark.push_back(pictures.radiance(0, light));
        slope.push_back(difference(pictures.radiance(1, light), dark.back()));
      }
      for (const double angle : angles_) {
        dark.push_back(point_lit(angle, model, alpha, 0.0, pictures.pixels()));
        slope.push_back(difference(point_lit(angle, model, alpha, 1.0, pictures.pixels()), dark.back()));
      }
    }
    return result;
  }

  static Picture point_lit(double angle, const std::string& model, double alpha, double specular,
                           const std::vector<std::uint32_t>& pixels) {
    Scene scene;
    scene.resolution = kResolution;
    scene.light = {angle, kPointDistance};
    scene.samples_per_axis = kPointSamples;
    const double nearest = kPointDistance - 1.0, exposure = std::numbers::pi * nearest * nearest;
    const Renderer& renderer = builtin_renderer();
    const Image image = renderer.render(grey_material(renderer.model(model), alpha, specular, 0.0), scene);
    Picture values;
    values.reserve(3 * pixels.size());
    for (const std::uint32_t pixel : pixels)
      values.insert(
          values.end(), 3,
          static_cast<float>(exposure * static_cast<double>(
                                            image.values[pixel * static_cast<std::size_t>(image.channels)])));
    return values;
  }

  std::vector<Environment> environments_;
  std::vector<double> angles_;
  unsigned jobs_;
  std::mutex mutex_;
  std::map<std::string, LobePictures> pictures_;
};

Environment sky() { return builtin_environments(kMapHeight)[0]; }
Environment overcast() { return builtin_environments(kMapHeight)[1]; }
Environment studio() { return builtin_environments(kMapHeight)[2]; }

Half& choosing_half(unsigned jobs) {
  static Half half({sky(), studio()}, {35.0, 65.0}, jobs);
  return half;
}

Half& judging_half(unsigned jobs) {
  static Half half({overcast(), turned(sky(), 0.4), turned(studio(), 0.3)}, {60.0}, jobs);
  return half;
}

// Makes the materials of one half. They have every other width, and the speculars of this half.
template <typename Speculars>
std::vector<MappedTexel> materials(const std::string& source, const Domain& domain, bool is_choosing,
                                   const Speculars& speculars) {
  std::vector<MappedTexel> all;
  const std::vector<double> widths = widths_of(source);
  for (std::size_t i = is_choosing ? 0 : 1; i < widths.size(); i += 2)
    for (const double specular : speculars)
      if (widths[i] >= kLeastWidth && domain.alpha.contains(widths[i]))
        all.push_back({widths[i], specular * domain.specular.max});
  return all;
}

}  // namespace

// A Judge compares pictures of target texels with those of the source, under one half of the lights.
class PairPictures::Judge {
 public:
  // A MaterialPictures shows a material of the source under each light. Pictures have display values under
  // environments, and linear values under point lights.
  struct MaterialPictures {
    MappedTexel source;
    std::vector<Picture> pictures;
    std::vector<double> power;  // sums of squares of the linear values
  };

  Judge(Half& half, const std::string& source_model, const std::string& target_model,
        const std::vector<MappedTexel>& materials)
      : environments_(half.environment_count()), lights_(half.count()), target_(half.of(target_model)) {
    const LobePictures& source = half.of(source_model);
    for (const MappedTexel& material : materials) {
      MaterialPictures& shown = shown_.emplace_back();
      shown.source = material;
      for (std::size_t light = 0; light < lights_; ++light) {
        Picture picture = source.at(light, material);
        double power = 0.0;
        for (const float value : picture) power += static_cast<double>(value) * static_cast<double>(value);
        shown.power.push_back(power);
        if (light < environments_) picture = display_values(picture);
        shown.pictures.push_back(std::move(picture));
      }
    }
  }

  const std::vector<MaterialPictures>& shown() const { return shown_; }

  // Returns the error under a light, in percent or relative. If `sum` is not null, adds the slopes to it.
  double error_under(std::size_t light, const MaterialPictures& shown, const MappedTexel& texel, double unit,
                     TexelError* sum) const {
    const bool is_environment = light < environments_;
    const Picture here = target_.at(light, texel);
    Picture wide, narrow, brighter;
    const double step = kWidthStep * texel.alpha, more = 0.05;
    if (sum != nullptr) {
      wide = target_.at(light, {texel.alpha + step, texel.specular});
      narrow = target_.at(light, {texel.alpha - step, texel.specular});
      brighter = target_.at(light, {texel.alpha, texel.specular + more});
    }
    const DisplayCurve& curve = display_curve();
    double square = 0.0, by_alpha = 0.0, by_specular = 0.0, alpha_2 = 0.0, both = 0.0, specular_2 = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      const auto [value, slope] = is_environment ? curve(here[i]) : std::pair(here[i], 1.0f);
      const auto off = static_cast<double>(value - shown.pictures[light][i]);
      square += off * off;
      if (sum == nullptr) continue;
      const double a = static_cast<double>(slope) * static_cast<double>(wide[i] - narrow[i]) / (2.0 * step);
      const double s = static_cast<double>(slope) * static_cast<double>(brighter[i] - here[i]) / more;
      by_alpha += off * a;
      by_specular += off * s;
      alpha_2 += a * a;
      both += a * s;
      specular_2 += s * s;
    }
    // The error is the square root of a mean of squares. So its derivative is the derivative of the mean,
    // divided by twice the error.
    const double count =
        is_environment ? static_cast<double>(here.size()) / 1e4 : std::max(shown.power[light], 1e-12);
    const double error = std::sqrt(square / count);
    if (sum == nullptr) return error;
    const double scale = unit / (count * std::max(error, 1e-6));
    sum->value += unit * error;
    sum->by_alpha += scale * by_alpha;
    sum->by_specular += scale * by_specular;
    sum->by_alpha_2 += scale * alpha_2;
    sum->by_both += scale * both;
    sum->by_specular_2 += scale * specular_2;
    return error;
  }

  // Returns mean errors over the materials, for each kind of light.
  PictureErrors mean_errors(const TexelMap& map) const {
    PictureErrors errors;
    for (const MaterialPictures& shown : shown_) {
      const MappedTexel target = map(shown.source.alpha, shown.source.specular);
      for (std::size_t light = 0; light < lights(); ++light)
        (light < environments() ? errors.rmse : errors.relative) +=
            error_under(light, shown, target, 0.0, nullptr);
    }
    const auto count = static_cast<double>(shown_.size());
    errors.rmse /= count * static_cast<double>(environments());
    errors.relative /= count * static_cast<double>(lights() - environments());
    return errors;
  }

  std::size_t environments() const { return environments_; }
  std::size_t lights() const { return lights_; }

 private:
  std::size_t environments_, lights_;
  const LobePictures& target_;
  std::vector<MaterialPictures> shown_;
};

PairPictures::PairPictures(const std::string& source, const std::string& target, const Domain& domain,
                           unsigned jobs)
    : choosing_(std::make_unique<Judge>(choosing_half(jobs), source, target,
                                        materials(source, domain, true, kChoosingSpeculars))),
      judging_(std::make_unique<Judge>(judging_half(jobs), source, target,
                                       materials(source, domain, false, kJudgingSpeculars))) {
  for (const Judge::MaterialPictures& shown : choosing_->shown()) sources_.push_back(shown.source);
}

PairPictures::~PairPictures() = default;

TexelErrors PairPictures::choosing_errors(const PictureErrors& unit_errors) const {
  return [&judge = *choosing_, unit_errors](const std::vector<MappedTexel>& targets) {
    std::vector<TexelError> errors(targets.size());
    const auto environments = static_cast<double>(judge.environments());
    const double points = static_cast<double>(judge.lights()) - environments;
    for (std::size_t m = 0; m < targets.size(); ++m)
      for (std::size_t light = 0; light < judge.lights(); ++light) {
        const double unit = light < judge.environments() ? 1.0 / (unit_errors.rmse * environments)
                                                         : kPointWeight / (unit_errors.relative * points);
        judge.error_under(light, judge.shown()[m], targets[m], unit, &errors[m]);
      }
    return errors;
  };
}

PictureErrors PairPictures::chosen(const TexelMap& map) const { return choosing_->mean_errors(map); }
PictureErrors PairPictures::judged(const TexelMap& map) const { return judging_->mean_errors(map); }

std::unique_ptr<PairPictures> pair_pictures(const std::string& source, const std::string& target,
                                            const Domain& domain, unsigned jobs) {
  if (!is_linear_lobe(source) || !is_linear_lobe(target)) return nullptr;
  return std::make_unique<PairPictures>(source, target, domain, jobs);
}

}  // namespace remap
