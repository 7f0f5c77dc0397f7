// This file compares everything that OpenImageIO reports about a file before and after a conversion: the
// name, type and value of each attribute, windows, tiles, channels and their types, and the texels of
// channels that are not converted. The files have as many attributes as their formats can hold, in every
// variant of each format.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "support/shared_data.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

struct AttributeImage {
  std::string title;                   // the variant, for messages
  std::string extension;               // extension of the file
  std::vector<OIIO::ImageSpec> parts;  // one part, or several
  bool has_levels = false;             // mip levels below the only part
  bool is_lossless = true;             // true if every written bit is read back
};

// Sets `NAME=TEXT; NAME:int=VALUE; NAME:float=VALUE; ...`.
OIIO::ImageSpec& set_all(OIIO::ImageSpec& spec, std::string_view attributes) {
  for (const std::string& one : OIIO::Strutil::splits(attributes, "; ")) {
    if (one.empty()) continue;
    const std::size_t equals = one.find('='), colon = one.substr(0, equals).rfind(':');
    const std::string type = colon == std::string::npos ? "" : one.substr(colon + 1, equals - colon - 1);
    const bool is_number = type == "int" || type == "float";
    spec.attribute(one.substr(0, is_number ? colon : equals), OIIO::TypeDesc(is_number ? type : "string"),
                   one.substr(equals + 1));
  }
  return spec;
}

// These are attributes that a picture may have in any format that allows them, including Exif and IPTC.
constexpr const char* kCommon =
    "DateTime=2021:03:04 05:06:07; Orientation:int=6; XResolution:float=300; YResolution:float=150; "
    "ResolutionUnit=in; PixelAspectRatio:float=2; wrapmodes=periodic,black; fovcot:float=1.25; "
    "ExposureTime:float=0.02; FNumber:float=5.6; Exif:LensModel=a lens; "
    "Exif:DateTimeOriginal=2020:01:02 03:04:05; Exif:ISOSpeedRatings:int=400; Exif:FocalLength:float=35; "
    "Exif:Flash:int=1; Exif:UserComment=a comment; GPS:LatitudeRef=N; GPS:Altitude:float=120; "
    "IPTC:City=Hameln; IPTC:Caption=a caption; IPTC:Instructions=none; dc:rights=all of them; xmp:Rating=3";

void describe(OIIO::ImageSpec& spec) {
  for (const char* name : {"ImageDescription", "Artist", "Copyright", "Software", "DocumentName",
                           "HostComputer", "Make", "Model", "Keywords"})
    spec.attribute(name, std::string("the ") + name + ", with \xc3\xbc");
  const std::array<float, 16> projection = {0.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0.25f, 3, 4, 5, 1};
  spec.attribute("worldtoscreen", OIIO::TypeMatrix, projection.data());
  spec.attribute("worldtocamera", OIIO::TypeMatrix, projection.data());
  set_all(spec, kCommon);
}

// Adds the head and one tag of an ICC profile, as small as OpenImageIO accepts.
void add_profile(OIIO::ImageSpec& spec) {
  std::array<std::uint8_t, 160> bytes{};
  const auto put = [&bytes](std::size_t at, std::string_view text) {
    std::transform(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                   [](char c) { return static_cast<std::uint8_t>(c); });
  };
  bytes[3] = bytes.size();
  bytes[8] = 2;  // version 2
  put(4, "none");
  put(12, "mntr");
  put(16, spec.nchannels < 3 ? "GRAY" : "RGB ");
  put(20, "XYZ ");
  put(36, "acsp");
  bytes[131] = 1;  // tags
  put(132, "cprt");
  bytes[139] = 144;  // place of its value
  bytes[143] = 16;   // length of its value
  put(144, "text");
  put(152, "nobody");
  // Set D50, the light that the connection space must have.
  for (const auto& [at, value] : {std::pair{70, 0xf6}, {71, 0xd6}, {73, 1}, {78, 0xd3}, {79, 0x2d}})
    bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
  spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, bytes.size()), bytes.data());
}

