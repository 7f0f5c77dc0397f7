// This file tests MTL files of programs that give statements another meaning than the specification, from
// public bug reports.
#include <catch2/catch.hpp>

#include "assets/maps/legacy_maps.hpp"
#include "assets/obj/obj_gltf.hpp"
#include "runtime/assets/mtl_texts.hpp"

using namespace remap;

namespace {

// A Scene has one triangle for each material of an MTL text, converted to glTF.
struct Scene {
  AssetConversion conversion;
  std::unique_ptr<SpannedJson> json;

  SpanValue material(std::size_t i = 0) const { return json->root()["materials"].children().at(i); }
  SpanValue extension(const char* name) const { return material()["extensions"][name]; }
  SpanValue core(const char* name, std::size_t i = 0) const {
    return material(i)["pbrMetallicRoughness"][name];
  }
  double number(const char* name, std::size_t i = 0) const { return core(name, i).number().value_or(-1.0); }
  std::vector<double> base(std::size_t i = 0) const {
    std::vector<double> color;
    for (const SpanValue& value : core("baseColorFactor", i).children())
      color.push_back(value.number().value_or(-1.0));
    color.resize(3);
    return color;
  }
  ImagePixels packed() const {
    for (const NewResource& file : conversion.files)
      if (file.path.ends_with("_metallicRoughness.png")) return PlainCodec().decode(file.bytes, "");
    return {};
  }
  std::string warnings() const {
    std::string text;
    for (const std::string& warning : conversion.warnings) text += warning + "\n";
    for (const AssetMaterial& material : conversion.materials)
      for (const std::string& warning : material.warnings) text += warning + "\n";
    return text;
  }
};

Scene scene_of(const std::string& mtl, PlainResources resources = {}, const AssetOptions& options = {}) {
  std::string obj = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
  for (const std::string& line : lines_in(mtl))
    if (line.starts_with("newmtl ")) obj += "usemtl " + line.substr(7) + "\nf 1/1 2/2 3/3\n";
  resources.files["a.mtl"] = mtl;
  Scene scene;
  scene.conversion = gltf_of_obj(MemorySource(obj), "a.obj", options, resources, "a.bin");
  scene.json = std::make_unique<SpannedJson>(scene.conversion.text, "made");
  return scene;
}

AssetOptions with(bool extensions, std::optional<MtlMaker> maker = std::nullopt) {
  AssetOptions options;
  if (extensions) options.extensions = DielectricExtensions::kWritten;
  options.mtl_maker = maker;
  return options;
}

const std::string kBlender = "# Blender 4.1.1 MTL File: 'a.blend'\n# www.blender.org\n\n",
                  kBlender28 = "# Blender MTL File: 'a.blend'\n# Material Count: 1\n\n";

// Returns a surface that is bumpy in both directions, as unit normals.
std::string normal_map() {
  return map_bytes({{128, 128, 255}, {150, 110, 250}, {100, 140, 251}, {140, 160, 248}}, 4);
}

}  // namespace

