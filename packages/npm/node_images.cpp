// This file reads and writes images in files for the commands of texremap in node. JavaScript decodes and
// encodes whole files in memory (images.js). This file handles the other chunks of PNG files.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <emscripten.h>
#include <string_view>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/plain_text.hpp"
#include "texture/image_library.hpp"

// Messages use this name for the program.
#ifndef REMAP_IMAGE_HOST
#define REMAP_IMAGE_HOST "the package for node"
#endif

namespace remap::node {
namespace {

// A DecodedByHost is JavaScript's answer to a request to decode; `bytes` are from malloc.
struct DecodedByHost {
  std::int32_t width, height, channels, bits, bytes, byte_count;
};
struct EncodedByHost {
  std::int32_t bytes, byte_count;
};

// clang-format off
// Both return null, or a message from malloc.
EM_JS(char*, remap_host_decode, (const char* bytes, int count, void* decoded), {
  try {
    const image = Module["images"].decode(HEAPU8.slice(bytes, bytes + count));
    const data = new Uint8Array(image.data.buffer, image.data.byteOffset, image.data.byteLength);
    const place = _malloc(Math.max(data.length, 1));
    if (place === 0) throw new Error("not enough memory");
    HEAPU8.set(data, place);
    HEAP32.set([image.width, image.height, image.channels, image.depth, place, data.length], decoded >> 2);
    return 0;
  } catch (error) {
    return allocateUTF8(String(error.message));
  }
});
EM_JS(char*, remap_host_encode, (const char* format, const void* texels, int count, int width, int height, int channels,
                                 int bits, int setting, void* encoded), {
  try {
    const bytes = HEAPU8.slice(texels, texels + count);
    const data = bits === 16 ? new Uint16Array(bytes.buffer) : bytes;
    const file = Module["images"].encode(UTF8ToString(format), { width, height, channels, depth: bits, data }, setting);
    const place = _malloc(Math.max(file.length, 1));
    if (place === 0) throw new Error("not enough memory");
    HEAPU8.set(file, place);
    HEAP32.set([place, file.length], encoded >> 2);
    return 0;
  } catch (error) {
    return allocateUTF8(String(error.message));
  }
});
// clang-format on

// Returns the text of a message, and frees the message.
std::string taken(char* message) {
  std::string text = message;
  std::free(message);
  return plain(text.substr(0, text.find('\n')));
}

std::string taken(std::int32_t bytes, std::int32_t count) {
  auto* const memory = reinterpret_cast<char*>(static_cast<std::uintptr_t>(bytes));
  std::string text(memory, static_cast<std::size_t>(count));
  std::free(memory);
  return text;
}

// An image states its size before its texels are read. A larger size is a mistake or an attack.
constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 28;

ImagePixels decoded(std::string_view bytes, const std::string& context) {
  DecodedByHost image{};
  if (char* message = remap_host_decode(bytes.data(), static_cast<int>(bytes.size()), &image))
    throw input_error(context + ": cannot be read: " + taken(message));
  const std::string texels = taken(image.bytes, image.byte_count);
  ImagePixels pixels;
  pixels.width = static_cast<std::size_t>(image.width);
  pixels.height = static_cast<std::size_t>(image.height);
  pixels.channels = static_cast<std::size_t>(image.channels);
  pixels.type = image.bits == 16 ? PixelType::kUint16 : PixelType::kUint8;
  if (image.channels < 1 || image.channels > 4 ||
      texels.size() != pixels.width * pixels.height * pixels.texel_bytes())
    throw input_error(context + ": cannot be read: the image is damaged");
  const auto* const first = reinterpret_cast<const std::byte*>(texels.data());
  pixels.bytes.assign(first, first + texels.size());
  return pixels;
}

// `setting` is the level of PNG, or the quality of JPEG.
std::string encoded(const std::string& format, const ImagePixels& pixels, int setting,
                    const std::string& context) {
  EncodedByHost file{};
  char* const message = remap_host_encode(
      format.c_str(), pixels.bytes.data(), static_cast<int>(pixels.bytes.size()),
      static_cast<int>(pixels.width), static_cast<int>(pixels.height), static_cast<int>(pixels.channels),
      pixels.type == PixelType::kUint16 ? 16 : 8, setting, &file);
  if (message != nullptr) throw output_error(context + ": cannot be encoded: " + taken(message));
  return taken(file.bytes, file.byte_count);
}

std::string_view part_of(std::string_view bytes, std::size_t begin, std::size_t count) {
  return bytes.size() < begin ? std::string_view() : bytes.substr(begin, count);
}

// Returns the name of the format of a file as in OpenImageIO, or an empty text for others.
std::string format_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "png";
  if (bytes.starts_with("\xff\xd8")) return "jpeg";
  if (bytes.starts_with("RIFF") && part_of(bytes, 8, 4) == "WEBP") return "webp";
  if (bytes.starts_with(std::string_view("II*\0", 4)) || bytes.starts_with(std::string_view("MM\0*", 4)))
    return "tiff";
  return "";
}

// Returns the message about formats that other packages read.
std::string refusal_of(std::string_view bytes) {
  const auto elsewhere = [](const std::string& name) {
    return name + " is not read by " REMAP_IMAGE_HOST " (use the Debian or the Python package)";
  };
  if (bytes.starts_with("\x76\x2f\x31\x01")) return elsewhere("EXR");
  if (bytes.starts_with("#?")) return elsewhere("Radiance HDR");
  if (bytes.starts_with("BM")) return elsewhere("BMP");
  if (bytes.starts_with("DDS ")) return elsewhere("DDS");
  if (bytes.starts_with("\xabKTX")) return "is KTX2, which is not read (convert it to PNG)";
  if (part_of(bytes, 4, 8) == "ftypavif") return "is AVIF, which is not read (convert it to PNG)";
  return "is not an image of a known format (PNG, JPEG, WebP, TIFF)";
}

// Limits files, because they are held whole in memory, of which WebAssembly has 2 GB.
constexpr std::uintmax_t kLargestImageFile = std::uintmax_t{512} << 20;

std::string image_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored && size > kLargestImageFile)
    throw input_error(path.string() + ": has " + std::to_string(size >> 20) +
                      " MB, and " REMAP_IMAGE_HOST " reads " + std::to_string(kLargestImageFile >> 20) +
                      " MB at most (use the Debian or the Python package)");
  return read_file(path, kLargestImageFile);
}

