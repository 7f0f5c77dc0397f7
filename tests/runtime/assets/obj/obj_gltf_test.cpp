// This file tests OBJ files as glTF: geometry, materials, images, and damaged files.
#include "assets/obj/obj_gltf.hpp"

#include <cstring>
#include <filesystem>
#include <sstream>

#include <catch2/catch.hpp>

#include "assets/maps/legacy_maps.hpp"
#include "assets/obj/obj_mesh.hpp"
#include "core/input_file.hpp"
#include "runtime/assets/mtl_texts.hpp"
#include "support/build_speed.hpp"
#include "support/error_of.hpp"
#include "support/shared_data.hpp"

using namespace remap;

namespace {

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 .25\n";

struct MadeScene {
  AssetConversion conversion;
  GltfContainer container;
  std::string bytes;
  std::unique_ptr<SpannedJson> json;

  SpanValue root() const { return json->root(); }
  SpanValue entry(const char* list, std::size_t index) const { return root()[list].children().at(index); }
  SpanValue core(std::size_t material = 0) const {
    return entry("materials", material)["pbrMetallicRoughness"];
  }
  double number(SpanValue value) const { return value.number().value_or(-99.0); }
  std::string view(std::size_t index) const {
    const SpanValue found = entry("bufferViews", index);
    return bytes.substr(container.chunks.at(0).content_begin() + *found["byteOffset"].whole(),
                        *found["byteLength"].whole());
  }
  std::vector<float> floats(std::size_t accessor) const {
    const std::string raw = view(*entry("accessors", accessor)["bufferView"].whole());
    std::vector<float> values(raw.size() / 4);
    std::memcpy(values.data(), raw.data(), values.size() * 4);
    return values;
  }
};

MadeScene made(const std::string& obj, PlainResources resources = {}, const std::string& mtl = "",
               bool extensions = false) {
  if (!mtl.empty()) resources.files["a.mtl"] = mtl;
  MadeScene scene;
  AssetOptions options;
  if (extensions) options.extensions = DielectricExtensions::kWritten;
  scene.conversion = gltf_of_obj(MemorySource(obj), "file.obj", options, resources);
  for (const AssetPiece& piece : scene.conversion.pieces) scene.bytes += piece.bytes;
  scene.container = read_container(MemorySource(scene.bytes), "made");
  scene.json = std::make_unique<SpannedJson>(scene.container.json, "made");
  return scene;
}

MadeScene of_material(const std::string& lines, const PlainResources& resources = {},
                      bool extensions = false) {
  return made("mtllib a.mtl\n" + kTriangle + "usemtl m\nf 1/1 2/2 3/3\n", resources, "newmtl m\n" + lines,
              extensions);
}

ObjScene read(const std::string& text) { return read_obj(MemorySource(text), "file"); }

std::string refusal_of(const std::string& obj) {
  return error_of([&] { (void)made(obj); });
}

}  // namespace

TEST_CASE("A triangle: positions, texture coordinates from the top, indices, ranges", "[assets]") {
  const MadeScene scene = made(kTriangle + "o box\nf 1/1 2/2 3/3\n");
  CHECK(scene.entry("nodes", 0)["name"].text() == "box");
  const SpanValue primitive = scene.entry("meshes", 0)["primitives"].children().at(0);
  const std::size_t positions = *primitive["attributes"]["POSITION"].whole(),
                    texcoords = *primitive["attributes"]["TEXCOORD_0"].whole();
  CHECK(scene.floats(positions) == std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(scene.floats(texcoords) == std::vector<float>{0, 1, 1, 1, 0, 0.75f});
  CHECK(scene.entry("accessors", positions)["max"].raw() == "[1.0,1.0,0.0]");
  CHECK_FALSE(primitive["attributes"]["NORMAL"]);
  CHECK(scene.view(*scene.entry("accessors", *primitive["indices"].whole())["bufferView"].whole()) ==
        std::string("\0\0\1\0\2\0", 6));
}

TEST_CASE("Polygons are taken to triangles, corners are shared, materials are parts", "[assets]") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv -.5 .5 0\n";
  const ObjScene scene =
      read(vertices + "usemtl a  b \nf 1 2 3 4\nusemtl c\nf 1 3 4 5\nusemtl a  b\nf -5 -4 -3\n");
  REQUIRE(scene.shapes.size() == 1);
  REQUIRE(scene.shapes[0].primitives.size() == 2);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0] == "a  b");
  CHECK(scene.shapes[0].primitives[0].indices.size() == 9);
  CHECK(scene.shapes[0].primitives[0].vertex_count() == 4);
  CHECK(scene.shapes[0].primitives[1].indices.size() == 6);
  CHECK(scene.shapes[0].primitives[0].texcoords.empty());
}

