#include "assets/mtl/mtl_asset.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "assets/document/asset_uri.hpp"
#include "assets/document/mtl_document.hpp"
#include "assets/document/text_edits.hpp"
#include "assets/gltf/gltf_inputs.hpp"
#include "assets/maps/legacy_maps.hpp"
#include "assets/maps/map_pixels.hpp"
#include "assets/mtl/mtl_libraries.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "core/number_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Colors that differ by less are equal. Rounding in floats changes a color by less.
constexpr double kSameColor = 1e-6;

std::string float_text_of(double value) { return float_text(static_cast<float>(value)); }

std::string color_text(const std::array<double, 3>& color) {
  return float_text_of(color[0]) + " " + float_text_of(color[1]) + " " + float_text_of(color[2]);
}

// Changes a prefix of file names, so that no part of it looks like an option of a map, as in `wood -s 2 2`.
// Also replaces backslashes, because they would separate folders.
std::string argument_prefix(std::string prefix) {
  for (std::size_t i = 0; i < prefix.size(); ++i) {
    const bool begins_word = i == 0 || prefix[i - 1] == ' ';
    if (prefix[i] == '\\' || (begins_word && prefix[i] == '-') || (i == 0 && prefix[i] == ' '))
      prefix[i] = '_';
  }
  return prefix;
}

// Writes the name of a file as the argument of a map. If the name begins with `-`, it must not be read as an
// option.
std::string argument(const std::string& file) { return (file.starts_with('-') ? "./" : "") + file; }

// An MtlResult is the result of a material: numbers, and names of new images.
struct MtlResult {
  MetalRoughFactors factors;
  bool keeps_map = false;  // true if map_Kd stays
  std::string base_file;
  std::string roughness_map, metallic_map;  // arguments of map_Pr and map_Pm
};

// Returns the options that place an image on the surface.
std::string placing_options(const MtlMap& map) {
  const auto pair = [](const std::array<double, 2>& numbers) {
    return number_text(numbers[0]) + " " + number_text(numbers[1]) + " ";
  };
  std::string text;
  if (map.scale != std::array{1.0, 1.0}) text += "-s " + pair(map.scale);
  if (map.offset != std::array{0.0, 0.0}) text += "-o " + pair(map.offset);
  return text + (map.clamps ? "-clamp on " : "");
}

// All converted maps of a material have the same placing options, so the first map decides.
std::string placing_options(const MtlSurface& surface) {
  for (const std::optional<MtlMap>* map :
       {&surface.specular_map, &surface.exponent_map, &surface.diffuse_map})
    if (*map) return placing_options(**map);
  return "";
}

// Returns arguments that name the file of `map` again, with its options.
std::string arguments_of(const MtlMap& map) {
  std::string text = placing_options(map);
  if (map.has_levels()) text += "-mm " + number_text(map.base) + " " + number_text(map.gain) + " ";
  if (map.channel != '\0') text += std::string("-imfchan ") + map.channel + " ";
  return text + argument(map.file);
}

// Returns the images that a text names, each once.
std::vector<AssetResource> named_images(const MtlDocument& document, MtlImages& images) {
  std::vector<AssetResource> resources;
  std::set<std::string> known;
  for (std::size_t i = 0; i < document.statements().size(); ++i) {
    if (!is_mtl_map(document.word(document.statements()[i]))) continue;
    const std::optional<std::string> path = images.place_of(read_mtl_map(document, i).file);
    if (path && known.insert(*path).second) resources.push_back({"", *path, UriKind::kFile});
  }
  return resources;
}

// A BlockEditor edits the statements of one material.
class BlockEditor {
 public:
  BlockEditor(const MtlDocument& document, const MtlSurface& surface, std::vector<TextSplice>& splices)
      : document_(document), surface_(surface), splices_(splices) {}

  void write(const MtlResult& result) {
    const std::array<double, 3> white = {1.0, 1.0, 1.0};
    const bool has_own_base = !result.base_file.empty();
    write_diffuse(has_own_base ? white : result.factors.base_color);
    if (surface_.diffuse_map && has_own_base) {
      splices_.push_back({surface_.diffuse_map->name, result.base_file});
      for (const TextSpan levels : surface_.diffuse_map->levels) splices_.push_back({levels, ""});
    } else if (surface_.diffuse_map && !result.keeps_map) {
      remove(surface_.diffuse_map->statement);
    } else if (has_own_base) {
      add("map_Kd " + placing_options(surface_) + result.base_file);
    }
    add("Pr " + (result.roughness_map.empty() ? float_text_of(result.factors.roughness) : "1"));
    add("Pm " + (result.metallic_map.empty() ? float_text_of(result.factors.metallic) : "1"));
    if (!result.roughness_map.empty()) add("map_Pr " + result.roughness_map);
    if (!result.metallic_map.empty()) add("map_Pm " + result.metallic_map);
    append();
  }

