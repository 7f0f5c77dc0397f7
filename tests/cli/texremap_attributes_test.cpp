// Everything that OpenImageIO reports of a file, before and after a conversion: each attribute by name, type
// and value, windows, tiles, channels and their types, and the texels of channels that take no part.
#include <algorithm>
#include <cstring>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/attribute_images.hpp"
#include "support/shared_data.hpp"
#include "support/spec_difference.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

// What may differ. A name ends in `*` where it is a beginning; no extension: of every format.
struct Exception {
  std::string extension;
  std::string name;
  std::string reason;
};

const std::vector<Exception> kExceptions = {
    {"", "remap:*", "texremap notes what it has done"},
    {"tif", "Software", "TIFF has no place for that but the tag of the writing program"},
    {"jpg", "Software", "nor has JPEG"},
    {"jpg", "IPTC:OriginatingProgram", "OpenImageIO writes Software here, too"},
    {"jpg", "jpeg:subsampling", "colours are written for every texel: converted maps are data"}};

// Only in files that OpenImageIO cannot write itself.
const std::vector<Exception> kForeignExceptions = {
    {"jpg", "Exif:PixelXDimension", "the same number, in the type that OpenImageIO writes"},
    {"jpg", "Exif:PixelYDimension", "as above"},
    {"jpg", "Exif:ExifVersion", "OpenImageIO writes Exif for Software where there was none"},
    {"jpg", "Exif:FlashPixVersion", "as above"},
    {"jpg", "photoshop:*", "OpenImageIO reads XMP of these names and does not write it"},
    {"jpg", "xmpMM:*", "as above"},
    {"jpg", "stEvt:*", "as above"},
    {"jpg", "IPTC:MetadataDate", "as above: a date of XMP"},
    {"jpg", "IPTC:ModifyDate", "as above"}};

bool covers(const Exception& exception, const std::string& extension, const std::string& name) {
  if (!exception.extension.empty() && exception.extension != extension) return false;
  if (exception.name.back() != '*') return exception.name == name;
  return name.starts_with(exception.name.substr(0, exception.name.size() - 1));
}

// The differences without a reason, a line each. Exceptions that were needed are marked in `used`.
std::string unexplained(const std::vector<SpecDifference>& all, const std::string& extension,
                        const std::vector<Exception>& exceptions, std::vector<bool>& used) {
  std::string lines;
  for (const SpecDifference& difference : all) {
    const auto found = std::find_if(exceptions.begin(), exceptions.end(), [&](const Exception& exception) {
      return covers(exception, extension, difference.name);
    });
    if (found == exceptions.end())
      lines += difference.name + ": was " + difference.before + "; is " + difference.after + "\n";
    else
      used[static_cast<std::size_t>(found - exceptions.begin())] = true;
  }
  return lines;
}

// How many channels but `converted` (-1: none is) have other bytes.
int changed_channels(const StoredPlane& before, const StoredPlane& after, int converted) {
  if (before.bytes.size() != after.bytes.size()) return before.spec.nchannels;
  const std::size_t texel = before.spec.pixel_bytes(true);
  int changed = 0;
  for (int c = 0; c < before.spec.nchannels; ++c) {
    const std::size_t begin = before.spec.pixel_bytes(0, c, true),
                      size = before.spec.pixel_bytes(c, c + 1, true);
    bool is_same = true;
    for (std::size_t i = begin; i < before.bytes.size(); i += texel)
      is_same = is_same && std::memcmp(&before.bytes[i], &after.bytes[i], size) == 0;
    changed += c != converted && !is_same;
  }
  return changed;
}

// Converts one channel of the first part and compares all that there is.
void check_image(const AttributeImage& image, std::vector<bool>& used) {
  const Session session;
  const std::string name = "map." + image.extension;
  INFO(image.extension << ", " << image.title);
  write_attribute_image(session.path(name), image);
  const auto before = read_planes(session.path(name));
  const OIIO::ImageSpec& first = before.front().front().spec;
  const int converted = first.nchannels < 3 ? 0 : 1;
  std::string channel = first.channelnames[static_cast<std::size_t>(converted)];
  if (before.size() > 1 && image.extension == "exr") channel = "beauty." + channel;
  const ProcessResult result =
      session.texremap({"convert", "--from", "mitsuba/ward", "--to", "mitsuba/as", "--roughness",
                        session.path(name) + ":" + channel, "--specular", "0.4", "--only", "roughness", "-o",
                        session.path("out")});
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  const auto after = read_planes(session.path("out/" + name));
  REQUIRE(after.size() == before.size());
  for (std::size_t part = 0; part < before.size(); ++part) {
    REQUIRE(after[part].size() == before[part].size());
    for (std::size_t level = 0; level < before[part].size(); ++level) {
      INFO("part " << part << ", level " << level);
      const StoredPlane &in = before[part][level], &out = after[part][level];
      CHECK(unexplained(differences(in.spec, out.spec), image.extension, kExceptions, used) == "");
      if (!image.is_lossless) continue;
      CHECK(changed_channels(in, out, part == 0 ? converted : -1) == 0);
      if (part == 0) CHECK(changed_channels(in, out, -1) == 1);  // the converted one
    }
  }
}