TEST_CASE("Groups and objects become nodes; normals get length 1, or come from faces", "[assets]") {
  const ObjScene scene = read(kTriangle +
                              "vn 0 0 2\nvn 0 0 0\nvn 3 0 4\ng one  two\nf 1//1 2//1 3//1\ng\nf 1//3 "
                              "2//2 3\no \tbox one\t\nf 1 2//2 3\n");
  REQUIRE(scene.shapes.size() == 3);
  CHECK(scene.shapes[0].name == "one two");
  CHECK(scene.shapes[1].name.empty());
  CHECK(scene.shapes[2].name == "box one");
  CHECK(scene.shapes[0].primitives[0].normals == std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
  CHECK(scene.shapes[1].primitives[0].normals == std::vector<float>{0.6f, 0, 0.8f, 0, 0, 1, 0, 0, 1});
  CHECK(scene.shapes[2].primitives[0].normals.empty());
  CHECK(scene.warnings ==
        std::vector<std::string>{
            "normals that are missing or have length 0 become the normals of the faces (1 mesh part)"});
}

TEST_CASE("A group that is read in parts is one shape", "[assets]") {
  // There are more faces than the importer gets at once, vertices after the first polygons, and a change of
  // material.
  constexpr int kFaces = 40000;
  std::string text = "g a b\nusemtl x\nf 1 2 3 4\n";
  for (int i = 0; i < kFaces; ++i) text += "f 1 2 3\n";
  text += "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (int i = 0; i < kFaces; ++i) text += i % 2 == 0 ? "f -4 -3 -2 -1\n" : "f 1 2 3 4\n";
  text += "usemtl y\nf 1 2 3\nusemtl x\nf 1 2 3\ng\nf 2 3 4\n";
  const ObjScene scene = read(text);
  REQUIRE(scene.shapes.size() == 2);
  CHECK(scene.shapes[0].name == "a b");
  REQUIRE(scene.shapes[0].primitives.size() == 2);
  CHECK(scene.shapes[0].primitives[0].indices.size() == 3 * (2 + kFaces + 2 * kFaces + 1));
  CHECK(scene.shapes[0].primitives[0].vertex_count() == 4);
  CHECK(scene.shapes[1].name.empty());
  CHECK(scene.materials.size() == 2);
}

TEST_CASE("Lines that end on the edges of blocks", "[assets]") {
  const std::string block(std::size_t{1} << 20, ' ');
  const std::string head = "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\n", face = "f 1 2 3";
  for (std::size_t shift = 0; shift < 16; ++shift) {
    std::string text = head + "#" + block;
    text.resize(block.size() - shift);
    text += "\r\n" + face + " \\\r\n 2\r\n" + face;
    const ObjScene scene = read(text);
    REQUIRE(scene.shapes.size() == 1);
    REQUIRE(scene.shapes[0].primitives[0].indices.size() == 9);
  }
}

TEST_CASE("Vertex colors are kept where every vertex has one", "[assets]") {
  const std::string face = "f 1 2 3\n";
  CHECK(read("v 0 0 0 1 .5 2\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\n" + face).shapes[0].primitives[0].colors ==
        std::vector<float>{1, 0.5f, 1, 0, 0, 0, 1, 1, 1});
  CHECK(read("v 0 0 0 1 .5 1\nv 1 0 0\nv 0 1 0 1 1 1\n" + face).shapes[0].primitives[0].colors.empty());
}

TEST_CASE("Materials by the short forms", "[assets]") {
  const std::string lines = "Kd .64 .64 .64\nKs .5 .5 .25\nNs 96.078431\n";
  const LegacyMaterial material{{0.64, 0.64, 0.64}, {0.5, 0.5, 0.25}, 96.078431};
  const MadeScene core = of_material(lines);
  CHECK(core.number(core.core()["roughnessFactor"]) == Approx(ggx_roughness(material)));
  CHECK(core.number(core.core()["metallicFactor"]) == 0.0);
  CHECK(core.number(core.core()["baseColorFactor"].children()[0]) ==
        Approx(0.64 + ggx_f0(material)[0] - 0.04));
  CHECK_FALSE(core.root()["extensionsUsed"]);
  const MadeScene exact = of_material(lines, {}, true);
  const SpanValue specular = exact.entry("materials", 0)["extensions"]["KHR_materials_specular"];
  CHECK(exact.number(specular["specularFactor"]) == Approx(ggx_f0(material)[0]));
  CHECK(exact.number(specular["specularColorFactor"].children()[0]) == Approx(25.0));
  CHECK(exact.number(specular["specularColorFactor"].children()[2]) == Approx(12.5));
  CHECK(exact.number(exact.core()["baseColorFactor"].children()[0]) ==
        Approx(0.64 / (1.0 - ggx_f0(material)[0])));
  CHECK(exact.root()["extensionsUsed"].raw() == "[\"KHR_materials_specular\"]");
  const MadeScene matte = of_material("Kd .5 .5 .5\n", {}, true);
  CHECK(matte.number(matte.entry("materials", 0)["extensions"]["KHR_materials_specular"]["specularFactor"]) ==
        0.0);
  const MadeScene later = of_material("Kd .5 .5 .5\nKs 1 1 1\nNs 5\nPr .25\nPm 1\n");
  CHECK(later.number(later.core()["roughnessFactor"]) == 0.25);
  CHECK(later.number(later.core()["metallicFactor"]) == 1.0);
}

TEST_CASE("d is opacity, whatever Tr says and in which order", "[assets]") {
  const auto alpha = [](const std::string& lines) {
    const MadeScene scene = of_material(lines);
    const bool blends = scene.entry("materials", 0)["alphaMode"].text() == "BLEND";
    const double value = scene.number(scene.core()["baseColorFactor"].children()[3]);
    CHECK(blends == (value < 1.0));
    return value;
  };
  CHECK(alpha("d 0.75\nTr 0.5\n") == 0.75);
  CHECK(alpha("Tr 0.5\nd 0.75\n") == 0.75);
  CHECK(alpha("Tr 0.25\n") == 0.75);
  CHECK(alpha("Tr 1\n") == 1.0);  // MeshLab writes this for opaque materials
  CHECK(alpha("Tr 1\nnewmtl b\nTr 0\n") == 0.0);
  CHECK(alpha("d 0\n") == 0.0);
}

TEST_CASE("Images: PNG and JPEG as they are, others as PNG, each once", "[assets]") {
  PlainResources resources;
  const std::string png = "\x89PNG\r\n\x1a\n and so on", jpeg = "\xff\xd8\xff and so on";
  resources.files["a b.png"] = png;
  resources.files["b.jpg"] = jpeg;
  resources.files["c.tga"] = map_bytes({{1, 2, 3}, {4, 5, 6}});
  const std::string mtl =
      "newmtl m\nmap_Kd -s 2 3 -o .5 a b.png\nnorm -bm .5 b.jpg\nKe 1 1 1\nmap_Ke c.tga\nnewmtl n\nmap_Kd "
      "-clamp on "
      "a b.png\nnewmtl o\nmap_Kd a b.png\n";
  const std::string obj = "mtllib a.mtl\n" + kTriangle +
                          "usemtl m\nf 1/1 2/2 3/3\nusemtl n\nf 1/1 2/2 3/3\nusemtl o\nf 1/1 2/2 3/3\n";
  const MadeScene scene = made(obj, resources, mtl);
  REQUIRE(scene.root()["images"].size() == 3);
  CHECK(scene.root()["textures"].size() == 4);
  const auto bytes = [&](std::size_t image) {
    return scene.view(*scene.entry("images", image)["bufferView"].whole());
  };
  CHECK(bytes(0) == png);
  CHECK(bytes(1) == jpeg);
  CHECK(scene.entry("images", 1)["mimeType"].text() == "image/jpeg");
  CHECK(PlainCodec().decode(bytes(2), "").bytes[3] == std::byte{4});
  const SpanValue transform = scene.core()["baseColorTexture"]["extensions"]["KHR_texture_transform"];
  CHECK(transform["scale"].raw() == "[2.0,3.0]");
  CHECK(transform["offset"].raw() == "[0.5,-2.0]");
  CHECK(scene.entry("materials", 0)["normalTexture"]["scale"].raw() == "0.5");
  // A .gltf file refers to images and buffer by their names, and does not contain them.
  resources.files["a.mtl"] = mtl;
  const AssetConversion beside = gltf_of_obj(MemorySource(obj), "file.obj", {}, resources, "my mesh.bin");
  CHECK(beside.text.find("\"uri\":\"a%20b.png\"") != std::string::npos);
  CHECK(beside.text.find("\"uri\":\"my%20mesh.bin\"") != std::string::npos);
  REQUIRE(beside.resources.size() == 2);
  CHECK(beside.resources[0].path == "a b.png");
  REQUIRE(beside.files.size() == 2);
  CHECK(beside.files[0].path == "c.png");
  CHECK(beside.files[1].path == "my mesh.bin");
}

TEST_CASE("An image with -mm is a new one", "[assets]") {
  PlainResources resources;
  resources.files["c.tga"] = map_bytes({{10, 20, 30}, {100, 110, 120}});
  const std::string mtl =
      "newmtl m\nmap_Kd -mm .2 2 c.tga\nnewmtl n\nmap_Kd c.tga\nnewmtl o\nmap_Kd -mm .2 2 c.tga\n";
  const MadeScene scene =
      made("mtllib a.mtl\n" + kTriangle +
               "usemtl m\nf 1/1 2/2 3/3\nusemtl n\nf 1/1 2/2 3/3\nusemtl o\nf 1/1 2/2 3/3\n",
           resources, mtl);
  CHECK(scene.conversion.count(MaterialState::kFailed) == 0);
  REQUIRE(scene.root()["images"].size() == 2);
  const auto bytes = [&](std::size_t image) {
    return scene.view(*scene.entry("images", image)["bufferView"].whole());
  };
  CHECK(bytes(0) == map_bytes({{71, 91, 111}, {251, 255, 255}}));
  CHECK(bytes(1) == resources.files["c.tga"]);
}

TEST_CASE("A map of opacity becomes the alpha of base color", "[assets]") {
  PlainResources resources;
  resources.files["d.tga"] = map_bytes({{1, 2, 3}, {4, 5, 6}});
  resources.files["o.tga"] = map_bytes({{0}, {200}});
  resources.files["leaf.tga"] = map_bytes({{1, 2, 3, 0}, {4, 5, 6, 100}});
  const auto image = [&](const std::string& lines) {
    const MadeScene scene = of_material(lines, resources);
    CHECK(scene.conversion.materials[0].failure.empty());
    const std::size_t texture = *scene.core()["baseColorTexture"]["index"].whole();
    const std::size_t source = *scene.entry("textures", texture)["source"].whole();
    std::vector<int> values;
    for (const std::byte byte :
         PlainCodec().decode(scene.view(*scene.entry("images", source)["bufferView"].whole()), "").bytes)
      values.push_back(std::to_integer<int>(byte));
    return values;
  };
  CHECK(image("map_Kd d.tga\nmap_d o.tga\n") == std::vector<int>{1, 2, 3, 0, 4, 5, 6, 200});
  CHECK(image("map_d o.tga\n") == std::vector<int>{255, 255, 255, 0, 255, 255, 255, 200});
  CHECK(image("map_Kd leaf.tga\nmap_d leaf.tga\n") == std::vector<int>{1, 2, 3, 0, 4, 5, 6, 100});
  // The alpha of map_Kd is not opacity.
  CHECK(image("d .5\nmap_Kd leaf.tga\n") == std::vector<int>{1, 2, 3, 4, 5, 6});
}

TEST_CASE("Maps of strength and exponent are converted, and shared", "[assets]") {
  PlainResources resources;
  resources.files["d.tga"] = map_bytes({{90, 120, 130}, {200, 90, 60}});
  resources.files["s.tga"] = map_bytes({{255, 255, 255}, {100, 60, 20}});
  const std::string lines = "Kd 1 1 1\nKs 1 1 1\nNs 30\nmap_Kd d.tga\nmap_Ks s.tga\n";
  const MadeScene core =
      made("mtllib a.mtl\n" + kTriangle + "usemtl m\nf 1/1 2/2 3/3\nusemtl n\nf 1/1 2/2 3/3\n", resources,
           "newmtl m\n" + lines + "newmtl n\n" + lines);
  CHECK(core.conversion.count(MaterialState::kConverted) == 2);
  CHECK(core.root()["images"].size() == 2);
  CHECK(core.core()["metallicRoughnessTexture"].raw() == core.core(1)["metallicRoughnessTexture"].raw());
  const MadeScene exact = of_material(lines, resources, true);
  const SpanValue specular = exact.entry("materials", 0)["extensions"]["KHR_materials_specular"];
  CHECK(exact.number(specular["specularFactor"]) == Approx(6.3 / 32.0).epsilon(0.08));
  CHECK(specular["specularColorFactor"].raw() == "[25.0,25.0,25.0]");
  CHECK(specular["specularTexture"].raw() == specular["specularColorTexture"].raw());
  CHECK(exact.number(exact.core()["metallicFactor"]) == 0.0);
}

TEST_CASE("What is missing is said, and the rest is there", "[assets]") {
  const MadeScene none = made("mtllib gone.mtl\n" + kTriangle + "usemtl x\nf 1 2 3\n");
  CHECK(none.conversion.warnings ==
        std::vector<std::string>{"mtllib gone.mtl: was not found; its materials become white"});
  CHECK(none.core()["metallicFactor"].raw() == "0");
  const MadeScene texture = of_material("Kd .5 .5 .5\nmap_Kd gone.png\n");
  CHECK(texture.conversion.materials[0].state == MaterialState::kFailed);
  CHECK(texture.conversion.materials[0].failure == "gone.png: was not found (put it next to the MTL file)");
  CHECK(texture.conversion.changed);
  CHECK(texture.core()["baseColorFactor"].raw() == "[0.5,0.5,0.5,1.0]");
  PlainResources resources;
  resources.files["x.png"] = "\x89PNG\r\n\x1a\n";
  const MadeScene bare =
      made("mtllib a.mtl\n" + kTriangle + "usemtl m\nf 1 2 3\n", resources, "newmtl m\nmap_Kd x.png\n");
  CHECK(bare.conversion.warnings.size() == 1);
  CHECK(bare.entry("meshes", 0)["primitives"].children()[0]["attributes"]["TEXCOORD_0"]);
}

TEST_CASE("MTL files are found with spaces, backslashes, several on a line", "[assets]") {
  PlainResources resources;
  resources.files["my mats/a b.mtl"] = "newmtl a\nmap_Kd ../x.png\nPr 1\n";
  resources.files["b.mtl"] = "newmtl b\nPr .5\n";
  resources.files["c.mtl"] = "newmtl b\nPr .25\nnewmtl c\nPr .125\n";
  resources.files["x.png"] = "\x89PNG\r\n\x1a\n";
  const std::string faces = "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n";
  const MadeScene scene =
      made("mtllib my mats\\\\a b.mtl\nmtllib C:\\b.mtl /x/c.mtl\n" + kTriangle + faces, resources);
  CHECK(scene.conversion.count(MaterialState::kConverted) == 3);
  CHECK(scene.conversion.warnings.empty());
  CHECK(scene.core(0)["baseColorTexture"]);
  CHECK(scene.core(1)["roughnessFactor"].raw() == "0.5");
  CHECK(scene.core(2)["roughnessFactor"].raw() == "0.125");
  std::vector<std::string> paths;
  const std::string obj = "# mtllib d.mtl\n \tmtllib  my mats\\a b.mtl \r\nmtllib c.mtl gone.mtl\nmtllibx\n";
  for (const AssetResource& resource : obj_resources(MemorySource(obj), "file", resources))
    paths.push_back(resource.path);
  CHECK(paths == std::vector<std::string>{"c.mtl", "my mats/a b.mtl", "x.png"});
}

TEST_CASE("Damaged OBJ files are refused", "[assets]") {
  const std::string gone = "refers to a vertex, normal or texture coordinate that does not exist";
  CHECK(refusal_of("") == "file.obj: has no faces");
  CHECK(refusal_of(kTriangle) == "file.obj: has no faces");
  CHECK(refusal_of(kTriangle + "f 1 2 9\n").find(gone) != std::string::npos);
  CHECK(refusal_of(kTriangle + "f 1/9 2/2 3/3\n").find(gone) != std::string::npos);
  CHECK(refusal_of(kTriangle + "f 1 2 3 9\n").find(gone) != std::string::npos);
  CHECK(refusal_of(kTriangle + "f 1 2 -9\n").find("that does not exist") != std::string::npos);
  CHECK(refusal_of(kTriangle + "f 1 2 3 -9\n").find(gone) != std::string::npos);
  CHECK(refusal_of(kTriangle + "f 1 2 3 2 -9\n").find("that does not exist") != std::string::npos);
  CHECK(refusal_of(kTriangle + "f 1 2 0\n").find("integers other than 0") != std::string::npos);
  for (const std::string index :
       {"4294967297", "-4294967293", "+99999999999999999999", "3/4294967297", "3//2147483648"})
    CHECK(refusal_of(kTriangle + "f 1 2 " + index + "\n") ==
          "file.obj: f 1 2 " + index + ": an index is too large");
  CHECK(refusal_of(kTriangle + "f 1 2 2147483647\n").find("does not exist") != std::string::npos);
  CHECK(refusal_of("v 1e999 0 0\n" + kTriangle + "f 1 2 3\n").find("too large") != std::string::npos);
  CHECK(refusal_of("v 1e2147483649 0 0\nf 1 1 1\n").find("too large") != std::string::npos);
  CHECK(refusal_of(kTriangle + std::string("f 1 2\0 3\n", 9)).empty());
}

TEST_CASE("Large polygons and lines take seconds", "[assets][slow]") {
  std::string text = kTriangle + "f";
  for (int i = 0; i < (1 << 20); ++i) text += " 1 2 3";
  for (int i = 0; i < 20; ++i) {
    text += "\nf";
    for (std::size_t k = 0; k < kMostClippedCorners; ++k) text += k % 2 == 0 ? " 1" : " 2";
  }
  const double seconds =
      seconds_of([&] { CHECK(read_obj(MemorySource(text), "file").warnings.size() == 1); });
  CHECK(seconds < 10.0);
}

TEST_CASE("Names that are not UTF-8 are read as Latin-1", "[assets]") {
  const MadeScene scene = made(kTriangle + "o caf\xe9\nf 1 2 3\n");
  CHECK(scene.entry("nodes", 0)["name"].text() == "caf\xc3\xa9");
}

TEST_CASE("Public OBJ files: every triangle arrives, and accessors lie in their views", "[assets][needs]") {
  const std::filesystem::path folder = shared_data("assets");
  if (folder.empty()) return;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    ++count;
    const std::string text = read_file(entry.path());
    // A polygon of n corners becomes n - 2 triangles.
    std::size_t expected = 0, triangles = 0;
    for (const std::string& line : lines_in(text)) {
      std::istringstream words(line);
      std::string word;
      std::size_t corners = 0;
      words >> word;
      if (word != "f") continue;
      while (words >> word) ++corners;
      expected += corners - 2;
    }
    const MadeScene scene = made(text);
    for (const SpanValue& mesh : scene.root()["meshes"].children())
      for (const SpanValue& primitive : mesh["primitives"].children())
        triangles += *scene.entry("accessors", *primitive["indices"].whole())["count"].whole() / 3;
    INFO(entry.path());
    CHECK(triangles == expected);
    for (const SpanValue& accessor : scene.root()["accessors"].children()) {
      const SpanValue view = scene.entry("bufferViews", *accessor["bufferView"].whole());
      const std::string type = accessor["type"].text().value_or("");
      const std::size_t components = type == "VEC3" ? 3 : type == "VEC2" ? 2 : 1;
      const std::size_t bytes = accessor["componentType"].whole() == 5123u ? 2 : 4;
      CHECK(*accessor["count"].whole() * components * bytes == *view["byteLength"].whole());
    }
  }
  CHECK(count >= 15);
}