// The following functions handle the chunks of PNG files.

struct PngChunk {
  std::string name, data;
};

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}
std::string big_endian(std::uint32_t number) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 255u);
  return bytes;
}

constexpr std::size_t kPngSignature = 8;
constexpr std::size_t kPngHeader = kPngSignature + 25;  // with IHDR

std::vector<PngChunk> png_chunks(std::string_view file, const std::string& context) {
  std::vector<PngChunk> chunks;
  for (std::size_t at = kPngSignature; at + 12 <= file.size();) {
    const std::size_t length = big_endian(file.substr(at, 4));
    const std::string name(file.substr(at + 4, 4));
    if (length > file.size() - at - 12)
      throw input_error(context + ": is damaged: chunk " + plain(name) +
                        " claims to be longer than the file");
    if (name != "IDAT") chunks.push_back({name, std::string(file.substr(at + 8, length))});
    at += 12 + length;
  }
  return chunks;
}

const PngChunk* find_chunk(const std::vector<PngChunk>& chunks, std::string_view name) {
  const auto found = std::ranges::find(chunks, name, &PngChunk::name);
  return found == chunks.end() ? nullptr : &*found;
}

// Returns the CRC-32 of ISO 3309, as PNG (annex D) defines it.
std::uint32_t checksum(std::string_view bytes) {
  std::uint32_t sum = ~0u;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (0xedb88320u & (0u - (sum & 1u)));
  }
  return ~sum;
}

std::string chunk_text(const PngChunk& chunk) {
  const std::string named = chunk.name + chunk.data;
  return big_endian(static_cast<std::uint32_t>(chunk.data.size())) + named + big_endian(checksum(named));
}

constexpr std::uint32_t kLinearGamma = 100000, kGammaTolerance = 1000, kSrgbGamma = 45455;
constexpr char kIntentOfLibpng = 3;
// These are the white and the primaries of sRGB, in units of 1e-5.
constexpr std::array<std::uint32_t, 8> kSrgbChromaticities = {31270, 32900, 64000, 33000,
                                                              30000, 60000, 15000, 6000};

// Returns the chunks by which libpng tags a file as sRGB.
std::vector<PngChunk> srgb_chunks() {
  std::string chromaticities;
  for (const std::uint32_t value : kSrgbChromaticities) chromaticities += big_endian(value);
  return {{"gAMA", big_endian(kSrgbGamma)}, {"sRGB", {kIntentOfLibpng}}, {"cHRM", chromaticities}};
}

