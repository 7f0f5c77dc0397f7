// This file tests how MTL files are edited: which lines, by which formula, and what stays byte for byte.
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "assets/maps/legacy_maps.hpp"
#include "assets/maps/map_pixels.hpp"
#include "core/input_file.hpp"
#include "core/number_text.hpp"
#include "runtime/assets/mtl_texts.hpp"
#include "support/build_speed.hpp"
#include "support/shared_data.hpp"

using namespace remap;

namespace {

LegacyMaterial grey(double diffuse, double specular, double exponent) {
  return {{diffuse, diffuse, diffuse}, {specular, specular, specular}, exponent};
}

double number_in(const AssetConversion& conversion, const std::string& word) {
  return parse_number(value_of(conversion, word)).value_or(-1.0);
}

// Checks that every byte outside of touched spans is in the new text, in the same order. Everything between
// was added.
void require_kept(const std::string& before, const AssetConversion& conversion) {
  std::size_t at = 0, from = 0;
  const auto require_next = [&](const std::string& part) {
    // Added lines lie between bytes that stay, so each line is searched separately.
    for (std::size_t begin = 0; begin < part.size();) {
      const std::size_t end = std::min(part.find('\n', begin), part.size() - 1) + 1;
      const std::string line = part.substr(begin, end - begin);
      const std::size_t found = conversion.text.find(line, at);
      REQUIRE(found != std::string::npos);
      at = found + line.size();
      begin = end;
    }
  };
  for (const TextSpan& span : conversion.touched) {
    require_next(before.substr(from, span.begin - from));
    from = span.end;
  }
  require_next(before.substr(from));
}

}  // namespace

TEST_CASE("Blinn's exponent and strength become roughness and F0", "[assets]") {
  // The constants (1.7 / (n + 4))^.25 and 6.3 Ks / (n + 2) were found by separate code under other lights.
  const LegacyMaterial material = grey(0.64, 0.5, 96.078431);
  CHECK(ggx_roughness(material) == Approx(0.361016547).epsilon(0.04));
  CHECK(ggx_f0(material)[0] == Approx(0.0321171533).epsilon(0.08));
  CHECK(ggx_f0(grey(0.0, 0.5, 8.0))[0] == Approx(0.315).epsilon(0.08));
  CHECK(ggx_f0(grey(0.0, 1.0, 1.0))[0] == 1.0);
  CHECK(ggx_roughness(grey(0.0, 1.0, 1e30)) == ggx_roughness(grey(0.0, 1.0, 1e4)));
}

TEST_CASE("Core keeps the sum of diffuse and specular", "[assets]") {
  // If base color is not clamped, base (1 - metallic) + metallic base + .04 (1 - metallic) is the sum of
  // diffuse and specular.
  for (const double diffuse : {0.0, 0.05, 0.3, 0.7})
    for (const double specular : {0.01, 0.2, 0.6})
      for (const double exponent : {5.0, 50.0, 500.0}) {
        const LegacyMaterial material = grey(diffuse, specular, exponent);
        const MetalRoughFactors core = core_of_legacy(material);
        const double sum = diffuse + ggx_f0(material)[0];
        const double share = 1.0 - core.metallic;
        const double base = core.base_color[0];
        const bool is_matte = ggx_f0(material)[0] < 0.001;
        if (base < 1.0 && base > 0.0 && !is_matte) CHECK(base + 0.04 * share == Approx(sum).margin(1e-6));
      }
  CHECK(core_of_legacy(grey(0.5, 0.5, 200.0)).metallic == 0.0);
  CHECK(core_of_legacy(grey(0.0, 0.5, 5.0)).metallic == 1.0);
  CHECK(core_of_legacy(grey(0.0, 0.0, 5.0)).metallic == 0.0);
}

TEST_CASE("A dielectric has the highlight's F0 at every angle", "[assets]") {
  const LegacyMaterial material{{0.5, 0.1, 0.0}, {0.5, 0.25, 0.0}, 48.0};
  const LegacyDielectric result = dielectric_of_legacy(material);
  CHECK(result.specular == ggx_f0(material)[0]);
  CHECK(result.specular_color[1] == Approx(0.5));
  CHECK(result.base_color[0] == Approx(0.5 / (1.0 - result.specular)));
  CHECK(dielectric_of_legacy(grey(0.5, 1.0, 1.0)).base_color[0] == 1.0);
}

