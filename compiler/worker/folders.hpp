// Where workers, renderers and pictures lie.
#pragma once

#include <filesystem>

namespace remapc {

// Where scripts/renderers installs: `REMAP_RENDERERS`, else `remap/renderers` in the user's data folder.
std::filesystem::path renderers_folder();

// Where pictures are kept: `remap/pictures` in the user's cache folder (`XDG_CACHE_HOME`, `~/.cache`).
std::filesystem::path default_cache_folder();

// The user's own list of workers: `REMAP_WORKERS`, else `remap/workers.json` in the user's configuration
// folder. Need not exist.
std::filesystem::path own_worker_list();

// The list that ships: beside the program where it is installed, else in the source tree it was built from.
std::filesystem::path shipped_worker_list();

// A folder of this process alone, in memory where there is such a file system; gone with the object. What
// processes left behind that died is removed an hour later, by the next that makes one.
class PrivateFolder {
 public:
  // Throws kOutput where none can be made.
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace remapc