// Returns the curve. Gamma curves are read as sRGB, as in the programs.
std::optional<Transfer> transfer_of(const std::vector<PngChunk>& chunks) {
  if (find_chunk(chunks, "sRGB") != nullptr) return Transfer::kSrgb;
  const PngChunk* gamma = find_chunk(chunks, "gAMA");
  if (gamma == nullptr || gamma->data.size() != 4) return std::nullopt;
  const std::uint32_t value = big_endian(gamma->data);
  const bool is_linear = value > kLinearGamma - kGammaTolerance && value < kLinearGamma + kGammaTolerance;
  return is_linear ? Transfer::kLinear : Transfer::kSrgb;
}

void set_channels(ImageLayout& layout, const std::vector<std::string>& names, PixelType type) {
  layout.channels.clear();
  layout.texel_bytes = 0;
  for (const std::string& name : names) {
    layout.channels.push_back({name, type, layout.texel_bytes});
    layout.texel_bytes += byte_count(type);
  }
  const auto alpha = std::find(names.begin(), names.end(), "A");
  layout.alpha_channel = alpha == names.end() ? -1 : static_cast<int>(alpha - names.begin());
}

// Returns the names that OpenImageIO gives.
std::vector<std::string> usual_names(std::size_t count) {
  std::vector<std::string> names = {"R", "G", "B"};
  if (count < 3) names = {"Y"};
  if (count % 2 == 0) names.emplace_back("A");
  return names;
}

// Reads size and channels of a PNG file from its header.
void read_png_header(std::string_view file, const std::vector<PngChunk>& chunks, const std::string& context,
                     ImageLayout& layout) {
  const PngChunk* header = find_chunk(chunks, "IHDR");
  if (header == nullptr || header->data.size() < 13 || file.size() < kPngHeader)
    throw input_error(context + ": cannot be read as an image: the header is damaged");
  layout.width = static_cast<int>(big_endian(std::string_view(header->data).substr(0, 4)));
  layout.height = static_cast<int>(big_endian(std::string_view(header->data).substr(4, 4)));
  const int kind = header->data[9];
  const bool has_alpha = (kind & 4) != 0 || find_chunk(chunks, "tRNS") != nullptr;
  const std::size_t count = ((kind & 2) != 0 ? 3u : 1u) + (has_alpha ? 1u : 0u);
  set_channels(layout, usual_names(count), header->data[8] == 16 ? PixelType::kUint16 : PixelType::kUint8);
}

class StoredByNode final : public StoredImage {
 public:
  StoredByNode(const std::filesystem::path& path, int part) : path_(path), file_(image_file(path)) {
    layout_.format = format_of(file_);
    if (layout_.format.empty()) fail(refusal_of(file_));
    if (part != 0) fail("part " + std::to_string(part) + " not found (number of parts: 1)");
    if (layout_.format == "png") {
      chunks_ = png_chunks(file_, path_.string());
      read_png_header(file_, chunks_, path_.string(), layout_);
      layout_.tagged_transfer = transfer_of(chunks_);
      layout_.has_compression_level = true;
    } else {
      decode();
      layout_.width = static_cast<int>(pixels_->width);
      layout_.height = static_cast<int>(pixels_->height);
      set_channels(layout_, usual_names(pixels_->channels), pixels_->type);
      if (layout_.format != "tiff") layout_.lossy_compression = layout_.format;
    }
    if (layout_.width < 1 || layout_.height < 1 ||
        static_cast<std::uint64_t>(layout_.width) * static_cast<std::uint64_t>(layout_.height) > kMostTexels)
      fail("its size is none that is read");
    followed_width_ = layout_.width;
    followed_height_ = layout_.height;
  }

  const ImageLayout& layout() const noexcept override { return layout_; }
  std::string part_name() const override { return {}; }
  int part_count() const noexcept override { return 1; }
  int level_count() const noexcept override { return 1; }
  void select_level(int) override {}
  void set_followed_size(int width, int height) override {
    followed_width_ = width;
    followed_height_ = height;
  }
  void read_rows(int first_row, int row_count, std::byte* texels) override {
    decode();
    const std::size_t row = layout_.row_bytes();
    std::memcpy(texels, pixels_->bytes.data() + static_cast<std::size_t>(first_row) * row,
                static_cast<std::size_t>(row_count) * row);
  }
  std::optional<std::string> noted_metadata(const std::string& name) const override {
    for (const PngChunk& chunk : chunks_)
      if (chunk.name == "tEXt" && chunk.data.starts_with(name + '\0'))
        return chunk.data.substr(name.size() + 1);
    return std::nullopt;
  }

