// The images of a tree of folders, whatever is wrong with it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

struct WalkOptions {
  bool recursive = true;
  std::vector<std::filesystem::path> excluded;  // folders that are not entered, such as the one for results
};

struct ImageFolder {
  std::filesystem::path path;       // relative to the root; empty for the root itself
  std::vector<std::string> images;  // file names, sorted by bytes
};

// Something that could not be read.
struct WalkProblem {
  std::filesystem::path path;  // relative to the root
  std::string message;         // `place: what; expected`, one line
};

struct Walk {
  std::vector<ImageFolder> folders;   // those with images; in no order that would mean anything
  std::vector<WalkProblem> problems;  // likewise
};

// Whether the extension is that of an image format that is read: exr tif tiff png jpg jpeg tga bmp hdr tx.
bool is_image_name(std::string_view name);

// Lists images under `root`. Hidden names are left out, and unfinished results with them (files.hpp).
// Symbolic links are followed; a folder is visited once, under its own path if that lies below the root, so
// that loops end. What cannot be read is a problem, and the rest is listed. Throws kInput where the root
// itself cannot be read.
Walk walk_images(const std::filesystem::path& root, const WalkOptions& options);

}  // namespace remap
