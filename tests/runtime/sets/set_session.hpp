// This file makes a tree of empty files, and finds the sets in it.
#pragma once

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>

#include "sets/discovery.hpp"
#include "support/temporary_folder.hpp"

namespace remap {

class SetSession {
 public:
  SetSession() = default;
  SetSession(std::initializer_list<std::string> files) {
    for (const std::string& file : files) add(file);
  }

  const std::filesystem::path& root() const { return folder_.path(); }
  void add(const std::string& file) const {
    const std::filesystem::path path = root() / file;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path).put('x');
  }
  Discovery find(const WalkOptions& options = {}) const { return find_sets(root(), options); }

 private:
  TemporaryFolder folder_;
};

// Returns the set at `path` (folder and name). Throws if it was not found.
inline const FoundSet& set_at(const Discovery& discovery, const std::string& path) {
  for (const FoundSet& set : discovery.sets)
    if ((set.folder / set.name).string() == path) return set;
  throw std::runtime_error("no set " + path);
}

// Returns the only set of a discovery. Throws if there is another number of sets, or if it has another name.
inline const FoundSet& only_set(const Discovery& discovery, const std::string& path) {
  if (discovery.sets.size() != 1)
    throw std::runtime_error(std::to_string(discovery.sets.size()) + " sets, expected " + path + " alone");
  return set_at(discovery, path);
}

// Returns a use as text: `roughness in G of a_orm.png`, or `-` for none.
inline std::string use_text(const FoundSet& set, const std::optional<MapUse>& use) {
  if (!use) return "-";
  std::string text(role_name(use->role));
  if (use->channels != Channels::kWhole) text += " in " + std::string(name_of(kChannels, use->channels));
  return text + " of " + set.maps[use->map].path.string();
}

}  // namespace remap
