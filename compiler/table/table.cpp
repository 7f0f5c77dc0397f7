#include "table/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// These names are in the order of RowStatus.
constexpr std::array<std::string_view, 7> kStatusNames = {"ok",      "clamped", "flat",   "unstable",
                                                          "clamped", "clamped", "clamped"};
constexpr double kSameLimit = 1e-8;  // relative difference, because tables hold ten digits
const std::array<std::string, 8> kColumns = {"alpha1",   "specular1", "alpha2", "specular2",
                                             "diffuse1", "diffuse2",  "error",  "status"};
constexpr std::size_t kRequiredColumns = 4;
constexpr const char* kPublished = "sztrajman-2019";
constexpr std::size_t kDiffuse1 = 4, kDiffuse2 = 5, kError = 6, kStatus = 7;

// Returns true if this is the table that was published with the paper. Its columns and models identify it.
bool is_published(const Csv& csv) {
  const auto holds = [&](std::string_view column, std::string_view word) {
    const auto found = std::ranges::find(csv.header.cells, column, &CsvCell::text);
    const auto place = static_cast<std::size_t>(found - csv.header.cells.begin());
    return found != csv.header.cells.end() && std::ranges::all_of(csv.lines, [&](const CsvLine& line) {
             return word.empty() || line.cells[place].text == word;
           });
  };
  return holds("bsdf1", "Mitsuba-Ward") && holds("bsdf2", "Mitsuba-Pbr-AS") && holds("eta2", "") &&
         !holds("specular2", "");
}

constexpr std::size_t kMissing = std::numeric_limits<std::size_t>::max();
using Places = std::array<std::size_t, kColumns.size()>;  // of kColumns in a line of the file

[[noreturn]] void fail_without(const Csv& csv, const std::string& wanted) {
  if (const std::string columns = csv.comment(kSourceColumnsComment); !columns.empty())
    csv.fail(csv.header.number, 1,
             "this command needs the columns alpha1, specular1, alpha2, specular2 of remapc sweep; the "
             "table has named parameters (" +
                 columns + ")");
  std::vector<std::string> found;
  for (const CsvCell& cell : csv.header.cells) found.emplace_back(cell.text);
  if (found.size() == 1)
    csv.fail(
        csv.header.number, 1,
        "the header row has one column, \"" + found[0] + "\" (separate columns by comma, tab or semicolon)");
  std::string remedy = suggestion(wanted, found);
  remedy.back() = ';';
  csv.fail(csv.header.number, 1,
           "has no column " + wanted + remedy + " --columns " + wanted +
               "=NAME reads another column, --columns " + kPublished + " reads the table of the paper)");
}

Places places_of(const Csv& csv, const ColumnMap& map) {
  const std::vector<CsvCell>& cells = csv.header.cells;
  Places places{};
  places.fill(kMissing);
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto renamed = map.columns.find(kColumns[i]);
    const std::string& wanted = renamed == map.columns.end() ? kColumns[i] : renamed->second;
    for (std::size_t j = 0; j < cells.size(); ++j)
      if (cells[j].text == wanted) places[i] = j;
    if (places[i] == kMissing && i < kRequiredColumns) fail_without(csv, wanted);
  }
  const bool source = places[kDiffuse1] != kMissing, target = places[kDiffuse2] != kMissing;
  if (source != target)
    csv.fail(csv.header.number, 1,
             "has a column " + kColumns[source ? kDiffuse1 : kDiffuse2] + " but no column " +
                 kColumns[source ? kDiffuse2 : kDiffuse1] + " (both or neither are needed)");
  return places;
}

