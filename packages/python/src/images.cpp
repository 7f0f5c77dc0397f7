#include "images.hpp"

#include <atomic>
#include <cstring>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <utility>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "texture/image_library.hpp"

namespace nb = nanobind;

namespace remap::python {
namespace {

namespace fs = std::filesystem;

// A Held is an object of Python in C++, which any thread may destroy.
class Held {
 public:
  explicit Held(nb::object object) : object_(new nb::object(std::move(object))) {}
  ~Held() {
    const nb::gil_scoped_acquire lock;
    delete object_;
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  const nb::object& operator*() const noexcept { return *object_; }
  const nb::object* operator->() const noexcept { return object_; }

 private:
  nb::object* object_;
};

// Calls Python with the interpreter lock. An exception there becomes an Error of `kind`.
template <typename Work>
auto in_python(ErrorKind kind, Work work) {
  const nb::gil_scoped_acquire lock;
  try {
    return work();
  } catch (nb::python_error& raised) {
    throw Error(kind, nb::cast<std::string>(nb::str(raised.value())));
  } catch (const nb::cast_error&) {
    throw Error(kind, "the images of Python: an answer has the wrong type");
  }
}

PixelType type_named(const std::string& name) {
  if (const auto type = value_named(kPixelTypes, name)) return *type;
  throw input_error("unknown pixel type '" + name + "'");
}
std::string name_of_type(PixelType type) { return std::string(name_of(kPixelTypes, type)); }

ImageLayout layout_from(const nb::handle& given) {
  const auto number = [&](const char* name) { return nb::cast<int>(given[name]); };
  ImageLayout layout;
  layout.width = number("width");
  layout.height = number("height");
  layout.x = number("x");
  layout.y = number("y");
  layout.alpha_channel = number("alpha_channel");
  layout.tile_height = number("tile_height");
  layout.format = nb::cast<std::string>(given["format"]);
  layout.lossy_compression = nb::cast<std::string>(given["lossy_compression"]);
  layout.has_compression_level = nb::cast<bool>(given["has_compression_level"]);
  const auto transfer = nb::cast<std::optional<std::string>>(given["tagged_transfer"]);
  if (transfer) layout.tagged_transfer = value_named(kTransfers, *transfer);
  for (const auto& [name, type] :
       nb::cast<std::vector<std::pair<std::string, std::string>>>(given["channels"])) {
    layout.channels.push_back({name, type_named(type), layout.texel_bytes});
    layout.texel_bytes += byte_count(layout.channels.back().type);
  }
  return layout;
}

// Python gets copies, because an object may keep them longer than the memory of C++ lives.
nb::object copy_of(const void* bytes, std::size_t count) {
  PyObject* const copy =
      PyBytes_FromStringAndSize(static_cast<const char*>(bytes), static_cast<Py_ssize_t>(count));
  if (copy == nullptr) throw nb::python_error();
  return nb::steal(copy);
}

class ReadByPython : public StoredImage {
 public:
  explicit ReadByPython(nb::object image) : image_(std::move(image)) { hold_layout(); }
  const ImageLayout& layout() const noexcept override { return layout_; }
  std::string part_name() const override { return word("part_name"); }
  int part_count() const noexcept override { return part_count_; }
  int level_count() const noexcept override { return level_count_; }
  void select_level(int level) override {
    in_python(ErrorKind::kInput, [&] {
      image_->attr("select_level")(level);
      hold_layout();
    });
  }
  void set_followed_size(int width, int height) override {
    in_python(ErrorKind::kInput, [&] { image_->attr("set_followed_size")(width, height); });
  }
  void read_rows(int first_row, int row_count, std::byte* texels) override {
    in_python(ErrorKind::kInput, [&] {
      const std::size_t size = static_cast<std::size_t>(row_count) * layout_.row_bytes();
      nb::bytearray rows;
      rows.resize(size);
      image_->attr("read_rows")(first_row, row_count, rows);
      if (rows.size() != size) throw input_error("the images of Python: an answer has the wrong size");
      std::memcpy(texels, rows.data(), size);
    });
  }
  std::optional<std::string> noted_metadata(const std::string& name) const override {
    return in_python(ErrorKind::kInput, [&] {
      return nb::cast<std::optional<std::string>>(image_->attr("noted_metadata")(name));
    });
  }
  const nb::object& object() const { return *image_; }

