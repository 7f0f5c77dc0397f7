// The two forms of a glTF 2.0 file: .gltf is JSON, .glb a container of chunks (glTF 2.0, section 4). Only the
// JSON is held in memory; all other bytes are ranges of the source.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;  // "JSON", "BIN\0"

inline constexpr std::uint64_t kChunkHeaderSize = 8;

// A chunk after the JSON. The range holds its header.
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
  std::vector<std::string> notes;  // what is unusual, and read nevertheless

  // The chunk of buffer 0; null without one.
  const GlbChunk* binary_chunk() const noexcept {
    return chunks.empty() || chunks.front().type != kBinaryChunk ? nullptr : &chunks.front();
  }
};

// Reads a file of either form. Every length is compared with the file before anything is allocated. Throws
// kInput, beginning with `context`, for a container that is cut off or whose lengths contradict each other.
GltfContainer read_container(const ByteSource& source, const std::string& context);

// The new end of the binary chunk.
struct BinaryTail {
  std::optional<std::uint64_t> kept;  // bytes from its start; none for all
  std::string appended;               // from the next multiple of four
};

// The file with other JSON: chunks stay in their order, the binary one with another tail. Throws kOutput,
// beginning with `context`, for 4 GiB or more, which a container cannot hold.
std::vector<AssetPiece> with_json(const GltfContainer& container, const std::string& json,
                                  const BinaryTail& tail, const std::string& context);

// The length of a result.
std::uint64_t size_of(const std::vector<AssetPiece>& pieces);

}  // namespace remap
