// This file formats the requests to a worker and parses its answers (compiler/adapters/PROTOCOL.md). Only
// this file knows their JSON. It also finds values that no picture of a renderer may hold, whether it comes
// from a worker or from a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "look/image.hpp"
#include "renderer/renderer.hpp"

namespace remap {

// Returns `the picture is nan in row 3, column 5 (values must be finite)` for the first value that is not
// finite, too bright, or negative beyond rounding. Returns an empty text for a picture that can be used.
std::string picture_fault(const Image& image);

inline constexpr int kWorkerProtocol = 1;

// A WorkerDescription is the answer to `describe`.
struct WorkerDescription {
  std::string renderer;  // name and version of the renderer
  std::vector<ModelDescription> models;
  bool meshes = false;  // true if it accepts other shapes than the sphere, as files
};

// A PictureRequest is the request for one picture. It is the same in every run, so it is the key of a cache.
struct PictureRequest {
  std::string text;   // JSON: model, parameters, scene, seed, channels
  std::string shown;  // `mitsuba3/ggx alpha 0.2, specular 0.5, light 60, 256 x 256`
  int resolution = 0;
  Shape shape = Shape::kSphere;
  int channels = 1;  // 1 if every parameter is grey, otherwise 3
  // Maps by the names of their parameters. An environment has an empty name. They must outlive the request.
  // `text` does not have them, so pictures with maps cannot be cached.
  std::map<std::string, const Image*> maps = {};
};
PictureRequest picture_request(const Material& material, const Scene& scene);

// Return lines for a worker's standard input, without the line break.
std::string describe_line(std::int64_t id, unsigned threads);
// `mesh` is the file of the shape. The sphere needs no file. `maps` are the files of the maps, in their
// order.
std::string render_line(std::int64_t id, const PictureRequest& request, const std::filesystem::path& image,
                        const std::filesystem::path& mesh,
                        const std::vector<std::filesystem::path>& maps = {});
std::string quit_line(std::int64_t id);

// Returns true if a line is an answer. Other lines before the first answer are banners.
bool is_answer(const std::string& line);

// Returns the error if the answer reports one. Throws kInput, beginning with `context`, if the line is not
// the answer to request `id`.
std::optional<std::string> read_answer(const std::string& line, std::int64_t id, const std::string& context);
// `prefix` is the part before the `/` in the name of every model. An empty prefix accepts any.
WorkerDescription read_description(const std::string& line, std::int64_t id, const std::string& prefix,
                                   const std::string& context);

}  // namespace remap
