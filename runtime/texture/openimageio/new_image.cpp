// This file writes images, and checks that they are complete.
#include <algorithm>
#include <cerrno>
#include <cstdio>

#include <OpenImageIO/filesystem.h>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/system.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// A CheckedFile remembers the first write that fails, because some encoders ignore failures (libpng) or end
// the process (libjpeg). It reports success to the encoder. Then the code that writes bands checks for a
// failure after each band.
class CheckedFile : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedFile(const NewFile& file)
      : IOProxy(file.unfinished().string(), Write), file_(file.stream()) {}

  const char* proxytype() const override { return "checked"; }
  std::int64_t tell() override { return static_cast<std::int64_t>(::ftello(file_)); }
  bool seek(std::int64_t offset) override {
    if (::fseeko(file_, static_cast<off_t>(offset), SEEK_SET) != 0) note_failure();
    return true;
  }
  std::size_t write(const void* buffer, std::size_t size) override {
    if (size > 0 && std::fwrite(buffer, 1, size, file_) != size) note_failure();
    end_ = std::max(end_, tell());
    return size;
  }
  std::size_t size() const override { return static_cast<std::size_t>(end_); }  // encoders write footers here
  void flush() const override { std::fflush(file_); }

  // Returns the errno of the first failure, or 0.
  int failure() const noexcept { return failure_; }

 private:
  void note_failure() {
    if (failure_ == 0) failure_ = errno;
  }
  std::FILE* file_;
  std::int64_t end_ = 0;
  int failure_ = 0;
};

bool same_storage(const ImageLayout& a, const ImageLayout& b) {
  return a.width == b.width && a.height == b.height && same_pixel_types(a, b);
}

class OpenedNewImage : public NewImage {
 public:
  OpenedNewImage(const fs::path& path, const std::vector<NewPart>& parts) : path_(path) { plan(parts); }

  const fs::path& path() const noexcept override { return path_; }
  const ImageLayout& layout() const noexcept override { return layout_; }
  int level_count(int part) const noexcept override {
    return static_cast<int>(specs_[static_cast<std::size_t>(part)].size());
  }
  ImageLayout layout(int part) const override {
    return layout_of(specs_[static_cast<std::size_t>(part)].front(), format_, path_);
  }
  void select(int part, int level) override;
  void write_rows(int first_row, int row_count, const std::byte* texels) override;
  void finish() override;
  const fs::path& finished_file() const noexcept override { return file_->unfinished(); }
  std::shared_ptr<const InputFile> content() const override { return file_->content(); }
  void flush_to_disk() const override { file_->flush_to_disk(); }
  void commit(Flush flush) override { file_->commit(flush); }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw output_error(path_.string() + ": " + what); }
  const OIIO::ImageSpec& spec() const {
    return specs_[static_cast<std::size_t>(part_)][static_cast<std::size_t>(level_)];
  }
  // Returns the name by which an encoder without streams opens the file. If possible, the name means the open
  // descriptor, because another user of the folder could replace the file.
  std::string open_name() const {
    std::string name = "/proc/self/fd/" + std::to_string(descriptor_of(file_->stream()));
    std::error_code ignored;
    return fs::exists(name, ignored) ? name : finished_file().string();
  }
  // Replaces the temporary name in an encoder's message by the name of the file.
  std::string in_words(std::string message) const {
    const std::string name = open_name();
    for (std::size_t at = message.find(name); at != std::string::npos; at = message.find(name, at))
      message.replace(at, name.size(), path_.filename().string());
    return with_final_name(std::move(message), finished_file(), path_);
  }
  void plan(const std::vector<NewPart>& parts);
  void open();
  void open_plane();
  void check_file() const;
  void check(bool done) const;
  void check_finished() const;

  fs::path path_;
  std::unique_ptr<NewFile> file_;
  std::unique_ptr<CheckedFile> proxy_;
  std::unique_ptr<OIIO::ImageOutput> output_;  // declared after `proxy_`, which it uses until its destructor
  std::vector<std::vector<OIIO::ImageSpec>> specs_;  // specs of every level and part
  int part_ = 0;
  int level_ = 0;
  std::string format_;  // name in OpenImageIO
  ImageLayout layout_;  // layout of the selected plane
  bool is_open_ = false;
  bool plane_is_open_ = false;
};

