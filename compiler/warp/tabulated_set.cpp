#include "warp/tabulated_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "table/csv.hpp"
#include "texture/image_reader.hpp"
#include "warp/image_texels.hpp"

namespace remap {
namespace {

// More BRDFs are not needed. A file has 33 MB on disk, and the database has 100 of them.
constexpr std::size_t kMostBrdfs = 10'000;

namespace fs = std::filesystem;

constexpr std::uint32_t kNoEntry = ~std::uint32_t{0};
constexpr std::array<const char*, 3> kTables = {"profiles.exr", "profiles.csv", "brdfs.txt"};
constexpr std::array<const char*, 4> kIndexMaps = {"index.exr", "index.png", "index.tif", "index.tiff"};

std::optional<fs::path> table_in(const fs::path& folder) {
  for (const char* name : kTables)
    if (fs::is_regular_file(folder / name)) return folder / name;
  return std::nullopt;
}

// A ProfileColumn is a color channel, a radius, and the index of the file's column or channel.
struct ProfileColumn {
  char channel = 'Y';
  double radius = 0.0;
  std::size_t column = 0;
};

std::optional<ProfileColumn> profile_column(std::string_view name, std::size_t column) {
  if (name.size() < 3 || name[1] != '@' || std::string_view("RGBY").find(name[0]) == std::string_view::npos)
    return std::nullopt;
  const auto radius = parse_number(name.substr(2));
  if (!radius || !(*radius > 0.0)) return std::nullopt;
  return ProfileColumn{name[0], *radius, column};
}

// A ProfileLayout holds the radii of a table, and the column of each sample of red, green and blue.
struct ProfileLayout {
  std::vector<double> radii;
  std::vector<std::size_t> columns;  // 3 x radii
};

ProfileLayout profile_layout(const std::vector<std::string>& names, const std::string& context) {
  std::map<char, std::map<double, std::size_t>> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto column = profile_column(names[i], i))
      found[column->channel][column->radius] = column->column;
  const bool is_grey = found.contains('Y');
  ProfileLayout layout;
  for (const auto& [radius, column] : found[is_grey ? 'Y' : 'R']) layout.radii.push_back(radius);
  for (const char channel : {'R', 'G', 'B'}) {
    const auto& own = found[is_grey ? 'Y' : channel];
    std::vector<double> radii;
    for (const auto& [radius, column] : own) {
      radii.push_back(radius);
      layout.columns.push_back(column);
    }
    if (radii.size() < 2 || radii != layout.radii)
      throw input_error(
          context + ": has no profiles, because the first column is " +
          (names.empty() ? "missing" : "'" + names.front() + "'") +
          " (name the columns R@RADIUS, G@RADIUS and B@RADIUS, or Y@RADIUS, for two or more radii)");
  }
  return layout;
}

void set_size(TabulatedSet& set, const ImageLayout& layout) {
  set.width = static_cast<std::size_t>(layout.width);
  set.height = static_cast<std::size_t>(layout.height);
}

void read_profile_map(TabulatedSet& set) {
  ImageReader image(set.table);
  set_size(set, image.layout());
  std::vector<std::string> names;
  for (const Channel& channel : image.layout().channels) names.push_back(channel.name);
  const ProfileLayout layout = profile_layout(names, set.table.string());
  const std::vector<std::byte> texels = texels_of(image);
  TabulatedMaterial& material = set.material;
  material.radii = layout.radii;
  material.samples.resize(static_cast<Eigen::Index>(layout.columns.size()),
                          static_cast<Eigen::Index>(set.width * set.height));
  for (std::size_t row = 0; row < layout.columns.size(); ++row) {
    const std::vector<float> values = channel_values(image.layout(), layout.columns[row], texels);
    material.samples.row(static_cast<Eigen::Index>(row)) =
        Eigen::Map<const Eigen::RowVectorXf>(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  for (Eigen::Index i = 0; i < material.samples.cols(); ++i) {
    const bool is_profile =
        (material.samples.col(i).array() >= 0.0f).all() && material.samples.col(i).allFinite();
    material.entries.push_back(is_profile ? static_cast<std::uint32_t>(i) : kNoEntry);
    if (!is_profile) material.samples.col(i).setZero();
  }
}

void read_profile_table(TabulatedSet& set) {
  const std::string text = read_file(set.table);
  const Csv csv = parse_csv(text, set.table.string());
  std::vector<std::string> names;
  for (const CsvCell& cell : csv.header.cells) names.emplace_back(cell.text);
  const ProfileLayout layout = profile_layout(names, set.table.string());
  set.material.radii = layout.radii;
  set.material.samples.resize(static_cast<Eigen::Index>(layout.columns.size()),
                              static_cast<Eigen::Index>(csv.lines.size()));
  for (std::size_t entry = 0; entry < csv.lines.size(); ++entry)
    for (std::size_t row = 0; row < layout.columns.size(); ++row) {
      const CsvCell& cell = csv.lines[entry].cells[layout.columns[row]];
      const double value = csv.number(csv.lines[entry], cell, names[layout.columns[row]]);
      if (!(value >= 0.0 && std::isfinite(value)))
        csv.fail(csv.lines[entry].number, cell.column,
                 "'" + std::string(cell.text) + "' is not a finite number of at least 0");
      set.material.samples(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(entry)) =
          static_cast<float>(value);
    }
}

void read_brdf_list(TabulatedSet& set) {
  std::istringstream lines(read_file(set.table));
  std::vector<std::vector<float>> columns;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (columns.size() == kMostBrdfs)
      throw input_error(set.table.string() + ": has more than " + std::to_string(kMostBrdfs) +
                        " BRDFs, which is the limit (split the list)");
    if (!line.empty()) columns.push_back(read_merl(set.table.parent_path() / line));
  }
  if (columns.empty())
    throw input_error(set.table.string() + ": contains no file name (write one BRDF file per line)");
  set.material.samples.resize(static_cast<Eigen::Index>(columns.front().size()),
                              static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    set.material.samples.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXf>(columns[i].data(), set.material.samples.rows());
}

double largest_of(PixelType type) {
  switch (type) {
    case PixelType::kUint8:
      return 255.0;
    case PixelType::kUint16:
      return 65535.0;
    case PixelType::kUint32:
      return 4294967295.0;
    default:
      return 1.0;
  }
}

void read_index_map(const fs::path& folder, TabulatedSet& set) {
  const auto name = std::find_if(kIndexMaps.begin(), kIndexMaps.end(),
                                 [&](const char* file) { return fs::is_regular_file(folder / file); });
  if (name == kIndexMaps.end())
    throw input_error(folder.string() + ": " + set.table.filename().string() +
                      " requires a map of its entries (add index.exr, .png or .tif)");
  ImageReader image(folder / *name);
  const ImageLayout& layout = image.layout();
  if (layout.channels.size() != 1)
    throw input_error(image.path().string() + ": has " + std::to_string(layout.channels.size()) +
                      " channels, but an index map must have one");
  set_size(set, layout);
  const auto entries = static_cast<double>(set.material.samples.cols());
  const double largest = largest_of(layout.channels[0].type);
  for (const float value : channel_values(layout, 0, texels_of(image))) {
    const double entry = std::round(static_cast<double>(value) * largest);
    const bool is_entry = entry >= 0.0 && entry < entries;  // false for NaN, too
    set.material.entries.push_back(is_entry ? static_cast<std::uint32_t>(entry) : kNoEntry);
  }
}

}  // namespace

bool is_tabulated_folder(const fs::path& folder) { return table_in(folder).has_value(); }

TabulatedSet read_tabulated_set(const fs::path& folder) {
  const auto table = table_in(folder);
  if (!table)
    throw input_error(folder.string() + ": contains no table (profiles.exr, profiles.csv or brdfs.txt)");
  TabulatedSet set;
  set.table = *table;
  set.material.name = folder.string();
  if (table->extension() == ".exr") {
    read_profile_map(set);
    return set;
  }
  if (table->extension() == ".csv")
    read_profile_table(set);
  else
    read_brdf_list(set);
  read_index_map(folder, set);
  return set;
}

}  // namespace remap
