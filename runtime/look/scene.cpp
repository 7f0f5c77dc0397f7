#include "look/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/number_text.hpp"

namespace remap {
namespace {

// Sphere tracing stops with a hit at this distance from the surface, and with a miss after this many steps.
// Rays that graze the torus need the most steps.
constexpr double kHitDistance = 1e-10;
constexpr int kMostSteps = 500;
// Shadow rays start this far above the surface, in sphere radii. Otherwise they would hit the point where
// they start.
constexpr double kShadowOffset = 1e-6;

const double kSine = std::sin(kTorusTilt * std::numbers::pi / 180.0);
const double kCosine = std::cos(kTorusTilt * std::numbers::pi / 180.0);

double length(const Vector3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

Vector3 along(const Vector3& origin, const Vector3& direction, double t) {
  return {origin.x + t * direction.x, origin.y + t * direction.y, origin.z + t * direction.z};
}

Vector3 unit_vector(const Vector3& v) {
  const double scale = 1.0 / length(v);
  return {v.x * scale, v.y * scale, v.z * scale};
}

// Returns the closest point of the circle that runs inside the torus, in the middle of its tube.
Vector3 tube_middle(const Vector3& p) {
  const double height = p.y * kSine + p.z * kCosine;  // along the axis
  const Vector3 flat = {p.x, p.y - height * kSine, p.z - height * kCosine};
  const double radius = std::max(length(flat), 1e-12);
  return along({0.0, 0.0, 0.0}, flat, kTorusRadius / radius);
}

double torus_distance(const Vector3& p) {
  const Vector3 middle = tube_middle(p);
  return length({p.x - middle.x, p.y - middle.y, p.z - middle.z}) - kTubeRadius;
}

// Traces spheres (Hart 1996). A step is as long as the distance to the surface, so it never passes the
// surface. Returns the distance along the ray, or a negative number if the ray hits nothing before `end`.
double march(const Vector3& origin, const Vector3& direction, double start, double end) {
  double t = start;
  for (int step = 0; step < kMostSteps && t < end; ++step) {
    const double distance = torus_distance(along(origin, direction, t));
    if (distance < kHitDistance) return t;
    t += distance;
  }
  return -1.0;
}

bool torus_point(int resolution, double column, double row, SurfaceHit* hit) {
  const Vector3 camera = {0.0, 0.0, kCameraDistance};
  const Vector3 direction = unit_vector(camera_ray(resolution, column, row));
  const double t = march(camera, direction, kCameraDistance - 1.0, kCameraDistance + 1.0);
  if (t < 0.0) return false;
  hit->position = along(camera, direction, t);
  const Vector3 middle = tube_middle(hit->position);
  hit->normal =
      unit_vector({hit->position.x - middle.x, hit->position.y - middle.y, hit->position.z - middle.z});
  return true;
}

}  // namespace

std::string light_name(const Light& light) {
  std::string name = light.angle == 0.0 ? "headlight" : number_text(light.angle);
  if (light.distance != Light{}.distance) name += "@" + number_text(light.distance);
  return name;
}

Vector3 camera_ray(int resolution, double column, double row) {
  // The edge of the picture touches the sphere: tan(asin(1 / distance)).
  const double half_extent = 1.0 / std::sqrt(kCameraDistance * kCameraDistance - 1.0);
  return {(2.0 * column / resolution - 1.0) * half_extent, (1.0 - 2.0 * row / resolution) * half_extent,
          -1.0};
}

bool sphere_point(int resolution, double column, double row, Vector3* point) {
  const Vector3 ray = camera_ray(resolution, column, row);
  const double dx = ray.x, dy = ray.y;
  // Intersect the ray (0, 0, d) + t (dx, dy, -1) with x^2 + y^2 + z^2 = 1. The smaller root is visible.
  const double a = dx * dx + dy * dy + 1.0;
  const double b = kCameraDistance;
  const double discriminant = b * b - a * (b * b - 1.0);
  if (discriminant <= 0.0) return false;
  const double t = (b - std::sqrt(discriminant)) / a;
  *point = {t * dx, t * dy, kCameraDistance - t};
  return true;
}

std::vector<float> view_cosines(int resolution, int samples_per_axis) {
  std::vector<float> cosines;
  cosines.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  const double step = 1.0 / samples_per_axis;
  for (int row = 0; row < resolution; ++row) {
    for (int column = 0; column < resolution; ++column) {
      double sum = 0.0;
      for (int v = 0; v < samples_per_axis; ++v) {
        for (int u = 0; u < samples_per_axis; ++u) {
          Vector3 p;
          if (!sphere_point(resolution, column + (u + 0.5) * step, row + (v + 0.5) * step, &p)) continue;
          const double to_camera = kCameraDistance - p.z;
          const double distance = std::sqrt(p.x * p.x + p.y * p.y + to_camera * to_camera);
          sum += (p.z * to_camera - p.x * p.x - p.y * p.y) / distance;
        }
      }
      cosines.push_back(static_cast<float>(sum * step * step));
    }
  }
  return cosines;
}

bool shape_point(Shape shape, int resolution, double column, double row, SurfaceHit* hit) {
  if (shape == Shape::kTorus) return torus_point(resolution, column, row, hit);
  if (!sphere_point(resolution, column, row, &hit->position)) return false;
  hit->normal = hit->position;
  return true;
}

bool is_shadowed(Shape shape, const SurfaceHit& hit, const Vector3& light) {
  if (shape == Shape::kSphere) return false;
  const Vector3 origin = along(hit.position, hit.normal, kShadowOffset);
  const Vector3 way = {light.x - origin.x, light.y - origin.y, light.z - origin.z};
  return march(origin, unit_vector(way), 0.0, length(way)) >= 0.0;
}

std::vector<std::uint32_t> shape_pixels(Shape shape, int resolution) {
  std::vector<std::uint32_t> pixels;
  SurfaceHit hit{};
  for (int row = 0; row < resolution; ++row)
    for (int column = 0; column < resolution; ++column)
      if (shape_point(shape, resolution, column + 0.5, row + 0.5, &hit))
        pixels.push_back(static_cast<std::uint32_t>(row * resolution + column));
  return pixels;
}

}  // namespace remap
