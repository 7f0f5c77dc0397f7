// This file holds a material's maps as linear values, scaled down to the size of a picture.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

#include "look/lit_sphere.hpp"
#include "remap/convert_maps.hpp"
#include "remap/converter.hpp"
#include "remap/pixels.hpp"
#include "texture/normal_green.hpp"
#include "texture/texture_set.hpp"

namespace remap {

// A ScaledMaps holds each parameter as rows of width * height values: one row, or red, green and blue.
struct ScaledMaps {
  int width = 1, height = 1;
  RoughnessEncoding encoding = RoughnessEncoding::kRoughness;  // of the roughness
  std::map<Parameter, std::vector<std::vector<float>>> rows;
  int full_width = 1, full_height = 1;  // of the maps before they were scaled down

  // Returns maps of zeros whose texels are cells of whole texels of `full_width` * `full_height`. They have
  // about `side` texels on the longer side.
  static ScaledMaps cells_of(int full_width, int full_height, int side);

  std::size_t count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  // Adds the means of a band of `across` * width by `down` texels to the cells of `row`.
  void add_means(const ConstChannelView& band, const ParameterValues& values, std::size_t channel, int across,
                 int down, int row, std::vector<float>& means) const;
};

// Reads each map of the set once. `encoding` is used if the set does not state the encoding of its roughness.
// Throws kInput if a map cannot be read.
ScaledMaps scaled_maps(TextureSet& set, RoughnessEncoding encoding, int side);

// Scales sources down, each of which is constants or a map of `width` * `height` texels.
ScaledMaps scaled_maps(const std::map<Parameter, SourceParameter>& sources, std::size_t width,
                       std::size_t height, RoughnessEncoding encoding, int side);

// Converts all texels. The result has the encoding of the converter. `outside`, if not null, receives the
// fraction of texels outside of the converter's domain.
ScaledMaps converted(const Converter& converter, ScaledMaps maps, double* outside = nullptr);

// Returns the normals (render_textured) of `stored`, the rows of a normal map as files hold it. Files hold 0
// to 1, or -1 to 1 if a value is negative. `scale` multiplies x and y. `green` is the direction of y.
Image normals_of(const std::vector<std::vector<float>>& stored, int width, double scale, NormalGreen green);
// Reads a normal map of a set. Returns an image without values for a map with fewer than three channels,
// because such a map holds heights. Throws kInput if the file cannot be read.
Image read_normals(const std::filesystem::path& file, NormalGreen green, int side);

// Returns the ball of maps with roughness, specular and diffuse (absent: black) in the model of this name.
TexturedBall ball_of(const std::string& model, ScaledMaps maps);

}  // namespace remap
