// This file defines which files an asset may read, and which files are copied beside its result.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "texremap/plan/job.hpp"

namespace remap {

// A FileSource gives the bytes of a file that stays open, so the whole file can be read even if it is
// renamed.
class FileSource final : public ByteSource {
 public:
  // Throws kInput unless `path` leads to a regular file that can be read.
  explicit FileSource(const std::filesystem::path& path) : file_(path) {}

  std::uint64_t size() const override { return file_.size(); }
  std::string read(std::uint64_t begin, std::size_t count) const override;
  const InputFile& file() const { return file_; }

 private:
  InputFile file_;
};

// A FolderResources gives the files that the asset of a job may read, and the image library of the program.
class FolderResources final : public AssetResources {
 public:
  // `job` must outlive this object.
  explicit FolderResources(const AssetWork& job) : job_(job) {}
  std::unique_ptr<ByteSource> open(const std::string& path) const override;
  const ImageCodec& codec() const override;
  ImagePixels enlarged(const ImagePixels& pixels, std::size_t width, std::size_t height) const override;
  std::string image_prefix() const override { return job_.image_prefix; }

  // Return the path of a file that the asset names, and the path of the copy that the result names. Throw
  // kInput for a name that leads out of the root.
  std::filesystem::path input(const std::string& path) const;
  std::filesystem::path output(const std::string& path) const;

 private:
  const AssetWork& job_;
};

// A ResourceCopy is a file that the asset names, and its copy.
struct ResourceCopy {
  std::filesystem::path from, to;
};

struct ResourcePlan {
  std::vector<ResourceCopy> copies;   // files that must be copied to the result
  std::vector<std::string> warnings;  // name missing files that the asset uses
};

// Plans copies of the files that the asset names, so that the result finds them. If the result lies in the
// folder of the asset, it needs no copies. Throws kInput for a name that leads out of the root or to the
// asset itself, and for a name that texremap uses for its own files. Calls `require_free` for each file that
// a copy would replace. `require_free` throws if the file must not be replaced.
ResourcePlan plan_resources(const AssetWork& job, const std::vector<AssetResource>& resources,
                            const std::function<void(const std::filesystem::path&)>& require_free);

// Throws kInput.
bool have_same_bytes(const ByteSource& first, const ByteSource& second);

// Adds the bytes of the pieces, a megabyte at a time.
void add_pieces(NewFile& file, const std::vector<AssetPiece>& pieces, const ByteSource& source);

}  // namespace remap
