#include "look/lit_sphere.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "look/image.hpp"
#include "look/scene.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

using std::numbers::pi;

Vector3 operator*(double factor, const Vector3& a) { return {factor * a.x, factor * a.y, factor * a.z}; }
Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector3 normalised(const Vector3& a) { return (1.0 / std::sqrt(dot(a, a))) * a; }

// A Frame is a normal with two tangents.
struct Frame {
  Vector3 tangent, bitangent, normal;
  Vector3 to_world(double x, double y, double z) const { return x * tangent + (y * bitangent + z * normal); }
};

// Returns a frame whose tangent leads along the rows of maps, to the right. Lobes need no certain frame,
// because they are isotropic.
Frame frame_about(const Vector3& n) {
  const bool is_pole = n.x == 0.0 && n.z == 0.0;
  const Vector3 tangent = is_pole ? Vector3{1.0, 0.0, 0.0} : normalised({n.z, 0.0, -n.x});
  return {tangent,
          {n.y * tangent.z - n.z * tangent.y, n.z * tangent.x - n.x * tangent.z,
           n.x * tangent.y - n.y * tangent.x},
          n};
}

// Returns the direction from a point to the camera.
Vector3 view_from(const Vector3& point) {
  return normalised({-point.x, -point.y, kCameraDistance - point.z});
}

// Returns a pseudo-random number in [0, 1) for a key (finalizer of splitmix64, Steele et al. 2014).
double hashed(std::uint64_t key) {
  key += 0x9e3779b97f4a7c15u;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((key ^ (key >> 31)) >> 11) * 0x1p-53;
}

double radical_inverse(std::uint32_t i) {
  i = (i << 16) | (i >> 16);
  i = ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
  i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
  i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
  i = ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
  return i * 0x1p-32;
}

enum Technique { kNarrowLobe, kWideLobe, kHemisphere, kTechniqueCount };
constexpr std::array<double, kTechniqueCount> kTechniqueShare = {0.4, 0.4, 0.2};
constexpr std::size_t kHalves = 2;

// A Mixture is the distribution from which directions are drawn at every pixel.
struct Mixture {
  std::array<double, 2> alphas{};                       // alphas of the GGX lobes
  std::array<std::uint32_t, kTechniqueCount> counts{};  // number of samples of each technique in one half

  // Returns the expected density of samples of one half at a direction, per steradian.
  double density(const LocalGeometry& g) const {
    double sum = counts[kHemisphere] / (2.0 * pi);
    for (std::size_t lobe = 0; lobe < alphas.size(); ++lobe)
      sum += counts[lobe] * microfacet_distribution(Brdf::kGgx, alphas[lobe], g.cos_half) *
             smith_shadowing(Brdf::kGgx, alphas[lobe], g.cos_view) / (4.0 * g.cos_view);
    return sum;
  }
};

// Returns the mixture for the least and the largest alpha of `materials`.
Mixture mixture_for(const auto& materials, int samples) {
  Mixture mixture;
  mixture.alphas = {materials.front().alpha, materials.front().alpha};
  for (const auto& material : materials) {
    mixture.alphas[0] = std::min(mixture.alphas[0], material.alpha);
    mixture.alphas[1] = std::max(mixture.alphas[1], material.alpha);
  }
  for (std::size_t t = 0; t < kTechniqueCount; ++t)
    mixture.counts[t] =
        std::max(1u, static_cast<std::uint32_t>(std::lround(kTechniqueShare[t] * samples / kHalves)));
  return mixture;
}

// Computes the geometry of a light direction for evaluate_lobe. Returns false if light or view is below the
// horizon.
bool is_lit(const Vector3& normal, const Vector3& view, const Vector3& light, LocalGeometry* g) {
  const double cos_light = dot(normal, light), cos_view = dot(normal, view), cos_between = dot(light, view);
  if (cos_light <= 0.0 || cos_view <= 0.0 || 2.0 + 2.0 * cos_between <= 0.0) return false;
  *g = local_geometry(cos_light, cos_view, cos_between);
  return true;
}

