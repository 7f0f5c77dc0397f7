// This file lists the images of a folder tree, even if parts of it cannot be read.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace remap {

// Returns the whole path with plain(). A file name may hold any byte, but a message must be one line and must
// not control a terminal.
std::string display_path(const std::filesystem::path& path);

struct WalkOptions {
  bool recursive = true;
  std::vector<std::filesystem::path> excluded;  // folders to skip, such as the one for results
  std::vector<std::string> also;  // more extensions, without dot, of files that are listed separately
};

// A WalkProblem is a file or folder that could not be read.
struct WalkProblem {
  std::filesystem::path path;  // relative to the root
  std::string message;         // `place: what is wrong`, one line
};

struct Walk {
  // Holds the names of images, sorted by bytes, by their folder: relative to the root, empty for the root.
  std::map<std::filesystem::path, std::vector<std::string>> images;
  std::vector<std::filesystem::path>
      others;                         // files with an extension of `also`, relative to the root, in any order
  std::vector<WalkProblem> problems;  // in any order
};

// Lists the images under `root`, with the extensions exr tif tiff png jpg jpeg tga bmp hdr tx webp. Skips
// hidden names, which include unfinished results (files.hpp). Follows symbolic links, but visits each folder
// only once, so that loops end. A folder below the root gets its own path, not the path of a link. Files and
// folders that cannot be read become problems. Throws kInput only if the root itself cannot be read.
Walk walk_images(const std::filesystem::path& root, const WalkOptions& options);

}  // namespace remap
