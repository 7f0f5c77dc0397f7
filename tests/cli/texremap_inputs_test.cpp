// This file tests what texremap reads: packed channels, glossiness, numbers, factors, colors, invalid
// values, and converters of fits. No mistake may be silent.
#include <cmath>
#include <cstring>
#include <set>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "lower/fit_file.hpp"
#include "remap/shipped_converters.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr int kInputSize = 40;

// Converts from mitsuba/ward to mitsuba/as, into `out`.
ProcessResult convert_ward(const Session& session, Words words) {
  return session.texremap(Words("convert --from mitsuba/ward --to mitsuba/as") + words);
}

Words maps(const std::string& roughness, const std::string& specular) {
  return "--roughness " + roughness + " --specular " + specular + " -o out";
}

}  // namespace

TEST_CASE("texremap inputs: one channel of a packed map is converted, the others keep every bit") {
  const Session session;
  session.map("orm.png", kColor, OIIO::TypeUInt8, kInputSize);
  require_success(convert_ward(session, "--roughness orm.png:G --specular 0.4 --only roughness -o out"));
  CHECK(session.file_count() == 1);
  const TestImage in = session.image("orm.png"), out = session.image("out/orm.png");
  CHECK(same_channel(in, out, 0));
  CHECK(same_channel(in, out, 2));
  for (int x = 0; x < kInputSize; ++x)
    CHECK(out.at(x, 7, 1) ==
          as_stored(converted_texel(in.at(x, 7, 1), {0.4f, 0.4f, 0.4f})[0], OIIO::TypeUInt8));
}

TEST_CASE("texremap inputs: a file of specular and glossiness in alpha is data throughout", "[slow]") {
  const Session session;
  const std::string name = "sg." + std::string(GENERATE("png", "tga", "tif", "exr"));
  // Alpha is 0 or far below the colors, so that a multiplication or division by it would be visible.
  const auto texel = [](int x, int y, int c) {
    return c < 3 ? noise(x, y, c) : x < 5 ? 0.0f : 0.3f * noise(x, y, c);
  };
  session.map(name, kWithAlpha, texel, OIIO::TypeUInt8, kInputSize);
  const std::string path = session.path(name);
  require_success(convert_ward(session, "--glossiness " + path + ":A --specular " + path +
                                            " --color-space linear --output-encoding glossiness -o out"));
  const TestImage in = read_image(path), out = session.image("out/" + name);
  for (int y = 0; y < kInputSize; ++y)
    for (int x = 0; x < kInputSize; ++x) {
      const float roughness = 1.0f - in.at(x, y, 3);
      const std::array<float, 4> expected =
          converted_texel(roughness * roughness, {in.at(x, y, 0), in.at(x, y, 1), in.at(x, y, 2)});
      REQUIRE(out.at(x, y, 3) == Approx(1.0f - std::sqrt(expected[0])).margin(0.501 / 255.0));
      for (int c = 0; c < 3; ++c)
        REQUIRE(out.at(x, y, c) ==
                Approx(as_stored(expected[static_cast<std::size_t>(c) + 1], out.spec.format)).margin(1e-3));
    }
}

TEST_CASE("texremap inputs: factors are applied once") {
  const Session session;
  session.write_pair("exr", kInputSize);
  require_success(
      convert_ward(session, maps("r.exr", "s.exr") + "--factor roughness=0.5 --factor specular=1,0.5,0.25"));
  const TestImage r = session.image("r.exr"), s = session.image("s.exr"), out = session.image("out/s.exr"),
                  width = session.image("out/r.exr");
  for (int x = 0; x < kInputSize; ++x) {
    const auto expected =
        converted_texel(0.5f * r.at(x, 3, 0), {s.at(x, 3, 0), 0.5f * s.at(x, 3, 1), 0.25f * s.at(x, 3, 2)});
    CHECK(width.at(x, 3, 0) == as_stored(expected[0], OIIO::TypeHalf));
    for (int c = 0; c < 3; ++c)
      CHECK(out.at(x, 3, c) == as_stored(expected[static_cast<std::size_t>(c) + 1], OIIO::TypeHalf));
  }
}