TableRow row_of(const Csv& csv, const Places& places, const CsvLine& line) {
  const auto number = [&](std::size_t column) {
    return csv.number(line, line.cells[places[column]], kColumns[column]);
  };
  TableRow row;
  row.line = line.number;
  row.alpha1 = number(0);
  row.specular1 = number(1);
  row.alpha2 = number(2);
  row.specular2 = number(3);
  if (places[kDiffuse1] != kMissing) {
    row.diffuse1 = number(kDiffuse1);
    row.diffuse2 = number(kDiffuse2);
  }
  row.error = places[kError] != kMissing ? number(kError) : std::numeric_limits<double>::quiet_NaN();
  if (places[kStatus] != kMissing) row.status = read_status(csv, line, line.cells[places[kStatus]]);
  return row;
}

// Returns the side that the comments name, unless it is given.
ModelSide side_of(const Csv& csv, const std::string& role, const ModelSide& given) {
  if (!given.model.empty()) return given;
  ModelSide side;
  side.model = csv.comment(role);
  if (const std::string text = csv.comment(role + "_roughness"); !text.empty()) {
    const auto convention = encoding_from_name(text);
    if (!convention)
      throw input_error(csv.name + ": " + role + "_roughness: unknown convention \"" + text + "\"" +
                        suggestion(text, convention_names()));
    side.roughness = *convention;
  }
  for (const char* suffix : {"_specular", "_specular_column"})
    if (const std::string text = csv.comment(role + suffix); !text.empty()) side.specular = text;
  return side;
}

std::optional<double> limit_in(const Table& table, const std::string& key) {
  for (const auto& [found, value] : table.comments) {
    if (found != key) continue;
    const auto limit = parse_number(value);
    if (!limit || !(*limit > 0.0))
      throw input_error(table.name + ": the comment " + key + " is \"" + value +
                        "\" (must be a number above 0)");
    return limit;
  }
  return std::nullopt;
}

std::vector<std::string> split_names(const std::string& text) {
  std::vector<std::string> names;
  for (const CsvCell& cell : split_csv_line(text, ',')) names.emplace_back(cell.text);
  return names;
}

std::size_t place_of(const Csv& csv, const std::string& column) {
  for (std::size_t i = 0; i < csv.header.cells.size(); ++i)
    if (csv.header.cells[i].text == column) return i;
  csv.fail(csv.header.number, 1, "has no column " + column + ", which the comments name");
}

std::vector<std::size_t> places_of(const Csv& csv, const std::vector<std::string>& columns) {
  std::vector<std::size_t> places;
  for (const std::string& column : columns) places.push_back(place_of(csv, column));
  return places;
}