TEST_CASE("Blender's default material gains two lines, and Kd its base color", "[assets]") {
  const std::string text =
      "# Blender MTL File: 'None'\n\nnewmtl Material\nNs 96.078431\nKa 0.200000 0.200000 0.200000\n"
      "Kd 0.640000 0.640000 0.640000\nKs 0.500000 0.500000 0.500000\nNi 1.000000\nd 1.000000\nillum 2\n";
  const AssetConversion conversion = converted_mtl(text);
  REQUIRE(conversion.changed);
  const LegacyMaterial material = grey(0.64, 0.5, 96.078431);
  CHECK(number_in(conversion, "Kd") == -1.0);
  CHECK(parse_number(value_of(conversion, "Kd").substr(0, 7)).value() ==
        Approx(0.64 + ggx_f0(material)[0] - 0.04).margin(1e-5));
  CHECK(number_in(conversion, "Pr") == ggx_roughness(material));
  CHECK(value_of(conversion, "Pm") == "0");
  CHECK(conversion.text.ends_with("illum 2\nPr " + value_of(conversion, "Pr") + "\nPm 0\n"));
  CHECK(conversion.touched.size() == 3);
  CHECK(conversion.materials[0].warnings.empty());
  CHECK(conversion.materials[0].factors.size() == 3);
  CHECK_FALSE(converted_mtl(conversion.text).changed);
}

TEST_CASE("A material of Blender with a map and no Kd only gains lines", "[assets]") {
  const std::string text =
      "# Blender MTL File: 'None'\n# Material Count: 1\n\nnewmtl a\nNs 250\nKs 0.5 0.5 0.5\nmap_Kd "
      "a.png\nillum 2\n";
  const AssetConversion conversion = converted_mtl(text);
  CHECK(conversion.text.starts_with(text + "Pr "));
  CHECK(conversion.text.ends_with("Pm 0\n"));
}

TEST_CASE("A material without a highlight keeps Kd", "[assets]") {
  for (const std::string lines : {"Ks 0 0 0\nNs 50\n", "Ks .5 .5 .5\nNs 50\nillum 1\n", "Ns 50\n"}) {
    const std::string text = "newmtl a\nKd 0.80 .30 1\n" + lines;
    const AssetConversion conversion = converted_mtl(text);
    CHECK(conversion.text == text + "Pr 1\nPm 0\n");
    CHECK(conversion.materials[0].warnings.empty());
    CHECK(conversion.touched.empty());
  }
  for (const std::string lines : {"Ks .5 .5 .5\nNs 0.0\n", "Ks .5 .5 .5\n"}) {
    const AssetConversion conversion = converted_mtl("newmtl a\nKd 1 1 1\n" + lines);
    CHECK(value_of(conversion, "Pr") == "1");
    CHECK(conversion.materials[0].warnings.size() == 1);
  }
}

TEST_CASE("Materials with Pr or Pm, and those that say nothing, stay", "[assets]") {
  for (const std::string lines :
       {"Kd x\nPr .5\n", "Kd 1 1 1\nPm 0\n", "map_Pr a.png\n", "MAP_PM a.png\n", "", "illum 2\n"}) {
    const std::string text = "newmtl a\n" + lines;
    const AssetConversion conversion = converted_mtl(text);
    CHECK_FALSE(conversion.changed);
    CHECK(conversion.text == text);
    CHECK(conversion.materials[0].state == MaterialState::kUntouched);
    CHECK(conversion.pieces.empty());
  }
}

TEST_CASE("Added lines have the ending and the indentation of the last statement", "[assets]") {
  CHECK(converted_mtl("newmtl a\r\n\tKd 1 1 1\r\n\r\n# end\r\n").text ==
        "newmtl a\r\n\tKd 1 1 1\r\n\tPr 1\r\n\tPm 0\r\n\r\n# end\r\n");
  CHECK(converted_mtl("newmtl a\rKd 1 1 1").text == "newmtl a\rKd 1 1 1\rPr 1\rPm 0");
  CHECK(converted_mtl("newmtl\nKd 1 \\\n  1 1\nnewmtl b\nKd 0 0 0\n").text ==
        "newmtl\nKd 1 \\\n  1 1\nPr 1\nPm 0\nnewmtl b\nKd 0 0 0\nPr 1\nPm 0\n");
}