TEST_CASE("reports: 01 numbers of Blender's exporter go back exactly", "[assets]") {
  const std::string mtl = kBlender +
                          "newmtl wall\nNs 360\nKa 1 1 1\nKd .18 .07 .04\nKs .5 .5 .5\nillum 2\n"
                          "newmtl gutter\nNs 640\nKa 1 1 1\nKd .8 .6 .2\nKs .5 .5 .5\nillum 3\n"
                          "newmtl half\nNs 250\nKa .6 .6 .6\nKd .8 .6 .2\nKs .5 .5 .5\nillum 3\n"
                          "newmtl roof\nNs 250\nKa 1 1 1\nKd .8 .8 .8\nKs .5 .5 .5\nillum 2\nmap_Kd t.png\n";
  PlainResources resources;
  resources.files["t.png"] = map_bytes({{10, 20, 30}, {200, 100, 50}});
  const Scene scene = scene_of(mtl, resources);
  CHECK(scene.number("roughnessFactor", 0) == Approx(0.4));
  CHECK(scene.number("metallicFactor", 0) == 0.0);
  CHECK(scene.base(0)[1] == Approx(0.07));
  CHECK(scene.number("roughnessFactor", 1) == Approx(0.2));
  CHECK(scene.number("metallicFactor", 1) == 1.0);
  CHECK(scene.base(1)[2] == Approx(0.2));
  CHECK(scene.number("metallicFactor", 2) == Approx(0.6));
  CHECK(scene.number("roughnessFactor", 3) == Approx(0.5));
  CHECK(scene.base(3) == std::vector<double>{1, 1, 1});
  CHECK(scene.warnings().find("a.mtl: was written by Blender") == 0);
  const AssetConversion lines = converted_mtl(mtl, &resources);
  CHECK(value_of(lines, "Kd") == "1 1 1");
  CHECK(value_of(lines, "Pr") == "0.5");
  CHECK(value_of(lines, "map_Kd") == "t.png");
  CHECK(lines.files.empty());
  // If the user asks for it, the specification is used.
  const Scene by_text = scene_of(mtl, resources, with(false, MtlMaker::kText));
  CHECK(by_text.number("roughnessFactor", 0) < 0.3);
  CHECK(by_text.number("metallicFactor", 1) == 0.0);
  CHECK(by_text.warnings().empty());
}

TEST_CASE("reports: 01 each version of Blender has its scale", "[assets]") {
  const auto roughness = [](const std::string& header, const std::string& exponent) {
    return scene_of(header + "newmtl a\nNs " + exponent + "\nKa 1 1 1\nKd .8 .8 .8\nKs .5 .5 .5\nillum 2\n")
        .number("roughnessFactor");
  };
  CHECK(roughness(kBlender, "250.000000") == Approx(0.5));
  CHECK(roughness("# Blender 3.6.2 MTL File: 'None'\n", "250.000000") == Approx(0.5));
  CHECK(roughness("# Blender 3.2.0 MTL File: 'None'\n", "225.000000") == Approx(0.5));
  CHECK(roughness(kBlender28, "225.000000") == Approx(0.5));
  CHECK(roughness(kBlender28, "323.999994") == Approx(0.4));
  // Blender 2.7 writes its hardness, which follows the specification.
  CHECK(roughness(kBlender28, "96.078431") == Approx(ggx_roughness({{}, {.5, .5, .5}, 96.078431})));
  CHECK(roughness(kBlender, "0") == 1.0);
  CHECK(roughness(kBlender, "1000") == 0.0);
  CHECK(roughness("\n  # some other tool\n", "250") == Approx(ggx_roughness({{}, {.5, .5, .5}, 250})));
}

TEST_CASE("reports: 01 maps of Blender hold roughness and metallic, and levels of specular are kept",
          "[assets]") {
  PlainResources resources;
  resources.files["r.png"] = map_bytes({{200}, {60}});
  resources.files["m.png"] = map_bytes({{0}, {255}});
  const std::string maps = kBlender +
                           "newmtl a\nNs 250\nKa 1 1 1\nKd .8 .8 .8\nKs .5 .5 .5\nillum 3\nmap_Ns r.png\n"
                           "map_refl m.png\n";
  const ImagePixels packed = scene_of(maps, resources).packed();
  REQUIRE(packed.bytes.size() == 6);
  const auto stored = [&](std::size_t i) { return std::to_integer<int>(packed.bytes[i]); };
  CHECK(std::vector<int>{stored(1), stored(2), stored(4), stored(5)} == std::vector<int>{200, 0, 60, 255});
  const AssetConversion lines = converted_mtl(maps, &resources);
  CHECK(value_of(lines, "map_Pr") == "r.png");
  CHECK(value_of(lines, "map_Pm") == "m.png");
  const auto level = [](const char* ks, bool extensions) {
    return scene_of(kBlender + "newmtl a\nNs 250\nKa 1 1 1\nKd .8 .8 .8\nKs " + ks + "\nillum 2\n", {},
                    with(extensions));
  };
  const Scene weak = level(".1 .1 .1", true);
  CHECK(weak.extension("KHR_materials_specular")["specularFactor"].number().value_or(0.0) == Approx(0.2));
  CHECK_FALSE(level(".5 .5 .5", true).material()["extensions"]);
  CHECK(level(".1 .1 .1", false).warnings().find("specular level") != std::string::npos);
  CHECK(level("0 0 0", false).number("roughnessFactor") == 1.0);
  CHECK(level("0 0 0", true).number("roughnessFactor") == Approx(0.5));
  // If there is a map of roughness, the number is not used.
  CHECK(scene_of(kBlender + "newmtl a\nKs .1 .1 .1\nillum 2\nPr .5\nmap_Pr r.png\n", resources, with(true))
            .number("roughnessFactor") == 1.0);
}

