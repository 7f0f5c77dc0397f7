// This target reads maps of a texture set to the last row. The last byte of the input is not part of the
// file. It chooses the extension (a file may have the name of another format), whether the map is roughness
// or a color, whether the channel R is given, whether there is another map, and whether the map is enlarged
// to its size. If the input is one line of text, it is also the value of an option: numbers, or channels of a
// file.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <unistd.h>

#include "core/plain_text.hpp"
#include "fuzz/fuzz.hpp"
#include "fuzz/fuzz_file.hpp"
#include "texture/texture_set.hpp"

namespace {

constexpr std::array<const char*, 8> kExtensions = {"png", "jpg", "tif", "exr", "hdr", "webp", "bmp", "tga"};
// These are bits of the last byte. A color that is not specular is diffuse.
enum : unsigned { kIsColor = 8, kIsSpecular = 16, kIsResampled = 32, kNamesChannel = 64, kHasOther = 128 };
// A small file may claim a large image. The size of a whole map is known before it is read.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;
constexpr std::size_t kLongestOption = 200;

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

void read_set(const remap::TextureSetRequest& request) {
  remap::TextureSet set = remap::open_texture_set(request);
  (void)remap::remarks(set);
  for (const std::size_t map : set.maps_of_material())
    if (map >= set.maps.size()) std::abort();
  for (remap::ImageReader& map : set.maps) {
    (void)map.noted_metadata("remap");
    read_rows(map);
  }
  remap::require_scale(set, remap::RoughnessEncoding::kExponent);
}

// Returns a grey Targa file of 8 x 8 equal texels.
std::string other_map() {
  constexpr std::array<std::uint8_t, 18> kHead = {0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 8, 0, 8, 0};
  static const std::string path = [&] {
    std::string bytes(kHead.begin(), kHead.end());
    bytes.append(64, 'x');
    const std::string name = "/dev/shm/remap-fuzz-" + std::to_string(::getpid()) + "_other.tga";
    std::ofstream(name, std::ios::binary) << bytes;
    return name;
  }();
  return path;
}

void read_option(const std::string& text) {
  auto source = remap::parameter_source("--roughness", text);
  if (auto* map = std::get_if<remap::MapName>(&source)) map->file = other_map();
  remap::TextureSetRequest request;
  request.parameters[remap::Parameter::kRoughness].source = source;
  request.parameters[remap::Parameter::kSpecular].source = source;
  request.carried.push_back({"occlusion", {source, {}, {}}});
  read_set(request);
}

void read_factors(const std::string& text) {
  remap::TextureSetRequest request;
  remap::ParameterRequest& roughness = request.parameters[remap::Parameter::kRoughness];
  roughness.source = remap::parameter_source("--roughness", other_map());
  roughness.factors = remap::parse_factors("--factor", text);
  read_set(request);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A module that cannot be loaded would otherwise look like maps that are refused.
  (void)remap::image_library();
  if (size == 0) return -1;
  const std::string_view text = remap::text_of(data, size);
  if (size <= kLongestOption && remap::is_plain_text(text)) {
    remap::read_or_refuse([&] { read_option(std::string(text)); });
    return remap::read_or_refuse([&] { read_factors(std::string(text)); });
  }
  const unsigned choice = data[size - 1];
  const std::string extension = kExtensions[choice % kExtensions.size()];
  const std::filesystem::path file = remap::fuzz_file(data, size - 1, "_map." + extension);
  return remap::read_or_refuse([&] {
    remap::TextureSetRequest request;
    const std::string channel = (choice & kNamesChannel) != 0 ? ":R" : "";
    request.parameters[remap::Parameter::kRoughness].source = remap::ConstantValues{0.5f};
    const remap::Parameter color =
        (choice & kIsSpecular) != 0 ? remap::Parameter::kSpecular : remap::Parameter::kDiffuse;
    remap::ParameterRequest& parameter =
        request.parameters[(choice & kIsColor) != 0 ? color : remap::Parameter::kRoughness];
    parameter.source = remap::parameter_source("--map", file.string() + channel);
    parameter.factors = {0.5f};
    if ((choice & kHasOther) != 0) {
      request.parameters[remap::Parameter::kMetallic].source =
          remap::parameter_source("--metallic", other_map());
      request.resample = (choice & kIsResampled) != 0;
    }
    read_set(request);
  });
}
