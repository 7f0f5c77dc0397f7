// This program is a worker with a chosen fault. It renders the built-in GGX behind the protocol, and shares
// no protocol code with the code under test.
//
//   fake_worker [--fault NAME] [--after N] [--of all] [--version TEXT] [--log FILE] [--model NAME]
//
// With a fault that begins with `textures`, the model accepts maps and environments.
// The fault occurs at the picture after the first N of this process, or with `--of all`, of all processes in
// the log. The log gets two lines for each picture (its file, its parameters), the process ids of the worker
// and of its children, and at the start of each worker the number of workers that run.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <nlohmann/json.hpp>

#include "compiler/renderer/oren_nayar.hpp"
#include "look/brdf.hpp"
#include "look/material_looks.hpp"
#include "renderer/renderer.hpp"

namespace {

using nlohmann::json;

std::map<std::string, std::string> options = {{"fault", ""},    {"after", "0"}, {"of", "one"},
                                              {"version", "1"}, {"log", ""},    {"model", "fake/ggx"}};
int rendered = 0;

bool has_fault(const std::string& name) {
  return options["fault"] == name && rendered >= std::stoi(options["after"]);
}

bool has_textures() { return options["fault"].starts_with("textures"); }

void log_line(const std::string& line) {
  if (!options["log"].empty()) std::ofstream(options["log"], std::ios::app) << line << std::endl;
}

std::vector<std::string> logged(const std::string& opening) {
  std::ifstream file(options["log"]);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(opening)) lines.push_back(line.substr(opening.size()));
  return lines;
}

// Returns how many workers of the log still run. A worker that ended counts until its parent waits for it.
std::ptrdiff_t crowd() {
  const std::vector<std::string> ids = logged("process ");
  return std::count_if(ids.begin(), ids.end(),
                       [](const std::string& id) { return ::kill(std::stoi(id), 0) == 0; });
}

json description(const json& request) {
  const auto parameter = [](const char* name, const char* role, double least, double most) {
    return json{{"name", name}, {"role", role}, {"range", {least, most}}};
  };
  json alpha = parameter("alpha", "roughness", 1e-4, 1.0), tint = parameter("tint", "other", 0.0, 1.0);
  alpha["convention"] = has_fault("convention") ? "width" : "alpha";
  tint["default"] = 0.5;
  const json model = {{"name", has_fault("prefix") ? "other/ggx" : options["model"]},
                      {"textures", has_textures()},
                      {"parameters",
                       {alpha, parameter("specular", "specular", 0.0, 1.0),
                        parameter("diffuse", "diffuse", 0.0, 1.0), tint}}};
  const int protocol = has_fault("protocol") ? 2 : 1;
  return {{"id", request.at("id")},
          {"protocol", protocol},
          {"renderer", "Fake " + options["version"]},
          {"models", {model}},
          {"meshes", has_fault("meshes")}};
}

// Applies the fault to a picture.
void spoil(const json& request, remap::Image* image) {
  auto& values = image->values;
  const auto side = static_cast<std::size_t>(image->width),
             channels = static_cast<std::size_t>(image->channels);
  const std::size_t middle = (side / 2 * side + side / 2) * channels;
  if (has_fault("nan")) values[middle] = std::nanf("");
  if (has_fault("short")) values.pop_back();
  if (has_fault("negative")) values[middle] = -0.01f * values[middle];
  if (has_fault("rounding")) values[0] = -1e-7f * values[middle];
  if (has_fault("huge")) values[middle] = 1e38f;
  if (has_fault("bright"))
    for (float& value : values) value *= 3.14159265f;
  if (has_fault("gamma"))
    for (float& value : values) value = std::pow(value, 1.0f / 2.2f);
  if (has_fault("eight-bit"))
    for (float& value : values) value = std::round(std::min(value, 1.0f) * 255.0f) / 255.0f;
  if (has_fault("grey-background"))
    for (float& value : values) value += 0.01f;
  if (has_fault("unrepeatable")) values[middle] *= 1.0f + 1e-3f * static_cast<float>(rendered % 7);
  if (has_fault("noise")) values[middle] *= 1.0f + 0.1f * request.at("seed").get<float>();
  if (has_fault("channels") && channels == 3)
    for (std::size_t i = 0; i < values.size(); i += 3) std::swap(values[i], values[i + 2]);
  const auto pixels = values;
  const auto move = [&](auto from) {
    for (std::size_t row = 0; row < side; ++row)
      for (std::size_t column = 0; column < side; ++column)
        for (std::size_t c = 0; c < channels; ++c)
          values[(row * side + column) * channels + c] = pixels[from(row, column) * channels + c];
  };
  if (has_fault("mirrored"))
    move([&](std::size_t row, std::size_t column) { return row * side + side - 1 - column; });
  if (has_fault("transposed")) move([&](std::size_t row, std::size_t column) { return column * side + row; });
  if (has_fault("shifted"))
    move([&](std::size_t row, std::size_t column) { return (row + 1) % side * side + column; });
}

