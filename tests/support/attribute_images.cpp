#include "support/attribute_images.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include <OpenImageIO/strutil.h>

#include "support/test_image.hpp"

namespace remap {
namespace {

constexpr int kWidth = 48, kHeight = 32;
const std::vector<std::string> kGrey = {"Y"}, kColor = {"R", "G", "B"}, kWithAlpha = {"R", "G", "B", "A"};

void require(bool done, const std::string& message) {
  if (!done) throw std::runtime_error("attribute image: " + message);
}

// Sets `NAME=TEXT; NAME:int=VALUE; NAME:float=VALUE; ...`.
OIIO::ImageSpec& set(OIIO::ImageSpec& spec, std::string_view attributes) {
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
  set(spec, kCommon);
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
  OIIO::ImageSpec spec = test_spec(kWidth, kHeight, channels, type);
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

}  // namespace

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
  set(images.add("half, mip levels", exr_spec(half, "zip", 16, 16), true),
      "textureformat=Plain Texture; openexr:roundingmode:int=0");
  set(images.add("half, mip levels rounded up", exr_spec(half, "piz", 32, 32), true),
      "textureformat=Plain Texture; openexr:roundingmode:int=1");
  set(images.add("decreasing line order", exr_spec(half, "zip")), "openexr:lineOrder=decreasingY");
  set(images.add("tiles in random order", exr_spec(half, "zip", 16, 16)), "openexr:lineOrder=randomY");
  set(images.add("latitude and longitude", exr_spec(half, "zip")), "envmap=latlong");
  images.add("grey", exr_spec(half, "zip", 0, 0, kGrey));
  return images.all();
}

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
    set(parts[i], "oiio:subimagename=" + names[i] + "; test:of_part=" + names[i]);
  set(parts[2], "view=left");
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
  set(images.add("planes apart", color), "planarconfig=separate");
  set(images.add("rows of a strip, predictor", deep), "tiff:RowsPerStrip:int=5; tiff:Predictor:int=2");
  set(images.add("IPTC", color), "tiff:write_iptc:int=1");
  set(images.add("half", rich_spec(kColor, OIIO::TypeHalf, "zip")), "tiff:half:int=1");
  set(images.add("said to be sRGB", color), "oiio:ColorSpace=sRGB");
  set_window(images.add("windows", color), OIIO::ROI(4, 52, 6, 38, 0, 1), OIIO::ROI(0, 100, 0, 80, 0, 1));
  images.add_parts("two parts", {color, rich_spec(kGrey, OIIO::TypeUInt16, "lzw")});
  return images.all();
}

std::vector<AttributeImage> png_images() {
  Images images("png");
  for (const OIIO::TypeDesc& type : {OIIO::TypeUInt8, OIIO::TypeUInt16}) {
    const std::string name = type.c_str();
    for (const auto& channels : {kGrey, {"Y", "A"}, kColor, kWithAlpha})
      set(images.add(name + " x " + std::to_string(channels.size()), rich_spec(channels, type)),
          "test:string=a string");
    const auto add = [&](const std::string& title, std::string_view attributes) -> OIIO::ImageSpec& {
      return set(images.add(name + ", " + title, rich_spec(kColor, type)), attributes);
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

std::vector<AttributeImage> small_format_images() {
  Images tga("tga"), bmp("bmp"), jpg("jpg"), hdr("hdr");
  for (const auto& channels : {kGrey, kColor, kWithAlpha}) {
    const std::string count = " x " + std::to_string(channels.size());
    tga.add("rle" + count, rich_spec(channels, OIIO::TypeUInt8, "rle"));
    set(tga.add("plain" + count, rich_spec(channels, OIIO::TypeUInt8, "none")),
        "oiio:Gamma:float=2.2; targa:JobTime=1:02:03; targa:ImageID=an identity");
    bmp.add("plain" + count, rich_spec(channels, OIIO::TypeUInt8));
    if (channels.size() > 3) continue;
    const OIIO::ImageSpec spec = rich_spec(channels, OIIO::TypeUInt8, "jpeg:90");
    jpg.add_lossy("plain" + count, spec);
    add_profile(set(jpg.add_lossy("with profile" + count, spec),
                    "jpeg:subsampling=4:2:0; Exif:ColorSpace:int=65535"));
  }
  hdr.add_lossy("radiance", rich_spec(kColor, OIIO::TypeFloat));
  std::vector<AttributeImage> images;
  for (const Images* format : {&tga, &bmp, &jpg, &hdr})
    images.insert(images.end(), format->all().begin(), format->all().end());
  return images;
}

void write_attribute_image(const std::filesystem::path& path, const AttributeImage& image) {
  const auto output = OIIO::ImageOutput::create(path.string());
  require(output != nullptr, "no writer for " + path.string());
  const auto check = [&](bool done) { require(done, image.title + ": " + output->geterror()); };
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

std::vector<std::vector<StoredPlane>> read_planes(const std::filesystem::path& path) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path.string(), &hints);
  require(input != nullptr, path.string() + ": " + OIIO::geterror());
  std::vector<std::vector<StoredPlane>> parts;
  for (int part = 0; input->seek_subimage(part, 0); ++part) {
    parts.emplace_back();
    for (int level = 0; input->seek_subimage(part, level); ++level) {
      StoredPlane plane{input->spec(), {}};
      plane.bytes.resize(plane.spec.image_bytes(true));
      require(input->read_image(part, level, 0, plane.spec.nchannels, OIIO::TypeUnknown, plane.bytes.data()),
              path.string() + ": " + input->geterror());
      parts.back().push_back(std::move(plane));
    }
  }
  return parts;
}

}  // namespace remap