// Adds one attribute of every type that an EXR holds, and what film scanners and renderers write.
void add_typed(OIIO::ImageSpec& spec) {
  using OIIO::TypeDesc;
  const auto set = [&spec](const char* name, TypeDesc type, const auto& values) {
    spec.attribute(name, type, values.data());
  };
  const std::array<float, 16> floats = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3127f, 0.329f,
                                        1e-7f, 3.0f,  4.0f, 5.0f, 6.0f,  7.0f,  8.0f,    9.0f};
  const std::array<double, 16> doubles = {0.1, 0.2, 0.3, 1e-300, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  const std::array<int, 7> ints = {12, 34, 567890, 1234, 56, 4, 64};
  const std::array<std::uint32_t, 2> time_code = {0x01020304u, 0x05060708u};
  const std::array<const char*, 3> words = {"one", "two", "three"};
  set("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), floats);
  set("smpte:TimeCode", OIIO::TypeTimeCode, time_code);
  set("smpte:KeyCode", OIIO::TypeKeyCode, ints);
  set("test:floats", TypeDesc(TypeDesc::FLOAT, 5), floats);
  set("test:words", TypeDesc(TypeDesc::STRING, 3), words);
  set("test:vec2f", TypeDesc(TypeDesc::FLOAT, TypeDesc::VEC2), floats);
  set("test:vec3f", TypeDesc(TypeDesc::FLOAT, TypeDesc::VEC3, TypeDesc::VECTOR), floats);
  set("test:vec2d", TypeDesc(TypeDesc::DOUBLE, TypeDesc::VEC2), doubles);
  set("test:vec2i", TypeDesc(TypeDesc::INT, TypeDesc::VEC2), ints);
  set("test:vec3i", TypeDesc(TypeDesc::INT, TypeDesc::VEC3), ints);
  set("test:matrix33", TypeDesc(TypeDesc::FLOAT, TypeDesc::MATRIX33), floats);
  set("test:matrix44", OIIO::TypeMatrix44, floats);
  set("test:matrix44d", TypeDesc(TypeDesc::DOUBLE, TypeDesc::MATRIX44), doubles);
  set("test:color", OIIO::TypeColor, floats);
  set("test:box2i", OIIO::TypeBox2i, ints);
  set("test:box2f", OIIO::TypeBox2, floats);
  set("test:box3f", OIIO::TypeBox3, floats);
  set("test:rational", OIIO::TypeRational, ints);
  spec.attribute("test:int", -7);
  spec.attribute("test:float", 1.0f / 3.0f);
  spec.attribute("test:double", OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE), doubles.data());
  spec.attribute("test:string", "with\nlines and \xe6\x9c\xa8");
  spec.attribute("test:empty", "");
  set("captureRate", OIIO::TypeRational, ints);
  spec.attribute("oiio:subimagename", "beauty");
}

OIIO::ImageSpec rich_spec(const std::vector<std::string>& channels, OIIO::TypeDesc type,
                          const std::string& compression = "", int tile_width = 0, int tile_height = 0) {
  OIIO::ImageSpec spec = test_spec(48, 32, channels, type);
  if (!compression.empty()) spec.attribute("Compression", compression);
  spec.tile_width = tile_width;
  spec.tile_height = tile_height;
  describe(spec);
  return spec;
}

// Images collects images of one format.
class Images {
 public:
  explicit Images(const char* extension) : extension_(extension) {}
  // Adds an image. The title names its special property.
  OIIO::ImageSpec& add(const std::string& title, const OIIO::ImageSpec& spec, bool has_levels = false) {
    images_.push_back({title, extension_, {spec}, has_levels});
    return images_.back().parts.front();
  }
  OIIO::ImageSpec& add_lossy(const std::string& title, const OIIO::ImageSpec& spec) {
    OIIO::ImageSpec& added = add(title, spec);
    images_.back().is_lossless = false;
    return added;
  }
  void add_parts(const std::string& title, const std::vector<OIIO::ImageSpec>& parts) {
    images_.push_back({title, extension_, parts});
  }
  const std::vector<AttributeImage>& all() const { return images_; }