MaterialTable material_table_from_csv(const Csv& csv) {
  MaterialTable table;
  table.name = csv.name;
  table.remarks = csv.remarks;
  for (const auto& comment : csv.comments)
    if (comment.first != kSourceColumnsComment && comment.first != kTargetColumnsComment)
      table.comments.push_back(comment);
  for (const char* key : {kSourceColumnsComment, kTargetColumnsComment})
    if (csv.comment(key).empty())
      csv.fail(csv.header.number, 1,
               std::string("has no comment ") + key + " (it must list the names of columns)");
  table.source_columns = split_names(csv.comment(kSourceColumnsComment));
  table.target_columns = split_names(csv.comment(kTargetColumnsComment));
  const auto sources = places_of(csv, table.source_columns), targets = places_of(csv, table.target_columns);
  const std::size_t error = place_of(csv, "error"), status = place_of(csv, "status");
  for (const CsvLine& line : csv.lines) {
    NamedRow row;
    const auto number = [&](std::size_t place) {
      return csv.number(line, line.cells[place], std::string(csv.header.cells[place].text));
    };
    for (const std::size_t place : sources) row.source.push_back(number(place));
    for (const std::size_t place : targets) row.target.push_back(number(place));
    row.error = number(error);
    row.status = read_status(csv, line, line.cells[status]);
    row.line = line.number;
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string change_text(double scale) {
  return percent(std::fabs(scale - 1.0)) + (scale > 1.0 ? " larger" : " smaller");
}

}  // namespace

std::string_view status_name(RowStatus status) { return kStatusNames[static_cast<std::size_t>(status)]; }

RowStatus read_status(const Csv& csv, const CsvLine& line, const CsvCell& cell) {
  for (std::size_t i = 0; i < kStatusNames.size(); ++i)
    if (kStatusNames[i] == cell.text) return static_cast<RowStatus>(i);
  csv.fail(line.number, cell.column,
           "status is \"" + std::string(cell.text) + "\" (must be ok, clamped, flat or unstable)");
}

ColumnMap column_map(const std::string& text) {
  ColumnMap map;
  if (text == kPublished) {
    map.columns = {{"specular2", "eta2"}};
    map.source = {"mitsuba/ward", RoughnessEncoding::kAlpha, "specular"};
    map.target = {"mitsuba/as", RoughnessEncoding::kAlpha, "f0"};
    return map;
  }
  if (text.find('=') == std::string::npos)
    throw usage_error("--columns: unknown preset '" + text + "' (use sztrajman-2019, or OWN=FILE pairs)");
  for (const CsvCell& cell : split_csv_line(text, ',')) {
    const std::size_t equals = cell.text.find('=');
    const std::string own(cell.text.substr(0, equals));
    if (equals == std::string_view::npos || std::ranges::find(kColumns, own) == kColumns.end())
      throw usage_error("--columns: cannot read \"" + std::string(cell.text) + "\" as OWN=FILE" +
                        suggestion(own, kColumns));
    map.columns[own] = std::string(cell.text.substr(equals + 1));
  }
  return map;
}

Table parse_table(std::string_view text, const std::string& name, const ColumnMap& map) {
  return table_from_csv(parse_csv(text, name), map);
}

Table table_from_csv(const Csv& csv, const ColumnMap& given) {
  Table table;
  table.remarks = csv.remarks;
  ColumnMap map = given;
  if (map.columns.empty() && is_published(csv)) {
    map = column_map(kPublished);
    table.remarks.push_back(csv.name + ": read as the table published with the paper (" + kPublished +
                            "): mitsuba/ward to mitsuba/as, eta2 is F0");
  }
  table.name = csv.name;
  table.comments = csv.comments;
  const Places places = places_of(csv, map);
  table.has_diffuse = places[kDiffuse1] != kMissing;
  table.has_error = places[kError] != kMissing;
  for (const CsvLine& line : csv.lines) table.rows.push_back(row_of(csv, places, line));
  table.source = side_of(csv, "source", map.source);
  table.target = side_of(csv, "target", map.target);
  find_limits(&table);
  return table;
}

Table read_table(const std::filesystem::path& path, const ColumnMap& map) {
  const std::string bytes = read_file(path);
  return table_from_csv(parse_table_file(bytes, path), map);
}

RowStatus status_at(const TableRow& row, const Limits& limits) {
  if (row.status != RowStatus::kClamped) return row.status;
  const bool is_wide = row.alpha2 >= limits.alpha * (1.0 - kSameLimit);
  const bool is_bright = limits.specular && row.specular2 >= *limits.specular * (1.0 - kSameLimit);
  if (is_wide) return is_bright ? RowStatus::kCorner : RowStatus::kWide;
  return is_bright ? RowStatus::kBright : RowStatus::kClamped;
}

void find_limits(Table* table) {
  const std::optional<double> alpha = limit_in(*table, kAlphaLimitComment);
  table->limits = {alpha.value_or(1.0), limit_in(*table, kSpecularLimitComment)};
  if (!alpha) return;
  for (TableRow& row : table->rows) row.status = status_at(row, table->limits);
}

bool has_answer(const TableRow& row) {
  return row.status == RowStatus::kOk || row.status >= RowStatus::kWide;
}

std::vector<TableRow> answer_rows(const Table& table) {
  std::vector<TableRow> rows;
  std::ranges::copy_if(table.rows, std::back_inserter(rows), has_answer);
  return rows;
}

bool is_inside(const TableRow& row, const Domain& domain) {
  return domain.alpha.contains(row.alpha1) && domain.specular.contains(row.specular1);
}

std::vector<TableRow> rows_inside(const std::vector<TableRow>& rows, const Domain& domain) {
  std::vector<TableRow> inside;
  for (const TableRow& row : rows)
    if (is_inside(row, domain)) inside.push_back(row);
  return inside;
}

std::string table_text(const Table& table) {
  std::string header;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if ((!table.has_diffuse && (i == kDiffuse1 || i == kDiffuse2)) || (!table.has_error && i == kError))
      continue;
    header += (i == 0 ? "" : ",") + kColumns[i];
  }
  CsvText csv(header, table.comments);
  for (const TableRow& row : table.rows) {
    std::vector<double> values = {row.alpha1, row.specular1, row.alpha2, row.specular2};
    if (table.has_diffuse) values.insert(values.end(), {row.diffuse1, row.diffuse2});
    if (table.has_error) values.push_back(row.error);
    csv.add_row(values, status_name(row.status));
  }
  return csv.text();
}

