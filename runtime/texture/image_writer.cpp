// The writing half of image_io.hpp.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <OpenImageIO/filesystem.h>

#include "remap/error.hpp"
#include "system/files.hpp"
#include "texture/image_library.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// A file that remembers its first write failure, because some encoders ignore failures (libpng) or end the
// process (libjpeg). It reports success to the encoder; the writer checks for a failure after every band.
class CheckedFile : public OIIO::Filesystem::IOProxy {
 public:
  explicit CheckedFile(const fs::path& path)
      : IOProxy(path.string(), Write), file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) note_failure();
  }
  ~CheckedFile() override { close_file(); }
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  const char* proxytype() const override { return "checked"; }
  bool opened() const override { return file_ != nullptr; }
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
  std::size_t size() const override { return static_cast<std::size_t>(end_); }  // footers are written here
  void flush() const override { std::fflush(file_); }

  void close_file() {
    if (file_ != nullptr && std::fclose(file_) != 0) note_failure();
    file_ = nullptr;
  }
  // The reason of the first failure; empty without a failure.
  const std::string& failure() const noexcept { return failure_; }

 private:
  void note_failure() {
    if (failure_.empty()) failure_ = std::strerror(errno);
  }
  std::FILE* file_;
  std::int64_t end_ = 0;
  std::string failure_;
};

bool same_storage(const ImageLayout& a, const ImageLayout& b) {
  return a.width == b.width && a.height == b.height && same_pixel_types(a, b);
}

}  // namespace

struct ImageWriter::State {
  fs::path path;
  fs::path unfinished;
  std::unique_ptr<CheckedFile> file;
  std::unique_ptr<OIIO::ImageOutput> output;  // declared after `file`, which it uses until its destructor
  std::vector<std::vector<OIIO::ImageSpec>> specs;  // of every level of every part
  int part = 0;
  int level = 0;
  std::string format;  // name in OpenImageIO
  ImageLayout layout;  // of the selected plane
  bool is_open = false;
  bool plane_is_open = false;
  bool is_committed = false;

  ~State() {
    output.reset();
    file.reset();
    std::error_code ignored;
    if (!is_committed && !unfinished.empty()) fs::remove(unfinished, ignored);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorKind::kOutput, path.string() + ": " + what);
  }
  const OIIO::ImageSpec& spec() const {
    return specs[static_cast<std::size_t>(part)][static_cast<std::size_t>(level)];
  }
  void plan(const std::vector<std::vector<OIIO::ImageSpec>>& models, const std::string& model_format,
            const std::vector<ImagePart>& parts);
  void open();
  void open_plane();
  void check(bool done) const;
  void check_finished() const;
};

// Prepares everything without opening the encoder: libpng prints errors if it is opened and gets no texels.
void ImageWriter::State::plan(const std::vector<std::vector<OIIO::ImageSpec>>& models,
                              const std::string& model_format, const std::vector<ImagePart>& parts) {
  output = OIIO::ImageOutput::create(path.string());
  if (!output) {
    (void)OIIO::geterror();
    fail("unknown image format (use .exr, .tif, .png, ...)");
  }
  if (models.size() > 1 && !output->supports("multiimage"))
    fail(std::string("format ") + output->format_name() + " cannot hold " + std::to_string(models.size()) +
         " parts (use exr or tif)");
  for (std::size_t p = 0; p < models.size(); ++p) {
    specs.emplace_back();
    for (const OIIO::ImageSpec& model : models[p]) {
      specs[p].push_back(output_spec(model, model_format, *output, parts[p].changes, path));
      // TIFF has no mip levels. Textures store them as parts, which readers of textures treat as levels.
      const bool has_levels =
          output->supports("mipmap") ||
          (model_format == output->format_name() && output->supports("multiimage") && models.size() == 1);
      if (specs[p].back().tile_width == 0 || !has_levels) break;
    }
  }
  format = output->format_name();
  layout = layout_of(spec(), format, path);
  unfinished = unfinished_name(path);
  file = std::make_unique<CheckedFile>(unfinished);
  if (!file->failure().empty()) fail("cannot be written: " + file->failure());
}