 private:
  std::string extension_;
  std::vector<AttributeImage> images_;
};

OIIO::ImageSpec exr_spec(OIIO::TypeDesc type, const std::string& compression, int tile_width = 0,
                         int tile_height = 0, const std::vector<std::string>& channels = kWithAlpha) {
  OIIO::ImageSpec spec = rich_spec(channels, type, compression, tile_width, tile_height);
  add_typed(spec);
  return spec;
}

void set_window(OIIO::ImageSpec& spec, const OIIO::ROI& data, const OIIO::ROI& display) {
  spec.set_roi(data);
  spec.set_roi_full(display);
  spec.full_depth = 1;
}

std::vector<float> noise_of(const OIIO::ImageSpec& spec, int plane) {
  std::vector<float> values;
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x)
      for (int c = 0; c < spec.nchannels; ++c) values.push_back(noise(x, y, c + 7 * plane));
  return values;
}

// Returns the next level, halved by the rounding mode of the file. Each level has its own display window.
OIIO::ImageSpec next_level(OIIO::ImageSpec spec, bool round_up) {
  spec.width = std::max((spec.width + (round_up ? 1 : 0)) / 2, 1);
  spec.height = std::max((spec.height + (round_up ? 1 : 0)) / 2, 1);
  spec.full_width = spec.width;
  spec.full_height = spec.height;
  return spec;
}

// Returns pixel types, compressions, tiles, mip levels.
std::vector<AttributeImage> exr_storage_images() {
  Images images("exr");
  const OIIO::TypeDesc half = OIIO::TypeHalf;
  for (const std::string compression : {"none", "rle", "zips", "zip", "piz"})
    images.add("half, " + compression, exr_spec(half, compression));
  for (const std::string compression : {"none", "zip", "piz"}) {
    images.add("float, " + compression, exr_spec(OIIO::TypeFloat, compression));
    images.add("half, tiled, " + compression, exr_spec(half, compression, 32, 16));
  }
  images.add("half, pxr24", exr_spec(half, "pxr24"));
  for (const std::string compression : {"b44", "b44a", "dwaa:60", "dwab:30.5"})
    images.add_lossy("half, " + compression, exr_spec(half, compression));
  images.add_lossy("float, pxr24", exr_spec(OIIO::TypeFloat, "pxr24"));
  set_all(images.add("half, mip levels", exr_spec(half, "zip", 16, 16), true),
          "textureformat=Plain Texture; openexr:roundingmode:int=0");
  set_all(images.add("half, mip levels rounded up", exr_spec(half, "piz", 32, 32), true),
          "textureformat=Plain Texture; openexr:roundingmode:int=1");
  set_all(images.add("decreasing line order", exr_spec(half, "zip")), "openexr:lineOrder=decreasingY");
  set_all(images.add("tiles in random order", exr_spec(half, "zip", 16, 16)), "openexr:lineOrder=randomY");
  set_all(images.add("latitude and longitude", exr_spec(half, "zip")), "envmap=latlong");
  images.add("grey", exr_spec(half, "zip", 0, 0, kGrey));
  return images.all();
}

