// This file holds the table of a sweep, which has the target's parameters for each sample of the source.
// Sweeps write it and fits read it, as a CSV file with comments that record how it was made. A table of more
// parameters than width and specular has a column for each parameter and channel, named as the models name
// them (Sztrajman et al. 2019, section 5.2: random samples; section 8).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lower/fit.hpp"
#include "table/csv.hpp"

namespace remap {

// A RowStatus states how reliable a row is, and at which limit of the target it is. Tables also call the last
// three clamped.
enum class RowStatus {
  kOk,
  kClamped,   // a target parameter is at a bound, or the source's renderer clamps its width
  kFlat,      // no highlight to match
  kUnstable,  // searches from different starts disagree
  kWide,      // alpha2 is at its limit
  kBright,    // specular2 is at its limit
  kCorner,    // alpha2 and specular2 are at their limits
};

std::string_view status_name(RowStatus status);

// Parses the status in a cell of `line`. For an unknown word, throws kInput with the place of the cell.
RowStatus read_status(const Csv& csv, const CsvLine& line, const CsvCell& cell);

struct TableRow {
  double alpha1 = 0.0;     // source width, canonical
  double specular1 = 0.0;  // source specular, linear
  double alpha2 = 0.0;     // target width, canonical
  double specular2 = 0.0;  // target specular, linear
  double error = 0.0;      // image error of the match, relative RMS; NaN if the file has none
  RowStatus status = RowStatus::kOk;
  std::size_t line = 0;   // in the file it was read from, 1-based; 0 for a new row
  double diffuse1 = 0.0;  // source diffuse, linear; used if has_diffuse
  double diffuse2 = 0.0;  // target diffuse, linear; used if has_diffuse
};

struct Table {
  std::string name;  // file name, for messages
  Comments comments;
  ModelSide source;
  ModelSide target;
  bool has_diffuse = false;  // true if rows have diffuse1 and diffuse2
  bool has_error = true;     // if false, the errors of its rows are NaN and are not written
  std::vector<TableRow> rows;
  Limits limits;                     // from comments (find_limits)
  std::vector<std::string> remarks;  // what the parser assumed, for the user
};

// A sweep records the limits of its target in these comments.
inline constexpr const char* kAlphaLimitComment = "target_alpha_limit";
inline constexpr const char* kSpecularLimitComment = "target_specular_limit";

// Returns kWide, kBright or kCorner if the row is at these limits. Otherwise, returns the status of the row.
RowStatus status_at(const TableRow& row, const Limits& limits);

// Sets the limits of a table from its comments. If the limit of alpha is known, also sets the statuses of its
// rows. Call this after making a table with limits. Parsed tables have them already. Throws kInput for a
// comment that is not a number above 0.
void find_limits(Table* table);

// These comments identify a table of named parameters (MaterialTable): the columns of each side,
// separated by commas.
inline constexpr const char* kSourceColumnsComment = "source_columns";
inline constexpr const char* kTargetColumnsComment = "target_columns";

// This comment holds the similarity of spheres: `alpha1 ssim, alpha1 ssim, ...`.
inline constexpr const char* kSpheresComment = "sphere_ssim";

// A ColumnMap holds the columns and models of a foreign table.
struct ColumnMap {
  // Maps our name of a column to its name in the file. A name that is missing here is the same in the file.
  std::map<std::string, std::string> columns;
  ModelSide source;  // if its model is empty, the comments of the file have it
  ModelSide target;
};

// Returns the column map of a preset, or of `own=file,own=file,...`. The preset `sztrajman-2019` is for the
// table that was published with the paper, from Mitsuba Ward to Ashikhmin-Shirley. `eta2` in that table is
// F0, and `k2` is a placeholder. If no map is given, the preset is used for that table. Throws kUsage for an
// unknown preset or column.
ColumnMap column_map(const std::string& text);

// Parses CSV text: UTF-8, `#` comments, then a header row, with comma, tab or semicolon as delimiter. The
// columns alpha1, specular1, alpha2 and specular2 are required. The columns error, status, and diffuse1 with
// diffuse2 are optional. Other columns are ignored. The comment `<side>_specular` names the specular
// parameter of a side. If the column holds another coordinate (F0 for an index), `<side>_specular_column`
// names this coordinate. Throws kInput with `name:line:column:` for a missing column, a bad number or status,
// a row of another length, and text without rows.
Table parse_table(std::string_view text, const std::string& name, const ColumnMap& map = {});

// Makes the table from CSV text that parse_csv has split.
Table table_from_csv(const Csv& csv, const ColumnMap& map);

Table read_table(const std::filesystem::path& path, const ColumnMap& map = {});

// Returns true if the match of the row can be used, even if it is at a limit of the target. Fits use only
// such rows.
bool has_answer(const TableRow& row);
std::vector<TableRow> answer_rows(const Table& table);

// Returns true if the source parameters of a row lie in `domain`.
bool is_inside(const TableRow& row, const Domain& domain);

// Returns the `rows` whose source parameters lie in `domain`.
std::vector<TableRow> rows_inside(const std::vector<TableRow>& rows, const Domain& domain);

// Formats a table as CSV: comments, header row, rows. It writes the diffuse columns only if has_diffuse, and
// the errors only if has_error. Parsing the text gives the same numbers.
std::string table_text(const Table& table);

// Returns what a fit records about its table. `bytes` is the content of the table's file.
TableRecord table_record(const std::filesystem::path& path, std::string_view bytes, const Comments& comments);

struct NamedRow {
  std::vector<double> source, target;  // one value for each column, in the parameters' own units
  double error = 0.0;                  // image error of the match over all channels, relative RMS
  RowStatus status = RowStatus::kOk;
  std::size_t line = 0;  // in the file it was read from, 1-based; 0 for a new row
};

struct MaterialTable {
  std::string name;                                         // file name, for messages
  Comments comments;                                        // without the two comments that list columns
  std::vector<std::string> source_columns, target_columns;  // base_color_r1, ..., roughness2
  std::vector<NamedRow> rows;
  std::vector<std::string> remarks = {};  // what the parser assumed, for the user
};

// Parses what material_table_text writes and ignores other columns. Throws kInput with `name:line:column:`.
MaterialTable parse_material_table(std::string_view text, const std::string& name);

std::string material_table_text(const MaterialTable& table);

// An AnyTable is a table of alpha and specular (remapc sweep), or of named parameters (remapc sample).
using AnyTable = std::variant<Table, MaterialTable>;

// Makes a table from CSV text in the form that its comments declare. With a comment source_columns, it is a
// MaterialTable. `map` applies only to a Table. Throws like parse_table() and parse_material_table().
AnyTable any_table(const Csv& csv, const ColumnMap& map);
// Parses text and then calls any_table().
AnyTable parse_any_table(std::string_view text, const std::string& name, const ColumnMap& map = {});

// The light of two renderers may differ. A sweep makes it equal before it compares highlights. For this, it
// multiplies the source's pictures by the factor that makes white diffuse spheres of both renderers look the
// same. This is right if only the lights differ. If diffuse lobes differ (Oren-Nayar and Lambert), it wrongly
// changes the specular of every row.
//
// These comments of a table hold the factor, the RMS difference of diffuse pictures that remains, and whether
// a user has accepted both.
inline constexpr const char* kLightScaleComment = "irradiance_scale";
inline constexpr const char* kDiffuseErrorComment = "diffuse_error";
inline constexpr const char* kLightAcceptedComment = "light_accepted";

struct LightMatch {
  double scale = 1.0;  // factor for the source's pictures, which also changes the specular of the target
  double diffuse_error = 0.0;  // relative to the source's picture
  bool accepted = false;
};

// A larger scale or difference is reported. Noise and rounding errors of renderers are smaller.
inline constexpr double kSaidLightChange = 0.01;
// A larger scale changes specular by more than the error of a fit, and most people see it.
inline constexpr double kMostLightChange = 0.05;

// Returns true if specular changes by more than kMostLightChange and nobody has accepted it.
bool is_wrong_light(const LightMatch& match);

// Returns `what is wrong (what to do)`, with the numbers, or an empty text if the light matches. Sweeps,
// checks, fits and cards all use this rule.
std::string light_remark(const LightMatch& match);

// Throws kInput with the remark, beginning with `context`, if the light is wrong.
void require_light(const LightMatch& match, const std::string& context);

// Returns the match that comments record. If they record none, the light is equal.
LightMatch light_match(const Comments& comments);

}  // namespace remap