// A PixelSampler draws the directions of one pixel.
class PixelSampler {
 public:
  PixelSampler(const Mixture& mixture, const Vector3& normal, const Vector3& view, std::uint64_t key)
      : mixture_(mixture), frame_(frame_about(normal)), view_(view), key_(key) {}

  const Mixture& mixture() const { return mixture_; }
  const Vector3& normal() const { return frame_.normal; }
  const Vector3& view() const { return view_; }

  // Returns sample `i` of a technique. It is from a Hammersley point set with a random shift for each pixel,
  // technique and half (Cranley and Patterson 1976).
  Vector3 direction(Technique technique, std::size_t half, std::uint32_t i) const {
    const std::uint64_t key = 2 * ((key_ * kTechniqueCount + technique) * kHalves + half);
    double u = (i + 0.5) / mixture_.counts[technique] + hashed(key);
    double v = radical_inverse(i) + hashed(key + 1);
    u -= std::floor(u), v -= std::floor(v);
    const double azimuth = 2.0 * pi * v;
    if (technique == kHemisphere) {
      const double sine = std::sqrt(1.0 - u * u);
      return frame_.to_world(sine * std::cos(azimuth), sine * std::sin(azimuth), u);
    }
    const Vector3 half_vector = visible_normal(mixture_.alphas[technique], u, azimuth);
    return 2.0 * dot(view_, half_vector) * half_vector + (-1.0) * view_;
  }

 private:
  // Returns a visible normal of GGX. It is drawn from a stretched spherical cap (Dupuy and Benyoub 2023).
  Vector3 visible_normal(double alpha, double u, double azimuth) const {
    const Vector3 stretched = normalised({alpha * dot(view_, frame_.tangent),
                                          alpha * dot(view_, frame_.bitangent), dot(view_, frame_.normal)});
    const double z = (1.0 - u) * (1.0 + stretched.z) - stretched.z;
    const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
    const Vector3 h = normalised({alpha * (sine * std::cos(azimuth) + stretched.x),
                                  alpha * (sine * std::sin(azimuth) + stretched.y), z + stretched.z});
    return frame_.to_world(h.x, h.y, h.z);
  }

  const Mixture& mixture_;
  Frame frame_;
  Vector3 view_;
  std::uint64_t key_;
};

// Calls visit(half, light, geometry, solid_angle) for each lit direction of a pixel. `solid_angle` is the
// share of directions that one sample of this half represents.
void for_each_sample(const PixelSampler& sampler, const auto& visit) {
  const Mixture& mixture = sampler.mixture();
  for (std::size_t half = 0; half < kHalves; ++half)
    for (const Technique technique : {kNarrowLobe, kWideLobe, kHemisphere})
      for (std::uint32_t i = 0; i < mixture.counts[technique]; ++i) {
        const Vector3 light = sampler.direction(technique, half, i);
        LocalGeometry geometry;
        if (!is_lit(sampler.normal(), sampler.view(), light, &geometry)) continue;
        visit(half, light, geometry, 1.0 / mixture.density(geometry));
      }
}

// Returns the radiance towards the camera for light of radiance 1 from a solid angle of 1 steradian.
double reflected(const SphereMaterial& material, const LocalGeometry& geometry) {
  const Lobe lobe = evaluate_lobe(material.model.brdf, material.model.fresnel, material.alpha, geometry);
  return (lobe.base + material.specular * lobe.slope + material.diffuse / pi) * geometry.cos_light;
}

void require(const SphereSampling& sampling) {
  if (sampling.resolution < 4 || sampling.resolution > 1024)
    throw usage_error("resolution: " + std::to_string(sampling.resolution) + " is out of range (4 to 1024)");
  if (sampling.samples < 16 || sampling.samples > 1 << 20)
    throw usage_error("samples: " + std::to_string(sampling.samples) + " is out of range (16 to " +
                      std::to_string(1 << 20) + ")");
}

