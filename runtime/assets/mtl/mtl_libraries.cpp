#include "assets/mtl/mtl_libraries.hpp"

#include <algorithm>
#include <utility>

#include "assets/document/text_edits.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// Four images are kept: color, specular and exponent of one material, and the next color.
constexpr std::size_t kImagesInMemory = 4;
constexpr std::uint64_t kLargestImageFile = std::uint64_t{1} << 30;
constexpr std::size_t kLongestShownName = 200;

std::string slashed(std::string text) {
  std::ranges::replace(text, '\\', '/');
  return text;
}

bool is_drive(const std::string& part) { return part.size() == 2 && part[1] == ':'; }

// A NamedMap is a map of one material that will get the common size.
struct NamedMap {
  const MtlMap* map;
  std::shared_ptr<const ImagePixels>* pixels;
};

void require_one_place(const std::vector<NamedMap>& maps) {
  for (const NamedMap& other : maps) {
    const MtlMap &first = *maps.front().map, &second = *other.map;
    if (!first.lies_like(second))
      throw input_error(plain(first.file, kLongestShownName) + " and " +
                        plain(second.file, kLongestShownName) +
                        " have different options -s, -o or -clamp (give both maps the same options)");
  }
}

void bring_to_one_size(const std::vector<NamedMap>& maps, const AssetResources& resources, bool enlarges) {
  std::size_t width = 0, height = 0;
  for (const NamedMap& map : maps) {
    width = std::max(width, (*map.pixels)->width);
    height = std::max(height, (*map.pixels)->height);
  }
  for (const NamedMap& map : maps) {
    const ImagePixels& pixels = **map.pixels;
    if (pixels.width == width && pixels.height == height) continue;
    if (!enlarges) {
      const NamedMap& other = &map == &maps.front() ? maps.back() : maps.front();
      throw input_error(plain(map.map->file, kLongestShownName) + " is " + size_text(pixels) + ", but " +
                        plain(other.map->file, kLongestShownName) + " is " + size_text(**other.pixels) +
                        " (--resample enlarges the smaller one)");
    }
    *map.pixels = std::make_shared<const ImagePixels>(resources.enlarged(pixels, width, height));
  }
}

}  // namespace

std::optional<std::string> relative_path(const std::string& folder, const std::string& name) {
  const std::string text = slashed(name);
  if (text.empty() || text.starts_with('/') || text.find('\0') != std::string::npos) return std::nullopt;
  std::vector<std::string> parts;
  for (const std::string& part : parts_between(folder.empty() ? text : slashed(folder) + "/" + text, '/')) {
    if (is_drive(part)) return std::nullopt;
    if (part.empty() || part == ".") continue;
    if (part == ".." && !parts.empty() && parts.back() != "..")
      parts.pop_back();
    else
      parts.push_back(part);
  }
  if (parts.empty() || parts.back() == "..") return std::nullopt;
  return joined(parts, "/");
}

std::string file_name_of(const std::string& name) {
  const std::string text = slashed(name);
  const std::size_t slash = text.find_last_of('/');
  return slash == std::string::npos ? text : text.substr(slash + 1);
}

std::vector<std::string> MtlImages::candidates(const std::string& file) const {
  std::vector<std::string> paths;
  for (const std::string& name : {file, file_name_of(file)})
    for (const std::string& folder : {folder_, std::string()})
      if (const auto path = relative_path(folder, name); path && !contains(paths, *path))
        paths.push_back(*path);
  return paths;
}

std::optional<std::string> MtlImages::find(const std::string& file, std::vector<std::string>& warnings) {
  const auto [entry, is_new] = found_.try_emplace(file);
  std::optional<std::string>& found = entry->second;
  if (is_new && resources_ != nullptr)
    for (const std::string& path : candidates(file))
      if (is_there(*resources_, path)) {
        found = path;
        break;
      }
  if (found && relative_path(folder_, file) != found)
    warnings.push_back(plain(file, kLongestShownName) + " is read from " + plain(*found, kLongestShownName));
  return found;
}

