// The table of a sweep: what the target's parameters must be for each sample of the source's. The contract
// between sweep and fit; a CSV file that a person can read and that says how it was made.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/fit.hpp"

namespace remapc {

struct Csv;
struct CsvLine;
struct CsvCell;

// How far a row can be trusted. Fits use kOk rows only.
enum class RowStatus {
  kOk,
  kClamped,   // a target parameter lies at its bound, or the source's renderer holds its width at one
  kFlat,      // no highlight to match
  kUnstable,  // searches from different starts disagree
};

std::string_view status_name(RowStatus status);

// The status in a cell of `line`. Throws kInput with its place for another word.
RowStatus read_status(const Csv& csv, const CsvLine& line, const CsvCell& cell);

struct TableRow {
  double alpha1 = 0.0;     // source width, canonical
  double specular1 = 0.0;  // source specular, linear
  double alpha2 = 0.0;     // target width, canonical
  double specular2 = 0.0;  // target specular, linear
  double error = 0.0;      // image error of the match, relative RMS; NaN where the file has none
  RowStatus status = RowStatus::kOk;
  std::size_t line = 0;   // in the file it was read from, 1-based; 0 for a new row
  double diffuse1 = 0.0;  // source diffuse, linear; of tables that have it
  double diffuse2 = 0.0;  // target diffuse, linear
};

struct Table {
  std::string name;                                           // file name, for messages
  std::vector<std::pair<std::string, std::string>> comments;  // `# key: value`, in file order
  remap::ModelSide source;
  remap::ModelSide target;
  bool has_diffuse = false;  // rows carry diffuse1 and diffuse2
  std::vector<TableRow> rows;
};

// The comments by which a table of named parameters (material_table.hpp) is known: the columns of each side,
// parted by commas.
inline constexpr const char* kSourceColumnsComment = "source_columns";
inline constexpr const char* kTargetColumnsComment = "target_columns";

// The comment that holds similarities of spheres: `alpha1 ssim, alpha1 ssim, ...`.
inline constexpr const char* kSpheresComment = "sphere_ssim";

// Which column of a foreign table holds what, and what its models are.
struct ColumnMap {
  std::map<std::string, std::string> columns;  // own name -> name in the file; missing: the same
  remap::ModelSide source;                     // model empty: taken from the comments
  remap::ModelSide target;
};

// The column map of a named preset, or of `own=file,own=file,...`.
// Preset `sztrajman-2019`: the table that the authors of the paper published, Mitsuba Ward to
// Ashikhmin-Shirley; `eta2` holds F0, `k2` is a sentinel. Throws kUsage for an unknown preset or own column.
ColumnMap column_map(const std::string& text);

// Reads CSV text: UTF-8, comma, tab or semicolon (whichever the header row has), `#` comments before it.
// Columns alpha1, specular1, alpha2, specular2 are needed; error, status, and diffuse1 with diffuse2 may be
// missing; others are ignored. The specular of a side is named by `<side>_specular_column` where the columns
// hold another coordinate than the model's own parameter (F0 for an index), else by `<side>_specular`. Throws
// kInput with `name:line:column:` for a missing column, a bad number or status, a row of another length, text
// without rows.
Table parse_table(std::string_view text, const std::string& name, const ColumnMap& map = {});

// The same from CSV text that parse_csv has split.
Table table_from_csv(const Csv& csv, const ColumnMap& map);

Table read_table(const std::filesystem::path& path, const ColumnMap& map = {});

// The rows of status ok.
std::vector<TableRow> usable_rows(const Table& table);

// Whether the source parameters of a row lie in `domain`.
bool is_inside(const TableRow& row, const remap::Domain& domain);

// Those of `rows` whose source parameters lie in `domain`.
std::vector<TableRow> rows_inside(const std::vector<TableRow>& rows, const remap::Domain& domain);

// The CSV text of a table: comments, header row, rows; diffuse columns only where it has them. Reading it
// gives the same table back, number for number.
std::string table_text(const Table& table);

// One line without its end, as table_text writes it. A sweep that is under way keeps finished rows like that.
std::string row_text(const TableRow& row, bool has_diffuse);

}  // namespace remapc