TEST_CASE("reports: 02 an exponent below 0 means no highlight, and what can be read of a material is kept",
          "[assets]") {
  const Scene scene = scene_of("newmtl a\nNs -1.960784\nKd .25 .25 .25\nKs .1 .1 .1\n");
  CHECK(scene.conversion.count(MaterialState::kFailed) == 0);
  CHECK(scene.base() == std::vector<double>{0.25, 0.25, 0.25});
  CHECK(scene.number("roughnessFactor") == 1.0);
  CHECK(scene.warnings().find("Ns -1.960784") != std::string::npos);
  const Scene damaged = scene_of("newmtl a\nNs shiny\nKd .25 .25 .25\nKs .1 .1 .1\n");
  CHECK(damaged.conversion.count(MaterialState::kFailed) == 1);
  CHECK(damaged.base() == std::vector<double>{0.25, 0.25, 0.25});
}

TEST_CASE("reports: 03 a bump map that holds normals is a normal map", "[assets]") {
  PlainResources resources;
  resources.files["n.png"] = normal_map();
  resources.files["h.png"] = map_bytes({{128}, {200}, {20}});
  resources.files["grey.png"] = map_bytes({{201, 201, 201}, {200, 201, 200}});
  const std::string start = "newmtl a\nKd .8 .8 .8\n";
  for (const std::string word : {"map_Bump", "bump", "map_bump"}) {
    const Scene scene = scene_of(start + word + " -bm 0.5 n.png\n", resources);
    REQUIRE(scene.material()["normalTexture"]);
    CHECK(scene.material()["normalTexture"]["scale"].number() == 0.5);
    CHECK(scene.warnings().empty());
  }
  for (const std::string name : {"h.png", "grey.png"}) {
    const Scene heights = scene_of(start + "map_Bump " + name + "\n", resources);
    CHECK_FALSE(heights.material()["normalTexture"]);
    CHECK(heights.warnings().find("holds heights") != std::string::npos);
  }
  // A statement for normals is preferred.
  const Scene both = scene_of(start + "map_Bump h.png\nnorm n.png\n", resources);
  CHECK(both.material()["normalTexture"]);
}

TEST_CASE("reports: 14 glass by illum", "[assets]") {
  const auto glass = [](const std::string& lines, bool extensions) {
    return scene_of("newmtl a\nKd .05 .05 .05\nKs .5 .5 .5\nNs 500\n" + lines, {}, with(extensions));
  };
  for (const char* model : {"4", "6", "7", "9"}) {
    const std::string lines = std::string("Ni 1.45\nTf .9 1 1\nd 1\nillum ") + model + "\n";
    const Scene scene = glass(lines, true);
    CHECK(scene.extension("KHR_materials_transmission")["transmissionFactor"].number() == 1.0);
    CHECK(scene.extension("KHR_materials_ior")["ior"].number().value_or(0.0) == Approx(1.45));
    CHECK_FALSE(scene.extension("KHR_materials_specular"));
    CHECK(scene.base()[0] == Approx(0.9));
    CHECK(scene.json->root()["extensionsUsed"].children().size() == 2);
    CHECK(glass(lines, false).warnings().find("is glass") == 0);
  }
  for (const std::string lines : {"illum 2\nNi 1.5\n", "illum 4\nNi 1\n", "illum 4\nNi 1.5\nd .4\n"}) {
    CHECK(glass(lines, false).warnings().empty());
    CHECK_FALSE(glass(lines, true).extension("KHR_materials_transmission"));
  }
  CHECK(glass("illum 7\n", false).warnings().find("add a line Ni") != std::string::npos);
}