void check_images(const std::vector<AttributeImage>& images) {
  std::vector<bool> used(kExceptions.size());
  for (const AttributeImage& image : images) check_image(image, used);
  const auto has_format = [&](const Exception& exception) {
    return std::any_of(images.begin(), images.end(),
                       [&](const AttributeImage& image) { return image.extension == exception.extension; });
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    INFO(kExceptions[i].name << " is an exception that nothing needs");
    if (has_format(kExceptions[i])) CHECK(used[i]);
  }
}

}  // namespace

TEST_CASE("texremap attributes: all that an EXR says is kept, however it is stored") {
  check_images(exr_storage_images());
}
TEST_CASE("texremap attributes: all that an EXR says is kept, whatever its windows, layers and parts") {
  check_images(exr_structure_images());
}
TEST_CASE("texremap attributes: all that a TIFF says is kept") { check_images(tiff_images()); }
TEST_CASE("texremap attributes: all that a PNG says is kept") { check_images(png_images()); }
TEST_CASE("texremap attributes: all that JPEG, Targa, BMP and Radiance files say is kept") {
  check_images(small_format_images());
}

TEST_CASE("texremap attributes: what files of other programs say is kept, but for what cannot be written") {
  std::vector<Exception> exceptions = kExceptions;
  exceptions.insert(exceptions.end(), kForeignExceptions.begin(), kForeignExceptions.end());
  std::vector<bool> used(exceptions.size());
  for (const char* file :
       {"BoomBox_occlusionRoughnessMetallic.png:G", "brass_roughness.jpg:Y", "king_black_roughness.jpg:Y",
        "king_black_base_color.jpg:G", "grid_udim/grid.1001.png:R"}) {
    const std::string words(file);
    const fs::path path = shared_data("textures/" + words.substr(0, words.rfind(':')));
    if (path.empty()) continue;
    const Session session;
    const ProcessResult result =
        session.texremap({"convert", "--from", "mitsuba/ward", "--to", "mitsuba/as", "--roughness",
                          path.string() + words.substr(words.rfind(':')), "--specular", "0.4", "--only",
                          "roughness", "-o", session.path("out")});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const OIIO::ImageSpec before = read_image(path).spec,
                          after = read_image(session.path("out/" + path.filename().string())).spec;
    CHECK(unexplained(differences(before, after), path.extension().string().substr(1), exceptions, used) ==
          "");
  }
  if (shared_data("textures/king_black_roughness.jpg").empty()) return;
  for (std::size_t i = kExceptions.size(); i < used.size(); ++i) {
    INFO(exceptions[i].name << " is an exception that nothing needs");
    CHECK(used[i]);
  }
}

TEST_CASE("texremap attributes: the comparison sees what is lost, added, and of another type or value") {
  OIIO::ImageSpec before = test_spec(8, 8, {"R", "G"}, OIIO::TypeHalf), after = before;
  CHECK(differences(before, after).empty());
  before.attribute("lost", 1);
  before.attribute("retyped", 1);
  before.attribute("changed", "a");
  after.attribute("added", 2.5f);
  after.attribute("retyped", 1.0f);
  after.attribute("changed", "b");
  after.x = -1;
  after.tile_width = 16;
  after.channelnames[1] = "B";
  after.alpha_channel = 1;
  std::vector<std::string> names;
  for (const SpecDifference& difference : differences(before, after)) names.push_back(difference.name);
  CHECK(names == std::vector<std::string>{"lost", "retyped", "changed", "added", "data window", "tiles",
                                          "channels", "roles of channels"});
}

TEST_CASE("texremap attributes: a PNG without a colour space is given none") {
  const Session session;
  const bool is_said = GENERATE(true, false);
  OIIO::ImageSpec spec = test_spec(16, 16, {"R", "G", "B"}, OIIO::TypeUInt8);
  if (is_said) spec.attribute("oiio:ColorSpace", "sRGB");
  write_image(session.path("orm.png"), spec, noise);
  REQUIRE(session
              .texremap({"convert", "--from", "mitsuba/ward", "--to", "mitsuba/as", "--roughness",
                         session.path("orm.png") + ":G", "--specular", "0.4", "--only", "roughness", "-o",
                         session.path("out")})
              .exit_code == 0);
  // OpenImageIO says sRGB of both: the name of the chunk tells.
  for (const char* file : {"orm.png", "out/orm.png"})
    CHECK((read_file(session.path(file)).find("sRGB") != std::string::npos) == is_said);
}
