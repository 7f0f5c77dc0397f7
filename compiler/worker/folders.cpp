#include "worker/folders.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>

#include "core/files.hpp"
#include "core/process_mark.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

const std::string kPrefix = "remap-pictures-";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// A folder of the XDG base directory specification.
fs::path user_folder(const char* name, const char* below_home) {
  // The specification requires that relative paths are ignored.
  if (const fs::path folder = variable(name); folder.is_absolute()) return folder;
  return fs::path(variable("HOME")) / below_home;
}

bool is_writable_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder, ignored) && ::access(folder.c_str(), W_OK) == 0;
}

// The mark of the process in the name of a private folder, before the six letters that make it unique.
std::string_view mark_in(std::string_view name) {
  const std::size_t end = name.rfind('-');
  if (!name.starts_with(kPrefix) || end == std::string_view::npos || end <= kPrefix.size()) return {};
  return name.substr(kPrefix.size(), end - kPrefix.size());
}

void remove_abandoned(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored))
    if (is_mark_of_the_dead(mark_in(entry.path().filename().string()))) fs::remove_all(entry.path(), ignored);
}

}  // namespace

fs::path renderers_folder() {
  if (const std::string own = variable("REMAP_RENDERERS"); !own.empty()) return own;
  return user_folder("XDG_DATA_HOME", ".local/share") / "remap" / "renderers";
}

fs::path default_cache_folder() { return user_folder("XDG_CACHE_HOME", ".cache") / "remap" / "pictures"; }

fs::path own_worker_list() {
  if (const std::string own = variable("REMAP_WORKERS"); !own.empty()) return own;
  return user_folder("XDG_CONFIG_HOME", ".config") / "remap" / "workers.json";
}

fs::path shipped_worker_list() {
  const fs::path list = installed(REMAP_INSTALLED_WORKERS "/workers.json");
  return list.empty() ? fs::path(REMAP_SOURCE_WORKERS) / "workers.json" : list;
}

PrivateFolder::PrivateFolder() {
  const fs::path memory = "/dev/shm";
  const fs::path parent = is_writable_folder(memory) ? memory : fs::temp_directory_path();
  remove_abandoned(parent);
  std::string name = (parent / (kPrefix + process_mark() + "-XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw Error(ErrorKind::kOutput, name + ": cannot be created: " + std::strerror(errno));
  path_ = name;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace remap
