#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <limits>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace {

// In a valid file of these formats, one byte never encodes more bytes of pixels, except in pictures of one
// color.
constexpr std::uint64_t kMostBytesOfAByte = 1'000'000;
// A header that claims more texels than this is damaged or an attack.
constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 32;

std::atomic<std::uint64_t> most_memory = std::uint64_t{4} << 30;

std::string begin_of(const ImageBytes& image) {
  std::string head(64, '\0');
  head.resize(image.read(0, head.data(), head.size()));
  return head;
}

std::uint32_t number_at(std::string_view bytes, std::size_t place, std::size_t count, bool is_big) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = place + (is_big ? i : count - 1 - i);
    number = number << 8 | (at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0u);
  }
  return number;
}

// Detects Targa files by the values of their 18-byte header, because they do not begin with a mark.
bool is_targa(std::string_view head) {
  const std::string_view types("\1\2\3\11\12\13", 6), depths("\10\17\20\30\40", 5);
  return head.size() >= 18 && (head[1] == 0 || head[1] == 1) &&
         types.find(head[2]) != std::string_view::npos && depths.find(head[16]) != std::string_view::npos;
}

std::string format_of(std::string_view head) {
  using Mark = std::pair<std::string_view, const char*>;
  constexpr std::array<Mark, 10> kMarks = {Mark{"\x89PNG\r\n\x1a\n", "png"},
                                           {"\xff\xd8", "jpeg"},
                                           {"BM", "bmp"},
                                           {std::string_view("II*\0", 4), "tiff"},
                                           {std::string_view("MM\0*", 4), "tiff"},
                                           {std::string_view("II+\0", 4), "tiff"},
                                           {std::string_view("MM\0+", 4), "tiff"},
                                           {"\x76\x2f\x31\x01", "openexr"},
                                           {"#?RADIANCE", "hdr"},
                                           {"#?RGBE", "hdr"}};
  for (const auto& [mark, format] : kMarks)
    if (head.starts_with(mark)) return format;
  if (head.starts_with("RIFF") && head.substr(std::min<std::size_t>(8, head.size()), 4) == "WEBP")
    return "webp";
  return is_targa(head) ? "targa" : "";
}

// Returns the name of a format that texremap recognises but does not read, otherwise an empty text.
std::string known_name(std::string_view head) {
  using Mark = std::pair<std::string_view, const char*>;
  constexpr std::array<Mark, 8> kMarks = {Mark{"\xabKTX", "KTX2"}, {"DDS ", "DDS"},   {"GIF8", "GIF"},
                                          {"8BPS", "PSD"},         {"SDPX", "DPX"},   {"XPDS", "DPX"},
                                          {"FOR4", "IFF"},         {"SIMPLE", "FITS"}};
  for (const auto& [mark, name] : kMarks)
    if (head.starts_with(mark)) return name;
  const std::string_view brand = head.substr(std::min<std::size_t>(4, head.size()), 8);
  return brand == "ftypavif" ? "AVIF" : brand == "ftypheic" ? "HEIC" : "";
}

[[noreturn]] void refuse_damaged(const std::string& context, const std::string& what) {
  throw input_error(context + ": is damaged: " + what);
}

// Checks chunk lengths, because libpng allocates and fills as much memory as a chunk claims.
void look_at_png(const ImageBytes& image, const std::string& context, ImageHead& head) {
  constexpr std::size_t kFrame = 12, kMostChunks = 10'000;  // length, name and checksum
  std::array<char, 8> begin{};
  for (std::uint64_t at = 8; image.read(at, begin.data(), begin.size()) == begin.size();) {
    const std::string_view bytes(begin.data(), begin.size());
    const std::string name(bytes.substr(4));
    if (name == "IDAT") return;
    at += std::uint64_t{number_at(bytes, 0, 4, true)} + kFrame;
    if (at > image.size)
      refuse_damaged(context, "chunk " + plain(name) + " claims to be longer than the file");
    if (head.png_chunks.size() == kMostChunks) refuse_damaged(context, "it has too many chunks");
    head.png_chunks.push_back(name);
  }
}

