// This file records every file that a run writes, by its final name, with its owner. Names are planned before
// work starts, so that two sets or assets never write the same file.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <unordered_map>

namespace remap {

// Returns the name as macOS and Windows compare it: absolute, without `.` and `..`, and without case. It does
// not follow links.
std::string name_key(const std::filesystem::path& path);

class WrittenNames {
 public:
  // Reserves the name of a file for `owner`: an asset, a set, or the file that is copied. Returns the other
  // owner if the name is reserved already, otherwise an empty text. The program's own names are never free.
  // Safe to call from many threads.
  std::string take(const std::filesystem::path& path, const std::string& owner);

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, std::string> owners_;  // keyed by name_key()
};

// Returns a message that two owners would write the same file, and what to do.
std::string written_twice_text(const std::filesystem::path& path, const std::string& first,
                               const std::string& second);

}  // namespace remap
