// This file tests layouts: results packed into one file, split into several, and packed again.
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/skip.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kLayoutSize = kMapSize;

ProcessResult convert(const Session& session, const std::string& from, const std::string& to, Words words,
                      const std::string& folder) {
  return session.texremap(Words("convert --from " + from + " --to " + to) + words + "-o " + folder);
}

std::vector<float> channel(const Session& session, const std::string& name, int index) {
  const TestImage image = session.image(name);
  std::vector<float> values;
  for (int y = 0; y < image.spec.height; ++y)
    for (int x = 0; x < image.spec.width; ++x) values.push_back(image.at(x, y, index));
  return values;
}

Words packed(const std::string& path) {
  return "--roughness " + path + ":G --input occlusion=" + path + ":R --metallic " + path +
         ":B --specular 0.4";
}

}  // namespace

TEST_CASE("texremap layouts: a packed map taken apart and packed again", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("png", "tif", "exr", "tga");
  const OIIO::TypeDesc type = extension == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8;
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  session.map(named("in"), kColor, type);
  Words words = packed(named("in"));
  words += "--layout separate";
  require_success(convert(session, "mitsuba/ward", "mitsuba/as", words, "apart"));
  CHECK(channel(session, named("apart/occlusion"), 0) == channel(session, named("in"), 0));
  CHECK(channel(session, named("apart/metallic"), 0) == channel(session, named("in"), 2));
  const std::vector<float> given = channel(session, named("in"), 1);
  std::vector<float> expected;
  for (const float alpha : given)
    expected.push_back(as_stored(converted_texel(alpha, {0.4f, 0.4f, 0.4f})[0], type));
  CHECK(channel(session, named("apart/roughness"), 0) == expected);
  CHECK(session.image(named("apart/roughness")).spec.format == type);

  // The maps are packed again and converted to another model. Then as-inputs keeps that layout.
  const std::string layout = GENERATE("orm", "arm");
  require_success(convert(session, "mitsuba/as", "mitsuba/ggx",
                          "--roughness " + named("apart/roughness") +
                              " --input occlusion=" + named("apart/occlusion") + " --metallic " +
                              named("apart/metallic") + " --specular 0.4 --layout " + layout,
                          "packed"));
  CHECK(channel(session, named("packed/" + layout), 0) == channel(session, named("in"), 0));
  CHECK(channel(session, named("packed/" + layout), 2) == channel(session, named("in"), 2));
  require_success(convert(session, "mitsuba/as", "mitsuba/ggx",
                          "--roughness " + named("apart/roughness") + " --specular 0.4", "plain"));
  CHECK(channel(session, named("packed/" + layout), 1) == channel(session, named("plain/roughness"), 0));
}

TEST_CASE("texremap layouts: missing maps give a warning") {
  const Session session;
  session.map("r.png", kGrey);
  const ProcessResult result = require_success(
      convert(session, "mitsuba/ward", "mitsuba/as", "--roughness r.png --specular 0.4 --layout orm", "out"));
  CHECK_THAT(result.errors, Contains("no occlusion map; occlusion is set to 1") &&
                                Contains("no metallic map; metallic is set to 0"));
  CHECK(channel(session, "out/orm.png", 0) == std::vector<float>(kLayoutSize * kLayoutSize, 1.0f));
  CHECK(channel(session, "out/orm.png", 2) == std::vector<float>(kLayoutSize * kLayoutSize, 0.0f));
}

namespace {

// The tests below write this metallic set in the arrangement of a tool (`preset`).
const std::string kOrmFile = "in/wood_occlusionRoughnessMetallic.png";

void write_orm_set(const Session& session) {
  session.map("in/wood_occlusionRoughnessMetallic.png", kColor);
  session.map("in/wood_baseColor.png", kColor, [](int x, int y, int c) { return noise(x, y, 3 + c); });
}

std::vector<float> complement(std::vector<float> values) {
  for (float& value : values) value = as_stored(1.0f - value, OIIO::TypeUInt8);
  return values;
}

struct Expected {
  std::string file;
  int channel = 0;
};
// An Arrangement says where a preset stores the values of the set.
struct Arrangement {
  std::string engine;
  Expected roughness;
  bool is_smooth = false;
  Expected metallic, occlusion;
  std::string base_color;
};
const std::string kOrm = "wood_occlusionRoughnessMetallic", kUnity = "wood_MetallicSmoothness";
const std::vector<Arrangement> kArrangements = {
    {"gltf", {kOrm, 1}, false, {kOrm, 2}, {kOrm, 0}, "wood_baseColor"},
    {"unity", {kUnity, 3}, true, {kUnity, 0}, {"wood_Occlusion", 0}, "wood_BaseMap"},
    {"unity-hdrp", {"wood_MaskMap", 3}, true, {"wood_MaskMap", 0}, {"wood_MaskMap", 1}, "wood_BaseMap"},
    {"unreal", {"T_wood_ORM", 1}, false, {"T_wood_ORM", 2}, {"T_wood_ORM", 0}, "T_wood_BC"},
    {"godot", {"wood_orm", 1}, false, {"wood_orm", 2}, {"wood_orm", 0}, "wood_albedo"},
    {"usd", {"wood_roughness"}, false, {"wood_metallic"}, {"wood_occlusion"}, "wood_base_color"},
    {"marmoset", {"wood_roughness"}, false, {"wood_metallic"}, {"wood_occlusion"}, "wood_base_color"}};

}  // namespace

