// This file reads and writes whole pictures as floats.
#include <OpenImageIO/filesystem.h>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "texture/openimageio/image_head.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

OIIO::ImageSpec spec_of(const Picture& picture, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()), type);
  spec.channelnames = picture.channels;
  return spec;
}

std::string encoded(const Picture& picture, const OIIO::ImageSpec& spec, const std::string& name) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(name);
  if (!output || !output->set_ioproxy(&memory) || !output->open(name, spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, picture.values.data()) || !output->close())
    throw Error(ErrorKind::kOutput,
                name + ": cannot be encoded: " + (output ? output->geterror() : OIIO::geterror()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Picture read_picture(const fs::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorKind::kInput, path.string() + ": cannot be read: " + reason);
  };
  const auto file = std::make_shared<const InputFile>(path);
  const ImageBytes bytes{file->size(), [&](std::uint64_t place, char* into, std::size_t count) {
                           return file->read(place, into, count);
                         }};
  const ImageHead head = checked_head(bytes, path.string());
  const auto input = OIIO::ImageInput::create(head.format, false);
  OIIO::ImageSpec spec;
  if (!input || !input->open(path.string(), spec)) refuse(input ? input->geterror() : OIIO::geterror());
  require_plausible(spec, head, bytes, path.string());
  require_image_memory(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels) * sizeof(float),
                       path.string());
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
  write_file(path, encoded(picture, spec, path.filename().string()));
}

void write_png_picture(const fs::path& path, const Picture& picture) {
  write_file(path, png_picture_bytes(picture));
}

std::string png_picture_bytes(const Picture& picture) {
  return encoded(picture, spec_of(picture, OIIO::TypeDesc::UINT8), "picture.png");
}

}  // namespace remap
