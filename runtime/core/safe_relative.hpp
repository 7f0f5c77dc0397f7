// This file checks paths from manifests and journals, because others may have written these files.
#pragma once

#include <filesystem>
#include <string>

namespace remap {

// Returns why `text` is not a path below a folder: it is absolute, it leads up with `..`, or it has control
// characters or line breaks. Returns an empty text for a safe path.
std::string fault_of_relative(const std::string& text);

// Returns `text` as a path below a folder. It is empty for the folder itself. If `text` is not safe, throws
// kInput, beginning with `context`.
std::filesystem::path safe_relative(const std::string& text, const std::string& context);
// Checks a single name in the same way. The name may be empty.
std::filesystem::path safe_name(const std::string& text, const std::string& context);

// Returns true for the name of a file of this program in an output folder (`.texremap*`). Other files must
// not use such names.
bool is_own_name(const std::filesystem::path& name);

}  // namespace remap
