// This file puts the bytes of a fuzz target into a file in memory, for functions that need a path.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace remap {

// Each run of one target overwrites the file. The name of the file ends with `ending`.
inline std::filesystem::path fuzz_file(const std::uint8_t* data, std::size_t size,
                                       const std::string& ending = "") {
  const std::string path = "/dev/shm/remap-fuzz-" + std::to_string(::getpid()) + ending;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  return path;
}

}  // namespace remap