// Calls take(index, share) for the texels of a map that are closest to a point of the ball.
void for_closest_texels(int width, int height, const Vector3& point, const auto& take) {
  const double u = 0.5 + std::atan2(point.x, point.z) / pi,
               v = std::acos(std::clamp(point.y, -1.0, 1.0)) / pi;
  const double x = std::clamp(u * width - 0.5, 0.0, width - 1.0),
               y = std::clamp(v * height - 0.5, 0.0, height - 1.0);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  for (int corner = 0; corner < 4; ++corner) {
    const int column = left + corner % 2, row = top + corner / 2;
    const double share = (1.0 - std::abs(x - column)) * (1.0 - std::abs(y - row));
    // Weights of 0 may be beyond the last column or row.
    if (share > 0.0) take(static_cast<std::size_t>(row * width + column), share);
  }
}

// Returns the texel that the camera sees at a point of the ball, interpolated between the closest four.
BallTexel texel_at(const TexturedBall& ball, const Vector3& point) {
  BallTexel mean;
  for_closest_texels(ball.width, ball.height, point, [&](std::size_t index, double share) {
    const BallTexel& texel = ball.texels[index];
    mean.alpha += share * texel.alpha;
    for (std::size_t c = 0; c < 3; ++c) {
      mean.specular[c] += share * texel.specular[c];
      mean.diffuse[c] += share * texel.diffuse[c];
    }
  });
  return mean;
}

// Returns the normal at a point of the ball. A normal that the camera would see from behind is turned until
// it faces the camera. web/viewer/shading.glsl does the same.
Vector3 bent_normal(const Image& normals, const Vector3& point, const Vector3& view) {
  constexpr double kLeastCosine = 0.05;  // between the normal and the surface, or the camera
  if (normals.values.empty()) return point;
  std::array<double, 3> bent{};
  for_closest_texels(normals.width, normals.height, point, [&](std::size_t index, double share) {
    for (std::size_t c = 0; c < 3; ++c) bent[c] += share * static_cast<double>(normals.values[3 * index + c]);
  });
  const Vector3 normal =
      normalised(frame_about(point).to_world(bent[0], bent[1], std::max(bent[2], kLeastCosine)));
  const double missing = kLeastCosine - dot(normal, view);
  return missing > 0.0 ? normalised(normal + missing * view) : normal;
}

void add_lamps(const RadiancePyramid& environments, std::span<const SphereMaterial> materials,
               const PixelSampler& sampler, std::size_t pixel, SpherePictures* pictures) {
  for (std::size_t e = 0; 3 * e < environments.channel_count(); ++e)
    for (const Lamp& lamp : environments.lamps(e)) {
      LocalGeometry geometry;
      if (!is_lit(sampler.normal(), sampler.view(), lamp.direction, &geometry)) continue;
      for (std::size_t m = 0; m < materials.size(); ++m) {
        const double factor = reflected(materials[m], geometry);
        for (std::size_t half = 0; half < kHalves; ++half)
          for (std::size_t c = 0; c < 3; ++c)
            pictures->values(m, half, pixel)[3 * e + c] += static_cast<float>(factor * lamp.flux[c]);
      }
    }
}

void add_samples(const RadiancePyramid& environments, std::span<const SphereMaterial> materials,
                 const PixelSampler& sampler, std::size_t pixel, SpherePictures* pictures) {
  std::vector<float> radiance(environments.channel_count());
  for_each_sample(sampler, [&](std::size_t half, const Vector3& light, const LocalGeometry& geometry,
                               double solid_angle) {
    environments.look_up(light, solid_angle / kHalves, radiance.data());
    for (std::size_t m = 0; m < materials.size(); ++m) {
      const auto factor = static_cast<float>(reflected(materials[m], geometry) * solid_angle);
      float* values = pictures->values(m, half, pixel);
      for (std::size_t c = 0; c < radiance.size(); ++c) values[c] += factor * radiance[c];
    }
  });
}

}  // namespace