TEST_CASE("texremap inputs: invalid texels are kept, clamped, or an error") {
  const Session session;
  session.write_pair("exr", kInputSize);
  const auto bad = [](int x, int y, int c) {
    return y != 4 || c != 1 ? 0.2f : x == 6 ? NAN : x == 7 ? INFINITY : x == 8 ? -2.0f : 0.2f;
  };
  session.map("s.exr", kColor, bad, OIIO::TypeFloat, kInputSize);
  const Words words = maps("r.exr", "s.exr") + "--json --force --nan";
  const ProcessResult kept = require_success(convert_ward(session, words + "keep"));
  const auto json = nlohmann::json::parse(kept.output);
  CHECK(json["first_bad"] == std::vector<int>{6, 4});
  CHECK(json["texels"] == kInputSize * kInputSize);
  for (const char* kind : {"nan", "infinite", "negative"}) CHECK(json[kind] == 1);
  CHECK(json["specular"] == "out/s.exr");
  CHECK_THAT(kept.errors, Contains("1 texel with NaN; first bad texel: (6, 4)"));
  CHECK(std::isnan(session.image("out/s.exr").at(6, 4, 1)));

  require_success(convert_ward(session, words + "clamp"));
  const TestImage out = session.image("out/s.exr"), r = session.image("r.exr");
  const float edge = static_cast<float>(find_converter("mitsuba/ward", "mitsuba/as").info().specular.max);
  for (const auto& [x, green] : {std::pair{6, 0.0f}, {7, edge}, {8, 0.0f}})
    CHECK(out.at(x, 4, 1) == converted_texel(r.at(x, 4, 0), {0.2f, green, 0.2f})[2]);

  fs::remove_all(session.path("out"));
  const ProcessResult failed = convert_ward(session, words + "fail");
  CHECK(failed.exit_code == 1);
  CHECK_THAT(failed.last_error(),
             Contains("s.exr: G of texel (6, 4) is nan (--nan clamp replaces such values)"));
  CHECK(session.file_count() == 0);
}

TEST_CASE("texremap inputs: the mask marks the texels that were counted") {
  const Session session;
  session.write_pair("exr", kInputSize);
  const auto wide = [](int x, int y, int c) { return 1.3f * noise(x, y, c); };
  session.map("r.exr", kGrey, wide, OIIO::TypeHalf, kInputSize);
  const ProcessResult result =
      require_success(convert_ward(session, maps("r.exr", "s.exr") + "--json --diagnose checks"));
  const TestImage mask = session.image("checks/mask.exr"), in = session.image("r.exr");
  const Range covered = find_converter("mitsuba/ward", "mitsuba/as").info().roughness;
  std::size_t marked = 0;
  for (int y = 0; y < kInputSize; ++y)
    for (int x = 0; x < kInputSize; ++x) {
      REQUIRE(mask.at(x, y, 0) == (covered.contains(static_cast<double>(in.at(x, y, 0))) ? 0.0f : 1.0f));
      marked += mask.at(x, y, 0) == 1.0f;
    }
  CHECK(marked > 0);
  CHECK(nlohmann::json::parse(result.output)["out_of_domain"] == marked);
}

TEST_CASE("texremap inputs: a converted map is not converted again", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("exr", "tif");
  session.write_pair(extension, kInputSize);
  const std::string r = "r." + extension, s = "s." + extension;
  require_success(session.convert(r, s));
  Words again = maps("out/" + r, "out/" + s);
  again.back() = "again";
  const ProcessResult refused = convert_ward(session, again);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.last_error(),
             Contains("already converted to mitsuba/as, but would be read as mitsuba/ward"));
  CHECK_FALSE(fs::exists(session.path("again")));
  // Converting the results again is allowed, from their current model.
  CHECK(session.texremap("convert --from mitsuba/as --to mitsuba/ggx" + again).exit_code == 0);
  again.push_back("--force");
  CHECK(convert_ward(session, again).exit_code == 0);
}

TEST_CASE("texremap inputs: grey in a JPEG may be a step from grey") {
  const Session session;
  const auto write = [&](float red) {
    session.make("r.jpg", test_spec(64, 64, {"R", "G", "B"}, OIIO::TypeUInt8),
                 [&](int x, int y, int c) { return 0.7f * noise(x / 8, y / 8, 0) + (c == 0 ? red : 0.0f); });
  };
  const Words words = "--roughness r.jpg --specular 0.5 -o out --force";
  write(1.0f / 255.0f);
  CHECK(convert_ward(session, words).exit_code == 0);
  write(0.2f);
  const ProcessResult refused = convert_ward(session, words);
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.last_error(), Contains("is not grey"));
}

