#include "support/attribute_images.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "support/test_image.hpp"

namespace remap {
namespace {

constexpr int kRoughness = 48, kHeight = 32;
const std::vector<std::string> kGrey = {"Y"}, kColor = {"R", "G", "B"}, kWithAlpha = {"R", "G", "B", "A"};

void require(bool done, const std::string& message) {
  if (!done) throw std::runtime_error("attribute image: " + message);
}

// What a picture may say of itself in any format that lets it.
void describe(OIIO::ImageSpec& spec) {
  for (const char* name : {"ImageDescription", "Artist", "Copyright", "Software", "DocumentName",
                           "HostComputer", "Make", "Model", "Keywords"})
    spec.attribute(name, std::string("the ") + name + ", with \xc3\xbc");
  spec.attribute("DateTime", "2021:03:04 05:06:07");
  spec.attribute("Orientation", 6);
  spec.attribute("XResolution", 300.0f);
  spec.attribute("YResolution", 150.0f);
  spec.attribute("ResolutionUnit", "in");
  spec.attribute("PixelAspectRatio", 2.0f);
  spec.attribute("wrapmodes", "periodic,black");
  const std::array<float, 16> projection = {0.5f, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0.25f, 3, 4, 5, 1};
  spec.attribute("worldtoscreen", OIIO::TypeMatrix, projection.data());
  spec.attribute("worldtocamera", OIIO::TypeMatrix, projection.data());
  spec.attribute("fovcot", 1.25f);
}

void add_exif(OIIO::ImageSpec& spec) {
  spec.attribute("ExposureTime", 0.02f);
  spec.attribute("FNumber", 5.6f);
  spec.attribute("Exif:LensModel", "a lens");
  spec.attribute("Exif:DateTimeOriginal", "2020:01:02 03:04:05");
  spec.attribute("Exif:ISOSpeedRatings", 400);
  spec.attribute("Exif:FocalLength", 35.0f);
  spec.attribute("Exif:Flash", 1);
  spec.attribute("Exif:UserComment", "a comment");
  spec.attribute("GPS:LatitudeRef", "N");
  spec.attribute("GPS:Altitude", 120.0f);
}

void add_iptc(OIIO::ImageSpec& spec) {
  spec.attribute("IPTC:City", "Hameln");
  spec.attribute("IPTC:Caption", "a caption");
  spec.attribute("IPTC:Instructions", "none");
  spec.attribute("dc:rights", "all of them");
  spec.attribute("xmp:Rating", "3");
}

// The head and one tag of an ICC profile: as small as OpenImageIO reads one.
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
  bytes[139] = 144;  // where its value begins
  bytes[143] = 16;   // and how long it is
  put(144, "text");
  put(152, "nobody");
  // D50, the light that the connection space must have.
  for (const auto& [at, value] : {std::pair{70, 0xf6}, {71, 0xd6}, {73, 1}, {78, 0xd3}, {79, 0x2d}})
    bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
  spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, bytes.size()), bytes.data());
}

// One of every type that an EXR holds, and what film scanners and renderers write.
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
  OIIO::ImageSpec spec = test_spec(kRoughness, kHeight, channels, type);
  if (!compression.empty()) spec.attribute("Compression", compression);
  spec.tile_width = tile_width;
  spec.tile_height = tile_height;
  describe(spec);
  add_exif(spec);
  add_iptc(spec);
  return spec;
}

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

// Halved as the rounding mode of the file says; the display window of a level is its own.
OIIO::ImageSpec next_level(OIIO::ImageSpec spec, bool round_up) {
  spec.width = std::max((spec.width + (round_up ? 1 : 0)) / 2, 1);
  spec.height = std::max((spec.height + (round_up ? 1 : 0)) / 2, 1);
  spec.full_width = spec.width;
  spec.full_height = spec.height;
  return spec;
}

}  // namespace

std::vector<AttributeImage> exr_storage_images() {
  std::vector<AttributeImage> images;
  for (const char* compression : {"none", "rle", "zips", "zip", "piz"})
    images.push_back({std::string("half, ") + compression, "exr", {exr_spec(OIIO::TypeHalf, compression)}});
  for (const char* compression : {"none", "zip", "piz"}) {
    images.push_back({std::string("float, ") + compression, "exr", {exr_spec(OIIO::TypeFloat, compression)}});
    images.push_back(
        {std::string("half, tiled, ") + compression, "exr", {exr_spec(OIIO::TypeHalf, compression, 32, 16)}});
  }
  for (const char* compression : {"pxr24", "b44", "b44a", "dwaa:60", "dwab:30.5"})
    images.push_back({std::string("half, ") + compression,
                      "exr",
                      {exr_spec(OIIO::TypeHalf, compression)},
                      false,
                      std::string_view(compression) == "pxr24"});
  images.push_back({"float, pxr24", "exr", {exr_spec(OIIO::TypeFloat, "pxr24")}, false, false});
  images.push_back({"half, mip levels", "exr", {exr_spec(OIIO::TypeHalf, "zip", 16, 16)}, true});
  images.back().parts.front().attribute("textureformat", "Plain Texture");
  images.back().parts.front().attribute("openexr:roundingmode", 0);
  images.push_back({"half, mip levels rounded up", "exr", {exr_spec(OIIO::TypeHalf, "piz", 32, 32)}, true});
  images.back().parts.front().attribute("textureformat", "Plain Texture");
  images.back().parts.front().attribute("openexr:roundingmode", 1);
  images.push_back({"decreasing line order", "exr", {exr_spec(OIIO::TypeHalf, "zip")}});
  images.back().parts.front().attribute("openexr:lineOrder", "decreasingY");
  images.push_back({"tiles in random order", "exr", {exr_spec(OIIO::TypeHalf, "zip", 16, 16)}});
  images.back().parts.front().attribute("openexr:lineOrder", "randomY");
  images.push_back({"latitude and longitude", "exr", {exr_spec(OIIO::TypeHalf, "zip")}});
  images.back().parts.front().attribute("envmap", "latlong");
  images.push_back({"grey", "exr", {exr_spec(OIIO::TypeHalf, "zip", 0, 0, kGrey)}});
  return images;
}