  ImageLayout followed() const {
    ImageLayout layout = layout_;
    layout.width = followed_width_;
    layout.height = followed_height_;
    return layout;
  }
  const std::vector<PngChunk>& chunks() const noexcept { return chunks_; }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw input_error(path_.string() + ": " + what); }
  void decode() {
    if (pixels_) return;
    pixels_ = decoded(file_, path_.string());
    const bool is_as_said =
        layout_.format != "png" ||
        pixels_->bytes.size() == layout_.row_bytes() * static_cast<std::size_t>(layout_.height);
    if (!is_as_said) fail("cannot be read: the image is damaged");
    file_ = {};
  }

  std::filesystem::path path_;
  std::string file_;
  std::vector<PngChunk> chunks_;
  std::optional<ImagePixels> pixels_;  // decoded on demand
  ImageLayout layout_;
  int followed_width_ = 0, followed_height_ = 0;
};

constexpr int kLevelOfNewPng = 6, kBestQuality = 100;

std::string name_of_type(PixelType type) { return std::string(name_of(kPixelTypes, type)); }

class NewByNode final : public NewImage {
 public:
  NewByNode(const std::filesystem::path& path, const NewPart& part) : file_(path) {
    const auto& model = static_cast<const StoredByNode&>(*part.model);
    layout_ = model.followed();
    const std::string model_format = layout_.format;
    layout_.format = format_named(path.extension().string());
    choose_channels(part.changes);
    choose_type(part.changes);
    layout_.lossy_compression = layout_.format == "jpeg" ? "jpeg" : "";
    layout_.has_compression_level = layout_.format == "png";
    if (part.changes.compression_level) level_ = *part.changes.compression_level;
    if (layout_.format == "png") choose_chunks(model, model_format, part.changes);
    pixels_.width = static_cast<std::size_t>(layout_.width);
    pixels_.height = static_cast<std::size_t>(layout_.height);
    pixels_.channels = layout_.channels.size();
    pixels_.type = layout_.channels.front().type;
    pixels_.bytes.resize(pixels_.width * pixels_.height * pixels_.texel_bytes());
  }