void ImageWriter::State::open() {
  // With a proxy, the TIFF writer of OpenImageIO 2.4 loses the directory of a file with Exif data. Without
  // one it reports write failures itself, except for the last bytes, which `check_finished` checks.
  if (layout.format == "tiff")
    file->close_file();
  else
    output->set_ioproxy(file.get());
  if (specs.size() > 1 && layout.format == "openexr") {  // needs all parts at once
    std::vector<OIIO::ImageSpec> firsts;
    for (const auto& levels : specs) firsts.push_back(levels.front());
    check(output->open(unfinished.string(), static_cast<int>(firsts.size()), firsts.data()));
  } else {
    check(output->open(unfinished.string(), spec()));
  }
  is_open = true;
}

void ImageWriter::State::open_plane() {
  if (!is_open)
    open();
  else
    check(output->open(unfinished.string(), spec(),
                       level > 0 && output->supports("mipmap") ? OIIO::ImageOutput::AppendMIPLevel
                                                               : OIIO::ImageOutput::AppendSubimage));
  if (!same_storage(layout_of(output->spec(), output->format_name(), path), layout))
    fail("cannot be written: format " + layout.format + " would change the pixel type");
  plane_is_open = true;
}

// Throws if the system refused bytes or OpenImageIO failed.
void ImageWriter::State::check(bool done) const {
  const std::string message = output ? output->geterror() : "";
  if (!file->failure().empty()) fail("cannot be written: " + file->failure());
  if (!done)
    fail("cannot be written: " + with_final_name(first_line(message, "unknown reason"), unfinished, path));
}

// Reads the header of the closed file and, for TIFF, its last rows.
void ImageWriter::State::check_finished() const {
  try {
    ImageReader reader(unfinished, part);
    reader.select_level(level);
    if (!same_storage(reader.layout(), layout)) fail("was written, but reads back as a different image");
    if (layout.format != "tiff") return;
    const int unit = std::max(layout.tile_height, 1), first = (layout.height - 1) / unit * unit;
    const int row_count = layout.height - first;
    std::vector<std::byte> rows(static_cast<std::size_t>(row_count) * layout.row_bytes());
    reader.read_rows(first, row_count, rows.data());
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kOutput) throw;
    const std::string reason = std::string(error.what()).substr(unfinished.string().size());
    fail("cannot be written completely" + with_final_name(reason, unfinished, path));
  }
}

ImageWriter::ImageWriter(const fs::path& path, const std::vector<ImagePart>& parts)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  std::vector<std::vector<OIIO::ImageSpec>> models;
  for (const ImagePart& part : parts) models.push_back(part.model->state_->levels);
  state_->plan(models, parts.front().model->layout().format, parts);
}
ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;
ImageWriter& ImageWriter::operator=(ImageWriter&&) noexcept = default;

const fs::path& ImageWriter::path() const noexcept { return state_->path; }
const ImageLayout& ImageWriter::layout() const noexcept { return state_->layout; }

int ImageWriter::level_count(int part) const noexcept {
  return static_cast<int>(state_->specs[static_cast<std::size_t>(part)].size());
}

ImageLayout ImageWriter::layout(int part) const {
  return layout_of(state_->specs[static_cast<std::size_t>(part)].front(), state_->format, state_->path);
}

void ImageWriter::select(int part, int level) {
  state_->part = part;
  state_->level = level;
  state_->plane_is_open = false;
  state_->layout = layout_of(state_->spec(), state_->format, state_->path);
}

void ImageWriter::write_rows(int first_row, int row_count, const std::byte* texels) {
  if (!state_->plane_is_open) state_->open_plane();
  const OIIO::ImageSpec& spec = state_->spec();
  OIIO::ImageOutput& output = *state_->output;
  const int begin = spec.y + first_row, end = begin + row_count;
  state_->check(spec.tile_width > 0 ? output.write_tiles(spec.x, spec.x + spec.width, begin, end, spec.z,
                                                         spec.z + 1, native_type(spec), texels)
                                    : output.write_scanlines(begin, end, spec.z, native_type(spec), texels));
}

void ImageWriter::finish() {
  const bool closed = state_->output->close();
  state_->check(closed);
  state_->output.reset();  // the EXR writer keeps files with mip levels open until it is destroyed
  state_->file->close_file();
  state_->check(true);
  state_->check_finished();
}

const fs::path& ImageWriter::finished_file() const noexcept { return state_->unfinished; }

void ImageWriter::commit(Flush flush) {
  commit_file(state_->unfinished, state_->path, flush);
  state_->is_committed = true;
}

}  // namespace remap
