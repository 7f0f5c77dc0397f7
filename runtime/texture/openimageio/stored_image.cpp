// This file reads images, band by band.
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/plain_text.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// Returns the name of a lossy compression, or an empty text for a lossless one.
std::string lossy_compression(const OIIO::ImageSpec& spec, const std::string& format) {
  if (format == "jpeg" || format == "hdr" || format == "webp") return format;
  const std::string compression = spec.get_string_attribute("Compression");
  for (const std::string_view lossy : {"dwaa", "dwab", "b44", "pxr24", "jpeg"}) {
    if (compression.starts_with(lossy)) return compression.substr(0, compression.find(':'));
  }
  return "";
}

// Returns false if OpenImageIO only assumed sRGB, as it does in these formats if the file states no color
// space.
bool tells_color_space(const OIIO::ImageSpec& spec, const std::string& format, const ImageHead& head) {
  if (format == "png")
    return std::ranges::any_of(head.png_chunks,
                               [](const std::string& name) { return name == "sRGB" || name == "gAMA"; });
  if (format == "jpeg" || format == "tiff") return spec.get_int_attribute("Exif:ColorSpace") == 1;
  return format != "webp";  // WebP cannot state a color space
}

// No material has so many maps. For every part, the headers of all parts are read, which costs memory and
// time.
constexpr int kMostParts = 128;

// Treats gamma curves as sRGB, because the usual gamma of 2.2 is close to it.
std::optional<Transfer> tagged_transfer(const OIIO::ImageSpec& spec) {
  if (const auto noted = noted_metadata(spec, kNotedColorSpace)) return value_named(kTransfers, *noted);
  const std::string color_space = spec.get_string_attribute("oiio:ColorSpace");
  if (color_space.empty()) return std::nullopt;
  const bool is_linear = OIIO::Strutil::iequals(color_space, "linear");
  return is_linear ? Transfer::kLinear : Transfer::kSrgb;
}

}  // namespace

std::optional<PixelType> pixel_type(OIIO::TypeDesc type) {
  return type.is_array() ? std::nullopt : value_named(kPixelTypes, type.c_str());
}

std::string first_line(const std::string& text, const std::string& otherwise) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? otherwise : plain(line);
}

OIIO::TypeDesc native_type(const OIIO::ImageSpec& spec) {
  return spec.channelformats.empty() ? spec.format : OIIO::TypeDesc(OIIO::TypeUnknown);
}

bool has_compression_level(const OIIO::ImageSpec& spec, const std::string& format) {
  if (format == "png") return true;
  const std::string compression = spec.get_string_attribute("Compression", "zip");
  return (format == "openexr" || format == "tiff") &&
         (compression == "zip" || compression.starts_with("zip:"));
}

ImageLayout layout_of(const OIIO::ImageSpec& spec, const std::string& format, const fs::path& path) {
  ImageLayout layout;
  layout.width = spec.width;
  layout.height = spec.height;
  layout.x = spec.x;
  layout.y = spec.y;
  layout.alpha_channel = spec.alpha_channel;
  layout.tile_height = spec.tile_width > 0 ? spec.tile_height : 0;
  layout.format = format;
  layout.lossy_compression = lossy_compression(spec, format);
  layout.has_compression_level = has_compression_level(spec, format);
  layout.tagged_transfer = tagged_transfer(spec);
  for (int c = 0; c < spec.nchannels; ++c) {
    const std::string name = spec.channel_name(c);
    const auto type = pixel_type(spec.channelformat(c));
    if (!type)
      throw input_error(path.string() + ": channel " + name + " has the unsupported type " +
                        spec.channelformat(c).c_str() +
                        " (use integers of up to 32 bits, half, float or double)");
    layout.channels.push_back({name, *type, layout.texel_bytes});
    layout.texel_bytes += byte_count(*type);
  }
  return layout;
}

namespace {

// A FileStream is an open file as a stream with its own position. Several threads may read one file.
struct FileStream {
  explicit FileStream(const InputFile& source) : file(source), stream(opened(this), std::fclose) {}
  static std::FILE* opened(FileStream* cookie);

  const InputFile& file;
  std::uintmax_t place = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream;
};

::ssize_t read_from(void* cookie, char* bytes, std::size_t size) try {
  auto& stream = *static_cast<FileStream*>(cookie);
  const std::size_t count = stream.file.read(stream.place, bytes, size);
  stream.place += count;
  return static_cast<::ssize_t>(count);
} catch (const Error& error) {  // an exception must not pass through C code
  errno = error.system_code();
  return -1;
}

int seek_in(void* cookie, ::off64_t* offset, int whence) {
  auto& stream = *static_cast<FileStream*>(cookie);
  const std::uintmax_t from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? stream.place : stream.file.size();
  const ::off64_t place = static_cast<::off64_t>(from) + *offset;
  if (place < 0) {
    errno = EINVAL;
    return -1;
  }
  stream.place = static_cast<std::uintmax_t>(place);
  *offset = place;
  return 0;
}

std::FILE* FileStream::opened(FileStream* cookie) {
  std::FILE* const stream = ::fopencookie(cookie, "rb", {read_from, nullptr, seek_in, nullptr});
  if (stream == nullptr) throw std::bad_alloc();
  return stream;
}

// A StreamProxy gives an open file to those parts of OpenImageIO that accept only C streams.
class StreamProxy : public OIIO::Filesystem::IOFile {
 public:
  explicit StreamProxy(const FileStream& source) : IOFile(source.stream.get(), Read), source_(source) {}

