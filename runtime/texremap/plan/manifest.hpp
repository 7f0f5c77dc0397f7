// This file reads and writes the manifest of a tree. It lists texture sets or assets, so that many processes
// can share one conversion without searching again. It has lines of JSON; the first describes the rest:
//
//   {"remap_manifest": 1, "version": "1.2.0", "root": "/library", "names": "", "sets": 2, "files": 5,
//    "bytes": 81234, "cost": 681234, "hash": "5c0e..."}
//   {"cost": 440617, "id": "props/chair", "folder": "props", "name": "chair", "bytes": 40617, "maps": [
//    {"file": "chair_rough.png", "habit": "...", "roles": {"all": "roughness"}, "bytes": 20308},
//    {"file": "chair_spec.<UDIM>.exr", ..., "tiles": [[1001, 20309]]}]}
//   {"unrecognised": "props/notes.png"}
//   {"problem": "props/secret: cannot be read: Permission denied"}
//
// If assets are listed, the first line has `"assets": 2` instead of sets, and the others are:
//
//   {"cost": 240617, "asset": "props/chair.gltf", "prefix": "", "bytes": 40617, "files": [
//    ["props/chair.gltf", 1203], ["props/wood.png", 39414]]}
//
// Entries are sorted by folder and name, by bytes, so that equal trees give equal manifests. `cost` comes
// first in the line of an entry, because a process that skips the entry reads no further.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sets/discovery.hpp"
#include "texremap/options/part.hpp"

namespace remap {

// This is what a small file costs to open, write and rename, in bytes of a large file (docs/farm.md).
inline constexpr std::uint64_t kCostOfFile = 200'000;

enum class ListedKind { kSets, kAssets };
inline constexpr NamedValues<ListedKind, 2> kListedKinds = {
    {{ListedKind::kSets, "sets"}, {ListedKind::kAssets, "assets"}}};
// Returns `set` or `asset`.
inline std::string noun_of(ListedKind kind) { return kind == ListedKind::kSets ? "set" : "asset"; }

// A ManifestHead is the first line of a manifest.
struct ManifestHead {
  std::string version;         // version of the program
  std::filesystem::path root;  // absolute path
  std::string names;           // hash of the file with names; empty for the built-in conventions
  ListedKind kind = ListedKind::kSets;
  std::size_t count = 0, file_count = 0;  // counts of sets or assets, and of their files
  std::uintmax_t bytes = 0;               // size of all files
  std::uint64_t cost = 0;  // bytes of the maps that a conversion may read, and kCostOfFile for each
  std::string hash;        // hash of the rest of this line and the following lines
};

struct ListedAsset {
  std::filesystem::path path;  // relative to the root
  std::string image_prefix;    // prefix of the new images beside the result; depends on the whole tree
  std::vector<std::filesystem::path> files;  // existing files that the asset names, relative to the root
};

// A TreeManifest holds the entries of a manifest, or of one part of it: the texture sets of a tree, or its
// assets.
struct TreeManifest {
  ManifestHead head;
  // Holds the texture sets, the sizes of all files, and the files that cannot be read. Files that cannot be
  // read, and images outside of sets, belong to part 1.
  Discovery found;
  std::vector<ListedAsset> assets;
  std::vector<std::uint64_t> costs;  // costs of the entries of the part
};

// Returns the part of `count` to which an entry belongs. The costs of all entries, one after another, are cut
// into `count` equal pieces. An entry belongs to the piece that has the middle of its cost.
std::size_t part_of_entry(std::uint64_t cost_before, std::uint64_t cost, const ManifestHead& head,
                          std::size_t count);

// Writes a manifest. An entry whose name JSON cannot hold (not UTF-8), or whose file cannot be examined,
// becomes a problem. Of the head of `tree`, only the kind is used. Throws kOutput.
ManifestHead write_manifest(const std::filesystem::path& file, const std::filesystem::path& root,
                            const std::string& names, TreeManifest tree);

// Reads a part of a manifest. Throws kInput, with what to do, if the file is not a manifest, is incomplete,
// has changed since it was written, or comes from another version of the program.
TreeManifest read_manifest(const std::filesystem::path& file, const Part& part);

// Refuses files that differ from the manifest, such as a file that is still being copied. Throws kInput.
using ListedSizes = std::map<std::filesystem::path, std::uintmax_t>;
void require_as_listed(const ListedSizes& files);

}  // namespace remap