// Reads the mesh of a scene. Reports whether its counts are complete, and whether its vertices and normals
// lie on the torus (radii 0.68 and 0.3, its axis 40 degrees from +z to +y).
std::string mesh_report(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::size_t vertices = 0, faces = 0;
  while (std::getline(file, line) && line != "end_header") {
    if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) faces = std::stoul(line.substr(13));
  }
  const double tilt = 40.0 / 180.0 * 3.14159265358979, axis[3] = {0.0, std::sin(tilt), std::cos(tilt)};
  double worst = 0.0;
  for (std::size_t i = 0; i < vertices; ++i) {
    float v[6];  // position and normal
    file.read(reinterpret_cast<char*>(v), sizeof(v));
    const double height = v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2];
    double flat[3], around = 0.0;
    for (int k = 0; k < 3; ++k) flat[k] = v[k] - height * axis[k];
    for (const double part : flat) around += part * part;
    around = std::sqrt(around);
    for (int k = 0; k < 3; ++k) {
      const double from_circle = v[k] - 0.68 * flat[k] / around;
      worst = std::max(worst, std::fabs(from_circle - 0.3 * v[3 + k]));
    }
  }
  std::size_t good = 0;
  for (std::size_t i = 0; i < faces; ++i) {
    unsigned char count = 0;
    std::uint32_t corner[3] = {};
    file.read(reinterpret_cast<char*>(&count), 1);
    file.read(reinterpret_cast<char*>(corner), sizeof(corner));
    if (count == 3 && corner[0] < vertices && corner[1] < vertices && corner[2] < vertices) ++good;
  }
  const bool complete =
      file.good() && file.peek() == EOF && good == faces && vertices > 0 && faces == 2 * vertices;
  return std::string(complete ? "complete" : "broken") + (worst < 1e-6 ? " exact" : " off");
}

// Returns the map of a file, or one texel for a list of numbers.
remap::Image map_of(const json& value, const char* file) {
  if (value.is_array()) return {1, 1, static_cast<int>(value.size()), value.get<std::vector<float>>()};
  remap::Image map{value.at("width"), value.at("height"), value.value("channels", 3), {}};
  map.values.resize(static_cast<std::size_t>(map.width * map.height * map.channels));
  std::ifstream input(value.at(file).get<std::string>(), std::ios::binary);
  input.read(reinterpret_cast<char*>(map.values.data()),
             static_cast<std::streamsize>(map.values.size() * sizeof(float)));
  if (!input || input.peek() != EOF) throw std::runtime_error("a map has another size");
  return map;
}

// Returns a material of maps. All maps of more than one texel have one size.
remap::TexturedBall ball_of_request(const json& values) {
  const std::map<std::string, remap::Image> maps = {{"alpha", map_of(values.at("alpha"), "map")},
                                                    {"specular", map_of(values.at("specular"), "map")},
                                                    {"diffuse", map_of(values.at("diffuse"), "map")}};
  remap::TexturedBall ball{remap::builtin_brdf("mitsuba/ggx-plain"), 1, 1, {}};
  for (const auto& [name, map] : maps)
    if (map.width * map.height > 1) ball.width = map.width, ball.height = map.height;
  for (int row = 0; row < ball.height; ++row)
    for (int column = 0; column < ball.width; ++column) {
      const auto at = [&](const char* name, std::size_t channel) {
        const remap::Image& map = maps.at(name);
        const int y = has_fault("textures-flipped") ? ball.height - 1 - row : row;
        const auto texel = static_cast<std::size_t>(map.width > 1 ? y * map.width + column : 0);
        const auto channels = static_cast<std::size_t>(map.channels);
        return static_cast<double>(map.values[texel * channels + channel % channels]);
      };
      ball.texels.push_back({at("alpha", 0),
                             {at("specular", 0), at("specular", 1), at("specular", 2)},
                             {at("diffuse", 0), at("diffuse", 1), at("diffuse", 2)}});
    }
  return ball;
}

