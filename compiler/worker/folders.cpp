#include "worker/folders.hpp"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <unistd.h>

#include "core/errors.hpp"
#include "core/files.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

const std::string kPrefix = "remap-pictures-";

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Returns a folder of the XDG base directory specification.
fs::path user_folder(const char* name, const char* below_home) {
  // The specification requires that relative paths are ignored.
  if (const fs::path folder = variable(name); folder.is_absolute()) return folder;
  return fs::path(variable("HOME")) / below_home;
}

bool is_writable_folder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder, ignored) && ::access(folder.c_str(), W_OK) == 0;
}

fs::path folder_in_memory() {
  const fs::path memory = "/dev/shm";
  return is_writable_folder(memory) ? memory : fs::temp_directory_path();
}

// Returns the mark of a process in the name of a private folder. It stands before the six letters that make
// the name unique.
std::string_view mark_in(std::string_view name) {
  const std::size_t end = name.rfind('-');
  if (!name.starts_with(kPrefix) || end == std::string_view::npos || end <= kPrefix.size()) return {};
  return name.substr(kPrefix.size(), end - kPrefix.size());
}

void remove_abandoned(const fs::path& parent) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, ignored))
    if (is_stale_owner(mark_in(entry.path().filename().string()))) fs::remove_all(entry.path(), ignored);
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

fs::path shipped_worker_list() { return installed(REMAP_INSTALLED_WORKERS "/workers.json"); }

PrivateFolder::PrivateFolder(const fs::path& given) {
  const fs::path parent = given.empty() ? folder_in_memory() : fs::absolute(given);
  if (!is_writable_folder(parent))
    throw output_error(parent.string() + ": is not a writable folder (create it, or choose another folder)");
  remove_abandoned(parent);
  std::string name = (parent / (kPrefix + owner_tag() + "-XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw output_error(name + ": cannot be created: " + std::strerror(errno));
  path_ = name;
}

// Deletes the folder several times, because a process on another machine may write a last file meanwhile.
PrivateFolder::~PrivateFolder() {
  constexpr int kTries = 10;
  std::error_code failure;
  for (int i = 0; i < kTries; ++i) {
    fs::remove_all(path_, failure);
    if (!failure) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

}  // namespace remap
