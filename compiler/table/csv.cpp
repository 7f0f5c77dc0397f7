#include "table/csv.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <openssl/evp.h>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

constexpr std::size_t kShownText = 80;  // messages show at most this many bytes of a text

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '"')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '"' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

// Returns the delimiter that splits the header row into the most cells; a comma if none does.
char detect_delimiter(std::string_view header) {
  char best = ',';
  std::ptrdiff_t most = 0;
  for (const char candidate : {',', '\t', ';'}) {
    const std::ptrdiff_t count = std::ranges::count(header, candidate);
    if (count > most) {
      best = candidate;
      most = count;
    }
  }
  return best;
}

void require_line(const Csv& csv, std::size_t number, std::string_view line) {
  if (line.size() > kLongestCsvLine)
    csv.fail(number, 1,
             "the line has " + std::to_string(line.size()) + " bytes; at most " +
                 std::to_string(kLongestCsvLine) + " can be read");
}

// Throws if two columns have the same name, because they are ambiguous.
void require_header(const Csv& csv) {
  const std::vector<CsvCell>& cells = csv.header.cells;
  if (cells.size() > kMostCsvColumns)
    csv.fail(csv.header.number, 1,
             "the header has " + std::to_string(cells.size()) + " columns; at most " +
                 std::to_string(kMostCsvColumns) + " can be read");
  std::map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto [first, is_new] = places.emplace(cells[i].text, i);
    if (!is_new && !cells[i].text.empty())
      csv.fail(csv.header.number, cells[i].column,
               "the column " + std::string(cells[i].text) + " appears twice, as number " +
                   std::to_string(first->second + 1) + " and " + std::to_string(i + 1) + " (remove one)");
  }
}

void read_line(std::string_view line, std::size_t number, char* delimiter, Csv* csv) {
  if (csv->header.cells.empty()) {
    if (line.front() == '#') return add_comment(line, &csv->comments);
    *delimiter = detect_delimiter(line);
    csv->header = {number, split_csv_line(line, *delimiter)};
    return require_header(*csv);
  }
  if (csv->lines.size() == kMostCsvRows)
    csv->fail(number, 1,
              "the table has more than " + std::to_string(kMostCsvRows) + " rows, which is the limit");
  std::vector<CsvCell> cells = split_csv_line(line, *delimiter);
  if (cells.size() != csv->header.cells.size())
    csv->fail(number, 1,
              "the row has " + std::to_string(cells.size()) + " columns, the header " +
                  std::to_string(csv->header.cells.size()));
  csv->lines.push_back({number, std::move(cells)});
}

constexpr const char* kDigest = "sha256";  // hash of the whole_text() that was written

std::filesystem::path metadata_of(const std::filesystem::path& table) { return table.string() + ".json"; }

}  // namespace

void add_comment(std::string_view line, Comments* comments) {
  const std::size_t colon = line.find(": ");
  if (colon == std::string_view::npos || comments->size() == kMostCsvComments) return;
  // Comments become part of fits and headers, which allow no control characters.
  comments->emplace_back(plain(trimmed(line.substr(1, colon - 1)), kLongestComment),
                         plain(trimmed(line.substr(colon + 2)), kLongestComment));
}

std::string Csv::comment(const std::string& key) const {
  for (const auto& [found, value] : comments)
    if (found == key) return value;
  return "";
}

void Csv::fail(std::size_t line, std::size_t column, const std::string& what) const {
  throw input_error(plain(name + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " + what));
}

double Csv::number(const CsvLine& line, const CsvCell& cell, const std::string& column_name) const {
  const auto value = parse_number(cell.text);
  if (!value)
    fail(line.number, cell.column,
         plain(column_name, kShownText) + " is \"" + plain(cell.text, kShownText) + "\" (must be a number)");
  return *value;
}

std::vector<CsvCell> split_csv_line(std::string_view line, char delimiter) {
  std::vector<CsvCell> cells;
  std::size_t start = 0;
  for (;;) {
    const std::size_t end = std::min(line.find(delimiter, start), line.size());
    cells.push_back({trimmed(line.substr(start, end - start)), start + 1});
    if (end == line.size()) return cells;
    start = end + 1;
  }
}

Csv parse_csv(std::string_view text, const std::string& name) {
  Csv csv;
  csv.name = name;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
  char delimiter = ',';
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    require_line(csv, number, line);
    if (!trimmed(line).empty()) read_line(line, number, &delimiter, &csv);
  }
  if (csv.header.cells.empty()) throw input_error(name + ": no header row found (a CSV table is needed)");
  if (csv.lines.empty()) csv.fail(number, 1, "the table has no rows");
  return csv;
}

CsvText::CsvText(const std::string& header, const Comments& comments)
    : text_(comment_lines(comments) + header + "\n") {}

void CsvText::add(std::string_view cell) {
  const char* quote = cell.find(',') == std::string_view::npos ? "" : "\"";
  text_ += quote + std::string(cell) + quote + ",";
}

void CsvText::add(double number) { text_ += number_text(number) + ","; }

std::string file_sha256(const std::filesystem::path& path) {
  return std::filesystem::is_regular_file(path) ? sha256(read_file(path)) : std::string();
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1)
    throw numeric_error("sha256: cannot compute the digest");
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < length; ++i) {
    text += kDigits[digest[i] >> 4];
    text += kDigits[digest[i] & 15];
  }
  return text;
}

Comments parse_metadata(std::string_view json, const std::string& context) {
  const Json root = parse_json(json, context);
  const Field fields(root, context);
  fields.require(root.fields() != nullptr && root.size() <= kMostCsvComments, "an object of texts");
  Comments comments;
  for (const auto& [key, value] : *root.fields())
    comments.emplace_back(plain(key, kLongestComment), plain(fields[key].any_text(), kLongestComment));
  return comments;
}

Csv parse_table_file(std::string_view bytes, const std::filesystem::path& path) {
  Csv csv = parse_csv(bytes, path.string());
  const std::filesystem::path metadata = metadata_of(path);
  if (!csv.comments.empty() || !std::filesystem::is_regular_file(metadata)) return csv;
  csv.comments = parse_metadata(read_file(metadata), metadata.string());
  const std::string digest = csv.comment(kDigest);
  std::erase_if(csv.comments, [](const auto& comment) { return comment.first == kDigest; });
  if (!digest.empty() && digest != sha256(whole_text(csv, bytes)))
    csv.remarks.push_back(
        "warning: " + csv.name + ": " + metadata.string() +
        ", which states its models, does not belong to this table: one of them was changed");
  return csv;
}

std::string whole_text(const Csv& csv, std::string_view bytes) {
  return (csv.header.number == 1 ? comment_lines(csv.comments) : "") + std::string(bytes);
}

void require_new_table(const std::filesystem::path& path, bool force) {
  require_new(path, force);
  require_new(metadata_of(path), force);
}

void write_plain_table(const std::filesystem::path& path, std::string_view text) {
  Comments comments;
  while (text.starts_with('#')) {
    add_comment(text.substr(0, text.find('\n')), &comments);
    text.remove_prefix(text.find('\n') + 1);
  }
  write_file(path, text);
  if (comments.empty()) return;
  comments.emplace_back(kDigest, sha256(comment_lines(comments) + std::string(text)));
  Json metadata = Json::object();
  for (const auto& [key, value] : comments) metadata[key] = value;
  write_file(metadata_of(path), metadata.dump(2) + "\n");
}

}  // namespace remap