// Returns layers, windows, parts.
std::vector<AttributeImage> exr_structure_images() {
  Images images("exr");
  const OIIO::TypeDesc half = OIIO::TypeHalf;
  images
      .add("layers of several types",
           exr_spec(OIIO::TypeFloat, "zip", 0, 0,
                    {"base.R", "base.G", "base.B", "base.A", "depth.Z", "id.name", "N.x"}))
      .channelformats = {half, half, half, half, OIIO::TypeFloat, OIIO::TypeUInt32, OIIO::TypeFloat};
  images.add("alpha and depth", exr_spec(OIIO::TypeFloat, "zip", 32, 32, {"R", "G", "B", "A", "Z"}));
  const OIIO::ROI display(0, 40, 0, 30, 0, 1), crop(3, 21, 5, 19, 0, 1);
  for (const int tile : {0, 16}) {
    const std::string suffix = tile > 0 ? ", tiled" : "";
    const OIIO::ImageSpec spec = exr_spec(half, "zip", tile, tile);
    set_window(images.add("overscan" + suffix, spec), OIIO::ROI(-4, 44, -1, 31, 0, 1), display);
    set_window(images.add("crop" + suffix, spec), crop, display);
    set_window(images.add("outside" + suffix, spec), OIIO::ROI(-100, -52, 200, 232, 0, 1), display);
  }
  set_window(images.add("display window from 5, -3", exr_spec(half, "zip")), OIIO::ROI(-4, 44, -6, 26, 0, 1),
             OIIO::ROI(5, 45, -3, 27, 0, 1));
  std::vector<OIIO::ImageSpec> parts = {exr_spec(half, "zip"), exr_spec(half, "zip", 0, 0, {"id"}),
                                        exr_spec(half, "zip")};
  const std::array<std::string, 3> names = {"beauty", "id", "left"};
  for (std::size_t i = 0; i < names.size(); ++i)
    set_all(parts[i], "oiio:subimagename=" + names[i] + "; test:of_part=" + names[i]);
  set_all(parts[2], "view=left");
  set_window(parts[1], crop, parts[0].roi_full());
  images.add_parts("three parts", parts);
  // Make all parts tiled, because OpenImageIO cannot write a file with tiled and untiled parts.
  for (OIIO::ImageSpec& part : parts) part.tile_width = part.tile_height = 16;
  images.add_parts("three parts, tiled", parts);
  return images.all();
}

std::vector<AttributeImage> tiff_images() {
  Images images("tif");
  const auto add = [&](OIIO::TypeDesc type, const std::string& compression, int tile) {
    add_profile(images.add(std::string(type.c_str()) + ", " + compression + (tile > 0 ? ", tiled" : ""),
                           rich_spec(kWithAlpha, type, compression, tile, tile)));
  };
  for (const OIIO::TypeDesc& type : {OIIO::TypeUInt8, OIIO::TypeUInt16, OIIO::TypeFloat})
    for (const int tile : {0, 16}) add(type, "zip", tile);
  for (const char* compression : {"none", "lzw", "packbits"}) add(OIIO::TypeUInt8, compression, 0);
  const OIIO::ImageSpec grey = rich_spec(kGrey, OIIO::TypeUInt8, "zip"),
                        color = rich_spec(kColor, OIIO::TypeUInt8, "zip"),
                        deep = rich_spec(kColor, OIIO::TypeUInt16, "zip");
  images.add("grey", grey);
  images.add("five channels", rich_spec({"R", "G", "B", "A", "mask"}, OIIO::TypeUInt16, "zip"));
  images.add("associated alpha", rich_spec(kWithAlpha, OIIO::TypeUInt16, "zip"))
      .erase_attribute("oiio:UnassociatedAlpha");
  set_all(images.add("planes apart", color), "planarconfig=separate");
  set_all(images.add("rows of a strip, predictor", deep), "tiff:RowsPerStrip:int=5; tiff:Predictor:int=2");
  set_all(images.add("IPTC", color), "tiff:write_iptc:int=1");
  set_all(images.add("half", rich_spec(kColor, OIIO::TypeHalf, "zip")), "tiff:half:int=1");
  set_all(images.add("said to be sRGB", color), "oiio:ColorSpace=sRGB");
  set_window(images.add("windows", color), OIIO::ROI(4, 52, 6, 38, 0, 1), OIIO::ROI(0, 100, 0, 80, 0, 1));
  images.add_parts("two parts", {color, rich_spec(kGrey, OIIO::TypeUInt16, "lzw")});
  return images.all();
}

