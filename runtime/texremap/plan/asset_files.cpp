#include "texremap/plan/asset_files.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "sets/folder_walk.hpp"
#include "texture/image_library.hpp"
#include "texture/image_reader.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kCopiedAtOnce = std::uint64_t{1} << 20;

// Returns `path`, which is relative to `folder`, as a path relative to `root`. Throws kInput if it leads out
// of `root`.
fs::path below(const fs::path& folder, const fs::path& root, const std::string& path) {
  std::string slashes = path;
  std::ranges::replace(slashes, '\\', '/');
  const fs::path inner = folder.lexically_normal().lexically_relative(root.lexically_normal());
  for (const fs::path& place : {(inner / path).lexically_normal(), (inner / slashes).lexically_normal()})
    if (place.empty() || place.is_absolute() || *place.begin() == "..")
      throw input_error(display_path(path) + ": is outside the " +
                        (root.lexically_normal() == "." ? "current folder" : "folder " + display_path(root)) +
                        " (copy this file into the folder, or give a larger folder before the asset: "
                        "texremap convert FOLDER ASSET)");
  fs::path place = (inner / path).lexically_normal();
  if (std::ranges::any_of(place, is_own_name))
    throw input_error(display_path(path) + ": has a name that texremap uses for its own files (rename it)");
  return place;
}

}  // namespace

std::string FileSource::read(std::uint64_t begin, std::size_t count) const {
  std::string bytes(count, '\0');
  if (file_.read(begin, bytes.data(), count) < count)
    throw input_error(file_.path().string() +
                      ": became shorter while texremap read the file (run the command again)");
  return bytes;
}

std::unique_ptr<ByteSource> FolderResources::open(const std::string& path) const {
  return std::make_unique<FileSource>(input(path));
}

const ImageCodec& FolderResources::codec() const { return image_library().codec(); }

ImagePixels FolderResources::enlarged(const ImagePixels& pixels, std::size_t width,
                                      std::size_t height) const {
  return enlarged_pixels(pixels, width, height);
}

fs::path FolderResources::input(const std::string& path) const {
  return job_.input_root / below(folder_of_asset(job_.input), job_.input_root, path);
}

fs::path FolderResources::output(const std::string& path) const {
  return job_.output_root / below(folder_of_asset(job_.output), job_.output_root, path);
}

bool have_same_bytes(const ByteSource& first, const ByteSource& second) {
  if (first.size() != second.size()) return false;
  for (std::uint64_t at = 0; at < first.size(); at += kCopiedAtOnce) {
    const std::uint64_t count = std::min(kCopiedAtOnce, first.size() - at);
    if (first.read(at, count) != second.read(at, count)) return false;
  }
  return true;
}

void add_pieces(NewFile& file, const std::vector<AssetPiece>& pieces, const ByteSource& source) {
  for (const AssetPiece& piece : pieces) {
    file.add(piece.bytes);
    for (std::uint64_t at = piece.begin; at < piece.end; at += kCopiedAtOnce)
      file.add(source.read(at, std::min(kCopiedAtOnce, piece.end - at)));
  }
}

ResourcePlan plan_resources(const AssetWork& job, const std::vector<AssetResource>& resources,
                            const std::function<void(const fs::path&)>& require_free) {
  ResourcePlan plan;
  const FolderResources files(job);
  for (const AssetResource& resource : resources) {
    if (resource.kind == UriKind::kRemote) continue;
    const std::string context =
        display_path(job.input) + ": " + (resource.where.empty() ? "" : resource.where + ": ");
    if (resource.kind == UriKind::kAbsolute)
      throw input_error(context + display_path(resource.path) +
                        " is an absolute path (use a path relative to the asset)");
    fs::path source, target;
    try {
      source = files.input(resource.path);
      target = files.output(resource.path);
    } catch (const Error& error) {
      throw input_error(context + error.what());
    }
    std::error_code ignored;
    if (same_file(source, job.input))
      throw input_error(context + "refers to " + display_path(resource.path) +
                        " as an image or buffer, but this is the file itself (correct this reference)");
    if (!fs::is_regular_file(source, ignored)) {
      plan.warnings.push_back("refers to " + display_path(resource.path) + ", which was not found");
      continue;
    }
    if (same_file(source, target)) continue;
    if (fs::is_regular_file(target, ignored)) {
      if (have_same_bytes(FileSource(source), FileSource(target))) continue;
      require_free(target);
    }
    plan.copies.push_back({source, target});
  }
  return plan;
}

}  // namespace remap
