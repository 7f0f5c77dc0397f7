// This file tests that core materials become spec-gloss, and that KHR_materials_specular and _ior are folded
// into core. It computes the meaning of a result from its JSON, by the texts of glTF 2.0 and the extensions.
// It does not use the code under test for this.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "core/number_text.hpp"
#include "runtime/assets/gltf_texts.hpp"
#include "support/shared_data.hpp"

using namespace remap;

namespace {

using Color = std::array<double, 3>;

// A Surface is what a surface reflects: the diffuse lobe's reflectance, F0, roughness.
struct Surface {
  Color diffuse{}, f0{};
  double roughness = 0.0;
};

double number_in(SpanValue object, const char* name, double otherwise) {
  return object[name] ? object[name].number().value() : otherwise;
}

Color color_in(SpanValue object, const char* name) {
  Color color = {1.0, 1.0, 1.0};
  const std::vector<SpanValue> entries = object[name].children();
  for (std::size_t c = 0; c < std::min<std::size_t>(3, entries.size()); ++c)
    color[c] = entries[c].number().value();
  return color;
}

double largest_of(const Color& color) { return *std::ranges::max_element(color); }

// This is glTF 2.0, appendix B, with the F0 of KHR_materials_specular: min(((ior - 1) / (ior + 1))^2 color,
// 1) factor. The dielectric's diffuse lobe gets the light that the largest channel of F0 does not reflect.
Surface core_surface(SpanValue material) {
  const SpanValue core = material["pbrMetallicRoughness"], extensions = material["extensions"],
                  specular = extensions["KHR_materials_specular"];
  const double ior = number_in(extensions["KHR_materials_ior"], "ior", 1.5),
               f0 = ior == 0.0 ? 1.0 : std::pow((ior - 1.0) / (ior + 1.0), 2.0),
               metallic = number_in(core, "metallicFactor", 1.0);
  const Color base = color_in(core, "baseColorFactor"), tint = color_in(specular, "specularColorFactor");
  Color dielectric{};
  for (std::size_t c = 0; c < 3; ++c)
    dielectric[c] = std::min(f0 * tint[c], 1.0) * number_in(specular, "specularFactor", 1.0);
  Surface surface;
  surface.roughness = number_in(core, "roughnessFactor", 1.0);
  for (std::size_t c = 0; c < 3; ++c) {
    surface.diffuse[c] = (1.0 - metallic) * base[c] * (1.0 - largest_of(dielectric));
    surface.f0[c] = (1.0 - metallic) * dielectric[c] + metallic * base[c];
  }
  return surface;
}

// This is KHR_materials_pbrSpecularGlossiness, appendix: c_diff = diffuse (1 - max(specular)), F0 = specular,
// alpha = (1 - glossiness)^2.
Surface specgloss_surface(SpanValue material) {
  const SpanValue extension = material["extensions"]["KHR_materials_pbrSpecularGlossiness"];
  Surface surface;
  surface.f0 = color_in(extension, "specularFactor");
  surface.roughness = 1.0 - number_in(extension, "glossinessFactor", 1.0);
  const Color diffuse = color_in(extension, "diffuseFactor");
  for (std::size_t c = 0; c < 3; ++c) surface.diffuse[c] = diffuse[c] * (1.0 - largest_of(surface.f0));
  return surface;
}

void require_alike(const Surface& a, const Surface& b, double tolerance) {
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(a.diffuse[c] == Approx(b.diffuse[c]).margin(tolerance));
    CHECK(a.f0[c] == Approx(b.f0[c]).margin(tolerance));
  }
  CHECK(a.roughness == Approx(b.roughness).margin(tolerance));
}

std::string file_with(const std::string& materials, const std::string& extensions) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":[)" + extensions + R"(],"materials":[)" + materials +
         "]}";
}

const std::string kDielectrics = R"("KHR_materials_specular","KHR_materials_ior")";

std::string text_of_color(const Color& color, const std::string& more = "") {
  return "[" + number_text(color[0]) + "," + number_text(color[1]) + "," + number_text(color[2]) + more + "]";
}

