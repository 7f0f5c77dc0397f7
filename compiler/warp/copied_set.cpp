#include "warp/copied_set.hpp"

#include <limits>
#include <sstream>

#include "core/files.hpp"
#include "core/number_text.hpp"
#include "look/image_file.hpp"
#include "remap/version.hpp"
#include "warp/warp.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class CopyWriter {
 public:
  CopyWriter(const fs::path& folder, const std::vector<std::uint32_t>& texels, const MaterialRef& source)
      : folder_(folder), texels_(texels), source_(source) {}

  template <typename Value>
  void write(const char* name, const std::vector<std::string>& channels, const Value& value) {
    Image image{static_cast<int>(source_.width()),
                static_cast<int>(source_.height()),
                static_cast<int>(channels.size()),
                {}};
    image.values.reserve(texels_.size() * channels.size());
    for (const std::uint32_t texel : texels_)
      for (std::size_t c = 0; c < channels.size(); ++c)
        image.values.push_back(texel == kNoTexel ? kNan : value(texel, c));
    write_exr(folder_ / name, image, {{"Software", std::string("remapc ") + kVersion}}, channels);
    files.push_back(folder_ / name);
  }

  void write_text(const char* name, const std::string& text) {
    write_file(folder_ / name, text);
    files.push_back(folder_ / name);
  }

  const fs::path& folder() const { return folder_; }
  std::vector<fs::path> files;

 private:
  const fs::path& folder_;
  const std::vector<std::uint32_t>& texels_;
  MaterialRef source_;
};

void write_parameters(CopyWriter& writer, const WarpMaterial& material) {
  const auto part = [&](std::size_t first) {
    return
        [&material, first](std::uint32_t texel, std::size_t c) { return material.texels[texel][first + c]; };
  };
  writer.write("diffuse.exr", {"R", "G", "B"}, part(0));
  writer.write("specular.exr", {"R", "G", "B"}, part(3));
  writer.write("alpha.exr", {"Y"}, part(6));
}

void write_profiles(CopyWriter& writer, const TabulatedMaterial& material) {
  std::vector<std::string> channels;
  for (const char* color : {"R@", "G@", "B@"})
    for (const double radius : material.radii) channels.push_back(color + number_text(radius));
  writer.write("profiles.exr", channels, [&](std::uint32_t texel, std::size_t c) {
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

void write_entries(CopyWriter& writer, const TabulatedMaterial& material) {
  writer.write("index.exr", {"Y"},
               [&](std::uint32_t texel, std::size_t) { return static_cast<float>(material.entries[texel]); });
  if (material.table.extension() == ".csv")
    writer.write_text("profiles.csv", read_file(material.table));
  else
    writer.write_text("brdfs.txt", moved_list(material.table, writer.folder()));
}

}  // namespace

std::vector<fs::path> write_copied_set(const fs::path& folder, const std::vector<std::uint32_t>& texels,
                                       const MaterialRef& source, const MaterialRef& goal) {
  CopyWriter writer(folder, texels, source);
  if (const WarpMaterial* parametric = goal.parametric())
    write_parameters(writer, *parametric);
  else if (goal.tabulated()->table.extension() == ".exr")
    write_profiles(writer, *goal.tabulated());
  else
    write_entries(writer, *goal.tabulated());
  writer.write("template_texel.exr", {"X", "Y"}, [&](std::uint32_t texel, std::size_t c) {
    return static_cast<float>(c == 0 ? texel % goal.width() : texel / goal.width());
  });
  return std::move(writer.files);
}

}  // namespace remap