std::vector<AttributeImage> png_images() {
  Images images("png");
  for (const OIIO::TypeDesc& type : {OIIO::TypeUInt8, OIIO::TypeUInt16}) {
    const std::string name = type.c_str();
    for (const auto& channels : {kGrey, {"Y", "A"}, kColor, kWithAlpha})
      set_all(images.add(name + " x " + std::to_string(channels.size()), rich_spec(channels, type)),
              "test:string=a string");
    const auto add = [&](const std::string& title, std::string_view attributes) -> OIIO::ImageSpec& {
      return set_all(images.add(name + ", " + title, rich_spec(kColor, type)), attributes);
    };
    add("sRGB", "oiio:ColorSpace=sRGB");
    add("linear", "oiio:ColorSpace=Linear");
    add("gamma", "oiio:ColorSpace=Gamma2.2; oiio:Gamma:float=2.2");
    add_profile(add("profile", ""));
    OIIO::ImageSpec& offset = add("offset", "");
    offset.x = 7;
    offset.y = 9;
    add("72 to the inch", "XResolution:float=72.009; YResolution:float=72.009; PixelAspectRatio:float=1.0");
    add("to the centimetre", "ResolutionUnit=cm; XResolution:float=28.0");
    add("no unit", "ResolutionUnit=none");
  }
  return images.all();
}

// Returns JPEG, Targa, BMP, Radiance.
std::vector<AttributeImage> small_format_images() {
  Images tga("tga"), bmp("bmp"), jpg("jpg"), hdr("hdr");
  for (const auto& channels : {kGrey, kColor, kWithAlpha}) {
    const std::string count = " x " + std::to_string(channels.size());
    tga.add("rle" + count, rich_spec(channels, OIIO::TypeUInt8, "rle"));
    set_all(tga.add("plain" + count, rich_spec(channels, OIIO::TypeUInt8, "none")),
            "oiio:Gamma:float=2.2; targa:JobTime=1:02:03; targa:ImageID=an identity");
    bmp.add("plain" + count, rich_spec(channels, OIIO::TypeUInt8));
    if (channels.size() > 3) continue;
    const OIIO::ImageSpec spec = rich_spec(channels, OIIO::TypeUInt8, "jpeg:90");
    jpg.add_lossy("plain" + count, spec);
    add_profile(set_all(jpg.add_lossy("with profile" + count, spec),
                        "jpeg:subsampling=4:2:0; Exif:ColorSpace:int=65535"));
  }
  hdr.add_lossy("radiance", rich_spec(kColor, OIIO::TypeFloat));
  std::vector<AttributeImage> images;
  for (const Images* format : {&tga, &bmp, &jpg, &hdr})
    images.insert(images.end(), format->all().begin(), format->all().end());
  return images;
}

// Writes noise in all planes.
void write_attribute_image(const std::filesystem::path& path, const AttributeImage& image) {
  const auto output = OIIO::ImageOutput::create(path.string());
  REQUIRE(output != nullptr);
  const auto check = [&](bool done) {
    INFO(output->geterror());
    REQUIRE(done);
  };
  const std::vector<OIIO::ImageSpec>& parts = image.parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (p == 0 && parts.size() > 1 && image.extension == "exr")
      check(output->open(path.string(), static_cast<int>(parts.size()), parts.data()));
    else
      check(output->open(path.string(), parts[p],
                         p == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage));
    check(output->write_image(OIIO::TypeFloat, noise_of(parts[p], static_cast<int>(p)).data()));
  }
  OIIO::ImageSpec level = parts.front();
  for (int number = 1; image.has_levels && (level.width > 1 || level.height > 1); ++number) {
    level = next_level(level, level.get_int_attribute("openexr:roundingmode") == 1);
    check(output->open(path.string(), level, OIIO::ImageOutput::AppendMIPLevel));
    check(output->write_image(OIIO::TypeFloat, noise_of(level, number).data()));
  }
  check(output->close());
}