class RandomMaterials {
 public:
  explicit RandomMaterials(std::uint32_t seed) : random_(seed) {}

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Color color(double most = 1.0) { return {most * unit(), most * unit(), most * unit()}; }
  // One of three materials is a metal, one a dielectric.
  std::string core() {
    const double kind = unit(), metallic = kind < 0.33 ? 0.0 : kind < 0.66 ? 1.0 : unit();
    return R"("pbrMetallicRoughness":{"baseColorFactor":)" +
           text_of_color(color(), "," + number_text(unit())) + R"(,"metallicFactor":)" +
           number_text(metallic) + R"(,"roughnessFactor":)" + number_text(unit()) + "}";
  }
  std::string dielectric() {
    const double ior = unit() < 0.1 ? 0.0 : 1.0 + 2.0 * unit();
    return R"("extensions":{"KHR_materials_ior":{"ior":)" + number_text(ior) +
           R"(},"KHR_materials_specular":{"specularFactor":)" + number_text(unit()) +
           R"(,"specularColorFactor":)" + text_of_color(color(1.6)) + "}}";
  }

 private:
  std::mt19937 random_;
};

}  // namespace

TEST_CASE("Core materials become spec-gloss ones that reflect the same", "[assets]") {
  RandomMaterials random(3);
  for (int i = 0; i < 400; ++i) {
    const bool has_dielectric = i % 2 == 1;
    const std::string text =
        file_with("{" + random.core() + (has_dielectric ? "," + random.dielectric() : "") + "}",
                  has_dielectric ? kDielectrics : "\"KHR_lights_punctual\"");
    CAPTURE(text);
    const std::string after = converted_bytes(text, kToSpecGloss);
    const SpannedJson before_json(text, "before"), json(after, "after");
    const SpanValue before = before_json.root()["materials"].children()[0],
                    material = json.root()["materials"].children()[0];
    // Five decimals of floats must agree. If little light is left for diffuse, its factor is a quotient of
    // small numbers.
    require_alike(specgloss_surface(material), core_surface(before), 1e-5);
    CHECK(material["pbrMetallicRoughness"].raw() == before["pbrMetallicRoughness"].raw());
    CHECK_FALSE(material["extensions"]["KHR_materials_ior"]);
    CHECK(json.root()["extensionsUsed"].children().back().text() == "KHR_materials_pbrSpecularGlossiness");
    CHECK(converted_bytes(after, kToSpecGloss) == after);
  }
}

TEST_CASE("Core materials keep their numbers as spec-gloss", "[assets]") {
  const auto extension_of = [](const std::string& members) {
    const std::string after = converted_bytes(file_with("{" + members + "}", ""), kToSpecGloss);
    const SpannedJson json(after, "after");
    return std::string(
        json.root()["materials"].children()[0]["extensions"]["KHR_materials_pbrSpecularGlossiness"].raw());
  };
  CHECK(extension_of("") == R"({"diffuseFactor":[0,0,0,1],"specularFactor":[1,1,1],"glossinessFactor":0})");
  CHECK(
      extension_of(
          R"("pbrMetallicRoughness":{"baseColorFactor":[0.20,3e-1,0.4,0.50],"metallicFactor":0.0,"roughnessFactor":0.25})") ==
      R"({"diffuseFactor":[0.20,3e-1,0.4,0.50],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.75})");
  CHECK(extension_of(R"("pbrMetallicRoughness":{"baseColorFactor":[1.0,0.770,0.34,1]})") ==
        R"({"diffuseFactor":[0,0,0,1],"specularFactor":[1.0,0.770,0.34],"glossinessFactor":0})");
  CHECK(
      extension_of(
          R"("pbrMetallicRoughness":{"metallicFactor":0,"baseColorFactor":[0.5,0.5,0.5,1]},"extensions":{"KHR_materials_specular":{"specularColorFactor":[0.5,0.25,0.1]},"KHR_materials_ior":{"ior":0}})") ==
      R"({"diffuseFactor":[0.5,0.5,0.5,1],"specularFactor":[0.5,0.25,0.1],"glossinessFactor":0})");
}