TableRecord table_record(const std::filesystem::path& path, std::string_view bytes,
                         const std::vector<std::pair<std::string, std::string>>& comments) {
  TableRecord record{path.filename().string(), sha256(bytes), {}};
  for (const auto& [key, value] : comments) record.comments[key] = value;
  return record;
}

MaterialTable parse_material_table(std::string_view text, const std::string& name) {
  return material_table_from_csv(parse_csv(text, name));
}

std::string material_table_text(const MaterialTable& table) {
  const std::string sources = joined(table.source_columns, ","), targets = joined(table.target_columns, ",");
  Comments comments = table.comments;
  comments.emplace_back(kSourceColumnsComment, sources);
  comments.emplace_back(kTargetColumnsComment, targets);
  CsvText csv(sources + "," + targets + ",error,status", comments);
  for (const NamedRow& row : table.rows)
    csv.add_row(row.source, row.target, row.error, status_name(row.status));
  return csv.text();
}

AnyTable parse_any_table(std::string_view text, const std::string& name, const ColumnMap& map) {
  return any_table(parse_csv(text, name), map);
}

AnyTable any_table(const Csv& csv, const ColumnMap& map) {
  if (csv.comment(kSourceColumnsComment).empty()) return table_from_csv(csv, map);
  return material_table_from_csv(csv);
}

bool is_wrong_light(const LightMatch& match) {
  return std::fabs(match.scale - 1.0) > kMostLightChange && !match.accepted;
}

std::string light_remark(const LightMatch& match) {
  const double change = std::fabs(match.scale - 1.0);
  if (!(change > kSaidLightChange || match.diffuse_error > kSaidLightChange)) return "";
  const std::string left = "the diffuse pictures differ by " + percent(match.diffuse_error);
  if (!(change > kSaidLightChange)) return left + " (this does not change specular)";
  std::string remark = "diffuse matches only if the light of the source is multiplied by " +
                       number_text(rounded(match.scale, 4)) + " (" + left +
                       " after that). Therefore, specular2 is " + change_text(match.scale) +
                       ", which is right only if the two renderers have different light";
  if (is_wrong_light(match))
    remark +=
        " (check the diffuse of both models; --no-irradiance-matching keeps the light unchanged, "
        "--accept-light continues anyway)";
  return remark;
}

void require_light(const LightMatch& match, const std::string& context) {
  if (is_wrong_light(match)) throw input_error(context + ": " + light_remark(match));
}

LightMatch light_match(const Comments& comments) {
  LightMatch match;
  for (const auto& [key, value] : comments) {
    const double number = parse_number(value).value_or(0.0);
    if (key == kLightScaleComment && number > 0.0) match.scale = number;
    if (key == kDiffuseErrorComment) match.diffuse_error = number;
    if (key == kLightAcceptedComment) match.accepted = value == "yes";
  }
  return match;
}

}  // namespace remap
