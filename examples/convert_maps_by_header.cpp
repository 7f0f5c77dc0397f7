// This program converts maps by one generated header, and compares the result with maps that texremap
// converted. To build it: g++ -std=c++17 -O2 -ffp-contract=off -I generated
// examples/convert_maps_by_header.cpp -lOpenImageIO -lOpenImageIO_Util
#include <cstdio>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "mitsuba_ward_to_mitsuba_as.hpp"

namespace {

struct Map {
  std::size_t texel_count = 0, channels = 0;
  std::vector<float> values;  // channel by channel
};

bool read_map(const char* path, Map* map) {
  const auto file = OIIO::ImageInput::open(path);
  if (!file) return false;
  const OIIO::ImageSpec& spec = file->spec();
  map->channels = static_cast<std::size_t>(spec.nchannels);
  map->texel_count = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<float> texels(map->texel_count * map->channels);
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texels.data())) return false;
  map->values.resize(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i)
    map->values[i % map->channels * map->texel_count + i / map->channels] = texels[i];
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  Map roughness, specular, expected_roughness, expected_specular;
  if (argc != 5 || !read_map(argv[1], &roughness) || !read_map(argv[2], &specular) ||
      !read_map(argv[3], &expected_roughness) || !read_map(argv[4], &expected_specular) ||
      specular.channels != 3 || roughness.texel_count != specular.texel_count) {
    std::fprintf(stderr,
                 "usage: convert_maps_by_header ROUGHNESS SPECULAR CONVERTED_ROUGHNESS CONVERTED_SPECULAR\n"
                 "(maps of one size; specular in RGB)\n");
    return 2;
  }
  const std::size_t count = roughness.texel_count;
  float* width = roughness.values.data();
  float* red = specular.values.data();
  const std::size_t outside = remap::mitsuba_ward_to_mitsuba_as::evaluate_batch(
      count, {width, {red, red + count, red + 2 * count}}, {width, {red, red + count, red + 2 * count}});
  roughness.values.resize(count);  // the first channel is the width
  expected_roughness.values.resize(count);
  const bool same =
      roughness.values == expected_roughness.values && specular.values == expected_specular.values;
  std::printf("%zu texels, %zu out of domain, %s\n", count, outside,
              same ? "the same bits as the other maps" : "other values than those of the other maps");
  return same ? 0 : 1;
}