TEST_CASE("reports: 15 bsdf pbr packs roughness and metallic into Ks", "[assets]") {
  PlainResources resources;
  resources.files["kd.png"] = map_bytes({{10, 20, 30}, {200, 100, 50}});
  resources.files["ks.png"] = map_bytes({{0, 200, 0}, {9, 60, 255}});
  resources.files["n.png"] = normal_map();
  const std::string mtl = "newmtl defaultMat\nbsdf   pbr\nmap_Kd kd.png\nmap_Ks ks.png\nbump n.png\n";
  const Scene scene = scene_of(mtl, resources);
  const ImagePixels packed = scene.packed();
  REQUIRE(packed.bytes.size() == 6);
  CHECK(std::to_integer<int>(packed.bytes[1]) == 200);
  CHECK(std::to_integer<int>(packed.bytes[4]) == 60);
  CHECK(std::to_integer<int>(packed.bytes[2]) == 0);
  CHECK(std::to_integer<int>(packed.bytes[5]) == 255);
  CHECK(scene.material()["normalTexture"]);
  CHECK(scene.core("baseColorTexture"));
  const AssetConversion lines = converted_mtl(mtl, &resources);
  CHECK(value_of(lines, "map_Pr") == "-imfchan g ks.png");
  CHECK(value_of(lines, "map_Pm") == "-imfchan b ks.png");
  CHECK_FALSE(converted_mtl(lines.text, &resources).changed);
  // Numbers have the same packing as maps. Other materials of the file follow the specification.
  const Scene numbers = scene_of("newmtl a\nbsdf pbr\nKd .2 .2 .2\nKs 0 .3 1\nnewmtl b\nKd .2 .2 .2\n");
  CHECK(numbers.number("roughnessFactor") == Approx(0.3));
  CHECK(numbers.number("metallicFactor") == 1.0);
  CHECK(numbers.number("metallicFactor", 1) == 0.0);
}

TEST_CASE("reports: a black Kd beside a map is not used", "[assets]") {
  PlainResources resources;
  resources.files["c.png"] = map_bytes({{10, 20, 30}, {200, 100, 50}});
  const Scene scene = scene_of("newmtl a\nKd 0 0 0\nmap_Kd c.png\n", resources);
  CHECK(scene.base() == std::vector<double>{1, 1, 1});
  CHECK(scene.warnings() == "Kd is 0, which would make map_Kd black: texremap uses Kd 1\n");
  CHECK(scene_of("newmtl a\nKd 0 0 0\n").base() == std::vector<double>{0, 0, 0});
}

TEST_CASE("reports: an MTL file of the OBJ file's name is read if the one that it names is not there",
          "[assets]") {
  PlainResources resources;
  resources.files["a.mtl"] = "newmtl m\nKd .2 .4 .6\n";
  const auto converted = [&](const std::string& first) {
    return gltf_of_obj(MemorySource(first + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"), "dir/a.obj",
                       {}, resources, "a.bin");
  };
  for (const std::string line : {"mtllib renamed.mtl\n", ""}) {
    const AssetConversion scene = converted(line);
    CHECK(scene.text.find("0.4") != std::string::npos);
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0].ends_with("; a.mtl is read instead"));
  }
  resources.files["other.mtl"] = "newmtl m\nKd .1 .3 .5\n";
  CHECK(converted("mtllib other.mtl\n").warnings.empty());
}