remap::Image lit_by_environment(const json& request) {
  const json &scene = request.at("scene"), &light = scene.at("light");
  remap::Environment environment{"", map_of(light, "environment")};
  if (has_fault("textures-behind")) {
    auto& values = environment.map.values;  // turned by half a turn
    const auto row = static_cast<std::ptrdiff_t>(3 * environment.map.width);
    for (auto begin = values.begin(); begin != values.end(); begin += row)
      std::rotate(begin, begin + row / 2, begin + row);
  }
  remap::SphereSampling sampling;
  sampling.resolution = scene.at("resolution");
  sampling.samples = light.at("samples");
  const remap::RadiancePyramid pyramid(std::span(&environment, 1), remap::kPreviewLightRows);
  const remap::TexturedBall ball = ball_of_request(request.at("parameters"));
  const std::vector<float> radiance =
      remap::render_textured(pyramid, std::span(&ball, 1), {}, sampling).front();
  const std::vector<std::uint32_t> pixels = remap::shape_pixels(remap::Shape::kSphere, sampling.resolution);
  remap::Image image{sampling.resolution, sampling.resolution, 3, {}};
  image.values.resize(static_cast<std::size_t>(3 * image.width * image.height));
  for (std::size_t i = 0; i < radiance.size(); ++i) image.values[3 * pixels[i / 3] + i % 3] = radiance[i];
  return image;
}

// Renders maps under the point light: a picture for each texel, from which each pixel takes the closest
// texel's.
remap::Image lit_by_lamp(const json& request) {
  const json& scene = request.at("scene");
  const remap::Scene place{scene.at("resolution"),
                           scene.at("samples_per_axis"),
                           {scene.at("light").at("angle"), scene.at("light").at("distance")}};
  const remap::TexturedBall ball = ball_of_request(request.at("parameters"));
  const auto renderer = remap::make_builtin_renderer();
  std::vector<remap::Image> pictures;
  for (const remap::BallTexel& texel : ball.texels) {
    const auto list = [](const remap::Rgb& rgb) { return std::vector<double>(rgb.begin(), rgb.end()); };
    pictures.push_back(renderer->render(
        {"mitsuba/ggx-plain",
         {{"alpha", {texel.alpha}}, {"specular", list(texel.specular)}, {"diffuse", list(texel.diffuse)}}},
        place));
  }
  remap::Image image{place.resolution, place.resolution, 3, std::vector<float>(pictures[0].values.size())};
  for (int i = 0; i < place.resolution * place.resolution; ++i) {
    remap::Vector3 p{};
    if (!remap::sphere_point(place.resolution, i % place.resolution + 0.5, i / place.resolution + 0.5, &p))
      continue;
    const double u = 0.5 + std::atan2(p.x, p.z) / 3.14159265358979, v = std::acos(p.y) / 3.14159265358979;
    const int texel = std::min(static_cast<int>(v * ball.height), ball.height - 1) * ball.width +
                      std::clamp(static_cast<int>(u * ball.width), 0, ball.width - 1);
    for (int c = 0; c < 3; ++c) {
      const auto value = static_cast<std::size_t>(3 * i + c);
      image.values[value] = pictures[static_cast<std::size_t>(texel)].values[value];
    }
  }
  return image;
}

remap::Image picture(const json& request) {
  if (request.at("model") != options["model"])
    throw std::runtime_error("unknown model (choose " + options["model"] + ")");
  const json& given = request.at("parameters");
  if (request.at("scene").at("light").contains("environment")) return lit_by_environment(request);
  if (std::any_of(given.begin(), given.end(), [](const json& value) { return value.is_object(); }))
    return lit_by_lamp(request);
  const json &values = request.at("parameters"), &scene = request.at("scene");
  remap::Scene place{scene.at("resolution"),
                     scene.at("samples_per_axis"),
                     {scene.at("light").at("angle"), scene.at("light").at("distance")}};
  if (scene.contains("shape")) {
    log_line("mesh " + scene.at("shape").get<std::string>() + " " + mesh_report(scene.at("mesh")));
    place.shape = remap::Shape::kTorus;
  }
  // no sample is at the centre of a pixel
  if (has_fault("jitter") && place.samples_per_axis == 1) place.samples_per_axis = 2;
  if (has_fault("no-square")) place.light.distance = 3.0;
  remap::Material material{"mitsuba/ggx-plain", {}};
  for (const char* name : {"alpha", "specular", "diffuse"})
    material.parameters[name] = values.at(name).get<std::vector<double>>();
  values.at("tint");
  if (has_fault("clamping"))
    for (double& value : material.parameters["specular"]) value = std::min(value, 1.0);
  if (has_fault("inverted")) material.parameters["alpha"][0] = 1.0 - 0.9 * material.parameters["alpha"][0];
  const double diffuse = material.parameters["diffuse"][0];
  if (has_fault("oren-nayar")) material.parameters["diffuse"] = {0.0};
  remap::Image image = remap::make_builtin_renderer()->render(material, place);
  if (has_fault("oren-nayar")) {
    const remap::Image clay = remap::oren_nayar_picture(place, 0.7);
    for (std::size_t i = 0; i < clay.values.size(); ++i)
      image.values[i] += static_cast<float>(diffuse) * clay.values[i];
  }
  const std::size_t channels = request.at("channels");
  if (channels == 3 && image.channels == 1) {
    std::vector<float> rgb;
    for (const float value : image.values) rgb.insert(rgb.end(), 3, value);
    image.values = rgb;
    image.channels = 3;
  }
  spoil(request, &image);
  return image;
}

