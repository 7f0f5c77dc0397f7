// Reads files whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace remap {

// The most bytes that read_file() reads unless it is told otherwise: 100 times the largest file of text that
// this project writes, and little enough for any machine that it runs on.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{256} << 20;

// The whole file as bytes. Apart from regular files it reads only pipes that the caller's shell has opened
// (/dev/stdin, /dev/fd/N, /proc/self/fd/N), which end when their writer does. Throws kInput with the reason
// of the system if it cannot be read, and for more than `largest` bytes.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest = kLargestFile);

}  // namespace remap
