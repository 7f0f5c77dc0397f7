#include "support/test_image.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace remap {
namespace {

void require(bool done, const std::string& message) {
  if (!done) throw std::runtime_error(message);
}

template <typename Integer>
void divide(TestImage& image) {
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    Integer stored;
    std::memcpy(&stored, image.bytes.data() + i * sizeof stored, sizeof stored);
    image.values[i] = static_cast<float>(stored) / static_cast<float>(std::numeric_limits<Integer>::max());
  }
}

}  // namespace

OIIO::ImageSpec test_spec(int width, int height, const std::vector<std::string>& channels,
                          OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), type);
  spec.channelnames = channels;
  const auto alpha = std::find(channels.begin(), channels.end(), "A");
  spec.alpha_channel = alpha == channels.end() ? -1 : static_cast<int>(alpha - channels.begin());
  spec.attribute("oiio:UnassociatedAlpha", 1);
  return spec;
}

void write_image(const std::filesystem::path& path, const OIIO::ImageSpec& spec, const TexelFunction& texel) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x)
      for (int c = 0; c < spec.nchannels; ++c) values.push_back(texel(x, y, c));
  const auto output = OIIO::ImageOutput::create(path.string());
  require(output != nullptr, "no writer for " + path.string());
  require(output->open(path.string(), spec), output->geterror());
  require(output->write_image(OIIO::TypeFloat, values.data()), output->geterror());
  require(output->close(), output->geterror());
}

TestImage read_image(const std::filesystem::path& path) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path.string(), &hints);
  require(input != nullptr, path.string() + ": " + OIIO::geterror());
  TestImage image;
  image.spec = input->spec();
  const int channels = image.spec.nchannels;
  image.values.resize(static_cast<std::size_t>(image.spec.width * image.spec.height * channels));
  image.bytes.resize(image.spec.image_bytes(true));
  require(input->read_image(0, 0, 0, channels, OIIO::TypeFloat, image.values.data()), input->geterror());
  require(input->read_image(0, 0, 0, channels, OIIO::TypeUnknown, image.bytes.data()), input->geterror());
  // Divide exactly, because OpenImageIO multiplies by a rounded 1 / 255 and tests compare to the last bit.
  if (image.spec.format == OIIO::TypeUInt8) divide<std::uint8_t>(image);
  if (image.spec.format == OIIO::TypeUInt16) divide<std::uint16_t>(image);
  return image;
}

bool same_channel(const TestImage& a, const TestImage& b, int channel) {
  if (a.values.size() != b.values.size()) return false;
  for (int y = 0; y < a.spec.height; ++y)
    for (int x = 0; x < a.spec.width; ++x)
      if (a.at(x, y, channel) != b.at(x, y, channel)) return false;
  return true;
}

}  // namespace remap
