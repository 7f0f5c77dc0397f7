#include "texremap/plan/written_names.hpp"

#include "core/plain_text.hpp"
#include "core/safe_relative.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;

std::string name_key(const fs::path& path) {
  return without_case(fs::absolute(path).lexically_normal().generic_string());
}

std::string WrittenNames::take(const fs::path& path, const std::string& owner) {
  if (is_own_name(path.filename())) return "texremap itself";
  const std::string key = name_key(path);
  const std::lock_guard lock(mutex_);
  const auto [found, is_new] = owners_.try_emplace(key, owner);
  return is_new || found->second == owner ? std::string() : found->second;
}

std::string written_twice_text(const fs::path& path, const std::string& first, const std::string& second) {
  return display_path(path) + ": would be written twice, from " + first + " and from " + second +
         " (rename one, or convert them into two folders)";
}

}  // namespace remap
