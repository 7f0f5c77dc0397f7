#include "system/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include "remap/error.hpp"

namespace remap {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  if (fs::is_directory(path)) throw Error(ErrorKind::kInput, path.string() + ": is a folder, not a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(ErrorKind::kInput, path.string() + ": cannot be read: " + std::strerror(errno));
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad())
    throw Error(ErrorKind::kInput, path.string() + ": reading failed: " + std::strerror(errno));
  return std::move(content).str();
}

fs::path unfinished_name(const fs::path& path) {
  const std::string name =
      "." + path.stem().string() + ".unfinished-" + std::to_string(::getpid()) + path.extension().string();
  return path.parent_path() / name;
}

void commit_file(const fs::path& unfinished, const fs::path& path) {
  std::error_code failure;
  fs::rename(unfinished, path, failure);
  if (!failure) return;
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  throw Error(ErrorKind::kOutput, path.string() + ": cannot be written: " + failure.message());
}

void create_parent(const fs::path& path) {
  const fs::path parent = path.parent_path();
  if (parent.empty()) return;
  std::error_code failure;
  fs::create_directories(parent, failure);
  if (failure || !fs::is_directory(parent)) {
    const std::string reason = failure ? failure.message() : "not a folder";
    throw Error(ErrorKind::kOutput, parent.string() + ": folder cannot be created: " + reason);
  }
}

void write_file(const fs::path& path, std::string_view content) {
  create_parent(path);
  const fs::path unfinished = unfinished_name(path);
  std::FILE* file = std::fopen(unfinished.c_str(), "wb");
  if (file == nullptr)
    throw Error(ErrorKind::kOutput, path.string() + ": cannot be written: " + std::strerror(errno));
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int write_failure = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) {
    const int failure = written ? errno : write_failure;
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw Error(ErrorKind::kOutput, path.string() + ": cannot be written: " + std::strerror(failure));
  }
  commit_file(unfinished, path);
}

void copy_whole_file(const fs::path& from, const fs::path& to) {
  std::error_code failure;
  if (!fs::is_regular_file(from, failure))
    throw Error(ErrorKind::kInput,
                from.string() + ": cannot be copied: " + (failure ? failure.message() : "not a file"));
  const fs::path unfinished = unfinished_name(to);
  fs::copy_file(from, unfinished, fs::copy_options::overwrite_existing, failure);
  if (failure) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw Error(ErrorKind::kOutput,
                to.string() + ": cannot be copied from " + from.string() + ": " + failure.message());
  }
  commit_file(unfinished, to);
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  if (a == b || std::filesystem::equivalent(a, b, ignored)) return true;
  const std::filesystem::path canonical_a = std::filesystem::weakly_canonical(a, ignored),
                              canonical_b = std::filesystem::weakly_canonical(b, ignored);
  return !canonical_a.empty() && canonical_a == canonical_b;
}

}  // namespace remap
