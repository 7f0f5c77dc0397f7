#include "warp/copied_set.hpp"

#include <limits>
#include <sstream>

#include "core/files.hpp"
#include "core/number_text.hpp"
#include "look/image.hpp"
#include "remap/version.hpp"
#include "warp/warp.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The following functions call write(name, channels, value). It writes a map whose channels c have
// value(texel, c) for the template texel of each source texel.
void write_parameters(const auto& write, const WarpMaterial& material) {
  const auto part = [&](std::size_t first) {
    return
        [&material, first](std::uint32_t texel, std::size_t c) { return material.texels[texel][first + c]; };
  };
  write("diffuse.exr", {"R", "G", "B"}, part(0));
  write("specular.exr", {"R", "G", "B"}, part(3));
  write("alpha.exr", {"Y"}, part(6));
}

void write_profiles(const auto& write, const TabulatedMaterial& material) {
  std::vector<std::string> channels;
  for (const char* color : {"R@", "G@", "B@"})
    for (const double radius : material.radii) channels.push_back(color + number_text(radius));
  write("profiles.exr", channels, [&](std::uint32_t texel, std::size_t c) {
    return material.samples(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(material.entries[texel]));
  });
}

// Returns the list of BRDFs with paths relative to `folder`.
std::string moved_list(const fs::path& list, const fs::path& folder) {
  std::istringstream lines(read_file(list));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) text += fs::relative(list.parent_path() / line, folder).generic_string() + "\n";
  }
  return text;
}

}  // namespace

std::vector<fs::path> write_copied_set(const fs::path& folder, const std::vector<std::uint32_t>& texels,
                                       const MaterialRef& source, const MaterialRef& goal) {
  std::vector<fs::path> files;
  const auto write = [&](const char* name, const std::vector<std::string>& channels, const auto& value) {
    Image image{static_cast<int>(source.width()),
                static_cast<int>(source.height()),
                static_cast<int>(channels.size()),
                {}};
    image.values.reserve(texels.size() * channels.size());
    for (const std::uint32_t texel : texels)
      for (std::size_t c = 0; c < channels.size(); ++c)
        image.values.push_back(texel == kNoTexel ? kNan : value(texel, c));
    files.push_back(folder / name);
    write_exr(files.back(), image, {{"Software", std::string("remapc ") + kVersion}}, channels);
  };
  const TabulatedMaterial* table = goal.tabulated();
  if (table == nullptr) {
    write_parameters(write, *goal.parametric());
  } else if (table->table.extension() == ".exr") {
    write_profiles(write, *table);
  } else {
    write("index.exr", {"Y"},
          [&](std::uint32_t texel, std::size_t) { return static_cast<float>(table->entries[texel]); });
    const bool is_csv = table->table.extension() == ".csv";
    files.push_back(folder / (is_csv ? "profiles.csv" : "brdfs.txt"));
    write_file(files.back(), is_csv ? read_file(table->table) : moved_list(table->table, folder));
  }
  write("template_texel.exr", {"X", "Y"}, [&](std::uint32_t texel, std::size_t c) {
    return static_cast<float>(c == 0 ? texel % goal.width() : texel / goal.width());
  });
  return files;
}

}  // namespace remap