std::optional<std::string> MtlImages::place_of(const std::string& file) {
  std::vector<std::string> ignored;
  if (const auto found = find(file, ignored)) return found;
  // If the path of a missing file begins with `..`, it is unknown whether the file would lie in the allowed
  // folder.
  if (const auto path = relative_path(folder_, file); path && !path->starts_with("../")) return path;
  return relative_path("", file_name_of(file));
}

std::string MtlImages::bytes_of(const std::string& path) const {
  const std::unique_ptr<ByteSource> file = resources_->open(path);
  if (file->size() > kLargestImageFile)
    throw input_error(plain(path, kLongestShownName) + ": is too large for an image");
  return file->read(0, file->size());
}

std::shared_ptr<const ImagePixels> MtlImages::load(const std::string& path) {
  const auto known =
      std::ranges::find(recent_, path, &std::pair<std::string, std::shared_ptr<const ImagePixels>>::first);
  if (known != recent_.end()) return known->second;
  auto pixels = std::make_shared<const ImagePixels>(
      resources_->codec().decode(bytes_of(path), plain(path, kLongestShownName)));
  recent_.emplace_front(path, pixels);
  if (recent_.size() > kImagesInMemory) recent_.pop_back();
  return pixels;
}

std::string MtlImages::require(const MtlMap& map, std::vector<std::string>& warnings) {
  const std::string name = plain(map.file, kLongestShownName);
  if (!map.unusual.empty())
    throw input_error(name + ": has " + map.unusual.front() +
                      ", which is not applied (bake it into the image)");
  if (resources_ == nullptr)
    throw input_error(name + ": cannot be read, because only the text of the MTL file is available");
  const std::optional<std::string> path = find(map.file, warnings);
  if (!path) throw input_error(name + ": was not found (put it next to the MTL file)");
  return *path;
}

std::shared_ptr<const ImagePixels> MtlImages::load(const MtlMap& map, std::vector<std::string>& warnings) {
  const std::shared_ptr<const ImagePixels> pixels = load(require(map, warnings));
  if (!map.has_levels()) return pixels;
  return std::make_shared<const ImagePixels>(with_levels(*pixels, map.base, map.gain, !map.is_color));
}

bool is_there(const AssetResources& resources, const std::string& path) {
  try {
    (void)resources.open(path);
    return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return false;
  }
}

LegacyMaps load_maps(const MtlSurface& surface, const LegacyMaterial& factors, MtlImages& images,
                     const AssetOptions& options, std::vector<std::string>& warnings) {
  LegacyMaps maps;
  maps.factors = factors;
  if (surface.exponent_map && surface.exponent_map->channel != '\0')
    maps.exponent_channel = surface.exponent_map->channel;
  std::vector<NamedMap> named;
  const auto load = [&](const std::optional<MtlMap>& map, std::shared_ptr<const ImagePixels>& pixels) {
    if (!map) return;
    pixels = images.load(*map, warnings);
    named.push_back({&*map, &pixels});
  };
  load(surface.diffuse_map, maps.diffuse);
  load(surface.specular_map, maps.specular);
  load(surface.exponent_map, maps.exponent);
  if (named.empty()) return maps;
  require_one_place(named);
  bring_to_one_size(named, images.resources(), options.resamples);
  return maps;
}

std::string key_of(const MtlSurface& surface, const LegacyMaterial& factors) {
  std::string key;
  const auto add = [&](double number) { key += number_text(number) + " "; };
  for (const std::optional<MtlMap>* map :
       {&surface.diffuse_map, &surface.specular_map, &surface.exponent_map}) {
    key += *map ? (*map)->file + '\0' + (*map)->options : "";
    key += '\0';
  }
  for (const double number : factors.diffuse) add(number);
  for (const double number : factors.specular) add(number);
  add(factors.exponent);
  return key;
}

std::string exponent_warning(const MtlSurface& surface) {
  return "map_Ns " + plain(surface.exponent_map->file, kLongestShownName) + " is multiplied by Ns " +
         number_text(surface.exponent.value_or(0.0)) +
         ", as the MTL specification says (if the map holds roughness, invert it)";
}

