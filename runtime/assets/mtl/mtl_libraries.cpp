#include "assets/mtl/mtl_libraries.hpp"

#include <utility>

#include "assets/mtl/mtl_asset.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"

namespace remap {
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

}  // namespace remap