 private:
  const MtlStatement& statement(std::size_t index) const { return document_.statements()[index]; }

  // Writes Kd. Channels that stay keep their text.
  void write_diffuse(const std::array<double, 3>& base) {
    if (!surface_.diffuse_statement) {
      // A map without Kd is used unchanged, so Kd 1 need not be written.
      const bool is_said = surface_.diffuse_map && std::ranges::all_of(base, [](double value) {
                             return std::fabs(value - 1.0) <= kSameColor;
                           });
      if (!is_said) add("Kd " + color_text(base));
      return;
    }
    const std::vector<TextSpan> words = document_.words(statement(*surface_.diffuse_statement));
    std::array<std::optional<double>, 3> old;
    for (std::size_t c = 0; c < 3 && c < words.size(); ++c) old[c] = mtl_number(document_.raw(words[c]));
    const bool is_grey = !old[1];
    const auto differs = [&](std::size_t c) {
      return std::fabs(base[c] - old[is_grey ? 0 : c].value_or(-1.0)) > kSameColor;
    };
    if (is_grey && (differs(0) || differs(1) || differs(2))) splices_.push_back({words[0], color_text(base)});
    for (std::size_t c = 0; c < 3 && !is_grey; ++c)
      if (differs(c)) splices_.push_back({words[c], float_text_of(base[c])});
  }

  void remove(std::size_t index) {
    const MtlStatement& removed = statement(index);
    splices_.push_back({{removed.line.begin, removed.ending.end}, ""});
    removes_last_ = index == surface_.last_statement;
  }

  void add(const std::string& line) { added_.push_back(line); }

  // Inserts lines after the last statement, with its indentation. If the text did not end with a line ending,
  // it still does not.
  void append() {
    const MtlStatement& last = statement(surface_.last_statement);
    const std::string indentation = indentation_of(last);
    const bool is_ended = last.ending.begin != last.ending.end;
    const std::string ending(is_ended ? document_.raw(last.ending) : document_.line_ending());
    std::string text;
    for (const std::string& line : added_) {
      const bool is_first_of_text = text.empty() && removes_last_;
      text += is_ended ? indentation + line + ending : (is_first_of_text ? "" : ending) + indentation + line;
    }
    splices_.push_back({{last.ending.end, last.ending.end}, text});
  }

  // Returns the indentation of the last line of a statement. A backslash may join earlier lines to this line.
  std::string indentation_of(const MtlStatement& statement) const {
    const std::string_view before = document_.raw({statement.line.begin, statement.word.begin});
    const std::size_t start = before.find_last_of("\r\n");
    return std::string(start == std::string_view::npos ? before : before.substr(start + 1));
  }

  const MtlDocument& document_;
  const MtlSurface& surface_;
  std::vector<TextSplice>& splices_;
  std::vector<std::string> added_;
  bool removes_last_ = false;
};

class MtlEditor {
 public:
  MtlEditor(const MtlDocument& document, const AssetOptions& options, const AssetResources* resources)
      : document_(document),
        options_(options),
        maker_(options.mtl_maker.value_or(maker_of(document))),
        images_(resources, ""),
        names_(resources != nullptr ? argument_prefix(resources->image_prefix()) : "") {}

  AssetConversion result() {
    if (options_.writes_extensions())
      conversion_.warnings.push_back(
          "MTL files cannot hold what --extensions write adds (remove this option)");
    if (const std::string warning = maker_warning(maker_); !warning.empty())
      conversion_.warnings.push_back(warning);
    conversion_.resources = named_images(document_, images_);
    for (const AssetResource& resource : conversion_.resources) names_.take(resource.path);
    for (std::size_t i = 0; i < document_.materials().size(); ++i) convert(i);
    sort_splices(splices_);
    conversion_.text = spliced(document_.text(), splices_);
    conversion_.touched = touched_by(splices_);
    conversion_.changed = conversion_.count(MaterialState::kConverted) > 0;
    return std::move(conversion_);
  }

 private:
  void convert(std::size_t index) {
    const MtlBlock& block = document_.materials()[index];
    AssetMaterial& report = conversion_.materials.emplace_back();
    report.index = index;
    report.name = block.name;
    if (has_metal_rough_lines(document_, block)) return;
    const std::size_t splice_count = splices_.size();
    try {
      MtlSurface surface;
      read_mtl_surface(document_, block, maker_, surface, report.warnings);
      if (surface.is_empty()) return;
      const MtlResult result = surface.is_metal_rough
                                   ? as_written(surface)
                                   : converted(surface, reflection_of(surface, report.warnings), report);
      BlockEditor(document_, surface, splices_).write(result);
      report.becomes = becomes_text_of(result, surface);
      if (result.roughness_map.empty() && result.metallic_map.empty() && result.base_file.empty() &&
          !result.keeps_map)
        report.factors = {
            {"base_color", {result.factors.base_color.begin(), result.factors.base_color.end()}},
            {"metallic", {result.factors.metallic}},
            {"roughness", {result.factors.roughness}}};
      report.state = MaterialState::kConverted;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      splices_.resize(splice_count);
      report.state = MaterialState::kFailed;
      report.failure = error.what();
    }
  }

