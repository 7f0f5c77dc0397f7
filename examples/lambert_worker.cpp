// A whole worker (compiler/workers/PROTOCOL.md): Lambert and Blinn-Phong under a point light, traced here.
// Yours calls a renderer instead.
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

using Json = nlohmann::ordered_json;
using Vector = std::array<double, 3>;

const double kPi = std::acos(-1.0);
const Json kModel = Json::parse(R"({"name": "example/blinn-phong", "parameters": [
  {"name": "exponent", "role": "roughness", "convention": "exponent", "range": [0, 10000]},
  {"name": "specular", "role": "specular", "range": [0, 1]},
  {"name": "diffuse", "role": "diffuse", "range": [0, 1]}]})");

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector sum(const Vector& a, const Vector& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
Vector unit(const Vector& v) { return sum({}, v, 1.0 / std::sqrt(dot(v, v))); }

struct Material {
  double exponent, specular, diffuse;
};

// Radiance along the ray through (x, y) of the image plane at distance 1.
double radiance(double x, double y, double camera, const Vector& lamp, const Material& material) {
  const Vector ray = unit({x, y, -1.0});
  const double middle = -ray[2] * camera, beneath = middle * middle - camera * camera + 1.0;
  if (beneath <= 0.0) return 0.0;  // beside the unit sphere
  const Vector point = sum({0.0, 0.0, camera}, ray, middle - std::sqrt(beneath));
  const Vector to_lamp = sum(lamp, point, -1.0), light = unit(to_lamp);
  const double cosine = dot(light, point);
  if (cosine <= 0.0) return 0.0;
  const double half = std::max(0.0, dot(unit(sum(light, ray, -1.0)), point));
  const double lobe = (material.exponent + 2.0) / (2.0 * kPi) * std::pow(half, material.exponent);
  return (material.diffuse / kPi + material.specular * lobe) * cosine / dot(to_lamp, to_lamp);
}

void require(bool condition, const std::string& message) {
  if (!condition) throw std::runtime_error(message);
}

double value(const Json& values, std::size_t channel) { return values.at(values.size() == 3 ? channel : 0); }

void render(const Json& request) {
  const Json &values = request.at("parameters"), &scene = request.at("scene");
  require(request.at("model") == kModel["name"], "the model is unknown; expected example/blinn-phong");
  for (const Json& parameter : kModel["parameters"])
    for (const double v : values.at(parameter["name"].get<std::string>()))
      require(v >= parameter["range"][0] && v <= parameter["range"][1],
              parameter["name"].get<std::string>() + " is out of its range");
  const int side = scene.at("resolution"), grid = scene.at("samples_per_axis");
  const std::size_t channels = request.at("channels");
  const double camera = scene.at("camera").at("distance");
  const Vector lamp = scene.at("light").at("position");
  const double half_angle = scene.at("camera").at("half_angle");
  const double extent = std::tan(half_angle * kPi / 180.0);
  const auto place = [&](int sample) { return (2.0 * (sample + 0.5) / (side * grid) - 1.0) * extent; };
  std::vector<float> pixels;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      for (std::size_t c = 0; c < channels; ++c) {
        const Material material{value(values.at("exponent"), 0), value(values.at("specular"), c),
                                value(values.at("diffuse"), c)};
        double total = 0.0;
        for (int i = 0; i < grid * grid; ++i)
          total += radiance(place(column * grid + i % grid), -place(row * grid + i / grid), camera, lamp,
                            material);
        pixels.push_back(static_cast<float>(total / (grid * grid)));
      }
  std::ofstream file(request.at("image").get<std::string>(), std::ios::binary);
  file.write(reinterpret_cast<const char*>(pixels.data()),
             static_cast<std::streamsize>(pixels.size() * sizeof(float)));
  require(static_cast<bool>(file.flush()), "the picture cannot be written");
}

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    const Json request = Json::parse(line);
    Json answer = {{"id", request.at("id")}};
    try {
      if (request.at("request") == "quit") break;
      if (request.at("request") == "describe")
        answer.update(Json{{"protocol", 1}, {"renderer", "example 1.0"}, {"models", {kModel}}});
      else
        render(request);
    } catch (const std::exception& failure) {
      answer["error"] = failure.what();
    }
    std::cout << answer.dump() << std::endl;  // flushed: remapc waits for it
  }
}