TEST_CASE("texremap silence: a color that is made from numbers or EXR is sRGB in whole numbers", "[slow]") {
  const Session tree;
  tree.flat("r.png", {0.5f});
  tree.flat("b.exr", {0.5f, 0.2f, 0.05f}, OIIO::TypeHalf);
  tree.flat("r.exr", {0.5f}, OIIO::TypeHalf);
  const std::string format = GENERATE("png", "tga", "tif", "bmp");
  const Words output = "--metallic 1 --to usd-preview-surface --from gltf --layout separate --format " +
                       format + " --type uint8 -o out";
  const auto converted = [&](const Words& maps) {
    const ProcessResult result = require_success(tree.texremap(Words("convert") + output + maps + "--force"));
    CHECK(count_of(result.errors, "texremap: color:") == 1);
    CHECK_THAT(result.errors, Contains("base_color written as srgb"));
    return tree.texel("out/base_color." + format);
  };
  const std::vector<int> srgb = {188, 124, 63};  // by the curve of IEC 61966-2-1
  CHECK(converted("--base-color 0.5,0.2,0.05 --roughness r.png") == srgb);
  CHECK(converted("--base-color b.exr --roughness r.png") == srgb);
  CHECK(converted("--base-color b.exr --roughness r.exr") == srgb);
  CHECK(tree.texel("out/roughness." + format).front() == 128);  // data has no curve
  if (format == "png") {
    // This is what glTF viewers expect: color is tagged sRGB, and data has no gamma tag that means linear.
    CHECK(count_of(tree.content("out/base_color.png"), "sRGB") > 0);
    for (const char* name : {"out/roughness.png", "out/metallic.png"}) {
      CHECK(count_of(tree.content(name), "gAMA") == 0);
      CHECK(count_of(tree.content(name), "sRGB") == 0);
    }
  }
}

TEST_CASE("texremap silence: specular from a number beside an 8-bit roughness is sRGB") {
  const Session tree;
  tree.flat("r.png", {0.5f});
  require_success(
      tree.texremap("convert --from gltf-specgloss --to specular --roughness r.png --diffuse 0.5 --specular "
                    "0.04 --layout separate -o out"));
  CHECK(tree.texel("out/specular.png") == std::vector<int>{56, 56, 56});
}

TEST_CASE(
    "texremap silence: the line on colors counts the maps of a folder, for whatever reason they are sRGB") {
  const Session tree;
  for (const std::string set : {"in/a", "in/b"}) tree.map(set + "_roughness.png", kGrey);
  tree.map("in/a_specular.png", kColor);
  tree.map("in/b_specular.exr", kColor, OIIO::TypeHalf);
  const ProcessResult result = require_success(
      tree.texremap("convert in --from mitsuba/ward --to mitsuba/as --format png --type uint8 -o out"));
  CHECK_THAT(result.errors,
             Contains("color: specular read as srgb in 1 map, specular written as srgb in 2 maps;"));
}

TEST_CASE("texremap silence: a color space on request, and back without a word") {
  const Session tree;
  tree.flat("b.png", {188.0f / 255.0f, 124.0f / 255.0f, 63.0f / 255.0f});
  const std::string format = GENERATE("png", "tif");
  const ProcessResult linear = require_success(
      tree.texremap("convert --from gltf --to usd-preview-surface --base-color b.png --metallic 1 "
                    "--roughness 0.5 --layout separate --format " +
                    format + " --output-color-space base_color=linear -o linear"));
  CHECK_THAT(linear.errors,
             Contains("base_color read as srgb, base_color written as linear (--output-color-space)"));
  CHECK(tree.texel("linear/base_color." + format) == std::vector<int>{128, 51, 13});
  // The file is tagged linear, and is read as linear.
  const ProcessResult back = require_success(
      tree.texremap("convert --from usd-preview-surface --to gltf --base-color linear/base_color." + format +
                    " --metallic 1 --roughness 0.5 --output-color-space srgb -o back"));
  CHECK_THAT(back.errors, Contains("base_color read as linear (as the file's tag states)"));
  const std::vector<int> again = tree.texel("back/base_color." + format);
  CHECK(std::abs(again[0] - 188) <= 1);
  CHECK(std::abs(again[1] - 124) <= 1);
}

TEST_CASE(
    "texremap silence: metals of three.js are inside the domain, and dielectrics come back with metallic 0") {
  const Session tree;
  const auto numbers = [&](const std::string& from, const std::string& to, const Words& more) {
    return tree.json("convert --from " + from + " --to " + to + " --json" + more);
  };
  for (const std::string roughness : {"0.15", "0.5", "0.7", "1"}) {
    INFO("roughness " << roughness);
    const auto gold = numbers("threejs/standard", "gltf",
                              "--base-color 0.944,0.776,0.373 --metallic 1 --roughness " + roughness);
    CHECK(gold["in_domain"] == true);
    CHECK(gold["values"]["metallic"].get<double>() == Approx(1.0).margin(0.005));
    const auto plastic = numbers("threejs/standard", "gltf",
                                 "--base-color 0.5,0.2,0.05 --metallic 0 --roughness " + roughness);
    CHECK(plastic["values"]["metallic"].get<double>() == 0.0);
    CHECK(plastic["values"]["base_color"][0].get<double>() == Approx(0.5 / 0.96).margin(1e-3));
    // Metallic between 0 and 1 follows the same formula, without a jump at 0.
    const auto mixed = numbers("threejs/standard", "gltf",
                               "--base-color 0.8,0.6,0.4 --metallic 0.02 --roughness " + roughness);
    CHECK(mixed["values"]["metallic"].get<double>() == Approx(0.02).margin(0.01));
  }
}

