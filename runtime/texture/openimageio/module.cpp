// This file holds the function of the module that a program calls.
#include "remap/version.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace {

class OpenImageIo : public ImageLibrary {
 public:
  void set_limits(int threads, std::uint64_t memory_bytes) const override {
    if (memory_bytes > 0) set_image_memory(memory_bytes);
    if (threads == 0) return;
    OIIO::attribute("threads", threads);
    // With -1, OpenEXR works in the calling thread. With 1, it would start a thread, and the caller would
    // wait.
    OIIO::attribute("exr_threads", threads == 1 ? -1 : threads);
  }
  std::unique_ptr<StoredImage> open(const std::filesystem::path& path, int part) const override {
    return open_image(std::make_shared<const InputFile>(path), part);
  }
  std::unique_ptr<StoredImage> open_part(const std::shared_ptr<const InputFile>& file,
                                         int part) const override {
    return open_image(file, part);
  }
  std::unique_ptr<NewImage> create(const std::filesystem::path& path,
                                   const std::vector<NewPart>& parts) const override {
    return create_image(path, parts);
  }
  Picture read_picture(const std::filesystem::path& path) const override { return remap::read_picture(path); }
  void write_exr(const std::filesystem::path& path, const Picture& picture,
                 const std::map<std::string, std::string>& attributes) const override {
    write_exr_picture(path, picture, attributes);
  }
  void write_png(const std::filesystem::path& path, const Picture& picture) const override {
    write_png_picture(path, picture);
  }
  const ImageCodec& codec() const override { return asset_codec(); }
  std::string png_bytes(const Picture& picture) const override { return png_picture_bytes(picture); }
};

}  // namespace

// This is the only symbol that the module exports.
extern "C" __attribute__((visibility("default"))) const ImageLibrary* remap_image_library(
    const char* version) {
  static const OpenImageIo library;
  return std::string(version) == kVersion ? &library : nullptr;
}

}  // namespace remap