// Applies faults of the process and of the protocol. Returns true if it has answered.
bool misbehave(const json& request) {
  std::cerr << "rendering number " << rendered << std::endl;
  if (has_fault("deaf")) {  // keeps running without its pipes
    for (int end = 0; end < 3; ++end) ::close(end);
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
  if (has_fault("die")) ::raise(SIGKILL);
  if (has_fault("exit")) std::exit(3);
  if (has_fault("half")) {
    std::ofstream(request.at("image").get<std::string>()) << "half";
    std::exit(0);
  }
  if (has_fault("launcher")) {  // if asked to end, it ends what it has started elsewhere
    std::signal(SIGTERM, [](int) {
      log_line("told to end");
      std::_Exit(0);
    });
  }
  if (has_fault("hang") || has_fault("launcher")) std::this_thread::sleep_for(std::chrono::hours(1));
  if (has_fault("garbage")) std::cout << "Saved: picture.exr" << std::endl;
  if (has_fault("wrong-id")) std::cout << json{{"id", request.at("id").get<int>() + 1}} << std::endl;
  if (has_fault("refuse"))
    std::cout << json{{"id", request.at("id")}, {"error", "no licence left"}} << std::endl;
  if (has_fault("no-file")) std::cout << json{{"id", request.at("id")}} << std::endl;
  if (has_fault("pipe")) {
    ::mkfifo(request.at("image").get<std::string>().c_str(), 0600);
    std::cout << json{{"id", request.at("id")}} << std::endl;
  }
  if (has_fault("flood")) std::cout << std::string(20 << 20, 'x') << std::endl;
  const auto complain = [&](const json& error) {
    std::cout << json{{"id", request.at("id")}, {"error", error}} << std::endl;
  };
  if (has_fault("error-number")) complain(5);
  if (has_fault("error-long")) complain(std::string(5'000'000, 'x'));
  if (has_fault("error-lines")) complain("line 1\nline 2 \x1b[31m\xe2\x80\xae");
  if (has_fault("deep"))
    std::cout << "{\"id\": " << request.at("id") << ", \"error\": " << std::string(65'700, '[')
              << std::string(65'700, ']') << "}" << std::endl;
  if (has_fault("talkative")) {
    std::cerr << std::string(7000, 'y') << "\x1b[31m the end" << std::endl;
    std::exit(3);
  }
  for (const char* fault : {"garbage", "wrong-id", "refuse", "no-file", "pipe", "flood", "error-number",
                            "error-long", "error-lines", "deep"})
    if (has_fault(fault)) return true;
  return false;
}

void render(const json& request) {
  if (misbehave(request)) return;
  const remap::Image image = picture(request);
  const std::string path = (has_fault("elsewhere") ? "/proc" : "") + request.at("image").get<std::string>();
  log_line("file " + path);
  std::ofstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot write " + path);
  file.write(reinterpret_cast<const char*>(image.values.data()),
             static_cast<std::streamsize>(image.values.size() * sizeof(float)));
  file.close();
  ++rendered;
  log_line("picture " + request.at("parameters").dump());
  std::cout << json{{"id", request.at("id")}} << std::endl;
}

void answer(const json& request) {
  try {
    if (request.at("request") == "describe")
      std::cout << description(request) << std::endl;
    else
      render(request);
  } catch (const std::exception& failure) {
    std::cout << json{{"id", request.at("id")}, {"error", failure.what()}} << std::endl;
  }
}

// Starts a child process, as renderers do. It runs until remapc ends it. If it has its own session, it is no
// longer in the group of the worker.
void start_child(bool has_session) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (has_session) ::setsid();
    ::execlp("sleep", "sleep", "3600", nullptr);
    ::_exit(127);
  }
  log_line("process " + std::to_string(child));
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i + 1 < argc; i += 2) options[std::string(argv[i]).substr(2)] = argv[i + 1];
  log_line("process " + std::to_string(::getpid()));
  log_line("crowd " + std::to_string(crowd()));
  if (options["of"] == "all") rendered = static_cast<int>(logged("picture ").size());
  if (options["fault"] == "child" || options["fault"] == "daemon") start_child(options["fault"] == "daemon");
  if (options["fault"] == "banner") std::cout << "Fake renderer 1\nLoading...\n" << std::endl;
  if (options["fault"] == "mute") std::this_thread::sleep_for(std::chrono::hours(1));
  for (std::string line; std::getline(std::cin, line);) {
    const json request = json::parse(line);
    if (request.at("request") == "quit") break;
    answer(request);
  }
  if (options["fault"] == "stays") std::this_thread::sleep_for(std::chrono::hours(1));
}