  std::size_t pread(void* bytes, std::size_t size, std::int64_t place) override try {
    return source_.file.read(static_cast<std::uintmax_t>(place), static_cast<char*>(bytes), size);
  } catch (const Error& error) {
    errno = error.system_code();
    return 0;
  }

 private:
  const FileStream& source_;
};

// Returns true if OpenImageIO opens a file of this format again, by its name, to go back to an earlier row.
bool starts_again(const ImageLayout& layout) {
  constexpr std::array<std::string_view, 4> kFormats = {"hdr", "jpeg", "png", "tiff"};
  return layout.tile_height == 0 && contains(kFormats, layout.format);
}

class OpenedImage : public StoredImage {
 public:
  OpenedImage(const std::shared_ptr<const InputFile>& file, int part)
      : file_(file),
        bytes_{file->size(),
               [file = file.get()](std::uint64_t place, char* bytes, std::size_t count) {
                 return file->read(place, bytes, count);
               }},
        stream_(*file),
        proxy_(stream_),
        part_(part) {
    open();
  }

  const ImageLayout& layout() const noexcept override { return layout_; }
  std::string part_name() const override { return levels_.front().get_string_attribute("oiio:subimagename"); }
  int part_count() const noexcept override { return part_count_; }
  int level_count() const noexcept override { return static_cast<int>(levels_.size()); }
  void select_level(int level) override;
  void set_followed_size(int width, int height) override;
  void read_rows(int first_row, int row_count, std::byte* texels) override;
  std::optional<std::string> noted_metadata(const std::string& name) const override {
    return remap::noted_metadata(levels_.front(), name);
  }
  const std::vector<OIIO::ImageSpec>& levels() const noexcept { return levels_; }

 private:
  const OIIO::ImageSpec& spec() const { return levels_[static_cast<std::size_t>(level_)]; }
  void open();
  void open_input();
  void count_parts();
  void find_planes();
  void refuse_spoiled_webp();
  [[noreturn]] void fail(const std::string& what, int system_code = 0) const;

  const fs::path& path() const noexcept { return file_->path(); }

