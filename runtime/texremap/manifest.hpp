// The manifest of a tree: its texture sets as an index in a file, by which many processes share one
// conversion without looking for the sets again. Lines of JSON; the first describes the rest:
//
//   {"remap_manifest": 1, "version": "1.2.0", "root": "/library", "names": "", "sets": 2, "files": 5,
//    "bytes": 81234, "cost": 681234, "hash": "5c0e..."}
//   {"cost": 440617, "id": "props/chair", "folder": "props", "name": "chair", "bytes": 40617, "maps":
//   [{"file":
//    "chair_rough.png", "habit": "...", "roles": {"all": "roughness"}, "bytes": 20308}, {"file":
//    "chair_spec.<UDIM>.exr", ..., "tiles": [[1001, 20309]]}]}
//   {"unrecognised": "props/notes.png"}
//   {"problem": "props/secret: cannot be read: Permission denied"}
//
// Sets are sorted by folder and name, by bytes, so that equal trees give equal manifests. `cost` stands first
// in the line of a set: a process that converts a part of the sets reads no more of the others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sets/discovery.hpp"
#include "texremap/part.hpp"

namespace remap {

// What opening, writing and naming a small file costs, in bytes of a large one: measured, docs/farm.md.
inline constexpr std::uint64_t kCostOfFile = 200'000;

// What the first line says.
struct ManifestHead {
  std::string version;         // of the program
  std::filesystem::path root;  // absolute
  std::string names;           // hash of the file with names; empty for the built-in habits
  std::size_t set_count = 0, file_count = 0;
  std::uintmax_t bytes = 0;  // of all files
  std::uint64_t cost = 0;    // bytes of the maps that a conversion may read, and kCostOfFile for each
  std::string hash;          // of the rest of this line, and of those that follow
};

struct SetManifest {
  ManifestHead head;
  // The sets of the part that was asked for, with the sizes of their files. Problems, and images of no set,
  // belong to part 1.
  Discovery found;
  std::vector<std::uint64_t> costs;  // of the sets of the part
};

// The part of `count` to which a set belongs: in whose share of the whole cost its middle lies.
std::size_t part_of_set(std::uint64_t cost_before, std::uint64_t cost, const ManifestHead& head,
                        std::size_t count);

// Writes a manifest of `found`. A set whose name JSON cannot hold (no UTF-8), and one with a file that cannot
// be looked at, becomes a problem. Throws kOutput.
ManifestHead write_manifest(const std::filesystem::path& file, const std::filesystem::path& root,
                            const std::string& names, Discovery found);

// Reads a part of a manifest. Throws kInput, with what to do, if the file is none, incomplete, changed since
// it was written, or of another version of the program.
SetManifest read_manifest(const std::filesystem::path& file, const Part& part);

}  // namespace remap
