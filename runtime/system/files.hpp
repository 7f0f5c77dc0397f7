// Reads and writes files. A result appears under its final name complete or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace remap {

// The whole file as bytes. Throws kInput with the reason of the system if it cannot be read.
std::string read_file(const std::filesystem::path& path);

// A hidden name in the folder of `path` for an unfinished file. It has the same extension, by which image
// writers choose the format, and includes the process id.
std::filesystem::path unfinished_name(const std::filesystem::path& path);

// Renames the finished file to its final name. On failure it removes `unfinished` and throws kOutput.
void commit_file(const std::filesystem::path& unfinished, const std::filesystem::path& path);

// Writes `content` under an unfinished name, checks the close and renames. Creates missing parent folders.
// Throws kOutput and then leaves an existing file unchanged.
void write_file(const std::filesystem::path& path, std::string_view content);

// Copies a file byte for byte and replaces `to`, which is complete or unchanged. Throws kInput if `from` is
// not a readable file, kOutput if the copy cannot be written.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Whether two names lead to the same file, which need not exist.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// Creates the folder of `path` if it does not exist. Throws kOutput on failure.
void create_parent(const std::filesystem::path& path);

}  // namespace remap
