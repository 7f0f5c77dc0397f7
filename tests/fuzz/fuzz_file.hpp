// The bytes of a fuzz target as a file, in memory, for readers that take a path.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace remap {

// Overwritten by each run of one target. `ending`: of its name.
inline std::filesystem::path fuzz_file(const std::uint8_t* data, std::size_t size,
                                       const std::string& ending = "") {
  const std::string path = "/dev/shm/remap-fuzz-" + std::to_string(::getpid()) + ending;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

}  // namespace remap
