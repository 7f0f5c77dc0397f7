#include "assets/gltf/gltf_container.hpp"

#include <algorithm>
#include <limits>

#include "core/errors.hpp"
#include "core/json_spans.hpp"

namespace remap {
namespace {

constexpr std::string_view kMagic = "glTF";
constexpr std::uint64_t kHeaderSize = 12;

// Reads a little-endian number, as containers store them.
std::uint32_t number_in(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

std::string bytes_of(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

GlbChunk chunk_at(const ByteSource& source, std::uint64_t at, const std::string& context) {
  const std::uint64_t left = source.size() - at;
  if (left < kChunkHeaderSize)
    throw input_error(context + ": is cut off in the header of a chunk at byte " + std::to_string(at));
  const std::string header = source.read(at, kChunkHeaderSize);
  const std::uint64_t length = number_in(header, 0);
  if (length > left - kChunkHeaderSize)
    throw input_error(context + ": the chunk at byte " + std::to_string(at) + " should have " +
                      std::to_string(length) + " bytes, but the file ends after " +
                      std::to_string(left - kChunkHeaderSize) +
                      " (the file is cut off or damaged; copy or export it again)");
  return {number_in(header, 4), at, at + kChunkHeaderSize + length};
}

// Throws unless the file is as long as its header states.
void require_header(const ByteSource& source, const std::string& context) {
  if (source.size() < kHeaderSize)
    throw input_error(context + ": is cut off in its header (copy or export the file again)");
  const std::string header = source.read(0, kHeaderSize);
  if (const std::uint32_t version = number_in(header, 4); version != 2)
    throw input_error(context + ": is a GLB file of version " + std::to_string(version) +
                      ", but only version 2 can be read");
  if (const std::uint64_t length = number_in(header, 8); length != source.size())
    throw input_error(context + ": its header states " + std::to_string(length) +
                      " bytes, but the file has " + std::to_string(source.size()) +
                      " (the file is cut off or damaged; copy or export it again)");
}

std::string without_padding(std::string json, GltfContainer& container) {
  const std::size_t end = json.find_last_not_of(std::string_view(" \0", 2));
  const std::string_view padding = std::string_view(json).substr(end == std::string::npos ? 0 : end + 1);
  if (padding.find('\0') != std::string_view::npos)
    container.notes.emplace_back("the JSON is padded with zeros, but glTF requires spaces");
  json.resize(json.size() - padding.size());
  return json;
}

void require_short(std::uint64_t size, const std::string& context) {
  if (size > kLongestSpannedText)
    throw input_error(context + ": has " + std::to_string(size >> 20) + " MB of JSON; at most " +
                      std::to_string(kLongestSpannedText >> 20) +
                      " MB can be read (store buffers and images in separate files)");
}

}  // namespace

GltfContainer read_container(const ByteSource& source, const std::string& context) {
  GltfContainer container;
  container.is_binary = source.size() >= kMagic.size() && source.read(0, kMagic.size()) == kMagic;
  if (!container.is_binary) {
    require_short(source.size(), context);
    container.json = source.read(0, source.size());
    return container;
  }
  require_header(source, context);
  if (source.size() == kHeaderSize)
    throw input_error(context + ": has no JSON chunk (the file is damaged; export it again)");
  const GlbChunk json = chunk_at(source, kHeaderSize, context);
  if (json.type != kJsonChunk)
    throw input_error(context + ": its first chunk is not JSON (the file is damaged; export it again)");
  require_short(json.content_size(), context);
  for (std::uint64_t at = json.end; at < source.size();) {
    container.chunks.push_back(chunk_at(source, at, context));
    at = container.chunks.back().end;
  }
  container.json = without_padding(
      source.read(json.content_begin(), static_cast<std::size_t>(json.content_size())), container);
  return container;
}

std::uint64_t size_of(const std::vector<AssetPiece>& pieces) {
  std::uint64_t size = 0;
  for (const AssetPiece& piece : pieces)
    size += piece.bytes.empty() ? piece.end - piece.begin : piece.bytes.size();
  return size;
}

namespace {

void add_chunk(const GlbChunk& chunk, const BinaryTail& tail, std::vector<AssetPiece>& pieces) {
  const std::uint64_t size = tail.kept.value_or(chunk.content_size());
  const std::string gap((4 - size % 4) % 4, '\0'), end((4 - tail.appended.size() % 4) % 4, '\0');
  // with_json() has already refused files whose length needs more than 32 bits.
  const auto length = static_cast<std::uint32_t>(size + gap.size() + tail.appended.size() + end.size());
  pieces.push_back({bytes_of(length) + bytes_of(chunk.type), 0, 0});
  pieces.push_back({"", chunk.content_begin(), chunk.content_begin() + size});
  pieces.push_back({gap + tail.appended + end, 0, 0});
}

}  // namespace

std::vector<AssetPiece> with_json(const GltfContainer& container, const std::string& json,
                                  const BinaryTail& tail, const std::string& context) {
  if (!container.is_binary) return {{json, 0, 0}};
  std::vector<AssetPiece> pieces(1);
  std::string padded = json;
  padded.append((4 - json.size() % 4) % 4, ' ');
  for (const GlbChunk& chunk : container.chunks)
    if ((tail.kept || !tail.appended.empty()) && &chunk == &container.chunks.front())
      add_chunk(chunk, tail, pieces);
    else
      pieces.push_back({"", chunk.begin, chunk.end});
  const std::uint64_t size = kHeaderSize + kChunkHeaderSize + padded.size() + size_of(pieces);
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw output_error(
        context + ": would have " + std::to_string(size) +
        " bytes; a .glb holds less than 4 GiB (export the asset as .gltf with a .bin, then convert it)");
  pieces.front().bytes = std::string(kMagic) + bytes_of(2) + bytes_of(static_cast<std::uint32_t>(size)) +
                         bytes_of(static_cast<std::uint32_t>(padded.size())) + bytes_of(kJsonChunk) + padded;
  return pieces;
}

}  // namespace remap