namespace {

constexpr std::size_t kLongestLibraryName = 200;

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

}  // namespace

MtlLibrary::MtlLibrary(std::string content, const std::string& path, const AssetResources& resources,
                       std::optional<MtlMaker> own_maker)
    : text(std::move(content)),
      document(text, plain(path)),
      maker(own_maker.value_or(maker_of(document))),
      images(&resources, folder_of(path)) {}

void MtlLibraries::read(const std::vector<std::string>& lines, const std::string& obj,
                        std::vector<std::string>& warnings) {
  std::vector<std::string> missing_lines;
  for (const std::string& line : lines) {
    if (read_file(line, warnings)) continue;
    std::vector<std::string> missing;
    std::size_t found = 0;
    for (const std::string& name : parts_between(line, ' ')) {
      if (name.empty()) continue;
      // The file may lie beside the OBJ file, even if its name has another folder.
      if (read_file(name, warnings) || read_file(file_name_of(name), warnings))
        ++found;
      else
        missing.push_back(name);
    }
    if (found == 0 ? read_file(file_name_of(line), warnings) : missing.empty()) continue;
    missing_lines.push_back("mtllib " +
                            plain(missing.size() == 1 ? missing.front() : line, kLongestLibraryName) +
                            ": was not found");
  }
  const std::string name = file_name_of(obj), own = name.substr(0, name.find_last_of('.')) + ".mtl";
  const bool reads_own = libraries_.empty() && read_file(own, warnings);
  if (reads_own && missing_lines.empty()) missing_lines.emplace_back("has no mtllib");
  for (const std::string& line : missing_lines)
    warnings.push_back(line + (reads_own ? "; " + plain(own, kLongestLibraryName) + " is read instead"
                                         : "; its materials become white"));
}

bool MtlLibraries::read_file(const std::string& name, std::vector<std::string>& warnings) {
  const std::optional<std::string> path = relative_path("", name);
  if (!path || !is_there(resources_, *path)) return false;
  if (!paths_.insert(*path).second) return true;
  auto library = std::make_unique<MtlLibrary>(mtl_text(*resources_.open(*path), plain(*path)), *path,
                                              resources_, maker_);
  if (const std::string warning = maker_warning(library->maker); !warning.empty())
    warnings.push_back(plain(*path, kLongestLibraryName) + ": " + warning);
  const MtlDocument& document = library->document;
  for (const MtlBlock& block : document.materials())
    entries_.try_emplace(block.name, Entry{library.get(), &block});
  for (std::size_t i = 0; i < document.statements().size(); ++i)
    if (is_mtl_map(document.word(document.statements()[i])))
      if (const auto image = library->images.place_of(read_mtl_map(document, i).file))
        image_paths_.insert(*image);
  libraries_.push_back(std::move(library));
  return true;
}

std::optional<MtlLibraries::Entry> MtlLibraries::find(const std::string& material) const {
  const auto found = entries_.find(material);
  return found == entries_.end() ? std::nullopt : std::optional(found->second);
}

bool MtlLibraries::has_tr_for_opaque() const {
  std::vector<std::string> ignored;
  bool has_material = false;
  for (const std::unique_ptr<MtlLibrary>& library : libraries_)
    for (const MtlBlock& block : library->document.materials()) {
      try {
        const MtlCover cover = read_mtl_cover(library->document, block, library->maker, ignored);
        if (cover.opacity || cover.transparency.value_or(0.0) < 1.0) return false;
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::kInput) throw;
        return false;
      }
      has_material = true;
    }
  return has_material;
}

bool is_mtl_map(const std::string& word) {
  constexpr std::array<std::string_view, 5> kOthers = {"bump", "disp", "decal", "refl", "norm"};
  return word.starts_with("map_") || contains(kOthers, word);
}

std::string mtl_text(const ByteSource& source, const std::string& context) {
  if (source.size() > kLongestMtl)
    throw input_error(context + ": has " + std::to_string(source.size()) + " bytes, but at most " +
                      std::to_string(kLongestMtl) + " can be read (split it into several files)");
  return utf8_text(source, context);
}

}  // namespace remap