  std::shared_ptr<const InputFile> file_;
  ImageBytes bytes_;
  ImageHead head_;
  FileStream stream_;
  StreamProxy proxy_;
  std::unique_ptr<OIIO::ImageInput> input_;  // declared after `proxy_`, which it uses until its destructor
  int part_ = 0;
  int part_count_ = 0;
  int level_ = 0;
  int next_row_ = 0;                     // the row after the last one that was read
  std::vector<OIIO::ImageSpec> levels_;  // levels of the part, at the size for new images made from it
  ImageLayout layout_;                   // layout of `level_`, as stored
};

void OpenedImage::fail(const std::string& what, int system_code) const {
  throw Error(ErrorKind::kInput, path().string() + ": " + what, system_code);
}

void OpenedImage::open() {
  head_ = checked_head(bytes_, path().string());
  open_input();
  (void)input_->geterror();  // drops messages about unusual headers
  find_planes();
  for (const OIIO::ImageSpec& level : levels_) require_plausible(level, head_, bytes_, path().string());
  // Ignore a color space that OpenImageIO only assumed, and do not write it.
  if (!tells_color_space(spec(), input_->format_name(), head_))
    for (OIIO::ImageSpec& level_spec : levels_) level_spec.erase_attribute("oiio:ColorSpace");
  layout_ = layout_of(spec(), input_->format_name(), path());
  refuse_spoiled_webp();
}

// Opens the input from the start of the file, and tries only the format that the head shows.
void OpenedImage::open_input() {
  input_.reset();
  OIIO::ImageSpec hints, ignored;
  hints.attribute(kUnassociatedAlpha, 1);
  proxy_.seek(0);
  errno = 0;
  input_ = OIIO::ImageInput::create(head_.format, false);
  next_row_ = 0;
  if (input_ && input_->set_ioproxy(&proxy_) && input_->open(path().string(), ignored, hints)) return;
  if (is_transient(errno)) throw system_error(ErrorKind::kInput, path().string() + ": cannot be read", errno);
  std::string reason = input_ ? input_->geterror() : OIIO::geterror();
  if (reason.empty()) reason = OIIO::geterror();
  fail("cannot be read as an image: " + first_line(reason, "it is damaged"));
}

// Refuses WebP images with alpha below 1, because OpenImageIO 2.4 multiplies their colors by alpha in 8 bits.
void OpenedImage::refuse_spoiled_webp() {
  if (layout_.format != "webp" || layout_.alpha_channel < 0) return;
  std::vector<std::byte> row(layout_.row_bytes());
  const auto alpha = layout_.channels[static_cast<std::size_t>(layout_.alpha_channel)].offset;
  for (int y = 0; y < layout_.height; ++y) {
    read_rows(y, 1, row.data());
    for (std::size_t i = alpha; i < row.size(); i += layout_.texel_bytes)
      if (row[i] != std::byte{255})
        fail(
            "is WebP with alpha: OpenImageIO multiplies the colors by alpha when it reads them, so that they "
            "are lost (convert it to PNG: dwebp " +
            shell_word(path().string()) + " -o " +
            shell_word(fs::path(path()).replace_extension(".png").string()) + ")");
  }
}

void OpenedImage::count_parts() {
  // OpenImageIO reads nothing from a WebP file after a request for a missing frame. Only the first frame of
  // an animation is used.
  const int most_parts = std::string_view(input_->format_name()) == "webp" ? 1 : kMostParts;
  while (part_count_ < most_parts && input_->seek_subimage(part_count_, 0)) ++part_count_;
  if (part_count_ == kMostParts && input_->seek_subimage(part_count_, 0))
    fail("has more than " + std::to_string(kMostParts) + " parts, which is the limit (split the file)");
}

void OpenedImage::find_planes() {
  // For each part, OpenImageIO goes through all earlier parts of a TIFF file. If every part also counted all
  // parts, the time would grow with the cube of their number.
  if (part_ == 0 || part_ >= kMostParts || !input_->seek_subimage(part_, 0)) {
    count_parts();
    if (part_ >= part_count_)
      fail("part " + std::to_string(part_) + " not found (number of parts: " + std::to_string(part_count_) +
           ")");
  }
  (void)input_->geterror();
  for (int number = 0; input_->seek_subimage(part_, number); ++number) levels_.push_back(input_->spec());
  (void)input_->geterror();
  if (!input_->seek_subimage(part_, 0))
    fail("cannot be read: " + first_line(input_->geterror(), "no image in it"));
  if (spec().deep) fail("deep images are not supported");
  if (spec().depth > 1) fail("volumes are not supported");
  if (spec().width < 1 || spec().height < 1)  // possible in Targa and Radiance files
    fail("image is empty (" + std::to_string(spec().width) + "x" + std::to_string(spec().height) + ")");
}

void OpenedImage::select_level(int level) {
  if (level == level_) return;
  level_ = level;
  layout_ = layout_of(spec(), input_->format_name(), path());
}

void OpenedImage::set_followed_size(int width, int height) {
  if (level_count() > 1) fail("cannot be resampled, because it has mip levels");
  OIIO::ImageSpec& spec = levels_.front();
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height)
    fail(
        "cannot be resampled, because its data window differs from its display window (crop it: oiiotool OLD "
        "--croptofull -o NEW)");
  spec.width = spec.full_width = width;
  spec.height = spec.full_height = height;
}

void OpenedImage::read_rows(int first_row, int row_count, std::byte* texels) {
  const OIIO::ImageSpec& plane = spec();
  const int width = layout_.width;  // as stored in the file
  if (first_row < next_row_ && starts_again(layout_)) open_input();
  next_row_ = first_row + row_count;
  const int begin = plane.y + first_row, end = begin + row_count;
  errno = 0;
  const bool read = plane.tile_width > 0
                        ? input_->read_tiles(part_, level_, plane.x, plane.x + width, begin, end, plane.z,
                                             plane.z + 1, 0, plane.nchannels, native_type(plane), texels)
                        : input_->read_scanlines(part_, level_, begin, end, plane.z, 0, plane.nchannels,
                                                 native_type(plane), texels);
  // OpenImageIO reads truncated TIFF and JPEG files without failing. Only its message shows the error.
  const std::string message = input_->geterror();
  if (read && message.empty()) return;
  const std::string rows = "rows " + std::to_string(first_row) + " to " +
                           std::to_string(first_row + row_count - 1) + " cannot be read: ";
  if (is_transient(errno)) fail(rows + std::strerror(errno), errno);
  fail(rows + first_line(message, "unknown reason") + " (the file may be truncated)");
}

}  // namespace

std::unique_ptr<StoredImage> open_image(const std::shared_ptr<const InputFile>& file, int part) {
  return std::make_unique<OpenedImage>(file, part);
}

const std::vector<OIIO::ImageSpec>& followed_levels(const StoredImage& image) {
  return static_cast<const OpenedImage&>(image).levels();  // no other class implements StoredImage here
}

std::optional<std::string> noted_metadata(const OIIO::ImageSpec& spec, const std::string& name) {
  if (const std::string value = spec.get_string_attribute(name); !value.empty()) return value;
  const std::string software = spec.get_string_attribute("Software"), key = name + "=";
  const std::size_t begin = software.find(key);
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = software.find(';', begin);
  return software.substr(begin + key.size(), end == std::string::npos ? end : end - begin - key.size());
}

}  // namespace remap
