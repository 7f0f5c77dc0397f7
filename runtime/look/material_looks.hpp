// This file shows a material before and after a conversion: in the source's model, in the target's model with
// the same numbers, and in the target's model with converted numbers. Its maps are linear values, scaled down
// to the size of a picture.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "look/brdf.hpp"
#include "look/lit_sphere.hpp"
#include "remap/convert_maps.hpp"
#include "remap/converter.hpp"
#include "remap/path.hpp"
#include "remap/pixels.hpp"
#include "remap/workflow.hpp"
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

// Returns true if another renderer must show the ball.
inline bool is_external(const TexturedBall& ball) { return !ball.name.empty() && !is_linear_lobe(ball.name); }

// A MaterialLooks is one material on balls.
struct MaterialLooks {
  std::string name;
  TexturedBall source;
  std::optional<TexturedBall> copied;  // none if source and target have other parameters
  TexturedBall converted;
  Image normals;             // of all balls (render_textured); no values without a normal map
  ScaledMaps before, after;  // in the parameters of source and target
  double outside = 0.0;  // fraction of the texels outside of the range that the conversion was measured for
};

// A PictureError compares a picture with the source's, in display values (sRGB) over the pixels that show the
// shape.
struct PictureError {
  double ssim = 0.0;  // similarity of luma, 1 for equal pictures
  double rms = 0.0;   // error over red, green and blue
};

PictureError picture_error(const DisplayedSphere& source, const DisplayedSphere& other,
                           std::span<const std::uint32_t> pixels, int resolution);

// A LitLooks holds the pictures of a MaterialLooks: source, copied if there is one, and converted.
struct LitLooks {
  std::vector<DisplayedSphere> pictures;
  std::optional<PictureError> copied;
  PictureError converted;
};

// Environments of previews have this many rows. With fewer, the edges of lamps blur in the highlights of
// smooth materials.
inline constexpr int kPreviewLightRows = 256;

// Renders balls with normals: returns linear RGB for each ball, for the pixels of shape_pixels(kSphere).
using BallRenderer =
    std::function<std::vector<std::vector<float>>(std::span<const TexturedBall> balls, const Image& normals)>;

LitLooks light(const MaterialLooks& looks, const BallRenderer& render, int resolution);

// Decides whether a renderer has a model, by its name.
using ModelTest = std::function<bool(const std::string&)>;

// A ShownModel is a BRDF model as a renderer shows it. A model that the renderer lacks is shown by the model
// that a converter of the graph matches best to it.
class ShownModel {
 public:
  // `has` are the models of the renderer, by default of the built-in one. Throws kInput if no converter leads
  // from the model to one of them.
  ShownModel(const std::string& model, const ConverterGraph& graph, const ModelTest& has = is_linear_lobe);

  // Returns the name of the model that is shown.
  const std::string& name() const { return name_; }
  // Returns the ball of maps of a workflow over this model. Without one, they are roughness, specular,
  // diffuse.
  TexturedBall ball(const std::optional<WorkflowEnd>& workflow, ScaledMaps maps) const;

 private:
  std::string name_;
  std::unique_ptr<Converter> to_shown_;  // null if the model itself is shown
};

// An AssetFile is an open asset. All members must outlive its use.
struct AssetFile {
  const ByteSource& bytes;
  const std::string& context;  // for messages
  const AssetResources& resources;
};

// An AssetReader reads materials of an asset as maps. All functions throw kInput for what cannot be read.
class AssetReader {
 public:
  virtual ~AssetReader() = default;
  // Returns the maps of a material as its file describes it, with at most about `side` texels a side.
  virtual ScaledMaps maps(const AssetMaterial& material, int side) = 0;
  // Returns the ball of these maps. `ggx` shows GGX with F0, the model of glTF.
  virtual TexturedBall ball(const AssetMaterial& material, const ShownModel& ggx, ScaledMaps maps) const = 0;
  // Returns what programs show that ignore extensions of glTF, or nothing for a material without these.
  virtual std::optional<TexturedBall> without_extensions(const AssetMaterial&, const ShownModel&, int) {
    return std::nullopt;
  }
  // Returns the normals (render_textured), or an image without values.
  virtual Image normals(const AssetMaterial&, int) { return {}; }
};

std::unique_ptr<AssetReader> gltf_reader(const AssetFile& file);
// Reads the materials of an MTL file, or of the MTL files that an OBJ file names. Materials of the
// specification are shown by unnormalised Blinn (legacy/blinn-phong), materials with Pr and Pm like glTF.
std::unique_ptr<AssetReader> mtl_reader(const AssetFile& file, std::optional<MtlMaker> maker, bool is_obj);

}  // namespace remap
