// Where the results of a conversion go, and the refusals that keep other files safe.
#pragma once

#include <filesystem>
#include <string>

#include "texture/texture_set.hpp"

namespace remap {

struct OutputPaths {
  std::filesystem::path roughness;
  std::filesystem::path specular;
};

struct OutputChoice {
  std::filesystem::path folder;
  std::string extension;  // of both files; empty: as the inputs
  bool force = false;     // may replace files that exist
};

// The names of the inputs in the folder; `specular` for a constant. Throws kUsage where both names are the
// same, where one is an input, and for an unknown extension; kOutput where one exists and `force` is not set
// or where the folder is a file.
OutputPaths output_paths(const TextureSetRequest& request, const OutputChoice& choice);

// Throws kOutput where the folder is not there and cannot be made.
void create_output_folder(const std::filesystem::path& folder);

}  // namespace remap