TEST_CASE("Channels of Kd that do not change keep their text, one number becomes three", "[assets]") {
  const AssetConversion one = converted_mtl("newmtl a\nKd 0.5 # grey\nKs 1 .5 .5\nNs 20\n");
  CHECK(value_of(one, "Kd").ends_with(" # grey"));
  CHECK(one.text.find("Kd 0.5 #") == std::string::npos);
  // If the form gives F0 .04, base color is the diffuse color.
  double ks = 0.5;
  for (int i = 0; i < 20; ++i) ks *= 0.04 / ggx_f0(grey(0.5, ks, 98.0))[0];
  const std::string text = number_text(ks);
  const AssetConversion same =
      converted_mtl("newmtl a\nKd .50 0.500 5e-1\nKs " + text + " " + text + " " + text + "\nNs 98\n");
  CHECK(value_of(same, "Kd") == ".50 0.500 5e-1");
}

TEST_CASE("A material that fails stays, others go on", "[assets]") {
  const std::string text = "newmtl a\nKd spectral x.rfl\nnewmtl b\nKd 1 1 1\n";
  const AssetConversion conversion = converted_mtl(text);
  CHECK(conversion.text == text + "Pr 1\nPm 0\n");
  CHECK(conversion.materials[0].state == MaterialState::kFailed);
  CHECK(conversion.materials[1].state == MaterialState::kConverted);
}

TEST_CASE("A map of diffuse stays where base color is the map", "[assets]") {
  PlainResources resources;
  resources.files["wood.png"] = map_bytes({{110, 120, 130}, {200, 100, 90}});
  // At an F0 of .04, base color equals diffuse, so the map stays.
  const AssetConversion kept =
      converted_mtl("newmtl a\nKd 1 1 1\nKs 1 1 1\nNs 155.5\nmap_Kd wood.png\n", &resources);
  CHECK(kept.materials[0].failure.empty());
  CHECK(kept.files.empty());
  CHECK(kept.text.find("map_Kd wood.png\nPr ") != std::string::npos);
  CHECK(kept.touched.empty());
  // The material has no highlight, so the map is not even read.
  CHECK(converted_mtl("newmtl a\nmap_Kd missing.png\n", &resources).files.empty());
}

TEST_CASE("Maps are converted texel by texel, as factors are", "[assets]") {
  PlainResources resources;
  const std::vector<std::vector<int>> diffuse = {{10, 20, 30}, {200, 100, 50}, {255, 255, 255}, {0, 0, 0}},
                                      specular = {{255, 255, 255}, {0, 0, 0}, {90, 80, 70}, {255, 180, 60}},
                                      exponent = {{255}, {128}, {20}, {64}};
  resources.files["t/wood.png"] = map_bytes(diffuse);
  resources.files["t/shine.png"] = map_bytes(specular);
  resources.files["t/n.png"] = map_bytes(exponent);
  const std::string text =
      "newmtl a\nKd .8 .8 .8\nKs .9 .6 .3\nNs 100\nmap_Kd -s 2 2 t\\wood.png\nmap_Ks -s 2 2 t/shine.png\n"
      "map_Ns -s 2 2 t/n.png\nnewmtl b\nKd .8 .8 .8\nKs .9 .6 .3\nNs 100\nmap_Kd -s 2 2 t\\wood.png\n"
      "map_Ks -s 2 2 t/shine.png\nmap_Ns -s 2 2 t/n.png\n";
  const AssetConversion conversion = converted_mtl(text, &resources);
  REQUIRE(conversion.materials[0].failure.empty());
  REQUIRE(conversion.files.size() == 3);  // both materials share the new images
  CHECK(conversion.files[0].path == "t/wood_baseColor.png");
  CHECK(conversion.files[1].path == "t/shine_roughness.png");
  CHECK(conversion.files[2].path == "t/shine_metallic.png");
  CHECK(value_of(conversion, "Kd") == "1 1 1");
  CHECK(value_of(conversion, "map_Kd") == "-s 2 2 t/wood_baseColor.png");
  CHECK(value_of(conversion, "map_Pr") == "-s 2 2 t/shine_roughness.png");
  CHECK(value_of(conversion, "Pm") == "1");
  CHECK(conversion.materials[0].warnings.size() == 1);  // the warning says how map_Ns is read
  const auto pixels = [&](std::size_t file) { return PlainCodec().decode(conversion.files[file].bytes, ""); };
  const ImagePixels base = pixels(0), roughness = pixels(1), metallic = pixels(2);
  const auto stored = [](const ImagePixels& image, std::size_t texel, std::size_t channel) {
    return std::to_integer<int>(image.bytes[texel * image.channels + channel]);
  };
  for (std::size_t i = 0; i < 4; ++i) {
    LegacyMaterial texel;
    const std::array<double, 3> factors = {0.9, 0.6, 0.3};
    for (std::size_t c = 0; c < 3; ++c) {
      texel.diffuse[c] =
          0.8 * static_cast<double>(linear_of_srgb(static_cast<float>(diffuse[i][c]) / 255.0f));
      texel.specular[c] =
          factors[c] * static_cast<double>(linear_of_srgb(static_cast<float>(specular[i][c]) / 255.0f));
    }
    texel.exponent = 100.0 * exponent[i][0] / 255.0;
    const MetalRoughFactors expected = core_of_legacy(texel);
    for (std::size_t c = 0; c < 3; ++c) {
      const double back =
          static_cast<double>(linear_of_srgb(static_cast<float>(stored(base, i, c)) / 255.0f));
      CHECK(back == Approx(expected.base_color[c]).margin(0.005));
    }
    CHECK(stored(roughness, i, 0) == std::lround(expected.roughness * 255.0));
    CHECK(stored(metallic, i, 0) == std::lround(expected.metallic * 255.0));
  }
  CHECK_FALSE(converted_mtl(conversion.text, &resources).changed);
}

