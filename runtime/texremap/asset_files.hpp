// Assets and what lies beside them, as files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/asset.hpp"
#include "core/open_file.hpp"

namespace remap {

// The bytes of a file that stays open: it is read to its end even where its name is given to another.
class FileSource final : public ByteSource {
 public:
  // Throws kInput unless `path` leads to a regular file that can be read.
  explicit FileSource(const std::filesystem::path& path);

  std::uint64_t size() const override { return size_; }
  std::string read(std::uint64_t begin, std::size_t count) const override;

 private:
  std::filesystem::path path_;
  OpenFile file_;
  std::uint64_t size_ = 0;
};

// Files in the folder of an asset, and the image library of the program.
class FolderResources final : public AssetResources {
 public:
  explicit FolderResources(std::filesystem::path folder) : folder_(std::move(folder)) {}
  std::unique_ptr<ByteSource> open(const std::string& path) const override {
    return std::make_unique<FileSource>(folder_ / path);
  }
  const ImageCodec& codec() const override;
  ImagePixels enlarged(const ImagePixels& pixels, std::size_t width, std::size_t height) const override;

 private:
  std::filesystem::path folder_;
};

// The folder that the files of an asset are relative to.
std::filesystem::path folder_of_asset(const std::filesystem::path& asset);

// Whether the file holds these bytes. Throws kInput.
bool have_same_bytes(const std::filesystem::path& file, std::string_view bytes);

// Writes a result, a megabyte at a time, complete or not at all. Throws kOutput.
void write_pieces(const std::filesystem::path& path, const std::vector<AssetPiece>& pieces,
                  const ByteSource& source);

// A file that the asset names, and its copy.
struct ResourceCopy {
  std::filesystem::path from, to;
};

struct ResourcePlan {
  std::vector<ResourceCopy> copies;   // that are missing beside the result
  std::vector<std::string> warnings;  // files that the asset names and that are not there
};

// What must be copied so that `output` finds the files that `input` names; nothing in one folder. Throws
// kInput for a name that leads out of the folder of the asset or to the asset itself, kOutput where another
// file has the name of a copy, unless `force`.
ResourcePlan plan_resources(const std::filesystem::path& input, const std::filesystem::path& output,
                            const std::vector<AssetResource>& resources, bool force);

}  // namespace remap