// A StoredPlane describes one of all parts and levels as OpenImageIO does, with its texels as they are
// stored.
struct StoredPlane {
  OIIO::ImageSpec spec;
  std::vector<unsigned char> bytes;
};
std::vector<std::vector<StoredPlane>> read_planes(const std::filesystem::path& path) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path.string(), &hints);
  REQUIRE(input != nullptr);
  std::vector<std::vector<StoredPlane>> parts;
  for (int part = 0; input->seek_subimage(part, 0); ++part) {
    parts.emplace_back();
    for (int level = 0; input->seek_subimage(part, level); ++level) {
      StoredPlane plane{input->spec(), {}};
      plane.bytes.resize(plane.spec.image_bytes(true));
      REQUIRE(input->read_image(part, level, 0, plane.spec.nchannels, OIIO::TypeUnknown, plane.bytes.data()));
      parts.back().push_back(std::move(plane));
    }
  }
  return parts;
}

const std::string kNothing = "nothing";

std::string type_name(OIIO::TypeDesc type) { return type.c_str(); }

std::string attribute_text(const OIIO::ParamValue* value) {
  return value == nullptr ? kNothing : type_name(value->type()) + " " + std::string(value->get_string());
}

// Compares strings by their characters, because they are pointers, and everything else by its bytes.
bool same_value(const OIIO::ParamValue& a, const OIIO::ParamValue& b) {
  if (a.type() != b.type()) return false;
  if (a.type().basetype == OIIO::TypeDesc::STRING) return a.get_string(1 << 20) == b.get_string(1 << 20);
  return a.datasize() == b.datasize() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.datasize())) == 0;
}

const OIIO::ParamValue* same_name(const OIIO::ImageSpec& spec, const OIIO::ParamValue& value) {
  for (const OIIO::ParamValue& other : spec.extra_attribs)
    if (other.name() == value.name()) return &other;
  return nullptr;
}

std::string attribute_text(const OIIO::ROI& window) {
  return std::to_string(window.width()) + " x " + std::to_string(window.height()) + " from " +
         std::to_string(window.xbegin) + ", " + std::to_string(window.ybegin);
}

std::string channel_text(const OIIO::ImageSpec& spec) {
  std::string all;
  for (int c = 0; c < spec.nchannels; ++c)
    all += (c == 0 ? "" : ", ") + std::string(spec.channel_name(c)) + " " + type_name(spec.channelformat(c));
  return all;
}

std::string role_text(const OIIO::ImageSpec& spec) {
  return "alpha " + std::to_string(spec.alpha_channel) + ", z " + std::to_string(spec.z_channel);
}

std::string tile_text(const OIIO::ImageSpec& spec) {
  return std::to_string(spec.tile_width) + " x " + std::to_string(spec.tile_height) + " x " +
         std::to_string(spec.tile_depth);
}

struct SpecDifference {
  std::string name;    // name of the attribute, or of the field of the description
  std::string before;  // type and value, or `nothing`
  std::string after;
  bool operator==(const SpecDifference&) const = default;
};

// Returns the differences. First come attributes that do not occur in both with the same type and bytes. Then
// come fields: windows, tiles, channels, their types and roles.
std::vector<SpecDifference> differences(const OIIO::ImageSpec& before, const OIIO::ImageSpec& after) {
  std::vector<SpecDifference> all;
  for (const OIIO::ParamValue& value : before.extra_attribs) {
    const OIIO::ParamValue* other = same_name(after, value);
    if (other == nullptr || !same_value(value, *other))
      all.push_back({value.name().string(), attribute_text(&value), attribute_text(other)});
  }
  for (const OIIO::ParamValue& value : after.extra_attribs)
    if (same_name(before, value) == nullptr)
      all.push_back({value.name().string(), kNothing, attribute_text(&value)});
  const auto compare = [&all](const std::string& name, const std::string& a, const std::string& b) {
    if (a != b) all.push_back({name, a, b});
  };
  compare("data window", attribute_text(before.roi()), attribute_text(after.roi()));
  compare("display window", attribute_text(before.roi_full()), attribute_text(after.roi_full()));
  compare("tiles", tile_text(before), tile_text(after));
  compare("channels", channel_text(before), channel_text(after));
  compare("pixel type", type_name(before.format), type_name(after.format));
  compare("roles of channels", role_text(before), role_text(after));
  compare("deep", before.deep ? "yes" : "no", after.deep ? "yes" : "no");
  return all;
}

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