TEST_CASE("-mm moves the values of a map before it is converted", "[assets]") {
  PlainResources resources;
  resources.files["d.png"] = map_bytes({{10, 20, 30, 77}, {200, 100, 50, 0}, {120, 130, 0, 255}});
  resources.files["n.png"] = map_bytes({{0}, {100}, {200}});
  resources.files["baked/d.png"] = map_bytes({{46, 66, 86, 77}, {255, 226, 126, 0}, {255, 255, 26, 255}});
  resources.files["baked/n.png"] = map_bytes({{51}, {101}, {151}});
  const std::string numbers = "newmtl a\nKd .8 .8 .8\nKs .9 .6 .3\nNs 100\n";
  const AssetConversion moved = converted_mtl(
      numbers + "map_Kd -mm .1 2 -s 2 2 d.png -blendu on\nmap_Ns -s 2 2 n.png -mm .2 .5\n", &resources);
  const AssetConversion baked =
      converted_mtl(numbers + "map_Kd -s 2 2 baked/d.png\nmap_Ns -s 2 2 baked/n.png\n", &resources);
  REQUIRE(moved.materials[0].failure.empty());
  REQUIRE(moved.files.size() == baked.files.size());
  REQUIRE(moved.files.size() >= 2);
  for (std::size_t i = 0; i < moved.files.size(); ++i) CHECK(moved.files[i].bytes == baked.files[i].bytes);
  CHECK(value_of(moved, "map_Kd") == "-s 2 2 d_baseColor.png -blendu on");
  CHECK(value_of(moved, "map_Pr").starts_with("-s 2 2 "));
  // Materials whose -mm differ share nothing, wherever -mm stands in the line.
  const std::string other = numbers + "map_Ns n.png -mm 0 .5\n";
  const AssetConversion both = converted_mtl(numbers + "map_Ns n.png -mm .2 .5\n" + other, &resources);
  CHECK(both.files.size() == 2 * converted_mtl(other, &resources).files.size());
  // If the map stays, its line does not change.
  const AssetConversion kept =
      converted_mtl("newmtl a\nKd 1 1 1\nKs 1 1 1\nNs 155.5\nmap_Kd -mm .5 .25 d.png\n", &resources);
  CHECK(value_of(kept, "map_Kd") == "-mm .5 .25 d.png");
  CHECK(kept.files.empty());
}