TEST_CASE("texremap layouts: the same material is arranged again, and no stored value changes", "[slow]") {
  const Session session;
  write_orm_set(session);
  for (const Arrangement& to : kArrangements) {
    INFO(to.engine);
    const std::string out = "out_" + to.engine, back = "back_" + to.engine;
    require_success(
        session.texremap("convert in --from gltf --to gltf --layout " + to.engine + " -o " + out));
    const auto held = [&](const Expected& place) {
      return channel(session, out + "/" + place.file + ".png", place.channel);
    };
    const std::vector<float> width = held(to.roughness);
    CHECK((to.is_smooth ? complement(width) : width) == channel(session, kOrmFile, 1));
    CHECK(held(to.metallic) == channel(session, kOrmFile, 2));
    CHECK(held(to.occlusion) == channel(session, kOrmFile, 0));
    // A file whose content does not change is copied byte for byte.
    CHECK(session.content(out + "/" + to.base_color + ".png") == session.content("in/wood_baseColor.png"));
    // texremap recognises the names that it wrote.
    require_success(session.texremap("convert " + out + " --from gltf --to gltf --layout gltf -o " + back));
    const std::string set = back + (to.engine == "unreal" ? "/T_wood" : "/wood");
    CHECK(session.content(set + "_baseColor.png") == session.content("in/wood_baseColor.png"));
    for (int c = 0; c < 3; ++c)
      CHECK(channel(session, set + "_occlusionRoughnessMetallic.png", c) == channel(session, kOrmFile, c));
  }
}

TEST_CASE("texremap layouts: in words, with a constant, and a channel without a role that is named") {
  const Session session;
  write_orm_set(session);
  session.map("in/stone_MaskMap.png", kWithAlpha);
  session.map("in/stone_BaseMap.png", kColor);
  const ProcessResult result = require_success(
      session.texremap(Words("convert in --from unity --to gltf -o out --layout") +
                       Words(Names{"Packed=smoothness,1,metallic,occlusion; *_c=base_color"})));
  CHECK_THAT(result.errors, Contains("stone_MaskMap.png: channel B is not used and is skipped"));
  CHECK(channel(session, "out/wood_Packed.png", 0) == complement(channel(session, kOrmFile, 1)));
  CHECK(channel(session, "out/wood_Packed.png", 1) == std::vector<float>(kLayoutSize * kLayoutSize, 1.0f));
  CHECK(channel(session, "out/wood_Packed.png", 3) == channel(session, kOrmFile, 0));
  CHECK(channel(session, "out/stone_Packed.png", 0) == channel(session, "in/stone_MaskMap.png", 3));
  CHECK(session.content("out/stone_c.png") == session.content("in/stone_BaseMap.png"));
}

TEST_CASE("texremap: every file of a folder that takes no part is named") {
  const Session session;
  write_orm_set(session);
  for (const char* name : {"in/wood_normal.png", "in/preview of wood.png"}) session.map(name, kColor);
  const Words words = "convert in --from gltf --to cycles-5/principled -o out";
  const std::string unknown = "not recognised: in/preview of wood.png";
  const ProcessResult planned = require_success(session.texremap(words + "--dry-run"));
  CHECK_THAT(planned.errors, Contains(unknown));
  CHECK_THAT(planned.output, Contains("role") && Contains("wood_occlusionRoughnessMetallic.png:G") &&
                                 Contains("wood_normal.png") && Contains("copied"));
  CHECK_THAT(require_success(session.texremap(words)).errors, Contains(unknown));
  const ProcessResult all = require_success(session.texremap(words + "--force --json"));
  CHECK_THAT(all.output, Contains("\"left_behind\":[]") &&
                             Contains("\"unrecognised_images\":[\"in/preview of wood.png\"]"));
}

TEST_CASE("texremap: the maps of a folder tell the source, and what was taken is said") {
  const Session session;
  write_orm_set(session);
  const ProcessResult told = require_success(session.texremap("convert in --to gltf -o out"));
  CHECK_THAT(told.errors, Contains("texremap uses --from metallic, detected from the maps of wood"));
  CHECK(session.content("out/wood_occlusionRoughnessMetallic.png") ==
        session.content("in/wood_occlusionRoughnessMetallic.png"));
  for (const char* word : {"Diffuse", "Specular", "Glossiness"})
    session.map("in/chair_" + std::string(word) + ".png", kColor);
  const ProcessResult differ = session.texremap("convert in --to gltf -o out2");
  CHECK(differ.exit_code == 2);
  CHECK_THAT(differ.errors, Contains("--from is required, because the sets differ: chair uses the model "
                                     "gltf-specgloss, wood uses metallic"));
}

