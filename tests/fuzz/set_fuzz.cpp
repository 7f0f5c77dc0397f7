// Maps of a texture set, read to the last row. The last byte is none of the file: it chooses the extension,
// since a file may have the name of another format, whether the map is of roughness or of a color, and
// whether the channel R is named.
#include <array>

#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "texture/texture_set.hpp"

namespace {

constexpr std::array<const char*, 8> kExtensions = {"png", "jpg", "tif", "exr", "hdr", "webp", "bmp", "tga"};
// A small file may claim more. What a whole map takes is known before it is read.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;

void read_rows(remap::ImageReader& map) {
  for (int level = 0; level < map.level_count(); ++level) {
    map.select_level(level);
    const remap::ImageLayout& layout = map.layout();
    if (layout.row_bytes() > kMostBytes / static_cast<std::size_t>(layout.height)) continue;
    const int band = layout.tile_height > 0 ? layout.tile_height : 16;
    for (int row = 0; row < layout.height; row += band) {
      const int count = std::min(band, layout.height - row);
      std::vector<std::byte> texels(static_cast<std::size_t>(count) * layout.row_bytes());
      map.read_rows(row, count, texels.data());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)remap::image_library();  // otherwise a module that cannot be loaded would look like maps that are
                                 // refused
  if (size == 0) return -1;
  const unsigned choice = data[size - 1];
  const std::string extension = kExtensions[choice % kExtensions.size()];
  const std::filesystem::path file = remap::fuzz_file(data, size - 1, "_map." + extension);
  return remap::read_or_refuse([&] {
    remap::TextureSetRequest request;
    const bool is_color = (choice & 8u) != 0, names_channel = (choice & 64u) != 0;
    request.parameters[remap::Parameter::kRoughness].source = remap::ConstantValues{0.5f};
    remap::ParameterRequest& parameter =
        request.parameters[is_color ? remap::Parameter::kSpecular : remap::Parameter::kRoughness];
    parameter.source = remap::parameter_source("--map", file.string() + (names_channel ? ":R" : ""));
    parameter.factors = {0.5f};
    remap::TextureSet set = remap::open_texture_set(request);
    (void)remap::remarks(set);
    for (remap::ImageReader& map : set.maps) {
      (void)map.noted_metadata("remap");
      read_rows(map);
    }
  });
}