 private:
  std::string word(const char* name) const {
    return in_python(ErrorKind::kInput, [&] { return nb::cast<std::string>(image_->attr(name)); });
  }
  void hold_layout() {
    layout_ = layout_from(image_->attr("layout")());
    part_count_ = nb::cast<int>(image_->attr("part_count"));
    level_count_ = nb::cast<int>(image_->attr("level_count"));
  }

  Held image_;
  ImageLayout layout_;
  int part_count_ = 1, level_count_ = 1;
};

nb::dict changes_of(const ImageChanges& changes) {
  nb::dict given;
  given["type"] = changes.type ? nb::object(nb::cast(name_of_type(*changes.type))) : nb::none();
  given["channels"] = nb::cast(changes.channels);
  given["is_color"] = changes.colors.has_value();
  // Pass the curves of integers and of other types, and the one that is followed.
  if (changes.colors) {
    given["transfer_of_whole"] = std::string(name_of(kTransfers, changes.colors->of(PixelType::kUint8)));
    given["transfer_of_floats"] = std::string(name_of(kTransfers, changes.colors->of(PixelType::kFloat)));
    const auto& followed = changes.colors->followed;
    given["followed_transfer"] =
        followed ? nb::object(nb::cast(std::string(name_of(kTransfers, *followed)))) : nb::none();
  }
  given["compression_level"] = nb::cast(changes.compression_level);
  given["metadata"] = nb::cast(changes.metadata);
  return given;
}

class WrittenByPython : public NewImage {
 public:
  WrittenByPython(const nb::object& images, const fs::path& path, const std::vector<NewPart>& parts)
      : path_(path), unfinished_(unfinished_name(path)), image_(made(images, parts)) {
    for (int part = 0; part < static_cast<int>(parts.size()); ++part) {
      const int levels = nb::cast<int>(image_->attr("level_count")(part));
      std::vector<ImageLayout>& of_part = layouts_.emplace_back();
      for (int level = 0; level < levels; ++level)
        of_part.push_back(layout_from(image_->attr("layout")(part, level)));
    }
  }
  ~WrittenByPython() override {
    if (is_committed_) return;
    try {
      in_python(ErrorKind::kOutput, [&] { image_->attr("abandon")(); });
    } catch (const Error&) {
      // The file is still removed.
    }
    std::error_code ignored;
    fs::remove(unfinished_, ignored);
  }
  const fs::path& path() const noexcept override { return path_; }
  const ImageLayout& layout() const noexcept override {
    return layouts_[static_cast<std::size_t>(part_)][static_cast<std::size_t>(level_)];
  }
  int level_count(int part) const noexcept override {
    return static_cast<int>(layouts_[static_cast<std::size_t>(part)].size());
  }
  ImageLayout layout(int part) const override { return layouts_[static_cast<std::size_t>(part)].front(); }
  void select(int part, int level) override {
    part_ = part;
    level_ = level;
    in_python(ErrorKind::kOutput, [&] { image_->attr("select")(part, level); });
  }
  void write_rows(int first_row, int row_count, const std::byte* texels) override {
    in_python(ErrorKind::kOutput, [&] {
      image_->attr("write_rows")(first_row, row_count,
                                 copy_of(texels, static_cast<std::size_t>(row_count) * layout().row_bytes()));
    });
  }
  void finish() override {
    in_python(ErrorKind::kOutput, [&] { image_->attr("finish")(); });
  }
  const fs::path& finished_file() const noexcept override { return unfinished_; }
  void commit(Flush flush) override {
    commit_file(unfinished_, path_, flush);
    is_committed_ = true;
  }

 private:
  nb::object made(const nb::object& images, const std::vector<NewPart>& parts) const {
    nb::list given;
    for (const NewPart& part : parts)
      given.append(
          nb::make_tuple(static_cast<const ReadByPython*>(part.model)->object(), changes_of(part.changes)));
    return images.attr("create")(path_.string(), unfinished_.string(), given);
  }