TEST_CASE("texremap: of several maps of one parameter, one is taken and named, or --prefer chooses") {
  const Session session;
  write_orm_set(session);
  session.map("in/wood_rough.png", kGrey);
  session.map("in/wood_Gloss.png", kGrey, [](int x, int y, int) { return noise(x, y, 7); });
  const Words words = "convert in --to gltf --layout unity -o ";
  const auto smoothness = [&](const Words& more, const std::string& folder) {
    const ProcessResult result = require_success(session.texremap(words + folder + more));
    CHECK((result.errors.find("--prefer changes that") == std::string::npos) == (more.size() > 0));
    return channel(session, folder + "/wood_MetallicSmoothness.png", 3);
  };
  CHECK(smoothness({}, "a") == complement(channel(session, "in/wood_rough.png", 0)));
  CHECK(smoothness("--prefer gloss", "b") == channel(session, "in/wood_Gloss.png", 0));
  CHECK(smoothness("--prefer occlusionroughnessmetallic", "c") == complement(channel(session, kOrmFile, 1)));
}

TEST_CASE("texremap: maps of a folder are found by a name with * for the name of the set") {
  const Session session;
  write_orm_set(session);
  session.map("in/wood_mine.png", kColor);
  const Words words = Words("convert in --to gltf --layout unity -o out --roughness") +
                      Words(Names{"*_mine.png:B", "--input", "occlusion=*_mine.png:R"});
  require_success(session.texremap(words));
  CHECK(channel(session, "out/wood_MetallicSmoothness.png", 3) ==
        complement(channel(session, "in/wood_mine.png", 2)));
  CHECK(channel(session, "out/wood_Occlusion.png", 0) == channel(session, "in/wood_mine.png", 0));
  std::filesystem::remove(session.path("in/wood_mine.png"));
  CHECK_THAT(session.texremap(words + "--force").errors,
             Contains("in/wood: wood_mine.png of --roughness was not found"));
}

TEST_CASE("texremap: layers of an EXR by their names, factors of every parameter") {
  const Session session;
  session.map("in/wood_maps.exr", {"rough.Y", "metal.Y", "base.R", "base.G", "base.B"}, OIIO::TypeHalf);
  const std::string all =
      "convert --from gltf --to gltf --roughness in/wood_maps.exr --metallic in/wood_maps.exr "
      "--base-color in/wood_maps.exr --layout separate";
  require_success(session.texremap(all + " -o out"));
  const auto stored = [&](const std::string& name, const std::string& part) {
    const TestImage image = session.image(name);
    return channel(session, name, image.channel(part));
  };
  CHECK(stored("out/roughness.exr", "Y") == stored("in/wood_maps.exr", "rough.Y"));
  CHECK(stored("out/metallic.exr", "Y") == stored("in/wood_maps.exr", "metal.Y"));
  CHECK(stored("out/base_color.exr", "G") == stored("in/wood_maps.exr", "base.G"));

  require_success(session.texremap(all + " --factor base_color=0.5,1,1 --factor metallic=0.5 -o half"));
  const std::vector<float> red = stored("in/wood_maps.exr", "base.R"),
                           halved = stored("half/base_color.exr", "R"),
                           metal = stored("in/wood_maps.exr", "metal.Y"),
                           dull = stored("half/metallic.exr", "Y");
  for (std::size_t i = 0; i < red.size(); i += 97) {
    CHECK(halved[i] == Approx(0.5f * red[i]).epsilon(1e-3));
    CHECK(dull[i] == Approx(0.5f * metal[i]).epsilon(1e-3));
  }
  CHECK(stored("half/base_color.exr", "G") == stored("in/wood_maps.exr", "base.G"));
}

TEST_CASE("texremap: WebP is read, and written as PNG", "[needs]") {
  const Session session;
  if (OIIO::ImageOutput::create("x.webp") == nullptr) return skip("webp", "OpenImageIO writes no WebP");
  session.map("web/wood_Roughness.webp", kColor, [](int x, int y, int) { return noise(x, y, 1); });
  require_success(
      session.texremap("convert web --from mitsuba/ward --to mitsuba/as --specular 0.04 --quiet -o webout"));
  CHECK(session.image("webout/wood_Roughness.png").spec.width == kLayoutSize);
  // OpenImageIO multiplies colors by alpha, and 8 bits lose too much to undo this.
  session.map("half.webp", kWithAlpha, [](int x, int y, int c) { return c == 3 ? 0.5f : noise(x, y, c); });
  const ProcessResult spoiled = session.texremap(
      "convert --from mitsuba/ward --to mitsuba/as --roughness 0.3 --specular half.webp -o halfout");
  CHECK(spoiled.exit_code == 1);
  CHECK_THAT(spoiled.errors, Contains("half.webp: is WebP with alpha"));
}
