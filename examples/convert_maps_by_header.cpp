// Converts maps by one generated header, row by row, and compares the result with maps that texremap
// converted:
//   g++ -std=c++17 -O2 -ffp-contract=off -I generated examples/convert_maps_by_header.cpp -o
//   convert_maps_by_header
//   ./convert_maps_by_header roughness.pfm specular.pfm converted_roughness.pfm converted_specular.pfm
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "mitsuba_ward_to_mitsuba_as.hpp"

namespace {

struct Map {
  std::size_t texel_count = 0, channels = 0;
  std::vector<float> values;  // channel by channel
};

// A PFM file of this machine's byte order: `Pf` (grey) or `PF` (RGB), width, height, scale, floats.
bool read_pfm(const char* path, Map* map) {
  std::ifstream file(path, std::ios::binary);
  std::string kind;
  std::size_t width = 0, height = 0;
  double scale = 0.0;
  file >> kind >> width >> height >> scale;
  file.get();
  map->channels = kind == "PF" ? 3 : 1;
  map->texel_count = width * height;
  std::vector<float> texels(map->texel_count * map->channels);
  file.read(reinterpret_cast<char*>(texels.data()),
            static_cast<std::streamsize>(texels.size() * sizeof(float)));
  map->values.resize(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i)
    map->values[i % map->channels * map->texel_count + i / map->channels] = texels[i];
  return static_cast<bool>(file) && (kind == "PF" || kind == "Pf");
}

}  // namespace

int main(int argc, char** argv) {
  Map roughness, specular, expected_roughness, expected_specular;
  if (argc != 5 || !read_pfm(argv[1], &roughness) || !read_pfm(argv[2], &specular) ||
      !read_pfm(argv[3], &expected_roughness) || !read_pfm(argv[4], &expected_specular) ||
      specular.channels != 3 || roughness.texel_count != specular.texel_count) {
    std::fprintf(stderr,
                 "usage: convert_maps_by_header ROUGHNESS SPECULAR CONVERTED_ROUGHNESS CONVERTED_SPECULAR\n"
                 "(PFM files of one size; specular in RGB)\n");
    return 2;
  }
  const std::size_t count = roughness.texel_count;
  float* width = roughness.values.data();
  float* red = specular.values.data();
  const std::size_t outside = remap::mitsuba_ward_to_mitsuba_as::evaluate_batch<3>(
      count, width, {red, red + count, red + 2 * count}, width, {red, red + count, red + 2 * count});
  const bool same =
      roughness.values == expected_roughness.values && specular.values == expected_specular.values;
  std::printf("%zu texels, %zu out of domain, %s\n", count, outside,
              same ? "the bits of the other maps" : "other values than those of the other maps");
  return same ? 0 : 1;
}