SpherePictures::SpherePictures(std::size_t material_count, std::size_t channel_count, int resolution)
    : material_count_(material_count), channel_count_(channel_count), resolution_(resolution) {
  const std::vector<float> cosines = view_cosines(resolution, 1);
  for (std::size_t i = 0; i < cosines.size(); ++i)
    if (cosines[i] > 0.0f) pixels_.push_back(static_cast<std::uint32_t>(i));
  values_.resize(material_count * kHalves * pixels_.size() * channel_count_);
}

// Returns the offset of a pixel. Pixels are the outermost dimension, because a thread works on one pixel at a
// time.
std::size_t SpherePictures::offset(std::size_t material, std::size_t half, std::size_t pixel) const {
  return ((pixel * kHalves + half) * material_count_ + material) * channel_count_;
}

float* SpherePictures::values(std::size_t material, std::size_t half, std::size_t pixel) {
  return &values_[offset(material, half, pixel)];
}

std::vector<float> SpherePictures::half_radiance(std::size_t material, std::size_t environment,
                                                 std::size_t half) const {
  std::vector<float> picture;
  picture.reserve(3 * pixels_.size());
  for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel)
    for (std::size_t c = 0; c < 3; ++c)
      picture.push_back(values_[offset(material, half, pixel) + 3 * environment + c]);
  return picture;
}

std::vector<float> SpherePictures::radiance(std::size_t material, std::size_t environment) const {
  std::vector<float> picture = half_radiance(material, environment, 0);
  const std::vector<float> other = half_radiance(material, environment, 1);
  for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = 0.5f * (picture[i] + other[i]);
  return picture;
}

SpherePictures render_spheres(const RadiancePyramid& environments, std::span<const SphereMaterial> materials,
                              const SphereSampling& sampling) {
  require(sampling);
  if (materials.empty()) throw usage_error("spheres: at least one material is required");

  SpherePictures pictures(materials.size(), environments.channel_count(), sampling.resolution);
  const Mixture mixture = mixture_for(materials, sampling.samples);
  const std::vector<std::uint32_t>& pixels = pictures.pixels();
  const auto side = static_cast<std::uint32_t>(sampling.resolution);
  run_parallel(side, sampling.jobs, [&](std::size_t row) {
    if (sampling.cancelled != nullptr && *sampling.cancelled)
      throw Error(ErrorKind::kInterrupted, "study: interrupted; nothing was written");
    const auto begin = std::lower_bound(pixels.begin(), pixels.end(), row * side);
    const auto end = std::lower_bound(pixels.begin(), pixels.end(), (row + 1) * side);
    for (auto pixel = begin; pixel != end; ++pixel) {
      Vector3 point;
      sphere_point(sampling.resolution, *pixel % side + 0.5, static_cast<double>(row) + 0.5, &point);
      const PixelSampler sampler(mixture, point, view_from(point), sampling.shares_directions ? 0 : *pixel);
      const auto place = static_cast<std::size_t>(pixel - pixels.begin());
      add_lamps(environments, materials, sampler, place, &pictures);
      add_samples(environments, materials, sampler, place, &pictures);
    }
    if (sampling.progress) sampling.progress();
  });
  return pictures;
}

namespace {

// A BallPixel is one pixel, with the materials of all balls at this pixel.
struct BallPixel {
  const PixelSampler& sampler;
  std::span<const TexturedBall> balls;
  std::vector<BallTexel> texels;
  std::vector<Rgb> radiance;