TEST_CASE("texremap silence: --nan clamp clamps what is only passed on") {
  const Session tree;
  tree.flat("c.exr", {0.5f, 0.4f, 0.3f}, OIIO::TypeFloat);
  const auto odd = [](int x, int, int) {
    return x == 0 ? 1e38f : x == 1 ? INFINITY : x == 2 ? NAN : x == 3 ? -2.0f : 0.5f;
  };
  tree.map("r.exr", kGrey, odd, OIIO::TypeFloat);
  require_success(tree.texremap(
      "convert --from gltf --to usd-preview-surface --base-color c.exr --metallic 0 --roughness "
      "r.exr --nan clamp -o out"));
  const TestImage out = tree.image("out/r.exr");
  for (int x = 0; x < 8; ++x) CHECK(out.at(x, 0, 0) == (x < 2 ? 1.0f : x < 4 ? 0.0f : 0.5f));
}

TEST_CASE("texremap: --quiet prints nothing") {
  const Session session;
  session.write_pair("jpg", 64, OIIO::TypeUInt8);
  const ProcessResult result = session.convert("r.jpg", "s.jpg", "--quiet");
  CHECK(result.exit_code == 0);
  CHECK(result.errors.empty());
  CHECK(result.output.empty());
}

TEST_CASE("texremap: a fit as --converters names its models") {
  const Session session;
  session.write_pair("exr");
  const Fit fit = lowered_fit(example_fit());
  session.put("fit.json", fit_to_json(fit));
  require_success(
      session.texremap("convert --converters fit.json --roughness r.exr --specular s.exr -o out"));
  const TestImage in = session.image("r.exr"), out = session.image("out/r.exr");
  CHECK(out.spec.get_string_attribute("remap:converter") == fit.id);
  const auto converter = make_lowered_converter(fit);
  for (int x = 0; x < 64; ++x) {
    const float roughness = in.at(x, 1, 0), specular = 0.0f;
    float expected = 0.0f, ignored = 0.0f;
    const std::array<const float*, 1> specular_in = {&specular};
    const std::array<float*, 1> specular_out = {&ignored};
    converter->convert(1, &roughness, specular_in, &expected, specular_out);
    CHECK(out.at(x, 1, 0) == as_stored(expected, OIIO::TypeHalf));
  }
}

TEST_CASE("texremap: --converters replaces the shipped converters by those of a fit, a folder or a list",
          "[slow]") {
  const Session session;
  const Fit fit = lowered_fit(example_fit());
  session.put("fits/fit.json", fit_to_json(fit));
  session.put("fits/manifest.json", "{}");  // every folder of fits has this file, which is not a fit
  const auto list = [&](const std::string& path) {
    const ProcessResult result =
        require_success(session.texremap("list --pairs --converters " + path + " --json"));
    return result.output;
  };
  const std::string of_fit = list("fits/fit.json");
  CHECK_THAT(of_fit, Catch::Contains(fit.id));
  CHECK_THAT(of_fit, !Catch::Contains("mitsuba_ward_to_mitsuba_as"));
  CHECK(list("fits") == of_fit);
  CHECK(list(REMAP_SOURCE_DIR "/generated/converters.json") ==
        session.texremap("list --pairs --json").output);

  const Words numbers =
      "convert --from " + fit.source.model + " --to " + fit.target.model + " --roughness 0.25 --specular 0.3";
  CHECK(session.texremap(numbers).exit_code == 2);
  require_success(session.texremap(numbers + "--converters fits"));
}

TEST_CASE("texremap: a fit without a converter is refused with what to run") {
  const Session session;
  const auto refused = [&](const std::string& json) {
    session.put("fit.json", json);
    const ProcessResult result =
        session.texremap("convert --converters fit.json --roughness 0.25 --specular 0.3");
    CHECK(result.exit_code == 1);
    return result.errors;
  };
  std::string json = fit_to_json(example_fit());
  CHECK_THAT(refused(json), Contains("could not be lowered") && Contains("remapc fit --lower"));
  const std::string section = ",\n  \"converter\": null";
  json.erase(json.find(section), section.size());
  CHECK_THAT(refused(json), Contains("holds no converter") && Contains("run remapc fit again"));
}

TEST_CASE("texremap: every instruction set writes the same files", "[slow]") {
  const Session session;
  session.write_pair("exr");
  std::set<std::map<std::string, std::string>> written;
  for (const InstructionSet set : instruction_sets()) {
    const std::string name(instruction_set_name(set));
    const ProcessResult result =
        session.texremap_with(name, kConversion + " --roughness r.exr --specular s.exr --force --json");
    REQUIRE(result.exit_code == 0);
    CHECK(nlohmann::json::parse(result.output)["instructions"] == name);
    written.insert(session.contents());
  }
  CHECK(written.size() == 1);
}