TEST_CASE("Materials stay that cannot become spec-gloss", "[assets]") {
  const auto failures = [](const std::string& extensions) {
    return convert_gltf(MemorySource(file_with("{\"extensions\":{" + extensions + "}}", "")), "file",
                        kToSpecGloss)
        .materials.at(0)
        .failure;
  };
  CHECK(failures(R"("KHR_materials_clearcoat":{})") ==
        "has KHR_materials_clearcoat, which viewers ignore in spec-gloss materials (remove it from the "
        "material)");
  CHECK(failures(R"("ACME_fur":{})") ==
        "has ACME_fur, which is unknown and may have no effect in spec-gloss materials (remove it "
        "from the material)");
  CHECK(failures(R"("KHR_materials_ior":{"ior":0.5})") == "ior 0.5: expected 0, or a number of at least 1");
  CHECK(failures(R"("KHR_materials_emissive_strength":{})").empty());
  const std::string text = file_with(
      R"({"extensions":{"KHR_materials_unlit":{}}},{"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}})",
      R"("KHR_materials_unlit","KHR_materials_pbrSpecularGlossiness")");
  CHECK(converted_bytes(text, kToSpecGloss) == text);
  const std::string animated =
      R"({"asset":{"version":"2.0"},"materials":[{}],"animations":[{"channels":[{"target":{"extensions":)"
      R"({"KHR_animation_pointer":{"pointer":"/materials/0/pbrMetallicRoughness/roughnessFactor"}}}}]}]})";
  CHECK(convert_gltf(MemorySource(animated), "file", kToSpecGloss).materials.at(0).failure ==
        "an animation (KHR_animation_pointer) changes a value that this conversion replaces (remove this "
        "channel of the animation)");
}

TEST_CASE("Core materials come back from spec-gloss", "[assets]") {
  RandomMaterials random(5);
  double largest = 0.0;
  for (int i = 0; i < 300; ++i) {
    const std::string text = file_with("{" + random.core() + "}", "");
    CAPTURE(text);
    const std::string back = converted_bytes(converted_bytes(text, kToSpecGloss));
    const SpannedJson before(text, "before"), after(back, "after");
    const Surface a = core_surface(before.root()["materials"].children()[0]),
                  b = core_surface(after.root()["materials"].children()[0]);
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max({largest, std::fabs(a.diffuse[c] - b.diffuse[c]), std::fabs(a.f0[c] - b.f0[c])});
  }
  // The prior of the projection slightly changes materials between dielectrics and metals.
  CHECK(largest < 2e-4);
  INFO(largest);
}

TEST_CASE("Folding the exact form gives the core form", "[assets]") {
  RandomMaterials random(7);
  for (int i = 0; i < 300; ++i) {
    const std::string text = specgloss_text(R"({"diffuseFactor":)" + text_of_color(random.color(), ",0.5") +
                                            R"(,"specularFactor":)" + text_of_color(random.color()) +
                                            R"(,"glossinessFactor":)" + number_text(random.unit()) + "}");
    CAPTURE(text);
    const std::string folded = converted_bytes(converted_bytes(text, kExactOptions), kFolding),
                      core = converted_bytes(text);
    const SpannedJson a(folded, "folded"), b(core, "core");
    const SpanValue material = a.root()["materials"].children()[0];
    CHECK_FALSE(material["extensions"]);
    CHECK_FALSE(a.root()["extensionsUsed"]);
    const SpanValue expected = b.root()["materials"].children()[0];
    const Color base = color_in(material["pbrMetallicRoughness"], "baseColorFactor"),
                expected_base = color_in(expected["pbrMetallicRoughness"], "baseColorFactor");
    // Diffuse is converted to its reflectance and back, which rounds it.
    for (std::size_t c = 0; c < 3; ++c) CHECK(base[c] == Approx(expected_base[c]).margin(1e-6));
    for (const char* name : {"metallicFactor", "roughnessFactor"})
      CHECK(number_in(material["pbrMetallicRoughness"], name, 1.0) ==
            Approx(number_in(expected["pbrMetallicRoughness"], name, 1.0)).margin(1e-6));
    CHECK(converted_bytes(folded, kFolding) == folded);
  }
}