  fs::path path_, unfinished_;
  Held image_;
  std::vector<std::vector<ImageLayout>> layouts_;  // of every level of every part
  int part_ = 0, level_ = 0;
  bool is_committed_ = false;
};

class PythonCodec : public ImageCodec {
 public:
  explicit PythonCodec(const nb::object& images) : images_(images) {}

  ImagePixels decode(std::string_view bytes, const std::string& context) const override {
    return in_python(ErrorKind::kInput, [&] {
      const nb::object answer = images_->attr("decode")(copy_of(bytes.data(), bytes.size()), context);
      const auto [width, height, channels, type, texels] =
          nb::cast<std::tuple<std::size_t, std::size_t, std::size_t, std::string, nb::bytes>>(answer);
      ImagePixels pixels;
      pixels.width = width;
      pixels.height = height;
      pixels.channels = channels;
      pixels.type = type_named(type);
      const auto* const first = static_cast<const std::byte*>(texels.data());
      pixels.bytes.assign(first, first + texels.size());
      if (pixels.bytes.size() != width * height * pixels.texel_bytes())
        throw input_error(context + ": decodes to " + std::to_string(texels.size()) + " bytes");
      return pixels;
    });
  }
  std::string encode_png(const ImagePixels& pixels, int level) const override {
    return encoded(pixels, "encode_png", level);
  }
  std::string encode_jpeg(const ImagePixels& pixels, int quality) const override {
    return encoded(pixels, "encode_jpeg", quality);
  }

 private:
  std::string encoded(const ImagePixels& pixels, const char* method, int setting) const {
    return in_python(ErrorKind::kOutput, [&] {
      const nb::object bytes =
          images_->attr(method)(pixels.width, pixels.height, pixels.channels, name_of_type(pixels.type),
                                copy_of(pixels.bytes.data(), pixels.bytes.size()), setting);
      const auto text = nb::cast<nb::bytes>(bytes);
      return std::string(text.c_str(), text.size());
    });
  }

  Held images_;
};

// A PythonImages lives as long as the process, because the interpreter may end before static objects are
// destroyed.
class PythonImages : public ImageLibrary {
 public:
  explicit PythonImages(const nb::object& images) : images_(images), codec_(images) {}
  // Does nothing, because the objects in Python have their own limits for memory (images.py).
  void set_limits(int threads, std::uint64_t) const override {
    if (threads > 0) in_python(ErrorKind::kInput, [&] { images_->attr("set_thread_count")(threads); });
  }
  std::unique_ptr<StoredImage> open(const fs::path& path, int part) const override {
    return in_python(ErrorKind::kInput, [&] {
      return std::make_unique<ReadByPython>(images_->attr("open")(path.string(), part));
    });
  }
  std::unique_ptr<NewImage> create(const fs::path& path, const std::vector<NewPart>& parts) const override {
    return in_python(ErrorKind::kOutput,
                     [&] { return std::make_unique<WrittenByPython>(*images_, path, parts); });
  }
  const ImageCodec& codec() const override { return codec_; }

  // Only remapc needs these.
  Picture read_picture(const fs::path& path) const override { return refuse(path); }
  void write_exr(const fs::path& path, const Picture&,
                 const std::map<std::string, std::string>&) const override {
    refuse(path);
  }
  void write_png(const fs::path& path, const Picture&) const override { refuse(path); }
  std::string png_bytes(const Picture&) const override {
    refuse("picture");
    return {};
  }

 private:
  static Picture refuse(const fs::path& path) {
    throw input_error(path.string() + ": only remapc reads and writes whole pictures");
  }

  Held images_;
  PythonCodec codec_;
};

std::atomic<const PythonImages*> used = nullptr;

}  // namespace

void use_images(const nb::object& images) { used = new PythonImages(images); }

}  // namespace remap::python

namespace remap {

const ImageLibrary& load_image_library() {
  if (python::used == nullptr) {
    const nb::gil_scoped_acquire lock;
    try {
      python::use_images(nb::module_::import_("texremap.images").attr("Images")());
    } catch (nb::python_error& raised) {
      throw input_error(nb::cast<std::string>(nb::str(raised.value())));
    }
  }
  return *python::used;
}

}  // namespace remap
