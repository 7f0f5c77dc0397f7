// This program is a complete worker (compiler/adapters/PROTOCOL.md) for the renderer of blinn_phong.hpp. To
// write your own worker, replace the model and the renderer.
#include <fstream>
#include <iostream>
#include <string>

#include <nlohmann/json.hpp>

#include "blinn_phong.hpp"

using Json = nlohmann::ordered_json;

const Json kModel = Json::parse(R"({"name": "example/blinn-phong", "parameters": [
  {"name": "exponent", "role": "roughness", "convention": "exponent", "range": [0, 10000]},
  {"name": "specular", "role": "specular", "range": [0, 1]},
  {"name": "diffuse", "role": "diffuse", "range": [0, 1]}]})");

void require(bool condition, const std::string& message) {
  if (!condition) throw std::runtime_error(message);
}

void render(const Json& request) {
  const Json &values = request.at("parameters"), &scene = request.at("scene"), &camera = scene.at("camera");
  require(request.at("model") == kModel["name"], "unknown model (choose example/blinn-phong)");
  for (const Json& parameter : kModel["parameters"])
    for (const double v : values.at(parameter["name"].get<std::string>()))
      require(v >= parameter["range"][0] && v <= parameter["range"][1],
              parameter["name"].get<std::string>() + " is out of range");
  const auto value = [&](const char* name, std::size_t c) -> double {
    return values.at(name).at(c % values.at(name).size());
  };
  std::vector<example::Material> channels;
  for (std::size_t c = 0; c < request.at("channels"); ++c)
    channels.push_back({value("exponent", c), value("specular", c), value("diffuse", c)});
  const std::vector<float> pixels =
      example::picture({scene.at("resolution"), scene.at("samples_per_axis"), camera.at("half_angle"),
                        camera.at("distance"), scene.at("light").at("position")},
                       channels);
  std::ofstream file(request.at("image").get<std::string>(), std::ios::binary);
  file.write(reinterpret_cast<const char*>(pixels.data()),
             static_cast<std::streamsize>(pixels.size() * sizeof(float)));
  require(static_cast<bool>(file.flush()), "cannot write the picture");
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
    std::cout << answer.dump() << std::endl;  // std::endl flushes: remapc waits for the answer
  }
}
