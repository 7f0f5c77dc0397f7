// Reads and writes whole pictures as floats.
#include <functional>

#include <OpenImageIO/filesystem.h>

#include "remap/error.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// The description of a file of `type` with the picture.
OIIO::ImageSpec spec_of(const Picture& picture, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()), type);
  spec.channelnames = picture.channels;
  return spec;
}

// Writes to a temporary name, lets `is_whole` check that file, then renames it.
void write_picture(const fs::path& path, const Picture& picture, const OIIO::ImageSpec& spec,
                   const std::function<bool(const fs::path&)>& is_whole) {
  create_parent(path);
  const fs::path unfinished = unfinished_name(path);
  const auto output = OIIO::ImageOutput::create(unfinished.string());
  const bool written = output && output->open(unfinished.string(), spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, picture.values.data()) && output->close();
  if (!written || !is_whole(unfinished)) {
    std::string reason = output ? output->geterror() : OIIO::geterror();
    if (reason.empty()) reason = "the file is incomplete";
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw Error(ErrorKind::kOutput,
                path.string() + ": cannot be written: " + with_final_name(reason, unfinished, path));
  }
  commit_file(unfinished, path);
}

}  // namespace

Picture read_picture(const fs::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorKind::kInput, path.string() + ": cannot be read: " + reason);
  };
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) refuse(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  Picture picture{spec.width, spec.height, spec.channelnames, {}};
  picture.values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  // OpenImageIO may read a truncated file without failing; only the pending error message shows it.
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data()) ||
      input->has_error())
    refuse(input->geterror());
  return picture;
}

void write_exr_picture(const fs::path& path, const Picture& picture,
                       const std::map<std::string, std::string>& attributes) {
  OIIO::ImageSpec spec = spec_of(picture, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [key, value] : attributes) spec.attribute(key, value);
  write_picture(path, picture, spec, [](const fs::path&) { return true; });
}

void write_png_picture(const fs::path& path, const Picture& picture) {
  const OIIO::ImageSpec spec = spec_of(picture, OIIO::TypeDesc::UINT8);
  // OpenImageIO's PNG writer does not report a full disk, so the file is read back before it is renamed.
  write_picture(path, picture, spec, [&](const fs::path& unfinished) {
    const auto input = OIIO::ImageInput::open(unfinished.string());
    std::vector<unsigned char> bytes(picture.values.size());
    return input && input->spec().image_bytes() == bytes.size() &&
           input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, bytes.data()) &&
           !input->has_error();
  });
}

std::string png_picture_bytes(const Picture& picture) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const OIIO::ImageSpec spec = spec_of(picture, OIIO::TypeDesc::UINT8);
  const auto output = OIIO::ImageOutput::create("memory.png", &memory);
  if (!output || !output->open("memory.png", spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, picture.values.data()) || !output->close())
    throw Error(ErrorKind::kOutput,
                "PNG image: cannot be encoded: " + (output ? output->geterror() : OIIO::geterror()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace remap