  // Adds light of this radiance from `solid_angle` steradians.
  void add(const auto& light_radiance, double solid_angle, const LocalGeometry& geometry) {
    for (std::size_t b = 0; b < balls.size(); ++b) {
      const BallTexel& texel = texels[b];
      const Lobe lobe = evaluate_lobe(balls[b].model.brdf, balls[b].model.fresnel, texel.alpha, geometry);
      for (std::size_t c = 0; c < 3; ++c)
        radiance[b][c] += solid_angle * static_cast<double>(light_radiance[c]) * geometry.cos_light *
                          (lobe.base + texel.specular[c] * lobe.slope + texel.diffuse[c] / pi);
    }
  }
};

void add_light(const RadiancePyramid& environment, BallPixel& pixel) {
  LocalGeometry geometry;
  for (const Lamp& lamp : environment.lamps(0))
    if (is_lit(pixel.sampler.normal(), pixel.sampler.view(), lamp.direction, &geometry))
      pixel.add(lamp.flux, 1.0, geometry);
  std::array<float, 3> radiance{};
  for_each_sample(pixel.sampler,
                  [&](std::size_t, const Vector3& light, const LocalGeometry& sample, double solid_angle) {
                    environment.look_up(light, solid_angle / kHalves, radiance.data());
                    pixel.add(radiance, solid_angle / kHalves, sample);
                  });
}

}  // namespace

std::vector<std::vector<float>> render_textured(const RadiancePyramid& environment,
                                                std::span<const TexturedBall> balls, const Image& normals,
                                                const SphereSampling& sampling) {
  require(sampling);
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, sampling.resolution);
  std::vector<std::vector<float>> pictures(balls.size(), std::vector<float>(3 * pixels.size()));
  const auto side = static_cast<std::uint32_t>(sampling.resolution);
  run_parallel(side, sampling.jobs, [&](std::size_t row) {
    const auto begin = std::lower_bound(pixels.begin(), pixels.end(), row * side);
    const auto end = std::lower_bound(pixels.begin(), pixels.end(), (row + 1) * side);
    for (auto place = begin; place != end; ++place) {
      Vector3 point;
      sphere_point(sampling.resolution, *place % side + 0.5, static_cast<double>(row) + 0.5, &point);
      std::vector<BallTexel> texels;
      for (const TexturedBall& ball : balls) texels.push_back(texel_at(ball, point));
      const Mixture mixture = mixture_for(texels, sampling.samples);
      const Vector3 view = view_from(point);
      const PixelSampler sampler(mixture, bent_normal(normals, point, view), view,
                                 sampling.shares_directions ? 0 : *place);
      BallPixel pixel{sampler, balls, texels, std::vector<Rgb>(balls.size())};
      add_light(environment, pixel);
      for (std::size_t b = 0; b < balls.size(); ++b)
        for (std::size_t c = 0; c < 3; ++c)
          pictures[b][3 * static_cast<std::size_t>(place - pixels.begin()) + c] =
              static_cast<float>(pixel.radiance[b][c]);
    }
    if (sampling.progress) sampling.progress();
  });
  return pictures;
}

std::vector<float> display_values(std::span<const float> radiance) {
  std::vector<float> values;
  values.reserve(radiance.size());
  for (const float value : radiance) values.push_back(display_value(static_cast<double>(value)));
  return values;
}

DisplayedSphere displayed_colors(std::vector<float> colors, std::span<const std::uint32_t> pixels,
                                 int resolution) {
  const auto side = static_cast<std::size_t>(resolution);
  DisplayedSphere sphere{std::move(colors), std::vector<float>(side * side, 0.0f)};
  for (std::size_t i = 0; i < pixels.size(); ++i)
    sphere.luma[pixels[i]] = static_cast<float>(luminance(&sphere.colors[3 * i]));
  return sphere;
}

DisplayedSphere displayed_sphere(std::span<const float> radiance, std::span<const std::uint32_t> pixels,
                                 int resolution) {
  return displayed_colors(display_values(radiance), pixels, resolution);
}

double sphere_similarity(const DisplayedSphere& a, const DisplayedSphere& b,
                         std::span<const std::uint32_t> pixels, int resolution) {
  const std::vector<float> map = similarity_map(a.luma, b.luma, resolution, resolution);
  double sum = 0.0;
  for (const std::uint32_t pixel : pixels) sum += static_cast<double>(map[pixel]);
  return sum / static_cast<double>(pixels.size());
}

}  // namespace remap
