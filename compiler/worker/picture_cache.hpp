// Pictures that were rendered before, on disk: a picture is never rendered twice.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "renderer/image.hpp"
#include "worker/protocol.hpp"

namespace remapc {

// The pictures of one renderer in one version: a folder below that of the cache, named after both. Safe from
// many threads and processes; a picture appears whole or not at all.
class PictureCache {
 public:
  // `renderer`: WorkerDescription::renderer.
  PictureCache(const std::filesystem::path& folder, const std::string& worker, const std::string& renderer);

  // None where it was not kept, or where the file is damaged.
  std::optional<Image> find(const PictureRequest& request) const;

  // Throws kOutput where it cannot be written.
  void keep(const PictureRequest& request, const Image& image) const;

  // What else the cache holds of this worker, from versions that are not asked any more: names of folders.
  std::vector<std::string> other_versions() const;

 private:
  std::filesystem::path file_of(const PictureRequest& request) const;

  std::string key_opening_;
  std::filesystem::path worker_folder_, folder_;
};

}  // namespace remapc
