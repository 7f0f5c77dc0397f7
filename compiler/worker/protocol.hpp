// What is said to a worker and what it answers (compiler/adapters/PROTOCOL.md), as JSON. Nothing else of a
// worker's conversation is JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/renderer.hpp"

namespace remapc {

inline constexpr int kWorkerProtocol = 1;

// The answer to `describe`.
struct WorkerDescription {
  std::string renderer;  // name and version of what makes the pictures
  std::vector<ModelDescription> models;
  bool meshes = false;  // takes other shapes than the sphere, as files
};

// One picture as its request names it, without what differs from one run to the next: the key of a cache.
struct PictureRequest {
  std::string text;   // JSON: model, parameters, scene, seed, channels
  std::string shown;  // `mitsuba3/ggx alpha 0.2, specular 0.5, light 60, 256 x 256`
  int resolution = 0;
  Shape shape = Shape::kSphere;
  int channels = 1;  // 1 where every parameter is grey, else 3
};
PictureRequest picture_request(const Material& material, const Scene& scene);

// Lines for a worker's standard input, without the line break.
std::string describe_line(std::int64_t id, unsigned threads);
// `mesh`: the file of the shape where that is not the sphere.
std::string render_line(std::int64_t id, const PictureRequest& request, const std::filesystem::path& image,
                        const std::filesystem::path& mesh);
std::string quit_line(std::int64_t id);

// Whether a line is meant as an answer; those before the first that is are banners.
bool is_answer(const std::string& line);

// Throw kInput, opened by `place`, where the line is not the answer to request `id`, or says what was wrong.
void read_answer(const std::string& line, std::int64_t id, const std::string& place);
// Whether the line is the answer to `id`, and an error that the worker reports.
bool is_complaint(const std::string& line, std::int64_t id);
// `prefix`: what every model's name must begin with, before the `/`; any where it is empty.
WorkerDescription read_description(const std::string& line, std::int64_t id, const std::string& prefix,
                                   const std::string& place);

}  // namespace remapc
