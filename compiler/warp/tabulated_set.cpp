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
#include "warp/quadrature.hpp"
#include "warp/texture_material.hpp"

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

// Returns the radius of a column or channel such as `R@0.5`, or nothing for other names.
std::optional<double> profile_radius(std::string_view name) {
  if (name.size() < 3 || name[1] != '@' || std::string_view("RGBY").find(name[0]) == std::string_view::npos)
    return std::nullopt;
  const auto radius = parse_number(name.substr(2));
  return radius && *radius > 0.0 ? radius : std::nullopt;
}

// Sets the radii of a table. Returns the column of each sample of red, green and blue.
std::vector<std::size_t> profile_columns(const std::vector<std::string>& names, TabulatedMaterial& material) {
  std::map<char, std::map<double, std::size_t>> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const auto radius = profile_radius(names[i])) found[names[i].front()][*radius] = i;
  const bool is_grey = found.contains('Y');
  std::vector<std::size_t> columns;
  for (const auto& [radius, column] : found[is_grey ? 'Y' : 'R']) material.radii.push_back(radius);
  for (const char channel : {'R', 'G', 'B'}) {
    const auto& own = found[is_grey ? 'Y' : channel];
    std::vector<double> radii;
    for (const auto& [radius, column] : own) {
      radii.push_back(radius);
      columns.push_back(column);
    }
    if (radii.size() < 2 || radii != material.radii)
      throw input_error(
          material.table.string() + ": has no profiles, because the first column is " +
          (names.empty() ? "missing" : "'" + names.front() + "'") +
          " (name the columns R@RADIUS, G@RADIUS and B@RADIUS, or Y@RADIUS, for two or more radii)");
  }
  return columns;
}

void set_size(TabulatedMaterial& material, const ImageLayout& layout) {
  material.width = static_cast<std::size_t>(layout.width);
  material.height = static_cast<std::size_t>(layout.height);
}

void read_profile_map(TabulatedMaterial& material) {
  ImageReader image(material.table);
  set_size(material, image.layout());
  std::vector<std::string> names;
  for (const Channel& channel : image.layout().channels) names.push_back(channel.name);
  const std::vector<std::size_t> columns = profile_columns(names, material);
  const std::vector<std::byte> texels = texels_of(image);
  material.samples.resize(static_cast<Eigen::Index>(columns.size()),
                          static_cast<Eigen::Index>(material.width * material.height));
  for (std::size_t row = 0; row < columns.size(); ++row) {
    const std::vector<float> values = channel_values(image.layout(), columns[row], texels);
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

void read_profile_table(TabulatedMaterial& material) {
  const std::string text = read_file(material.table);
  const Csv csv = parse_csv(text, material.table.string());
  std::vector<std::string> names;
  for (const CsvCell& cell : csv.header.cells) names.emplace_back(cell.text);
  const std::vector<std::size_t> columns = profile_columns(names, material);
  material.samples.resize(static_cast<Eigen::Index>(columns.size()),
                          static_cast<Eigen::Index>(csv.lines.size()));
  for (std::size_t entry = 0; entry < csv.lines.size(); ++entry)
    for (std::size_t row = 0; row < columns.size(); ++row) {
      const CsvCell& cell = csv.lines[entry].cells[columns[row]];
      const double value = csv.number(csv.lines[entry], cell, names[columns[row]]);
      if (!(value >= 0.0 && std::isfinite(value)))
        csv.fail(csv.lines[entry].number, cell.column,
                 "'" + std::string(cell.text) + "' is not a finite number of at least 0");
      material.samples(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(entry)) =
          static_cast<float>(value);
    }
}

void read_brdf_list(TabulatedMaterial& material) {
  std::istringstream lines(read_file(material.table));
  std::vector<std::vector<float>> columns;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (columns.size() == kMostBrdfs)
      throw input_error(material.table.string() + ": has more than " + std::to_string(kMostBrdfs) +
                        " BRDFs, which is the limit (split the list)");
    if (!line.empty()) columns.push_back(read_merl(material.table.parent_path() / line));
  }
  if (columns.empty())
    throw input_error(material.table.string() + ": contains no file name (write one BRDF file per line)");
  material.samples.resize(static_cast<Eigen::Index>(columns.front().size()),
                          static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    material.samples.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXf>(columns[i].data(), material.samples.rows());
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

void read_index_map(const fs::path& folder, TabulatedMaterial& material) {
  const auto name =
      std::ranges::find_if(kIndexMaps, [&](const char* file) { return fs::is_regular_file(folder / file); });
  if (name == kIndexMaps.end())
    throw input_error(folder.string() + ": " + material.table.filename().string() +
                      " requires a map of its entries (add index.exr, index.png or index.tif)");
  ImageReader image(folder / *name);
  const ImageLayout& layout = image.layout();
  if (layout.channels.size() != 1)
    throw input_error(image.path().string() + ": has " + std::to_string(layout.channels.size()) +
                      " channels, but an index map must have one");
  set_size(material, layout);
  const auto entries = static_cast<double>(material.samples.cols());
  const double largest = largest_of(layout.channels[0].type);
  for (const float value : channel_values(layout, 0, texels_of(image))) {
    const double entry = std::round(static_cast<double>(value) * largest);
    const bool is_entry = entry >= 0.0 && entry < entries;  // false for NaN, too
    material.entries.push_back(is_entry ? static_cast<std::uint32_t>(entry) : kNoEntry);
  }
}

}  // namespace

bool is_tabulated_folder(const fs::path& folder) { return table_in(folder).has_value(); }

TabulatedMaterial read_tabulated_set(const fs::path& folder) {
  const auto table = table_in(folder);
  if (!table)
    throw input_error(folder.string() + ": contains no table (profiles.exr, profiles.csv or brdfs.txt)");
  TabulatedMaterial material;
  material.table = *table;
  material.name = folder.string();
  if (table->extension() == ".exr") {
    read_profile_map(material);
    return material;
  }
  if (table->extension() == ".csv")
    read_profile_table(material);
  else
    read_brdf_list(material);
  read_index_map(folder, material);
  return material;
}

}  // namespace remap