TEST_CASE("Folding keeps what core can represent", "[assets]") {
  RandomMaterials random(11);
  for (int i = 0; i < 100; ++i) {
    const std::string core = random.core();
    const std::string text = file_with(
        "{" + core + R"(,"extensions":{"KHR_materials_ior":{"ior":1.5},"KHR_materials_specular":{}}})",
        kDielectrics);
    CAPTURE(text);
    const std::string after = converted_bytes(text, kFolding);
    const SpannedJson before_json(text, "before"), json(after, "after");
    require_alike(core_surface(json.root()["materials"].children()[0]),
                  core_surface(before_json.root()["materials"].children()[0]), 2e-4);
  }
}

TEST_CASE("What folding does not change", "[assets]") {
  const std::string kept = R"({"extensions":{"KHR_materials_ior":{},"KHR_materials_volume":{}}})";
  const AssetConversion result = convert_gltf(
      MemorySource(file_with(
          kept +
              R"(,{"extensions":{"KHR_materials_ior":{}}},{},{"extensions":{"KHR_materials_ior":{},"KHR_materials_unlit":{}}})",
          kDielectrics)),
      "file", kFolding);
  CHECK(result.materials[0].failure ==
        "has KHR_materials_volume, which needs KHR_materials_ior (convert it without --extensions fold)");
  CHECK(result.count(MaterialState::kConverted) == 1);
  CHECK(result.count(MaterialState::kUntouched) == 2);
  // Two materials still use KHR_materials_ior. Nothing uses the other extension any more, so it is removed.
  CHECK(result.text.find("\"KHR_materials_ior\"],") != std::string::npos);
  AssetOptions wrong = kFolding;
  wrong.target = AssetTarget::kSpecGloss;
  CHECK_THROWS_WITH(convert_gltf(MemorySource("{}"), "file", wrong),
                    Catch::Contains("only folded into core"));
}

TEST_CASE("Spec-gloss beside an index that was ignored is not folded later", "[assets]") {
  const std::string after = converted_bytes(
      specgloss_text(R"({"specularFactor":[0.04,0.04,0.04]},"KHR_materials_ior":{"ior":2})"), kFolding);
  CHECK(after.find("KHR_materials_ior") == std::string::npos);
  CHECK(converted_bytes(after, kFolding) == after);
}

TEST_CASE("Vertex colors of metals are named on the way to spec-gloss", "[assets]") {
  std::string text = file_with("{}", "");
  text.replace(text.size() - 1, 1,
               R"(,"meshes":[{"primitives":[{"attributes":{"COLOR_0":0},"material":0}]}]})");
  CHECK(convert_gltf(MemorySource(text), "file", kToSpecGloss).materials[0].warnings ==
        std::vector<std::string>{"vertex colors of 1 primitive tinted its reflection and now tint only its "
                                 "diffuse color"});
}

TEST_CASE("Indices and specular colors of public files go into core", "[assets][needs]") {
  const std::filesystem::path file = shared_data("assets/gltf/17_ior/17_ior.gltf");
  if (file.empty()) return;
  const std::string text = read_file(file), after = converted_bytes(text, kFolding);
  const SpannedJson before_json(text, "before"), json(after, "after");
  CHECK(after.find("KHR_materials_ior") == std::string::npos);
  const std::vector<SpanValue> before = before_json.root()["materials"].children(),
                               materials = json.root()["materials"].children();
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Surface a = core_surface(before[i]), b = core_surface(materials[i]);
    // A grey plastic with an F0 of .034 to .111 is close to what core can represent.
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(a.f0[c] == Approx(b.f0[c]).margin(0.02));
      CHECK(a.diffuse[c] == Approx(b.diffuse[c]).margin(0.05));
    }
  }
}
