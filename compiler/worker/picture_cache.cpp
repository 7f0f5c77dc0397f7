// A file holds one line of text, the request and the renderer's version, then the picture as raw floats. Its
// name is a hash of that line. Since the line is compared, requests of equal hash are not confused.
#include "worker/picture_cache.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <thread>

#include "remap/error.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

namespace fs = std::filesystem;

// FNV-1a, 64 bits (Fowler, Noll, Vo 1991).
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::string hexadecimal(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15u];
  return text;
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

// The sizes of a picture and of its line in bytes.
std::size_t picture_bytes(const PictureRequest& request) {
  const auto side = static_cast<std::size_t>(request.resolution);
  return side * side * static_cast<std::size_t>(request.channels) * sizeof(float);
}

}  // namespace

PictureCache::PictureCache(const fs::path& folder, const std::string& worker, const std::string& renderer)
    : key_opening_("remap picture 1; protocol " + std::to_string(kWorkerProtocol) + "; " + renderer + "; "),
      worker_folder_(folder / folder_name(worker.empty() ? "unnamed" : worker)),
      folder_(worker_folder_ / (folder_name(renderer) + "-" + hexadecimal(hash_of(renderer)).substr(0, 8))) {}

fs::path PictureCache::file_of(const PictureRequest& request) const {
  const std::string name = hexadecimal(hash_of(key_opening_ + request.text));
  return folder_ / name.substr(0, 2) / (name + ".picture");
}

std::optional<Image> PictureCache::find(const PictureRequest& request) const {
  const fs::path path = file_of(request);
  std::error_code failure;
  const auto size = fs::file_size(path, failure);
  const std::string line = key_opening_ + request.text + "\n";
  if (failure || size != line.size() + picture_bytes(request)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::string found(line.size(), '\0');
  Image image{request.resolution, request.resolution, request.channels,
              std::vector<float>(picture_bytes(request) / sizeof(float))};
  if (!file.read(found.data(), static_cast<std::streamsize>(found.size())) || found != line)
    return std::nullopt;
  if (!file.read(reinterpret_cast<char*>(image.values.data()),
                 static_cast<std::streamsize>(picture_bytes(request))))
    return std::nullopt;
  return image;
}

void PictureCache::keep(const PictureRequest& request, const Image& image) const {
  std::string content = key_opening_ + request.text + "\n";
  const std::size_t start = content.size();
  content.resize(start + picture_bytes(request));
  std::memcpy(content.data() + start, image.values.data(), picture_bytes(request));
  // Two threads never keep the same picture at once (WorkerRenderer), so the temporary name is unique.
  remap::write_file(file_of(request), content);
}

std::vector<std::string> PictureCache::other_versions() const {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(worker_folder_, ignored))
    if (entry.path().filename() != folder_.filename()) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace remapc
