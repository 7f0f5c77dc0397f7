// This file keeps rendered pictures on disk, so that no picture is rendered twice.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "look/image.hpp"
#include "worker/protocol.hpp"

namespace remap {

// A PictureCache stores the pictures of one version of one renderer. Its folder is named after both. It is
// safe for many threads and processes. A picture appears complete or not at all.
class PictureCache {
 public:
  // `renderer` is WorkerDescription::renderer.
  PictureCache(const std::filesystem::path& folder, const std::string& worker, const std::string& renderer);

  // Returns the picture of a request, if the cache has it. If its file cannot be used, `damage` receives the
  // reason (`FILE: its checksum does not match its content`).
  std::optional<Image> find(const PictureRequest& request, std::string& damage) const;

  // Throws kOutput if the picture cannot be written.
  void keep(const PictureRequest& request, const Image& image) const;

  // Returns the names of the folders that hold pictures of other versions of this worker.
  std::vector<std::string> other_versions() const;

 private:
  std::filesystem::path file_of(const PictureRequest& request) const;

  std::string key_opening_;
  std::filesystem::path worker_folder_, folder_;
};

}  // namespace remap
