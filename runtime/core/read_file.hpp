// This file reads whole files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace remap {

// Limits the bytes that read_file() reads by default. This is 100 times the size of the largest text file of
// remap, and fits into the memory of any machine that runs it.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;

// Returns the whole file as bytes. Besides regular files it reads only pipes that the caller's shell has
// opened (/dev/stdin, /dev/fd/N, /proc/self/fd/N), because such pipes end with their writer. Throws kInput
// with the system's reason if the file cannot be read, and for more than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest = kLargestFile);

}  // namespace remap