std::vector<AttributeImage> exr_structure_images() {
  std::vector<AttributeImage> images;
  images.push_back({"layers of several types",
                    "exr",
                    {exr_spec(OIIO::TypeFloat, "zip", 0, 0,
                              {"base.R", "base.G", "base.B", "base.A", "depth.Z", "id.name", "N.x"})}});
  images.back().parts.front().channelformats = {OIIO::TypeHalf, OIIO::TypeHalf,  OIIO::TypeHalf,
                                                OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeUInt32,
                                                OIIO::TypeFloat};
  images.push_back(
      {"alpha and depth", "exr", {exr_spec(OIIO::TypeFloat, "zip", 32, 32, {"R", "G", "B", "A", "Z"})}});
  const OIIO::ROI display(0, 40, 0, 30, 0, 1);
  const std::vector<std::pair<std::string, OIIO::ROI>> windows = {
      {"overscan", OIIO::ROI(-4, 44, -1, 31, 0, 1)},
      {"crop", OIIO::ROI(3, 21, 5, 19, 0, 1)},
      {"outside", OIIO::ROI(-100, -52, 200, 232, 0, 1)}};
  for (const auto& window : windows)
    for (const int tile : {0, 16}) {
      images.push_back(
          {window.first + (tile > 0 ? ", tiled" : ""), "exr", {exr_spec(OIIO::TypeHalf, "zip", tile, tile)}});
      set_window(images.back().parts.front(), window.second, display);
    }
  images.push_back({"display window from 5, -3", "exr", {exr_spec(OIIO::TypeHalf, "zip")}});
  set_window(images.back().parts.front(), OIIO::ROI(-4, 44, -6, 26, 0, 1), OIIO::ROI(5, 45, -3, 27, 0, 1));
  AttributeImage parts{"three parts", "exr", {}};
  for (const char* name : {"beauty", "id", "left"}) {
    parts.parts.push_back(
        exr_spec(OIIO::TypeHalf, "zip", 0, 0, name[0] == 'i' ? std::vector<std::string>{"id"} : kWithAlpha));
    parts.parts.back().attribute("oiio:subimagename", name);
    parts.parts.back().attribute("test:of_part", name);
    if (name[0] == 'l') parts.parts.back().attribute("view", name);
  }
  set_window(parts.parts[1], OIIO::ROI(3, 21, 5, 19, 0, 1), parts.parts[0].roi_full());
  images.push_back(parts);
  // OpenImageIO writes no file of which some parts are tiled and some are not.
  parts.title += ", tiled";
  for (OIIO::ImageSpec& part : parts.parts) part.tile_width = part.tile_height = 16;
  images.push_back(parts);
  return images;
}