// Checks compression and bits, because OpenImageIO reads beyond its memory if they contradict each other.
void look_at_bmp(const std::string& begin, const ImageBytes& image, const std::string& context) {
  constexpr std::uint32_t kOldHeader = 12;  // a header without compression
  const std::uint32_t header = number_at(begin, 14, 4, false);
  const bool is_old = header == kOldHeader;
  const std::uint32_t bits = number_at(begin, is_old ? 24 : 28, 2, false),
                      compression = is_old ? 0 : number_at(begin, 30, 4, false),
                      pixels = number_at(begin, 10, 4, false);
  constexpr std::array<std::uint32_t, 6> kHeaders = {kOldHeader, 40, 52, 56, 108, 124},
                                         kBits = {1, 4, 8, 16, 24, 32};
  const bool fits = compression == 0 || (compression == 1 && bits == 8) || (compression == 2 && bits == 4) ||
                    (compression == 3 && (bits == 16 || bits == 32));
  if (!contains(kHeaders, header))
    throw input_error(context + ": is damaged, or of an unknown kind: a header of " + std::to_string(header) +
                      " bytes");
  if (!fits || !contains(kBits, bits))
    throw input_error(context + ": is damaged, or of an unknown kind: compression " +
                      std::to_string(compression) + " of " + std::to_string(bits) + " bits");
  if (pixels > image.size) refuse_damaged(context, "its texels would begin behind its end");
  const auto side = [&](std::size_t at, std::size_t size) {
    const std::uint32_t value = number_at(begin, at, size, false);
    return static_cast<std::uint64_t>(size == 4 && value > 0x7fffffffu ? 0u - value : value);
  };
  const std::uint64_t width = side(18, is_old ? 2 : 4), height = is_old ? side(20, 2) : side(22, 4);
  if (compression == 1 || compression == 2) {  // run lengths are all read when the file is opened
    constexpr std::uint64_t kLongest = std::numeric_limits<int>::max();
    const auto shorter = [&](std::uint64_t texels) { return static_cast<int>(std::min(texels, kLongest)); };
    ImageHead head;
    head.is_read_whole = true;
    require_plausible(OIIO::ImageSpec(shorter(width), shorter(height), 3), head, image, context);
  }
  if (compression != 0) return;
  if ((width * bits + 31) / 32 * 4 * height > image.size - pixels)
    refuse_damaged(context, "it has fewer texels than its size of " + std::to_string(width) + "x" +
                                std::to_string(height) + " needs (the file may be truncated)");
}

// Checks the ends of texts, because OpenImageIO reads a text of the extension area up to the next zero,
// wherever that is.
void look_at_targa(const ImageBytes& image, const std::string& context) {
  constexpr std::size_t kFooter = 26, kArea = 495;
  std::string footer(kFooter, '\0'), area(kArea, '\0');
  if (image.size < kFooter || image.read(image.size - kFooter, footer.data(), kFooter) < kFooter ||
      footer.substr(8, 16) != "TRUEVISION-XFILE")
    return;
  const std::uint32_t begin = number_at(footer, 0, 4, false);
  if (begin == 0) return;
  if (image.read(begin, area.data(), kArea) < kArea)
    refuse_damaged(context, "its extension area is incomplete");
  using Text = std::pair<std::size_t, std::size_t>;  // place and size
  constexpr std::array<Text, 7> kTexts = {Text{2, 41}, {43, 81},  {124, 81}, {205, 81},
                                          {286, 81},   {379, 41}, {426, 41}};
  for (const auto& [at, size] : kTexts)
    if (area.substr(at, size).find('\0') == std::string::npos)
      refuse_damaged(context, "a text of its extension area has no end");
}

