#include "texremap/asset_files.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "sets/folder_walk.hpp"
#include "texture/enlarged_pixels.hpp"
#include "texture/image_library.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kCopiedAtOnce = std::uint64_t{1} << 20;

bool are_same_files(const fs::path& a, const fs::path& b) {
  const FileSource first(a), second(b);
  if (first.size() != second.size()) return false;
  for (std::uint64_t at = 0; at < first.size(); at += kCopiedAtOnce) {
    const std::uint64_t count = std::min(kCopiedAtOnce, first.size() - at);
    if (first.read(at, count) != second.read(at, count)) return false;
  }
  return true;
}

}  // namespace

FileSource::FileSource(const fs::path& path)
    : path_((require_regular_file(path), path)), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (!file_.is_open()) throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", errno);
  std::error_code failure;
  size_ = fs::file_size(path, failure);
  if (failure) throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", failure.value());
}

std::string FileSource::read(std::uint64_t begin, std::size_t count) const {
  std::string bytes(count, '\0');
  for (std::size_t done = 0; done < count;) {
    const ::ssize_t got =
        ::pread(file_.get(), bytes.data() + done, count - done, static_cast<::off_t>(begin + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw system_error(ErrorKind::kInput, path_.string() + ": cannot be read", errno);
    if (got == 0) throw input_error(path_.string() + ": became shorter while it was read (try again)");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

fs::path folder_of_asset(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

const ImageCodec& FolderResources::codec() const { return image_library().codec(); }

ImagePixels FolderResources::enlarged(const ImagePixels& pixels, std::size_t width,
                                      std::size_t height) const {
  return enlarged_pixels(pixels, width, height);
}

bool have_same_bytes(const fs::path& file, std::string_view bytes) {
  const FileSource source(file);
  return source.size() == bytes.size() && source.read(0, bytes.size()) == bytes;
}

void write_pieces(const fs::path& path, const std::vector<AssetPiece>& pieces, const ByteSource& source) {
  NewFile file(path);
  for (const AssetPiece& piece : pieces) {
    file.add(piece.bytes);
    for (std::uint64_t at = piece.begin; at < piece.end; at += kCopiedAtOnce)
      file.add(source.read(at, std::min(kCopiedAtOnce, piece.end - at)));
  }
  file.commit();
}

ResourcePlan plan_resources(const fs::path& input, const fs::path& output,
                            const std::vector<AssetResource>& resources, bool force) {
  ResourcePlan plan;
  const fs::path from = folder_of_asset(input), to = folder_of_asset(output);
  const bool is_same_folder = same_file(from, to);
  for (const AssetResource& resource : resources) {
    if (resource.kind == UriKind::kRemote) continue;
    if (resource.kind == UriKind::kOutside)
      throw input_error(shown(input) + ": " + resource.where + ": " + shown(resource.path) +
                        " leads out of the folder of the asset (copy it into this folder)");
    const fs::path source = from / resource.path, target = to / resource.path;
    std::error_code ignored;
    if (same_file(source, input))
      throw input_error(shown(input) + ": " + shown(resource.path) + " names the asset itself as its part");
    if (!fs::is_regular_file(source, ignored)) {
      plan.warnings.push_back("names " + shown(resource.path) + ", which is not there");
      continue;
    }
    if (is_same_folder || same_file(source, target)) continue;
    if (fs::is_regular_file(target, ignored)) {
      if (are_same_files(source, target)) continue;
      require_new(target, force);
    }
    plan.copies.push_back({source, target});
  }
  return plan;
}

}  // namespace remap
