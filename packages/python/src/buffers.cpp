#include "buffers.hpp"

#include <optional>

#include "remap/error.hpp"

namespace remap::python {
namespace {

// Returns the type for a format of the module struct, in the order and sizes of this machine.
std::optional<PixelType> type_of(const std::string& format, Py_ssize_t size) {
  if (format.empty() || format.size() > 2) return std::nullopt;
  if (format.size() == 2 && format[0] != '@' && format[0] != '=' && format[0] != '<') return std::nullopt;
  const char letter = format.back();
  const std::string whole = "bhilq", natural = "BHILQ";
  if (letter == 'e' && size == 2) return PixelType::kHalf;
  if (letter == 'f' && size == 4) return PixelType::kFloat;
  if (letter == 'd' && size == 8) return PixelType::kDouble;
  const bool is_signed = whole.find(letter) != std::string::npos;
  if (!is_signed && natural.find(letter) == std::string::npos) return std::nullopt;
  if (size == 1) return is_signed ? PixelType::kInt8 : PixelType::kUint8;
  if (size == 2) return is_signed ? PixelType::kInt16 : PixelType::kUint16;
  if (size == 4) return is_signed ? PixelType::kInt32 : PixelType::kUint32;
  return std::nullopt;
}

}  // namespace

Buffer::Buffer(nanobind::handle object, Access access, const std::string& name) {
  auto view = std::make_unique<Py_buffer>();
  const int flags = access == Access::kWrite ? PyBUF_STRIDED | PyBUF_FORMAT : PyBUF_STRIDED_RO | PyBUF_FORMAT;
  if (PyObject_GetBuffer(object.ptr(), view.get(), flags) != 0) {
    PyErr_Clear();
    throw Error(ErrorKind::kUsage,
                name + (access == Access::kWrite ? ": cannot be written (give a writable array)"
                                                 : ": is not an array of numbers"));
  }
  view_ = std::shared_ptr<Py_buffer>(view.release(), [](Py_buffer* held) {
    PyBuffer_Release(held);
    delete held;
  });
  const std::string format = view_->format == nullptr ? "B" : view_->format;
  const auto type = type_of(format, view_->itemsize);
  if (!type)
    throw Error(ErrorKind::kUsage, name + ": has values of the unsupported type '" + format +
                                       "' (use integers of up to 32 bits or floats of 16 to 64)");
  type_ = *type;
  if (dimensions() != 3)
    throw Error(ErrorKind::kUsage, name + ": has " + std::to_string(dimensions()) +
                                       " dimensions, not (height, width, channels)");
}

std::vector<ChannelView> Buffer::channels() const {
  std::vector<ChannelView> channels;
  for (std::size_t c = 0; c < extent(2); ++c) {
    std::byte* const first =
        static_cast<std::byte*>(view_->buf) + static_cast<Py_ssize_t>(c) * view_->strides[2];
    channels.push_back({first, type_, view_->strides[1], view_->strides[0]});
  }
  return channels;
}

std::vector<ConstChannelView> Buffer::const_channels() const {
  std::vector<ConstChannelView> channels;
  for (const ChannelView& channel : this->channels()) channels.emplace_back(channel);
  return channels;
}

}  // namespace remap::python
