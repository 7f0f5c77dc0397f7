// This file describes a new file that is made from another file. It decides what the new file keeps, what
// becomes invalid with new pixels or in a new format, and what each format can hold.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/errors.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace {

// These attributes describe the pixel coding, and have another meaning in another format.
constexpr std::array kCodingAttributes = {
    "Compression",          "CompressionQuality", "jpeg:subsampling", "tiff:Compression",
    "tiff:RowsPerStrip",    "tiff:ColorSpace",    "tiff:zipquality",  "tiff:PhotometricInterpretation",
    "png:compressionLevel", "oiio:BitsPerSample"};
// OpenImageIO derives these attributes from the old pixels.
constexpr std::array kPixelSummaries = {"oiio:SHA-1", "oiio:ConstantColor", "oiio:AverageColor"};

std::string name_of(PixelType type) { return std::string(name_of(kPixelTypes, type)); }
OIIO::TypeDesc type_desc(PixelType type) { return OIIO::TypeDesc(name_of(type)); }

// Returns the type in which `format` holds values of `type` with the smallest loss. Returns nothing for
// unsupported types. OpenImageIO would choose 8 bits even if the format has 16.
std::optional<PixelType> stored_type(std::string_view format, PixelType type) {
  if (format == "openexr") {
    if (type == PixelType::kHalf || type == PixelType::kFloat || type == PixelType::kUint32) return type;
    return byte_count(type) == 1 ? PixelType::kHalf : PixelType::kFloat;
  }
  if (format == "tiff") return type == PixelType::kHalf ? PixelType::kFloat : type;
  if (format == "hdr") return PixelType::kFloat;  // three values with one exponent
  if (format == "png") return type == PixelType::kUint8 ? type : PixelType::kUint16;
  if (format == "jpeg" || format == "targa" || format == "bmp") return PixelType::kUint8;
  return std::nullopt;
}

void choose_channels(OIIO::ImageSpec& spec, const std::vector<std::string>& names) {
  spec.set_format(spec.channelformat(0));  // also removes the types of single channels
  spec.nchannels = static_cast<int>(names.size());
  spec.channelnames = names;
  const auto alpha = std::ranges::find(names, "A");
  spec.alpha_channel = alpha == names.end() ? -1 : static_cast<int>(alpha - names.begin());
  if (spec.alpha_channel >= 0) spec.attribute(kUnassociatedAlpha, 1);  // alpha is data here, not opacity
  spec.z_channel = -1;
  // A color profile is valid only for one number of channels.
  spec.erase_attribute("ICCProfile.*");
  spec.erase_attribute("tiff:PhotometricInterpretation");
}

// Returns the reason why the format cannot hold the channels of `spec`, or an empty text if it can.
std::string channels_refused(const OIIO::ImageOutput& output, const OIIO::ImageSpec& spec) {
  if (output.supports("nchannels")) return "";
  const bool has_alpha = spec.alpha_channel >= 0;
  const int colors = spec.nchannels - (has_alpha ? 1 : 0);
  if ((colors == 1 || colors == 3) && (!has_alpha || output.supports("alpha"))) return "";
  return "cannot hold the " + std::to_string(spec.nchannels) +
         " channels of the source (use --format exr or --format tif)";
}

void leave_coding_behind(OIIO::ImageSpec& spec, const OIIO::ImageOutput& output) {
  for (const char* name : kCodingAttributes) spec.erase_attribute(name);
  const bool is_tiff = std::string_view(output.format_name()) == "tiff";
  const bool sides_fit = !is_tiff || (spec.tile_width % 16 == 0 && spec.tile_height % 16 == 0);
  if (!output.supports("tiles") || !sides_fit) spec.tile_width = spec.tile_height = spec.tile_depth = 0;
}

// Removes the creator, because writers of IPTC data add the artist as creator, and the file would have two.
void leave_creator_to_writer(OIIO::ImageSpec& spec) {
  if (spec.get_string_attribute("IPTC:Creator") == spec.get_string_attribute("Artist"))
    spec.erase_attribute("IPTC:Creator");
}

void suit_openexr(OIIO::ImageSpec& spec) {
  // Rows are written from the top. The order in the file is not a property of the picture.
  spec.attribute("openexr:lineOrder", "increasingY");
  // OpenImageIO reads the level as an attribute, but writes it only with the name of the compression.
  const float level = spec.get_float_attribute("openexr:dwaCompressionLevel");
  const std::string compression = spec.get_string_attribute("Compression");
  if (level > 0.0f && compression.starts_with("dwa") && compression.find(':') == std::string::npos)
    spec.attribute("Compression", compression + ":" + std::to_string(std::lround(level)));
}

void suit_tiff(OIIO::ImageSpec& spec) {
  // OpenImageIO 2.4 cannot write this tag, and drops all of Exif with it.
  spec.erase_attribute("Exif:ImageHistory");
  // OpenImageIO writes IPTC data only if this attribute is set. It then also writes the artist as creator.
  const auto is_iptc = [](const OIIO::ParamValue& value) {
    return value.name().string().starts_with("IPTC:");
  };
  if (std::ranges::any_of(spec.extra_attribs, is_iptc)) spec.attribute("tiff:write_iptc", 1);
  leave_creator_to_writer(spec);
  if (spec.format == OIIO::TypeHalf) spec.attribute("tiff:half", 1);
}

