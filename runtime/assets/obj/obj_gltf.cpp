#include "assets/obj/obj_gltf.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "assets/document/asset_uri.hpp"
#include "assets/gltf/gltf_container.hpp"
#include "assets/obj/obj_materials.hpp"
#include "assets/obj/obj_mesh.hpp"
#include "assets/obj/obj_textures.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

// These are types of components (glTF 2.0, section 5.1.3).
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
// Indices below 65535 take two bytes. 65535 is excluded, because it restarts a strip.
constexpr std::size_t kMostShortVertices = 65535;

std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
  return bytes;
}

template <typename Value>
std::string bytes_of_values(const std::vector<Value>& values) {
  static_assert(std::endian::native == std::endian::little, "glTF is little-endian");
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

class SceneWriter {
 public:
  SceneWriter(ObjScene scene, const std::vector<SceneMaterial>& materials, GltfBuffer& buffer,
              AssetConversion& conversion)
      : scene_(std::move(scene)), materials_(materials), buffer_(buffer), conversion_(conversion) {}

  // Returns the JSON without its buffers.
  Json run() {
    Json meshes = Json::list(), nodes = Json::list(), roots = Json::list();
    for (ObjShape& shape : scene_.shapes) {
      Json primitives = Json::list();
      for (ObjPrimitive& primitive : shape.primitives)
        primitives.push_back(primitive_of(std::move(primitive)));
      Json mesh{{"primitives", std::move(primitives)}}, node{{"mesh", meshes.size()}};
      if (!shape.name.empty()) mesh["name"] = node["name"] = utf8_name(shape.name);
      meshes.push_back(std::move(mesh));
      roots.push_back(nodes.size());
      nodes.push_back(std::move(node));
    }
    if (without_texcoords_ > 0)
      conversion_.warnings.push_back(
          "faces of " + counted(without_texcoords_, "mesh part") +
          " have a texture, but no texture coordinates: they show only one texel of the texture");
    Json file{{"asset", Json{{"version", "2.0"}, {"generator", std::string("texremap ") + kVersion}}}};
    file["scene"] = 0;
    Json scene = Json::object();
    scene["nodes"] = std::move(roots);
    file["scenes"] = Json::list({std::move(scene)});
    file["nodes"] = std::move(nodes);
    file["meshes"] = std::move(meshes);
    file["accessors"] = std::move(accessors_);
    return file;
  }

 private:
  // Each array is freed as soon as its bytes are in the buffer, to save memory.
  Json primitive_of(ObjPrimitive primitive) {
    const std::size_t count = primitive.vertex_count();
    if (primitive.texcoords.empty() && materials_[primitive.material].has_texture) {
      primitive.texcoords.assign(count * 2, 0.0f);
      ++without_texcoords_;
    }
    Json attributes = Json::object();
    attributes["POSITION"] = add_vertices(std::move(primitive.positions), 3, true);
    if (!primitive.normals.empty())
      attributes["NORMAL"] = add_vertices(std::move(primitive.normals), 3, false);
    if (!primitive.texcoords.empty())
      attributes["TEXCOORD_0"] = add_vertices(std::move(primitive.texcoords), 2, false);
    if (!primitive.colors.empty())
      attributes["COLOR_0"] = add_vertices(std::move(primitive.colors), 3, false);
    Json result = Json::object();
    result["attributes"] = std::move(attributes);
    result["indices"] = add_indices(std::move(primitive.indices), count);
    result["material"] = primitive.material;
    return result;
  }

  std::size_t add_vertices(std::vector<float> values, std::size_t components, bool has_range) {
    const std::size_t view = buffer_.add_view(bytes_of_values(values), kVertexTarget);
    Json accessor{{"bufferView", view},
                  {"componentType", kFloat},
                  {"count", values.size() / components},
                  {"type", components == 3 ? "VEC3" : "VEC2"}};
    if (has_range) {
      std::vector<double> least, most;
      for (std::size_t c = 0; c < components; ++c) {
        float low = values[c], high = values[c];
        for (std::size_t i = c; i < values.size(); i += components) {
          low = std::min(low, values[i]);
          high = std::max(high, values[i]);
        }
        // Write all digits of the float, because the validator compares them.
        least.push_back(static_cast<double>(low));
        most.push_back(static_cast<double>(high));
      }
      accessor["min"] = least;
      accessor["max"] = most;
    }
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  std::size_t add_indices(std::vector<std::uint32_t> indices, std::size_t vertex_count) {
    const bool is_short = vertex_count < kMostShortVertices;
    std::size_t view = 0;
    if (is_short) {
      const std::vector<std::uint16_t> short_indices(indices.begin(), indices.end());
      view = buffer_.add_view(bytes_of_values(short_indices), kIndexTarget);
    } else {
      view = buffer_.add_view(bytes_of_values(indices), kIndexTarget);
    }
    accessors_.push_back(Json{{"bufferView", view},
                              {"componentType", is_short ? kUnsignedShort : kUnsignedInt},
                              {"count", indices.size()},
                              {"type", "SCALAR"}});
    return accessors_.size() - 1;
  }

  ObjScene scene_;
  const std::vector<SceneMaterial>& materials_;
  GltfBuffer& buffer_;
  AssetConversion& conversion_;
  Json accessors_ = Json::list();
  std::size_t without_texcoords_ = 0;
};

void add_list(Json& file, const char* name, Json list) {
  if (!list.empty()) file[name] = std::move(list);
}

// Returns the header, the JSON and the binary chunk (glTF 2.0, section 4).
std::vector<AssetPiece> glb_pieces(std::string json, GltfBuffer& buffer, const std::string& context) {
  constexpr std::uint64_t kHeader = 12;
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::uint64_t binary = buffer.padded_size(),
                      size = kHeader + 2 * kChunkHeaderSize + json.size() + binary;
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw output_error(context + ": would have " + std::to_string(size) +
                       " bytes; a .glb holds less than 4 GiB (convert it to .gltf, which has a .bin)");
  const auto number = [](std::uint64_t value) { return little_endian(static_cast<std::uint32_t>(value)); };
  std::vector<AssetPiece> pieces(2);
  pieces[0].bytes = "glTF" + number(2) + number(size) + number(json.size()) + number(kJsonChunk) + json +
                    number(binary) + number(kBinaryChunk);
  pieces[1].bytes = buffer.take(binary);
  return pieces;
}

}  // namespace

AssetConversion gltf_of_obj(const ByteSource& obj, const std::string& context, const AssetOptions& options,
                            const AssetResources& resources, const std::string& buffer_file) {
  ObjScene scene = read_obj(obj, context);
  if (scene.shapes.empty()) throw input_error(context + ": has no faces");
  AssetConversion conversion;
  conversion.warnings = scene.warnings;
  const bool is_glb = buffer_file.empty();
  GltfBuffer buffer;
  GltfTextures textures(options, resources, is_glb ? NewImagePlace::kBuffer : NewImagePlace::kFiles, buffer,
                        conversion);
  MtlLibraries libraries(resources, options.mtl_maker);
  libraries.read(scene.libraries, context, conversion.warnings);
  for (const std::string& path : libraries.image_paths()) textures.take(path);
  ObjMaterials converter(options, resources, libraries, textures, conversion);
  const std::vector<SceneMaterial> materials = converter.converted(scene.materials);
  Json file = SceneWriter(std::move(scene), materials, buffer, conversion).run();
  Json extensions = Json::list(), material_list = Json::list();
  for (const std::string& extension : converter.extensions()) extensions.push_back(extension);
  if (textures.has_transforms()) extensions.push_back(kTextureTransform);
  for (const SceneMaterial& material : materials) material_list.push_back(material.json);
  add_list(file, "extensionsUsed", std::move(extensions));
  add_list(file, "materials", std::move(material_list));
  add_list(file, "textures", textures.textures());
  add_list(file, "images", textures.images());
  add_list(file, "samplers", textures.samplers());
  file["bufferViews"] = buffer.views();
  Json whole{{"byteLength", buffer.size()}};
  if (!is_glb) whole["uri"] = uri_of_path(buffer_file);
  file["buffers"] = Json::list({std::move(whole)});
  conversion.text = file.dump();
  conversion.changed = true;
  if (is_glb) {
    conversion.pieces = glb_pieces(conversion.text, buffer, context);
    return conversion;
  }
  if (buffer.size() > std::numeric_limits<std::uint32_t>::max())
    throw output_error(context + ": its buffer would have " + std::to_string(buffer.size()) +
                       " bytes; at most 4 GiB are written (split the file)");
  conversion.pieces.push_back({conversion.text, 0, 0});
  conversion.files.push_back({buffer_file, buffer.take(buffer.size())});
  return conversion;
}

std::vector<AssetResource> obj_resources(const ByteSource& obj, const std::string& context,
                                         const AssetResources& resources) {
  MtlLibraries libraries(resources, std::nullopt);
  std::vector<std::string> ignored;
  libraries.read(obj_libraries(obj, context), context, ignored);
  std::vector<AssetResource> named;
  for (const std::set<std::string>* paths : {&libraries.paths(), &libraries.image_paths()})
    for (const std::string& path : *paths) named.push_back({"", path, UriKind::kFile});
  return named;
}

}  // namespace remap