// Checks palette indices, because OpenImageIO reads colors beyond the end of the palette.
void look_at_targa_palette(std::string_view begin, const ImageBytes& image, const std::string& context) {
  constexpr std::size_t kHeader = 18, kChunk = std::size_t{1} << 16;
  constexpr std::uint32_t kPlain = 1, kRunLengths = 9;
  const std::uint32_t type = number_at(begin, 2, 1, false), first = number_at(begin, 3, 2, false),
                      colors = number_at(begin, 5, 2, false), color_bits = number_at(begin, 7, 1, false),
                      index_bytes = (number_at(begin, 16, 1, false) + 7) / 8;
  if (type != kPlain && type != kRunLengths) return;
  if (begin[1] != 1 || first != 0 || index_bytes > 2)
    throw input_error(context + ": has a palette of an unknown kind (convert it to PNG)");
  std::uint64_t at = kHeader + number_at(begin, 0, 1, false) + std::uint64_t{colors} * ((color_bits + 7) / 8);
  std::uint64_t left = std::uint64_t{number_at(begin, 12, 2, false)} * number_at(begin, 14, 2, false);
  std::string chunk;
  std::size_t next = 0;
  bool has_ended = false;
  // Returns 0 beyond the end of the file. OpenImageIO reports such files itself.
  const auto number = [&](std::size_t count) {
    if (chunk.size() - next < count) {
      at += next;
      chunk.resize(kChunk);
      chunk.resize(image.read(at, chunk.data(), chunk.size()));
      next = 0;
      has_ended = chunk.size() < count;
    }
    const std::uint32_t value = has_ended ? 0 : number_at(chunk, next, count, false);
    next += has_ended ? 0 : count;
    return value;
  };
  while (left > 0 && !has_ended) {
    std::uint64_t texels = left, indices = left;
    if (type == kRunLengths) {
      const std::uint32_t packet = number(1);
      texels = std::min<std::uint64_t>(left, (packet & 0x7f) + 1);
      indices = (packet & 0x80) != 0 ? 1 : texels;
    }
    for (; indices > 0 && !has_ended; --indices)
      if (number(index_bytes) >= colors && !has_ended)
        refuse_damaged(context, "a texel has a color behind the end of the palette, which has " +
                                    std::to_string(colors) + " colors");
    left -= texels;
  }
}

// Checks attribute lengths, because OpenEXR allocates and fills as much memory as an attribute claims.
void look_at_exr(const ImageBytes& image, const std::string& context) {
  constexpr std::size_t kStart = 8, kMostAttributes = 100'000, kNames = 2 * 256;  // name and type
  constexpr std::uint32_t kSeveralParts = 0x1000;
  std::string bytes(kNames + 4, '\0');
  const auto read_at = [&](std::uint64_t at) {
    bytes.resize(kNames + 4);
    bytes.resize(image.read(at, bytes.data(), bytes.size()));
  };
  read_at(0);
  const bool has_parts = (number_at(bytes, 4, 4, false) & kSeveralParts) != 0;
  std::uint64_t at = kStart;
  for (std::size_t count = 0; count < kMostAttributes; ++count) {
    read_at(at);
    const std::size_t name = bytes.find('\0');
    if (name == 0 && (!has_parts || bytes.size() < 2 || bytes[1] == '\0'))
      return;  // the last header has ended
    if (name == 0) {
      ++at;
      continue;
    }
    const std::size_t type = name == std::string::npos ? name : bytes.find('\0', name + 1);
    if (type == std::string::npos || type + 5 > bytes.size())
      refuse_damaged(context, "its header has no end");
    at += type + 5 + std::uint64_t{number_at(bytes, type + 1, 4, false)};
    if (at > image.size)
      refuse_damaged(context,
                     "attribute " + plain(bytes.substr(0, name)) + " claims to be longer than the file");
  }
  refuse_damaged(context, "it has too many attributes");
}

