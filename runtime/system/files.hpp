// Text files in and out. A result appears under its final name whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace remap {

// The whole file as bytes. Throws kInput, with the reason of the system, where it cannot be read.
std::string read_file(const std::filesystem::path& path);

// A name beside `path` for unfinished work: hidden, same extension (image writers choose the format by it),
// not taken by another process.
std::filesystem::path unfinished_name(const std::filesystem::path& path);

// Renames finished work to its final name. Throws kOutput, and removes `unfinished`, where that fails.
void commit_file(const std::filesystem::path& unfinished, const std::filesystem::path& path);

// Writes `content` under an unfinished name, checks the close, renames. Creates missing parent folders.
// Throws kOutput; the file that was there before is then as it was.
void write_file(const std::filesystem::path& path, std::string_view content);

// Copies the bytes of a file to a name that is complete or not there at all, replacing what was there. Throws
// kInput where `from` is no file that can be read, kOutput where the copy cannot be made.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Whether two names lead to one file, or would if it were there.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// Throws kOutput where the folder of `path` does not exist and cannot be made.
void create_parent(const std::filesystem::path& path);

}  // namespace remap
