// Checks paths that stand in manifests and journals, because others may have written these files.
#pragma once

#include <filesystem>
#include <string>

namespace remap {

// Why `text` is no path below a folder: it is absolute, leads up by `..`, or has control characters or line
// breaks. Empty for a path that may be used.
std::string fault_of_relative(const std::string& text);

// The path below a folder that `text` means; empty for the folder itself. Throws kInput, beginning with
// `context`.
std::filesystem::path safe_relative(const std::string& text, const std::string& context);
// The same of a single name, which may be empty.
std::filesystem::path safe_name(const std::string& text, const std::string& context);

// The name of a file of this program in an output folder (`.texremap*`), which nothing else may have.
bool is_own_name(const std::filesystem::path& name);

}  // namespace remap