// Detects progressive JPEG files. They are in memory as a whole until their last scan is read.
bool is_progressive(const ImageBytes& image) {
  constexpr std::size_t kMostSegments = 10'000;
  std::array<char, 4> segment{};
  std::uint64_t at = 2;
  for (std::size_t i = 0;
       i < kMostSegments && image.read(at, segment.data(), segment.size()) == segment.size(); ++i) {
    const std::string_view bytes(segment.data(), segment.size());
    const std::uint32_t marker = number_at(bytes, 1, 1, true);
    if (number_at(bytes, 0, 1, true) != 0xff || marker == 0xda || marker == 0xc0) return false;
    if (marker == 0xc2) return true;
    at += 2 + number_at(bytes, 2, 2, true);
  }
  return true;
}

}  // namespace

ImageBytes bytes_of(std::string_view memory) {
  return {memory.size(), [memory](std::uint64_t place, char* bytes, std::size_t count) -> std::size_t {
            if (place >= memory.size()) return 0;
            count = std::min<std::size_t>(count, memory.size() - place);
            std::memcpy(bytes, memory.data() + place, count);
            return count;
          }};
}

ImageHead checked_head(const ImageBytes& image, const std::string& context, ImageUse use) {
  const std::string begin = begin_of(image);
  ImageHead head{format_of(begin), {}, false};
  const bool is_picture = head.format == "openexr" || head.format == "hdr";  // not in assets
  if (head.format.empty() || (is_picture && use == ImageUse::kAsset)) {
    const std::string name = is_picture ? head.format : known_name(begin);
    throw input_error(context + ": " +
                      (!name.empty() ? "is " + name + ", which texremap does not read " +
                                           (is_picture ? "in assets " : "") + "(convert it to PNG)"
                       : use == ImageUse::kAsset
                           ? "is not an image of a known format (PNG, JPEG, WebP, BMP, TIFF, Targa)"
                           : "cannot be read as an image: unknown format (PNG, JPEG, WebP, BMP, TIFF, Targa, "
                             "OpenEXR and Radiance HDR are read)"));
  }
  if (head.format == "png") {
    look_at_png(image, context, head);
    head.is_read_whole = number_at(begin, 28, 1, true) != 0;  // interlaced
  }
  if (head.format == "bmp") look_at_bmp(begin, image, context);
  if (head.format == "targa") {
    look_at_targa(image, context);
    look_at_targa_palette(begin, image, context);
  }
  if (head.format == "openexr") look_at_exr(image, context);
  if (head.format == "jpeg") head.is_read_whole = is_progressive(image);
  if (head.format == "webp" || head.format == "targa") head.is_read_whole = true;
  return head;
}

void require_plausible(const OIIO::ImageSpec& spec, const ImageHead& head, const ImageBytes& image,
                       const std::string& context) {
  const std::string size = std::to_string(spec.width) + "x" + std::to_string(spec.height);
  const std::uint64_t bytes = spec.image_bytes(true), row = spec.scanline_bytes(true);
  if (spec.width < 1 || spec.height < 1) return;  // the caller reports empty images with its own message
  if (spec.image_pixels() > kMostTexels)
    throw input_error(context + ": has " + size + " texels, which is more than texremap can read (" +
                      std::to_string(kMostTexels) + ")");
  if (bytes / kMostBytesOfAByte > image.size)
    refuse_damaged(context, "its size of " + size + " is too large for a file of " +
                                std::to_string(image.size) + " bytes");
  // OpenImageIO keeps this many rows while it reads strips, tiles and blocks.
  const int strip = std::max({spec.tile_height, spec.get_int_attribute("tiff:RowsPerStrip"), 256});
  require_image_memory(
      head.is_read_whole ? bytes : row * static_cast<std::uint64_t>(std::min(strip, spec.height)), context);
}

void set_image_memory(std::uint64_t bytes) { most_memory = bytes; }

void require_image_memory(std::uint64_t bytes, const std::string& context) {
  const std::uint64_t most = most_memory;
  if (bytes <= most) return;
  const auto megabytes = [](std::uint64_t size) { return std::to_string((size + 0xfffff) >> 20) + " MB"; };
  throw input_error(context + ": needs " + megabytes(bytes) +
                    " of memory, and an image of this run may take " + megabytes(most) +
                    " (--memory-limit MB allows more, fewer --threads leave more for each)");
}

}  // namespace remap