TEST_CASE("Constant maps become factors", "[assets]") {
  PlainResources resources;
  resources.files["d.png"] = map_bytes({{188, 188, 188}, {188, 188, 188}});
  resources.files["s.png"] = map_bytes({{255, 255, 255}, {255, 255, 255}});
  const AssetConversion conversion =
      converted_mtl("newmtl a\nKd 1 1 1\nmap_Kd d.png\nKs 1 1 1\nNs 20\nmap_Ks s.png\n", &resources);
  REQUIRE(conversion.materials[0].failure.empty());
  CHECK(conversion.files.empty());
  CHECK(value_of(conversion, "map_Kd").empty());
  CHECK(parse_number(value_of(conversion, "Pm")).value_or(0) > 0.1);
}

TEST_CASE("Maps that cannot be converted fail with a reason", "[assets]") {
  PlainResources resources;
  resources.files["d.png"] = map_bytes({{1, 2, 3}, {4, 5, 6}});
  resources.files["s.png"] = map_bytes({{1, 2, 3}});
  resources.files["x.png"] = "no image";
  const auto failure = [&](const std::string& lines, const AssetOptions& options = {}) {
    return converted_mtl("newmtl a\nKd 1 1 1\nKs 1 1 1\nNs 20\n" + lines, &resources, options)
        .materials[0]
        .failure;
  };
  CHECK(failure("map_Kd d.png\nmap_Ks s.png\n") ==
        "s.png is 1x1, but d.png is 2x1 (--resample enlarges the smaller one)");
  AssetOptions enlarging;
  enlarging.resamples = true;
  CHECK(failure("map_Kd d.png\nmap_Ks s.png\n", enlarging).empty());
  CHECK(failure("map_Kd gone.png\n") == "gone.png: was not found (put it next to the MTL file)");
  CHECK(failure("map_Kd x.png\n") == "x.png: is no image");
  CHECK(failure("map_Kd -t .1 d.png\n") == "d.png: has -t, which is not applied (bake it into the image)");
  CHECK(failure("map_Kd -cc on d.png\n") ==
        "d.png: has -cc on, which is not applied (bake it into the image)");
  CHECK(failure("map_Kd -s 2 2 d.png\nmap_Ks d.png\n") ==
        "d.png and d.png have different options -s, -o or -clamp (give both maps the same options)");
  CHECK(converted_mtl("newmtl a\nKs 1 1 1\nmap_Ns d.png\n", &resources).materials[0].failure ==
        "has map_Ns but no Ns, which the map multiplies (add a line such as Ns 1000)");
}

TEST_CASE("Names that lead out of the folder are looked for beside the file", "[assets]") {
  PlainResources resources;
  resources.files["d.png"] = map_bytes({{1, 2, 3}, {4, 5, 6}});
  for (const std::string name : {"/d.png", "..\\x\\d.png", "C:\\images\\d.png", "../d.png"}) {
    const AssetConversion conversion =
        converted_mtl("newmtl a\nKd 1 1 1\nKs 1 1 1\nNs 20\nmap_Kd " + name + "\n", &resources);
    CHECK(conversion.materials[0].failure.empty());
    CHECK(conversion.materials[0].warnings.back().ends_with(" is read from d.png"));
    REQUIRE(conversion.resources.size() == 1);
    CHECK(conversion.resources[0].path == "d.png");
  }
  CHECK(converted_mtl("newmtl a\nKd 1 1 1\nmap_Kd /etc/..\n", &resources).resources.empty());
  // The resources may allow files above the folder, which are then read there.
  resources.files["../up/e.png"] = map_bytes({{10, 20, 30}, {200, 100, 90}});
  const AssetConversion above =
      converted_mtl("newmtl a\nKd 1 1 1\nKs 1 1 1\nNs 20\nmap_Kd ..\\up\\e.png\n", &resources);
  CHECK(above.resources.at(0).path == "../up/e.png");
  CHECK(above.files.at(0).path == "../up/e_baseColor.png");
}

