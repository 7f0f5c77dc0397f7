// This file makes a temporary folder and removes it after the work.
#pragma once

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/errors.hpp"
#include "core/system.hpp"

namespace remap {

// A ScratchFolder is a folder `PREFIX-XXXXXX` in the system's temporary folder. Its destructor removes it
// with all its files. The constructor throws kOutput if it cannot make the folder.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& prefix) {
    std::string name = (std::filesystem::temp_directory_path() / (prefix + "-XXXXXX")).string();
    if (!create_scratch_folder(name))
      throw output_error(name + ": cannot be created: " + std::strerror(errno));
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace remap
