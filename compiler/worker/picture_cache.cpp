// This file stores pictures. The first line of a file is the request and the renderer's version. The second
// line is the checksum of the first line and of the picture. The picture follows as raw floats. The name of
// the file is a hash of the first line. Two requests may have the same hash, so the line is compared. The
// checksum covers every byte, so a damaged file is not used.
#include "worker/picture_cache.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "worker/protocol.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

// Returns FNV-1a, 64 bits (Fowler, Noll, Vo 1991). Changing a single byte always changes it.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::string hexadecimal(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15u];
  return text;
}

constexpr std::size_t kChecksumBytes = 17;  // 16 digits and the line break

std::string checksum_line(std::string_view line, std::string_view picture) {
  return hexadecimal(hash_of(std::string(line) += picture)) + "\n";
}

// Makes a file name by which a person recognises the text.
std::string folder_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.';
    if (kept || (!name.empty() && name.back() != '-')) name += kept ? c : '-';
  }
  return name.substr(0, 60);
}

std::size_t picture_bytes(const PictureRequest& request) {
  const auto side = static_cast<std::size_t>(request.resolution);
  return side * side * static_cast<std::size_t>(request.channels) * sizeof(float);
}

}  // namespace

PictureCache::PictureCache(const fs::path& folder, const std::string& worker, const std::string& renderer)
    : key_opening_("remap picture 2; protocol " + std::to_string(kWorkerProtocol) + "; " + renderer + "; "),
      worker_folder_(folder / folder_name(worker.empty() ? "unnamed" : worker)),
      folder_(worker_folder_ / (folder_name(renderer) + "-" + hexadecimal(hash_of(renderer)).substr(0, 8))) {}

fs::path PictureCache::file_of(const PictureRequest& request) const {
  const std::string name = hexadecimal(hash_of(key_opening_ + request.text));
  return folder_ / name.substr(0, 2) / (name + ".picture");
}

std::optional<Image> PictureCache::find(const PictureRequest& request, std::string& damage) const {
  const fs::path path = file_of(request);
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) return std::nullopt;
  const std::string line = key_opening_ + request.text + "\n";
  const std::size_t expected = line.size() + kChecksumBytes + picture_bytes(request);
  const auto damaged = [&](const std::string& what) {
    damage = path.string() + ": " + what;
    return std::nullopt;
  };
  std::string content;
  try {
    content = read_file(path);
  } catch (const Error& error) {
    damage = error.what();
    return std::nullopt;
  }
  const std::size_t end = content.find('\n') + 1;
  if (end == 0 || content.size() < end + kChecksumBytes) return damaged("the file is cut short");
  const std::string_view picture = std::string_view(content).substr(end + kChecksumBytes);
  if (content.compare(end, kChecksumBytes, checksum_line(content.substr(0, end), picture)) != 0)
    return damaged("its checksum does not match its content");
  if (content.compare(0, end, line) != 0) return std::nullopt;  // another request with the same hash
  if (content.size() != expected) return damaged("it has a picture of another size");
  Image image{request.resolution, request.resolution, request.channels,
              std::vector<float>(picture_bytes(request) / sizeof(float))};
  std::memcpy(image.values.data(), picture.data(), picture.size());
  if (const std::string fault = picture_fault(image); !fault.empty()) return damaged(fault);
  return image;
}

void PictureCache::keep(const PictureRequest& request, const Image& image) const {
  const std::string line = key_opening_ + request.text + "\n";
  const std::string_view picture(reinterpret_cast<const char*>(image.values.data()), picture_bytes(request));
  // Two threads never write the same picture at once (WorkerRenderer), so the temporary name is unique.
  write_file(file_of(request), line + checksum_line(line, picture) + std::string(picture), Flush::kNo);
}

std::vector<std::string> PictureCache::other_versions() const {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(worker_folder_, ignored))
    if (entry.path().filename() != folder_.filename()) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace remap
