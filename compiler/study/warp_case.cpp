#include "study/warp_case.hpp"

#include <algorithm>
#include <array>

#include "remap/error.hpp"
#include "renderer/image_file.hpp"

namespace remapc {
namespace {

namespace fs = std::filesystem;
using remap::Error;
using remap::ErrorKind;

// Reads a map. The first map sets the size of the case; all others must have the same size.
Image read_map(const fs::path& path, WarpCase& made) {
  Image image = read_rgb(path);
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  if (made.width == 0) {
    made.width = width;
    made.height = height;
  }
  if (width != made.width || height != made.height)
    throw Error(ErrorKind::kInput, path.string() + ": size " + std::to_string(width) + "x" +
                                       std::to_string(height) + " does not match the other maps (" +
                                       std::to_string(made.width) + "x" + std::to_string(made.height) + ")");
  return image;
}

std::vector<remap::WarpTexel> read_texels(const fs::path& folder, WarpCase& made) {
  const std::array<Image, 3> maps = {read_map(folder / "diffuse.exr", made),
                                     read_map(folder / "specular.exr", made),
                                     read_map(folder / "alpha.exr", made)};
  std::vector<remap::WarpTexel> texels(made.width * made.height);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      texels[i][c] = maps[0].values[3 * i + c];
      texels[i][3 + c] = maps[1].values[3 * i + c];
    }
    texels[i][6] = maps[2].values[3 * i];
    if (!is_finite(texels[i]))
      throw Error(ErrorKind::kInput, folder.string() + ": texel " + std::to_string(i % made.width) + ", " +
                                         std::to_string(i / made.width) + " is not finite");
  }
  return texels;
}

std::vector<std::uint32_t> read_mask(const fs::path& path, WarpCase& made) {
  const Image mask = read_map(path, made);
  std::vector<std::uint32_t> texels;
  for (std::uint32_t i = 0; i < made.width * made.height; ++i)
    if (mask.values[3 * std::size_t{i}] > 0.5f) texels.push_back(i);
  return texels;
}

std::vector<StrokePair> read_strokes(const fs::path& folder, WarpCase& made) {
  std::vector<StrokePair> strokes;
  for (std::size_t k = 0;; ++k) {
    const std::string number = std::to_string(k) + ".exr";
    if (k > 0 && !fs::exists(folder / ("source" + number))) return strokes;
    strokes.push_back(
        {read_mask(folder / ("source" + number), made), read_mask(folder / ("template" + number), made)});
  }
}

std::vector<std::string> case_names(const fs::path& folder) {
  std::error_code failure;
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    if (fs::is_directory(entry->path() / "source")) names.push_back(entry->path().filename().string());
  if (failure) throw Error(ErrorKind::kInput, folder.string() + ": cannot be read: " + failure.message());
  if (names.empty())
    throw Error(
        ErrorKind::kInput,
        folder.string() + ": contains no set (a set is a folder with source, template, truth and strokes)");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<WarpCase> read_warp_cases(const std::vector<fs::path>& folders) {
  std::vector<WarpCase> cases;
  if (folders.empty()) return cases;
  for (const std::string& name : case_names(folders.front())) {
    const fs::path first = folders.front() / name;
    WarpCase made;
    made.name = name;
    made.source.name = (first / "source").string();
    made.target.name = (first / "template").string();
    made.source.texels = read_texels(first / "source", made);
    made.target.texels = read_texels(first / "template", made);
    made.truth = read_texels(first / "truth", made);
    for (const fs::path& folder : folders)
      made.strokes.push_back(read_strokes(folder / name / "strokes", made));
    cases.push_back(std::move(made));
  }
  return cases;
}

}  // namespace remapc