void suit_jpeg(OIIO::ImageSpec& spec) {
  spec.attribute("Compression", "jpeg:100");
  spec.attribute("jpeg:subsampling", "4:4:4");
  leave_creator_to_writer(spec);
}

// Removes the version, because OpenImageIO appends it to the program's name each time it writes a file.
void suit_targa(OIIO::ImageSpec& spec) {
  const int version = OIIO::openimageio_version();
  const std::string own = " " + std::to_string(version / 100) + "." + std::to_string(version % 100);
  const std::string software = spec.get_string_attribute("Software");
  if (software.ends_with(own)) spec.attribute("Software", software.substr(0, software.size() - own.size()));
}

// Sets the attributes that some formats need.
void suit_format(OIIO::ImageSpec& spec, std::string_view format) {
  // In TIFF, mark alpha as associated, which keeps values unchanged. Other formats would divide colors by
  // such an alpha.
  if (format != "tiff" || spec.alpha_channel < 0) spec.attribute(kUnassociatedAlpha, 1);
  // EXR and TIFF writers add the time of the run. Equal inputs would then not give equal files. Readers
  // ignore an empty time.
  if (spec.find_attribute("DateTime") == nullptr && (format == "openexr" || format == "tiff"))
    spec.attribute("DateTime", "");
  if (format == "openexr") suit_openexr(spec);
  if (format == "tiff") suit_tiff(spec);
  if (format == "jpeg") suit_jpeg(spec);
  if (format == "targa") suit_targa(spec);
}

void choose_compression_level(OIIO::ImageSpec& spec, const std::string& format, int level) {
  if (!has_compression_level(spec, format)) return;
  if (format == "png")
    spec.attribute("png:compressionLevel", level);
  else
    spec.attribute("Compression", "zip:" + std::to_string(level));
}

// Tags the colors of a new file. If colors are stored as in the model, the new file keeps the model's tag.
// Data has no tag, because programs that obey the tag would decode the data. glTF and most programs read
// colors in PNG as sRGB and ignore its gamma. So linear colors have a tag only if the user chooses them.
void tag_colors(OIIO::ImageSpec& spec, std::string_view format, PixelType type, bool follows,
                const ImageChanges& changes, Metadata& metadata) {
  const bool keeps_tag = follows && changes.colors &&
                         (!is_integer(type) || changes.colors->of(type) == changes.colors->followed);
  if (keeps_tag) return;
  for (const char* name : {"oiio:ColorSpace", "oiio:Gamma", "Exif:ColorSpace"}) spec.erase_attribute(name);
  if (!changes.colors) return;
  const Transfer transfer = changes.colors->of(type);
  spec.attribute("oiio:ColorSpace", transfer == Transfer::kSrgb ? "sRGB" : "Linear");
  const bool is_usual = transfer == usual_color_transfer(type);
  if (!is_usual && format != "png")
    metadata.emplace_back(kNotedColorSpace, std::string(name_of(kTransfers, transfer)));
}

void note_metadata(OIIO::ImageSpec& spec, std::string_view format, const Metadata& metadata) {
  std::string all;
  for (const auto& [name, value] : metadata) {
    spec.attribute(name, value);
    all += (all.empty() ? "" : "; ") + name + "=" + value;
  }
  // TIFF and JPEG have no custom attributes. The tag Software holds them instead.
  if (!all.empty() && (format == "tiff" || format == "jpeg")) spec.attribute("Software", all);
}

}  // namespace

OIIO::ImageSpec output_spec(const OIIO::ImageSpec& model, const std::string& model_format,
                            const OIIO::ImageOutput& output, const ImageChanges& changes,
                            const std::filesystem::path& path) {
  const std::string format = output.format_name();
  const auto fail = [&](const std::string& what) {
    throw output_error(path.string() + ": format " + format + " " + what);
  };
  OIIO::ImageSpec spec = model;
  for (const char* name : kPixelSummaries) spec.erase_attribute(name);
  if (changes.channels) choose_channels(spec, *changes.channels);
  if (std::string reason = channels_refused(output, spec); !reason.empty()) fail(reason);

  if (!output.supports("channelformats")) spec.channelformats.clear();
  const bool is_mixed = !spec.channelformats.empty() && !changes.type;
  const PixelType type = changes.type ? *changes.type : pixel_type(spec.format).value();
  // Few programs read half floats in TIFF, so the new file has them only if the model has.
  const bool keeps_half = format == "tiff" && model_format == format && model.format == OIIO::TypeHalf;
  const std::optional<PixelType> stored =
      keeps_half && type == PixelType::kHalf ? type : stored_type(format, type);
  if (!stored) fail("is not supported for writing (use --format exr, tif or png)");
  if (changes.type && *stored != *changes.type)
    fail("cannot hold " + name_of(type) + " pixels (use --type " + name_of(*stored) + ")");
  if (!is_mixed && type_desc(*stored) != model.format) spec.erase_attribute("oiio:BitsPerSample");
  if (!is_mixed) spec.set_format(type_desc(*stored));

  const bool follows = format == model_format && !changes.channels &&
                       (is_mixed || is_integer(pixel_type(model.format).value()) == is_integer(*stored));
  Metadata metadata = changes.metadata;
  tag_colors(spec, format, *stored, follows, changes, metadata);
  if (format != model_format) leave_coding_behind(spec, output);
  suit_format(spec, format);
  if (changes.compression_level) choose_compression_level(spec, format, *changes.compression_level);
  note_metadata(spec, format, metadata);
  return spec;
}

}  // namespace remap
