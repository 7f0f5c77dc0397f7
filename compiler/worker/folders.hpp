// This file returns the folders of workers, renderers and pictures.
#pragma once

#include <filesystem>

namespace remap {

// Returns the folder into which scripts/renderers installs: `REMAP_RENDERERS`, or `remap/renderers` in the
// user's data folder.
std::filesystem::path renderers_folder();

// Returns the picture cache: `remap/pictures` in the user's cache folder (`XDG_CACHE_HOME`, `~/.cache`).
std::filesystem::path default_cache_folder();

// Returns the user's own list of workers: `REMAP_WORKERS`, otherwise `remap/workers.json` in the user's
// configuration folder. The file may be missing.
std::filesystem::path own_worker_list();

// Returns remap's own list of workers, which lies relative to the running program, or an empty path if it is
// not installed.
std::filesystem::path shipped_worker_list();

// A PrivateFolder is a folder of this process that is deleted with the object. Its name contains a mark of
// this machine and process (core/files.hpp), so many processes may use the same parent folder. The
// constructor also deletes folders that ended processes of this machine left.
class PrivateFolder {
 public:
  // If `parent` is empty, the folder is in memory if possible. Throws kOutput if no folder can be made.
  explicit PrivateFolder(const std::filesystem::path& parent = {});
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace remap
