// This file compares everything that OpenImageIO reports about a file before and after a conversion: the
// name, type and value of each attribute, windows, tiles, channels and their types, and the texels of
// channels that are not converted.
#include <algorithm>
#include <cstring>

#include <OpenImageIO/imagebufalgo.h>
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/attribute_images.hpp"
#include "support/shared_data.hpp"
#include "support/spec_difference.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

// An Exception is a permitted difference. A name with `*` at its end is a prefix. An empty extension means
// every format.
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
    {"jpg", "jpeg:subsampling", "colors are written for every texel: converted maps are data"},
    {"tx", "Software", "a TIFF by another name"},
    {"", "oiio:ColorSpace", "converted maps are data, which has no tag of color"},
    {"", "oiio:Gamma", "as above"},
    {"", "Exif:ColorSpace", "as above"}};

// These differences are permitted for textures with mip levels.
const std::vector<Exception> kTextureExceptions = {
    {"", "oiio:SHA-1", "sums over the texels that are no longer there"},
    {"", "oiio:AverageColor", "as above"}};

// These differences are permitted only for files that OpenImageIO cannot write itself.
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

struct Comparison {
  std::vector<Exception> exceptions;
  std::vector<bool> used;  // whether some file needed the exception
};

Comparison comparison(const std::vector<Exception>& more = {}) {
  Comparison all{kExceptions, {}};
  all.exceptions.insert(all.exceptions.end(), more.begin(), more.end());
  all.used.resize(all.exceptions.size());
  return all;
}

bool covers(const Exception& exception, const std::string& extension, const std::string& name) {
  if (!exception.extension.empty() && exception.extension != extension) return false;
  if (exception.name.back() != '*') return exception.name == name;
  return name.starts_with(exception.name.substr(0, exception.name.size() - 1));
}

// Returns the differences without an exception, one per line. Marks the exceptions that were needed.
std::string unexplained(const std::vector<SpecDifference>& all, const std::string& extension,
                        Comparison& comparison) {
  const std::vector<Exception>& exceptions = comparison.exceptions;
  std::string lines;
  for (const SpecDifference& difference : all) {
    const auto found = std::find_if(exceptions.begin(), exceptions.end(), [&](const Exception& exception) {
      return covers(exception, extension, difference.name);
    });
    if (found == exceptions.end())
      lines += difference.name + ": was " + difference.before + "; is " + difference.after + "\n";
    else
      comparison.used[static_cast<std::size_t>(found - exceptions.begin())] = true;
  }
  return lines;
}

// Counts the channels except `converted` that changed. With -1, it counts all.
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

// Converts channel `converted` of the first part and compares everything.
void check_file(const fs::path& file, int converted, bool is_lossless, Comparison& comparison) {
  const Session session;
  INFO(file);
  const auto before = read_planes(file);
  const OIIO::ImageSpec& first = before.front().front().spec;
  std::string channel = first.channelnames[static_cast<std::size_t>(converted)];
  const std::string part_name = first.get_string_attribute("oiio:subimagename");
  if (before.size() > 1 && !part_name.empty()) channel = part_name + "." + channel;
  require_success(session.convert(file.string() + ":" + channel, "0.4", "--only roughness"));
  const auto after = read_planes(session.path("out/" + file.filename().string()));
  REQUIRE(after.size() == before.size());
  for (std::size_t part = 0; part < before.size(); ++part) {
    REQUIRE(after[part].size() == before[part].size());
    for (std::size_t level = 0; level < before[part].size(); ++level) {
      INFO("part " << part << ", level " << level);
      const StoredPlane &in = before[part][level], &out = after[part][level];
      const std::string extension = file.extension().string().substr(1);
      CHECK(unexplained(differences(in.spec, out.spec), extension, comparison) == "");
      if (!is_lossless) continue;
      CHECK(changed_channels(in, out, part == 0 ? converted : -1) == 0);
      if (part == 0) CHECK(changed_channels(in, out, -1) == 1);  // only the converted channel changed
    }
  }
}

// Checks that each exception was needed by at least one file of these formats.
void check_used(const Comparison& comparison, const std::vector<std::string>& extensions) {
  for (std::size_t i = 0; i < comparison.used.size(); ++i) {
    const Exception& exception = comparison.exceptions[i];
    INFO(exception.extension << " " << exception.name << " is an exception that nothing needs");
    const bool is_of_these =
        std::find(extensions.begin(), extensions.end(), exception.extension) != extensions.end();
    if (is_of_these) CHECK(comparison.used[i]);
  }
}

void check_images(const std::vector<AttributeImage>& images) {
  const TemporaryFolder folder;
  Comparison all = comparison();
  std::vector<std::string> extensions;
  for (const AttributeImage& image : images) {
    INFO(image.title);
    const fs::path file = folder.path() / ("map." + image.extension);
    write_attribute_image(file, image);
    check_file(file, image.parts.front().nchannels < 3 ? 0 : 1, image.is_lossless, all);
    extensions.push_back(image.extension);
  }
  check_used(all, extensions);
}

}  // namespace