TEST_CASE("Names of files become neither options nor statements", "[assets]") {
  PlainResources resources;
  const std::string bytes = map_bytes({{10, 20, 30}, {200, 100, 90}});
  const auto converted = [&](const std::string& file) {
    resources.files = {{file, bytes}};
    return converted_mtl("newmtl a\nKd 1 1 1\nKs 1 1 1\nNs 20\nmap_Kd ./" + file + "\n", &resources);
  };
  const AssetConversion dashed = converted("-s 2 2 wood.png");
  CHECK(value_of(dashed, "map_Kd") == "./-s 2 2 wood_baseColor.png");
  CHECK(dashed.files.at(0).path == "-s 2 2 wood_baseColor.png");
  CHECK(converted("a\x01\xe2\x80\xa8"
                  "b\xff.png")
            .files.at(0)
            .path == "a__b\xff_baseColor.png");
  // If several assets use one image, the name of the asset is the prefix.
  resources.prefix = "\\a -s 2 2\nnewmtl b\nKd 1 0 0\n#_";
  const AssetConversion prefixed = converted("wood.png");
  CHECK(prefixed.files.at(0).path == "_a _s 2 2_newmtl b_Kd 1 0 0_#_wood_baseColor.png");
  CHECK(value_of(prefixed, "map_Kd") == prefixed.files.at(0).path);
  CHECK(converted_mtl(prefixed.text).materials.size() == 1);
}

TEST_CASE("Random texts: all but converted lines stays byte for byte, and a second run changes nothing",
          "[assets]") {
  std::mt19937 random(11);
  const auto pick = [&](const std::vector<std::string>& of) { return of[random() % of.size()]; };
  for (int i = 0; i < 400; ++i) {
    const std::string ending = pick({"\n", "\r\n"});
    std::string text = pick({"", "\xef\xbb\xbf", "# head" + ending, ending, "Kd 9 9 9" + ending});
    int number = 0;
    for (std::size_t count = random() % 30; count > 0; --count) {
      // Each line must be unique in its text, so that it can be searched.
      const std::string mark = " #" + std::to_string(number++);
      text += pick({"", " ", "\t", "  "}) +
              pick({"newmtl a b" + mark,
                    "newmtl",
                    "Kd .5 0.50 5e-1" + mark,
                    "kd 0.3" + mark,
                    "Ks .2 .3 .4" + mark,
                    "Ks 0 0 0",
                    "Ns 96.078431" + mark,
                    "Ns -1",
                    "NS\t7",
                    "illum 2",
                    "illum 0",
                    "Ni 1.45",
                    "# x \\",
                    "",
                    "foo bar" + mark,
                    "Ke 0 0 0",
                    "d 1",
                    "Tr 1",
                    "Kd 1 \\" + ending + " 0 1",
                    "\xff\xfe bytes",
                    "Ks spectral a.rfl 1",
                    "Pr 0.5",
                    "map_Ka x y.png"}) +
              pick({"", " ", "\t\t"}) + ending;
    }
    if (random() % 3 == 0 && text.size() > 2) text.resize(text.size() - ending.size());
    const AssetConversion once = converted_mtl(text);
    require_kept(text, once);
    CHECK(once.changed == (once.text != text));
    if (!once.changed) continue;
    const AssetConversion twice = converted_mtl(once.text);
    REQUIRE_FALSE(twice.changed);
    REQUIRE(twice.text == once.text);
    REQUIRE(twice.materials.size() == once.materials.size());
  }
}

TEST_CASE("Public MTL files: only added lines and Kd differ", "[assets][needs]") {
  const std::filesystem::path folder = shared_data("assets/mtl");
  if (folder.empty()) return;
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".mtl") continue;
    ++count;
    const std::string text = read_file(entry.path());
    const AssetConversion conversion = converted_mtl(text);
    std::vector<std::string> before = lines_in(text), after = lines_in(conversion.text);
    std::erase_if(after, [](const std::string& line) { return line.starts_with("P"); });
    for (std::vector<std::string>* lines : {&before, &after})
      std::erase_if(*lines, [](const std::string& line) { return line.starts_with("Kd"); });
    CHECK(before == after);
    CHECK_FALSE(converted_mtl(conversion.text).changed);
  }
  CHECK(count >= 15);
}

TEST_CASE("A hundred thousand materials are converted in seconds", "[assets][slow]") {
  std::string text;
  for (int i = 0; i < 100000; ++i)
    text += "newmtl m" + std::to_string(i) + "\nKd .5 .5 .5\nKs .5 .5 .5\nNs " + std::to_string(i % 900 + 1) +
            "\n";
  const double seconds =
      seconds_of([&] { CHECK(converted_mtl(text).count(MaterialState::kConverted) == 100000); });
  CHECK(seconds < 10.0);
}
