// This file reads and writes the two forms of a glTF 2.0 file: .gltf is JSON, .glb is a container of chunks
// (glTF 2.0, section 4). Only the JSON is in memory. All other bytes are ranges of the source.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;  // "JSON", "BIN\0"

inline constexpr std::uint64_t kChunkHeaderSize = 8;

// A GlbChunk is a chunk of a container. The range includes its header.
struct GlbChunk {
  std::uint32_t type = 0;
  std::uint64_t begin = 0, end = 0;

  std::uint64_t content_begin() const noexcept { return begin + kChunkHeaderSize; }
  std::uint64_t content_size() const noexcept { return end - content_begin(); }
};

struct GltfContainer {
  std::string json;  // without the padding of a container
  bool is_binary = false;
  std::vector<GlbChunk> chunks;    // after the JSON, in order
  std::vector<std::string> notes;  // unusual parts that are accepted

  // Returns the chunk of buffer 0, or null.
  const GlbChunk* binary_chunk() const noexcept {
    return chunks.empty() || chunks.front().type != kBinaryChunk ? nullptr : &chunks.front();
  }
};

// Reads a file of either form. It compares every length with the file before it allocates memory. Throws
// kInput, beginning with `context`, for a container that is cut off or whose lengths contradict each other.
GltfContainer read_container(const ByteSource& source, const std::string& context);

// A BinaryTail is the new end of the binary chunk.
struct BinaryTail {
  std::optional<std::uint64_t> kept;  // number of bytes at the start that stay; if unset, all
  std::string appended;               // starts at the next multiple of four
};

// Returns the file with new JSON. Chunks keep their order. The binary chunk gets the new tail. Throws
// kOutput, beginning with `context`, if a container would have 4 GiB or more.
std::vector<AssetPiece> with_json(const GltfContainer& container, const std::string& json,
                                  const BinaryTail& tail, const std::string& context);

// Returns the length of a result.
std::uint64_t size_of(const std::vector<AssetPiece>& pieces);

}  // namespace remap