TEST_CASE("texremap attributes: an EXR keeps all attributes in every kind of storage", "[slow]") {
  check_images(exr_storage_images());
}
TEST_CASE("texremap attributes: an EXR keeps all attributes with any windows, layers and parts", "[slow]") {
  check_images(exr_structure_images());
}
TEST_CASE("texremap attributes: a TIFF keeps all attributes", "[slow]") { check_images(tiff_images()); }
TEST_CASE("texremap attributes: a PNG keeps all attributes", "[slow]") { check_images(png_images()); }
TEST_CASE("texremap attributes: JPEG, Targa, BMP and Radiance files keep all attributes", "[slow]") {
  check_images(small_format_images());
}

TEST_CASE("texremap attributes: a mip-mapped texture keeps the attributes of its levels", "[slow]") {
  const TemporaryFolder folder;
  const fs::path plain = folder.path() / "plain.exr";
  write_image(plain, test_spec(40, 32, {"R", "G", "B"}, OIIO::TypeHalf), noise);
  Comparison all = comparison(kTextureExceptions);
  for (const char* name : {"map.exr", "map.tif", "map.tx"}) {
    OIIO::ImageSpec config;
    config.attribute("maketx:fileformatname", std::string(name) == "map.exr" ? "openexr" : "tiff");
    config.attribute("wrapmodes", "periodic,mirror");
    const fs::path file = folder.path() / name;
    REQUIRE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, plain.string(), file.string(),
                                             config));
    REQUIRE(read_planes(file).front().size() > 4);
    check_file(file, 1, true, all);
  }
  check_used(all, {"tif", "tx"});
}

TEST_CASE("texremap attributes: files of other programs keep all attributes that can be written",
          "[needs][slow]") {
  const fs::path folder = shared_data("textures");
  if (folder.empty()) return;
  Comparison all = comparison(kForeignExceptions);
  const auto check = [&](const char* name, int converted, bool is_lossless) {
    check_file(folder / name, converted, is_lossless, all);
  };
  check("BoomBox_occlusionRoughnessMetallic.png", 1, true);
  check("grid_udim/grid.1001.png", 1, true);
  check("brass_roughness.jpg", 0, false);
  check("king_black_roughness.jpg", 0, false);
  check("king_black_base_color.jpg", 1, false);
  for (std::size_t i = kExceptions.size(); i < all.used.size(); ++i) {
    INFO(all.exceptions[i].name << " is an exception that nothing needs");
    CHECK(all.used[i]);
  }
}

TEST_CASE("texremap attributes: a map without a date does not get the date of the run", "[slow]") {
  const Session session;
  session.write_pair("exr", 16);
  for (const char* name :
       {"r.exr", "s.exr"}) {  // removes the date, which OpenImageIO writes under EXR's own name
    std::string bytes = session.content(name);
    bytes.replace(bytes.find("capDate"), 7, "anyDate");
    write_file(session.path(name), bytes);
    REQUIRE(session.image(name).spec.find_attribute("DateTime") == nullptr);
  }
  const std::string extension = GENERATE("exr", "tif", "png", "jpg", "tga");
  require_success(session.convert("r.exr", "s.exr", "--format " + extension));
  for (const char* name : {"out/r.", "out/s."})
    CHECK(session.image(name + extension).spec.find_attribute("DateTime") == nullptr);
}

TEST_CASE("texremap attributes: the comparison detects lost, added and changed attributes") {
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
  CHECK(names == Names{"lost", "retyped", "changed", "added", "data window", "tiles", "channels",
                       "roles of channels"});
}

TEST_CASE("texremap attributes: a PNG of data gets no color space, and a PNG of color keeps its own") {
  const Session session;
  // OpenImageIO reports sRGB even for a PNG without any tag, so the test looks for the chunks.
  const auto tag_of = [&](const char* file) {
    const std::string bytes = session.content(file);
    return bytes.find("sRGB") != std::string::npos   ? "sRGB"
           : bytes.find("gAMA") != std::string::npos ? "gamma"
                                                     : "none";
  };
  const auto [name, tag] = GENERATE(table<const char*, const char*>(
      {{"sRGB", "sRGB"}, {"Linear", "gamma"}, {"Gamma2.2", "gamma"}, {"", "none"}}));
  OIIO::ImageSpec spec = test_spec(16, 16, kColor, OIIO::TypeUInt8);
  if (*name != '\0') spec.attribute("oiio:ColorSpace", name);
  if (std::string(name) == "Gamma2.2") spec.attribute("oiio:Gamma", 2.2f);
  session.make("orm.png", spec, noise);
  session.make("specular.png", spec, noise);
  REQUIRE(std::string(tag_of("orm.png")) == tag);
  require_success(session.convert("orm.png:G", "specular.png"));
  CHECK(std::string(tag_of("out/orm.png")) == "none");
  CHECK(std::string(tag_of("out/specular.png")) == tag);
}