  // Returns metallic and roughness that the maker of the file wrote in other statements.
  static MtlResult as_written(const MtlSurface& surface) {
    MtlResult result{metal_rough_of(surface, true), surface.diffuse_map.has_value(), "", "", ""};
    if (surface.roughness_map) result.roughness_map = arguments_of(*surface.roughness_map);
    if (surface.metallic_map) result.metallic_map = arguments_of(*surface.metallic_map);
    return result;
  }

  MtlResult converted(const MtlSurface& surface, const LegacyMaterial& factors, AssetMaterial& report) {
    const bool has_maps = surface.diffuse_map || surface.specular_map || surface.exponent_map;
    if (has_maps && factors.has_highlight()) return converted_with_maps(surface, factors, report);
    return {core_of_legacy(factors), surface.diffuse_map.has_value(), "", "", ""};
  }

  // Converts maps. Materials with the same maps and factors share the result.
  MtlResult converted_with_maps(const MtlSurface& surface, const LegacyMaterial& factors,
                                AssetMaterial& report) {
    if (surface.exponent_map) report.warnings.push_back(exponent_warning(surface));
    const std::string key = key_of(surface, factors);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    const LegacyMapResult converted =
        converted_maps(load_maps(surface, factors, images_, options_, report.warnings));
    MtlResult result;
    result.factors = converted.factors;
    result.keeps_map = converted.keeps_diffuse;
    if (converted.base_color) result.base_file = add_image(*converted.base_color, surface, "_baseColor");
    if (converted.metal_rough && !is_constant_channel(*converted.metal_rough, 1))
      result.roughness_map =
          placing_options(surface) + add_image(channel_of(*converted.metal_rough, 1), surface, "_roughness");
    if (converted.metal_rough && !is_constant_channel(*converted.metal_rough, 2))
      result.metallic_map =
          placing_options(surface) + add_image(channel_of(*converted.metal_rough, 2), surface, "_metallic");
    known_[key] = result;
    return result;
  }

  static bool is_constant_channel(const ImagePixels& pixels, std::size_t channel) {
    return is_constant(channel_of(pixels, channel));
  }

  // Adds an image. Its name comes from the map that it is made from, and it is stored beside this map.
  std::string add_image(const ImagePixels& pixels, const MtlSurface& surface, std::string_view suffix) {
    const bool is_color = suffix == "_baseColor";
    const std::optional<MtlMap>& model = is_color && surface.diffuse_map ? surface.diffuse_map
                                         : surface.specular_map          ? surface.specular_map
                                         : surface.exponent_map          ? surface.exponent_map
                                                                         : surface.diffuse_map;
    std::string png =
        images_.resources().codec().encode_png(pixels, options_.png_level.value_or(kUsualPngLevel));
    if (const auto same = std::ranges::find(conversion_.files, png, &NewResource::bytes);
        same != conversion_.files.end())
      return argument(same->path);
    const std::string name = names_.free_name(images_.place_of(model->file).value_or("material"), suffix);
    conversion_.files.push_back({name, std::move(png)});
    return argument(name);
  }

  static std::string becomes_text_of(const MtlResult& result, const MtlSurface& surface) {
    std::string text = "base color ";
    if (!result.base_file.empty())
      text += "map";
    else
      text += (surface.diffuse_map && result.keeps_map ? "map_Kd times " : "") +
              color_text(result.factors.base_color);
    text += ", metallic " + (result.metallic_map.empty() ? float_text_of(result.factors.metallic) : "map");
    return text + ", roughness " +
           (result.roughness_map.empty() ? float_text_of(result.factors.roughness) : "map");
  }

  const MtlDocument& document_;
  const AssetOptions& options_;
  MtlMaker maker_;
  MtlImages images_;
  NewImageNames names_;
  AssetConversion conversion_;
  std::vector<TextSplice> splices_;
  std::map<std::string, MtlResult> known_;
};

}  // namespace

std::vector<AssetResource> mtl_resources(const ByteSource& source, const std::string& context,
                                         const AssetResources* resources) {
  const std::string text = mtl_text(source, context);
  const MtlDocument document(text, context);
  MtlImages images(resources, "");
  return named_images(document, images);
}

AssetConversion convert_mtl(const ByteSource& source, const std::string& context, const AssetOptions& options,
                            const AssetResources* resources) {
  const std::string text = mtl_text(source, context);
  const MtlDocument document(text, context);
  AssetConversion conversion = MtlEditor(document, options, resources).result();
  if (conversion.changed)
    conversion.pieces.push_back({encoded(conversion.text, encoding_of(source), context), 0, 0});
  return conversion;
}

}  // namespace remap