  const std::filesystem::path& path() const noexcept override { return file_.path(); }
  const ImageLayout& layout() const noexcept override { return layout_; }
  int level_count(int) const noexcept override { return 1; }
  ImageLayout layout(int) const override { return layout_; }
  void select(int, int) override {}
  void write_rows(int first_row, int row_count, const std::byte* texels) override {
    const std::size_t row = layout_.row_bytes();
    std::memcpy(pixels_.bytes.data() + static_cast<std::size_t>(first_row) * row, texels,
                static_cast<std::size_t>(row_count) * row);
  }
  void finish() override {
    const int setting = layout_.format == "jpeg" ? kBestQuality : level_;
    std::string bytes = encoded(layout_.format, pixels_, setting, path().string());
    pixels_.bytes = {};
    if (layout_.format == "png") {
      std::string before, after;
      for (const PngChunk& chunk : chunks_) (chunk.name == "tEXt" ? after : before) += chunk_text(chunk);
      bytes.insert(kPngHeader, before + after);
    }
    file_.add(bytes);
    finished_ = file_.finish();
  }
  const std::filesystem::path& finished_file() const noexcept override { return finished_; }
  void commit(Flush flush) override { file_.commit(flush); }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw output_error(path().string() + ": " + what); }

  std::string format_named(const std::string& extension) const {
    if (extension == ".png") return "png";
    if (extension == ".jpg" || extension == ".jpeg") return "jpeg";
    if (extension == ".tif" || extension == ".tiff") return "tiff";
    if (extension == ".exr")
      fail("EXR is not written by " REMAP_IMAGE_HOST
           " (use --format png, or the Debian or the Python package)");
    fail("unknown image format (use .png, .tif or .jpg)");
  }

  void choose_channels(const ImageChanges& changes) {
    std::vector<std::string> names;
    for (const Channel& channel : layout_.channels) names.push_back(channel.name);
    if (changes.channels) names = *changes.channels;
    const bool has_alpha = std::ranges::find(names, "A") != names.end();
    const std::size_t colors = names.size() - (has_alpha ? 1 : 0);
    if ((colors != 1 && colors != 3) || (has_alpha && layout_.format == "jpeg"))
      fail("format " + layout_.format + " cannot hold the " + std::to_string(names.size()) +
           " channels of the source");
    set_channels(layout_, names, layout_.channels.front().type);
  }

  void choose_type(const ImageChanges& changes) {
    const PixelType type = changes.type.value_or(layout_.channels.front().type);
    const PixelType stored =
        type == PixelType::kUint8 || layout_.format == "jpeg" ? PixelType::kUint8 : PixelType::kUint16;
    if (changes.type && stored != type)
      fail("format " + layout_.format + " cannot hold " + name_of_type(type) + " pixels (use --type " +
           name_of_type(stored) + ")");
    for (std::size_t c = 0; c < layout_.channels.size(); ++c)
      layout_.channels[c] = {layout_.channels[c].name, stored, c * byte_count(stored)};
    layout_.texel_bytes = layout_.channels.size() * byte_count(stored);
  }

  // Keeps the tags of the file that the image follows, and adds the color tags that the programs choose. Data
  // gets no color tag.
  void choose_chunks(const StoredByNode& model, const std::string& model_format,
                     const ImageChanges& changes) {
    const bool follows = model_format == "png" && !changes.channels;
    const Transfer transfer =
        changes.colors ? changes.colors->of(layout_.channels.front().type) : Transfer::kLinear;
    const bool keeps = follows && changes.colors && transfer == changes.colors->followed;
    const bool is_srgb =
        keeps ? find_chunk(model.chunks(), "sRGB") != nullptr : changes.colors && transfer == Transfer::kSrgb;
    if (is_srgb)
      chunks_ = srgb_chunks();
    else if (changes.colors && !keeps)
      chunks_.push_back({"gAMA", big_endian(kLinearGamma)});
    for (const PngChunk& chunk : model.chunks()) {
      const bool is_replaced =
          chunk.name == "tEXt" && std::ranges::any_of(changes.metadata, [&](const auto& own) {
            return chunk.data.starts_with(own.first + '\0');
          });
      if ((chunk.name == "gAMA" && keeps && !is_srgb) || chunk.name == "pHYs" ||
          (chunk.name == "tEXt" && !is_replaced))
        chunks_.push_back(chunk);
    }
    for (const auto& [name, value] : changes.metadata) chunks_.push_back({"tEXt", name + '\0' + value});
  }

  NewFile file_;
  std::filesystem::path finished_;
  ImageLayout layout_;
  std::vector<PngChunk> chunks_;
  ImagePixels pixels_;
  int level_ = kLevelOfNewPng;
};

class NodeCodec final : public ImageCodec {
 public:
  ImagePixels decode(std::string_view bytes, const std::string& context) const override {
    if (format_of(bytes).empty()) throw input_error(context + ": " + refusal_of(bytes));
    return decoded(bytes, context);
  }
  std::string encode_png(const ImagePixels& pixels, int level) const override {
    return encoded("png", pixels, level, "png image");
  }
  std::string encode_jpeg(const ImagePixels& pixels, int quality) const override {
    return encoded("jpeg", pixels, quality, "jpg image");
  }
};

class NodeImages final : public ImageLibrary {
 public:
  void set_limits(int, std::uint64_t) const override {}
  std::unique_ptr<StoredImage> open(const std::filesystem::path& path, int part) const override {
    return std::make_unique<StoredByNode>(path, part);
  }
  std::unique_ptr<NewImage> create(const std::filesystem::path& path,
                                   const std::vector<NewPart>& parts) const override {
    if (parts.size() > 1)
      throw output_error(path.string() + ": cannot hold " + std::to_string(parts.size()) + " parts");
    return std::make_unique<NewByNode>(path, parts.front());
  }
  const ImageCodec& codec() const override { return codec_; }

  // Only remapc needs these.
  Picture read_picture(const std::filesystem::path& path) const override { refuse(path); }
  void write_exr(const std::filesystem::path& path, const Picture&,
                 const std::map<std::string, std::string>&) const override {
    refuse(path);
  }
  void write_png(const std::filesystem::path& path, const Picture&) const override { refuse(path); }
  std::string png_bytes(const Picture&) const override { refuse("picture"); }

 private:
  [[noreturn]] static void refuse(const std::filesystem::path& path) {
    throw input_error(path.string() + ": only remapc reads and writes whole pictures");
  }
  NodeCodec codec_;
};

}  // namespace
}  // namespace remap::node

namespace remap {

const ImageLibrary& load_image_library() {
  static const node::NodeImages images;
  return images;
}

}  // namespace remap
