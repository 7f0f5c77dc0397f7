#include "worker/shape_mesh.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>

#include "core/files.hpp"
#include "look/scene.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// With these counts, the sagitta r (1 - cos(pi / n)) of both circles is below 1e-4.
constexpr std::uint32_t kRound = 384, kTube = 192;

static_assert(std::endian::native == std::endian::little, "meshes are written in memory order");

template <typename Value>
void append(std::string* bytes, Value value) {
  char raw[sizeof(Value)];
  std::memcpy(raw, &value, sizeof(Value));
  bytes->append(raw, sizeof(Value));
}

void append_vertex(std::string* bytes, double around, double tube) {
  const double tilt = kTorusTilt * std::numbers::pi / 180.0;
  // `height` is measured along the axis of the torus
  const auto world = [&](double a, double b, double height) {
    for (const double value :
         {a, b * std::cos(tilt) + height * std::sin(tilt), height * std::cos(tilt) - b * std::sin(tilt)})
      append(bytes, static_cast<float>(value));
  };
  const double ca = std::cos(around), sa = std::sin(around), ct = std::cos(tube), st = std::sin(tube);
  const double radius = kTorusRadius + kTubeRadius * ct;
  world(radius * ca, radius * sa, kTubeRadius * st);
  world(ct * ca, ct * sa, st);
}

void append_triangle(std::string* bytes, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  append(bytes, static_cast<unsigned char>(3));
  for (const std::uint32_t vertex : {a, b, c}) append(bytes, static_cast<std::int32_t>(vertex));
}

}  // namespace

void write_mesh(Shape shape, const std::filesystem::path& path) {
  if (shape == Shape::kSphere)
    throw Error(ErrorKind::kUsage, "mesh: the sphere has none (choose another shape)");
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(kRound * kTube);
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) bytes += std::string("\nproperty float ") + name;
  bytes += "\nelement face " + std::to_string(2 * kRound * kTube) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::uint32_t i = 0; i < kRound; ++i)
    for (std::uint32_t j = 0; j < kTube; ++j)
      append_vertex(&bytes, 2.0 * std::numbers::pi * i / kRound, 2.0 * std::numbers::pi * j / kTube);
  const auto vertex = [](std::uint32_t i, std::uint32_t j) { return i % kRound * kTube + j % kTube; };
  for (std::uint32_t i = 0; i < kRound; ++i)
    for (std::uint32_t j = 0; j < kTube; ++j) {
      append_triangle(&bytes, vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      append_triangle(&bytes, vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  write_file(path, bytes);
}

}  // namespace remap