std::vector<AttributeImage> tiff_images() {
  std::vector<AttributeImage> images;
  const auto add = [&images](OIIO::TypeDesc type, const std::string& compression, int tile) {
    const std::string title = std::string(type.c_str()) + ", " + compression + (tile > 0 ? ", tiled" : "");
    images.push_back({title, "tif", {rich_spec(kWithAlpha, type, compression, tile, tile)}});
    add_profile(images.back().parts.front());
  };
  for (const OIIO::TypeDesc& type : {OIIO::TypeUInt8, OIIO::TypeUInt16, OIIO::TypeFloat})
    for (const int tile : {0, 16}) add(type, "zip", tile);
  for (const char* compression : {"none", "lzw", "packbits"}) add(OIIO::TypeUInt8, compression, 0);
  images.push_back({"grey", "tif", {rich_spec(kGrey, OIIO::TypeUInt8, "zip")}});
  images.push_back(
      {"five channels", "tif", {rich_spec({"R", "G", "B", "A", "mask"}, OIIO::TypeUInt16, "zip")}});
  images.push_back({"associated alpha", "tif", {rich_spec(kWithAlpha, OIIO::TypeUInt16, "zip")}});
  images.back().parts.front().erase_attribute("oiio:UnassociatedAlpha");
  images.push_back({"planes apart", "tif", {rich_spec(kColor, OIIO::TypeUInt8, "zip")}});
  images.back().parts.front().attribute("planarconfig", "separate");
  images.push_back({"rows of a strip, predictor", "tif", {rich_spec(kColor, OIIO::TypeUInt16, "zip")}});
  images.back().parts.front().attribute("tiff:RowsPerStrip", 5);
  images.back().parts.front().attribute("tiff:Predictor", 2);
  images.push_back({"IPTC", "tif", {rich_spec(kColor, OIIO::TypeUInt8, "zip")}});
  images.back().parts.front().attribute("tiff:write_iptc", 1);
  images.push_back({"half", "tif", {rich_spec(kColor, OIIO::TypeHalf, "zip")}});
  images.back().parts.front().attribute("tiff:half", 1);
  images.push_back({"said to be sRGB", "tif", {rich_spec(kColor, OIIO::TypeUInt8, "zip")}});
  images.back().parts.front().attribute("oiio:ColorSpace", "sRGB");
  images.push_back({"windows", "tif", {rich_spec(kColor, OIIO::TypeUInt8, "zip")}});
  set_window(images.back().parts.front(), OIIO::ROI(4, 52, 6, 38, 0, 1), OIIO::ROI(0, 100, 0, 80, 0, 1));
  AttributeImage parts{
      "two parts",
      "tif",
      {rich_spec(kColor, OIIO::TypeUInt8, "zip"), rich_spec(kGrey, OIIO::TypeUInt16, "lzw")}};
  images.push_back(parts);
  return images;
}

std::vector<AttributeImage> png_images() {
  std::vector<AttributeImage> images;
  for (const OIIO::TypeDesc& type : {OIIO::TypeUInt8, OIIO::TypeUInt16}) {
    for (const auto& channels : {kGrey, {"Y", "A"}, kColor, kWithAlpha}) {
      images.push_back({std::string(type.c_str()) + " x " + std::to_string(channels.size()),
                        "png",
                        {rich_spec(channels, type)}});
      images.back().parts.front().attribute("test:string", "a string");
    }
    const auto add = [&](const std::string& title) -> OIIO::ImageSpec& {
      images.push_back({std::string(type.c_str()) + ", " + title, "png", {rich_spec(kColor, type)}});
      return images.back().parts.front();
    };
    add("sRGB").attribute("oiio:ColorSpace", "sRGB");
    add("linear").attribute("oiio:ColorSpace", "Linear");
    OIIO::ImageSpec& curve = add("gamma");
    curve.attribute("oiio:ColorSpace", "Gamma2.2");
    curve.attribute("oiio:Gamma", 2.2f);
    add_profile(add("profile"));
    OIIO::ImageSpec& offset = add("offset");
    offset.x = 7;
    offset.y = 9;
    OIIO::ImageSpec& screen = add("72 to the inch");
    screen.attribute("XResolution", 72.009f);
    screen.attribute("YResolution", 72.009f);
    screen.attribute("PixelAspectRatio", 1.0f);
    OIIO::ImageSpec& metric = add("to the centimetre");
    metric.attribute("ResolutionUnit", "cm");
    metric.attribute("XResolution", 28.0f);
    OIIO::ImageSpec& none = add("no unit");
    none.attribute("ResolutionUnit", "none");
  }
  return images;
}

std::vector<AttributeImage> small_format_images() {
  std::vector<AttributeImage> images;
  for (const auto& channels : {kGrey, kColor, kWithAlpha}) {
    images.push_back(
        {"rle x " + std::to_string(channels.size()), "tga", {rich_spec(channels, OIIO::TypeUInt8, "rle")}});
    images.push_back({"plain x " + std::to_string(channels.size()),
                      "tga",
                      {rich_spec(channels, OIIO::TypeUInt8, "none")}});
    images.back().parts.front().attribute("oiio:Gamma", 2.2f);
    images.back().parts.front().attribute("targa:JobTime", "1:02:03");
    images.back().parts.front().attribute("targa:ImageID", "an identity");
  }
  images.push_back({"color", "bmp", {rich_spec(kColor, OIIO::TypeUInt8)}});
  images.push_back({"with alpha", "bmp", {rich_spec(kWithAlpha, OIIO::TypeUInt8)}});
  images.push_back({"grey", "bmp", {rich_spec(kGrey, OIIO::TypeUInt8)}});
  for (const auto& channels : {kGrey, kColor}) {
    images.push_back({"x " + std::to_string(channels.size()),
                      "jpg",
                      {rich_spec(channels, OIIO::TypeUInt8, "jpeg:90")},
                      false,
                      false});
    images.push_back({"with profile x " + std::to_string(channels.size()),
                      "jpg",
                      {rich_spec(channels, OIIO::TypeUInt8, "jpeg:90")},
                      false,
                      false});
    add_profile(images.back().parts.front());
    images.back().parts.front().attribute("jpeg:subsampling", "4:2:0");
    images.back().parts.front().attribute("Exif:ColorSpace", 65535);
  }
  images.push_back({"radiance", "hdr", {rich_spec(kColor, OIIO::TypeFloat)}, false, false});
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
