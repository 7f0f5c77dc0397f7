#include "sweep/image_file.hpp"

#include <OpenImageIO/imageio.h>

#include "error.hpp"
#include "files.hpp"

namespace remapc {

void write_exr(const std::filesystem::path& path, const Image& image,
               const std::map<std::string, std::string>& attributes) {
  using remap::Error;
  using remap::ErrorKind;
  if (path.extension() != ".exr")
    throw Error(ErrorKind::kUsage, path.string() + ": has not the extension .exr; expected an OpenEXR file");
  remap::create_parent(path);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [key, value] : attributes) spec.attribute(key, value);

  const std::filesystem::path unfinished = remap::unfinished_name(path);
  const auto output = OIIO::ImageOutput::create(unfinished.string());
  const bool written = output && output->open(unfinished.string(), spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) && output->close();
  if (!written) {
    const std::string reason = output ? output->geterror() : OIIO::geterror();
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw Error(ErrorKind::kOutput, path.string() + ": cannot be written: " + reason);
  }
  remap::commit_file(unfinished, path);
}

}  // namespace remapc