// Prepares everything except the encoder. The encoder is opened later, because libpng prints errors if it
// gets no texels.
void OpenedNewImage::plan(const std::vector<NewPart>& parts) {
  output_ = OIIO::ImageOutput::create(path_.string());
  if (!output_) {
    (void)OIIO::geterror();
    fail("unknown image format (use .exr, .tif, .png, ...)");
  }
  if (parts.size() > 1 && !output_->supports("multiimage"))
    fail(std::string("format ") + output_->format_name() + " cannot hold " + std::to_string(parts.size()) +
         " parts (use --format exr or --format tif)");
  const std::string model_format = parts.front().model->layout().format;
  for (const NewPart& part : parts) {
    std::vector<OIIO::ImageSpec>& levels = specs_.emplace_back();
    for (const OIIO::ImageSpec& model : followed_levels(*part.model)) {
      levels.push_back(output_spec(model, model_format, *output_, part.changes, path_));
      // TIFF has no mip levels. Textures in TIFF store levels as parts, and programs treat these parts as
      // levels.
      const bool has_levels =
          output_->supports("mipmap") ||
          (model_format == output_->format_name() && output_->supports("multiimage") && parts.size() == 1);
      if (levels.back().tile_width == 0 || !has_levels) break;
    }
  }
  format_ = output_->format_name();
  layout_ = layout_of(spec(), format_, path_);
  file_ = std::make_unique<NewFile>(path_);
  proxy_ = std::make_unique<CheckedFile>(*file_);
}

void OpenedNewImage::open() {
  // With a proxy, the TIFF writer of OpenImageIO 2.4 loses the directory of a file with Exif data. So it
  // opens TIFF files by name. It then reports write failures itself, except for the last bytes, which
  // check_finished() checks.
  if (layout_.format != "tiff") output_->set_ioproxy(proxy_.get());
  if (specs_.size() > 1 && layout_.format == "openexr") {  // OpenEXR needs the specs of all parts at once
    std::vector<OIIO::ImageSpec> firsts;
    for (const auto& levels : specs_) firsts.push_back(levels.front());
    check(output_->open(open_name(), static_cast<int>(firsts.size()), firsts.data()));
  } else {
    check(output_->open(open_name(), spec()));
  }
  is_open_ = true;
}

void OpenedNewImage::open_plane() {
  if (!is_open_)
    open();
  else
    check(output_->open(open_name(), spec(),
                        level_ > 0 && output_->supports("mipmap") ? OIIO::ImageOutput::AppendMIPLevel
                                                                  : OIIO::ImageOutput::AppendSubimage));
  if (!same_storage(layout_of(output_->spec(), output_->format_name(), path_), layout_))
    fail("cannot be written: format " + layout_.format + " would change the pixel type (use exr or tif)");
  plane_is_open_ = true;
}

// Throws if the system refused a write.
void OpenedNewImage::check_file() const {
  if (proxy_->failure() != 0)
    throw system_error(ErrorKind::kOutput, path_.string() + ": cannot be written", proxy_->failure());
}

// Throws if the system refused a write, or if OpenImageIO failed.
void OpenedNewImage::check(bool done) const {
  const std::string message = output_ ? output_->geterror() : "";
  check_file();
  if (!done) fail("cannot be written: " + in_words(first_line(message, "unknown reason")));
}

// Reads the header of the finished file. In TIFF, also reads its last rows.
void OpenedNewImage::check_finished() const {
  try {
    const auto image = open_image(content(), part_);
    image->select_level(level_);
    if (!same_storage(image->layout(), layout_)) fail("was written, but reads back as a different image");
    if (layout_.format != "tiff") return;
    const int unit = std::max(layout_.tile_height, 1), first = (layout_.height - 1) / unit * unit;
    const int row_count = layout_.height - first;
    std::vector<std::byte> rows(static_cast<std::size_t>(row_count) * layout_.row_bytes());
    image->read_rows(first, row_count, rows.data());
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kOutput) throw;
    fail("cannot be written completely (check the free space)");
  }
}

void OpenedNewImage::select(int part, int level) {
  part_ = part;
  level_ = level;
  plane_is_open_ = false;
  layout_ = layout_of(spec(), format_, path_);
}

void OpenedNewImage::write_rows(int first_row, int row_count, const std::byte* texels) {
  if (!plane_is_open_) open_plane();
  const OIIO::ImageSpec& plane = spec();
  const int begin = plane.y + first_row, end = begin + row_count;
  check(plane.tile_width > 0 ? output_->write_tiles(plane.x, plane.x + plane.width, begin, end, plane.z,
                                                    plane.z + 1, native_type(plane), texels)
                             : output_->write_scanlines(begin, end, plane.z, native_type(plane), texels));
}

void OpenedNewImage::finish() {
  const bool closed = output_->close();
  check(closed);
  output_.reset();  // the EXR writer closes files with mip levels only when it is destroyed
  check(true);
  file_->finish();
  check_finished();
}

}  // namespace

std::unique_ptr<NewImage> create_image(const fs::path& path, const std::vector<NewPart>& parts) {
  return std::make_unique<OpenedNewImage>(path, parts);
}

}  // namespace remap
