// This file tests tables, also of named parameters: reading, writing, column maps, and every error with
// its place.
#include "table/table.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "support/error_of.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"
#include "table/check.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

const std::string kHeader = "alpha1,specular1,alpha2,specular2,error,status\n";

Table parse(const std::string& text) { return parse_table(text, "t.csv"); }

}  // namespace

TEST_CASE("table: what is written is read back number for number") {
  Table table;
  table.name = "t.csv";
  table.comments = {{"source", "mitsuba/ward"},
                    {"target", "mitsuba/phong"},
                    {"target_roughness", "exponent"},
                    {"target_specular", "specular"},
                    {"note", "a: b"}};
  table.rows = {{0.1, 1.0 / 3.0, 1e-17, 123456.789, 0.0, RowStatus::kOk, 0},
                {0.2, 0.5, 0.25, 0.125, 1e300, RowStatus::kClamped, 0},
                {0.3, 0.0, 0.3, 0.0, 0.0, RowStatus::kFlat, 0},
                {0.4, 0.5, 0.3, 0.1, 0.2, RowStatus::kUnstable, 0}};
  const Table back = parse(table_text(table));
  CHECK(table_text(back) == table_text(table));
  REQUIRE(back.rows.size() == 4);
  CHECK(back.rows[0].specular1 == 1.0 / 3.0);
  CHECK(back.rows[1].status == RowStatus::kClamped);
  CHECK(back.rows[3].line == 10);
  CHECK(back.source.model == "mitsuba/ward");
  CHECK(back.target.roughness == RoughnessEncoding::kExponent);
}

TEST_CASE("table: diffuse is written where rows have it, and read back") {
  Table table;
  table.has_diffuse = true;
  table.rows = {{0.1, 0.2, 0.3, 0.4, 0.5, RowStatus::kOk, 0, 1.0 / 7.0, 0.25}};
  const std::string text = table_text(table);
  CHECK(text.starts_with("alpha1,specular1,alpha2,specular2,diffuse1,diffuse2,error,status\n"));
  const Table back = parse(text);
  CHECK(back.has_diffuse);
  CHECK(back.rows[0].diffuse1 == 1.0 / 7.0);
  CHECK(back.rows[0].diffuse2 == 0.25);
  CHECK(table_text(back) == text);
  table.has_diffuse = false;
  CHECK(table_text(table) == kHeader + "0.1,0.2,0.3,0.4,0.5,ok\n");
  CHECK_THROWS_WITH(
      parse("alpha1,specular1,alpha2,specular2,diffuse2\n1,2,3,4,5\n"),
      Catch::Contains("has a column diffuse2 but no column diffuse1 (both or neither are needed)"));
}

TEST_CASE("table: a side is named after the content of its column") {
  const Table table = parse("# source: a/b\n# source_specular: ior\n# source_specular_column: f0\n" +
                            kHeader + "0.1,0.2,0.3,0.4,0,ok\n");
  CHECK(table.source.specular == "f0");
}

TEST_CASE("table: comma, tab or semicolon is detected; spaces, quotes, BOM and CRLF are accepted") {
  for (const char delimiter : {',', '\t', ';'}) {
    std::string text =
        "\xEF\xBB\xBF# source: a/b\r\n\"alpha1\", specular1,alpha2,specular2,k2\r\n0.1, "
        "0.2,0.3,+0.4,-100\r\n\r\n";
    for (char& c : text) c = c == ',' ? delimiter : c;
    const Table table = parse(text);
    REQUIRE(table.rows.size() == 1);
    CHECK(table.rows[0].specular1 == 0.2);
    CHECK(table.rows[0].specular2 == 0.4);
    CHECK(std::isnan(table.rows[0].error));
    CHECK(table.source.model == "a/b");
  }
}

TEST_CASE("table: the published table loads by its preset and by a column map", "[needs]") {
  const auto path = shared_data("tables/mitsuba-ward2mitsuba-as.csv");
  if (path.empty()) return;
  const Table preset = read_table(path, column_map("sztrajman-2019"));
  REQUIRE(preset.rows.size() == 721);
  CHECK(preset.rows[0].alpha1 == 0.4975);
  CHECK(preset.rows[0].specular2 == 0.083393910193);
  CHECK(preset.source.model == "mitsuba/ward");
  CHECK(preset.target.specular == "f0");
  const Table mapped = read_table(path, column_map("specular2=eta2,specular1=specular1"));
  CHECK(table_text(mapped) == table_text([&] {
          Table same = preset;
          same.comments = mapped.comments;
          return same;
        }()));
  const Table recognised = read_table(path);
  CHECK(table_text(recognised) == table_text(preset));
  CHECK(recognised.target.specular == "f0");
}

TEST_CASE("table: a bad number is reported with line and column") {
  CHECK_THROWS_WITH(parse("# c: d\n" + kHeader + "0.1,0.2,0.3,0.4,0,ok\n0.1,0.2,0.3x,0.4,0,ok\n"),
                    "t.csv:4:9: alpha2 is \"0.3x\" (must be a number)");
  CHECK_THROWS_WITH(parse(kHeader + "0.1,,0.3,0.4,0,ok\n"), Catch::Contains("t.csv:2:5: specular1 is \"\""));
  CHECK_THROWS_WITH(parse(kHeader + "0.1,0.2,0.3,0.4,0,fine\n"),
                    Catch::Contains("t.csv:2:19: status is \"fine\""));
}

TEST_CASE("table: the published table is recognised by its columns and models, and says so") {
  const std::string header = "\talpha1\talpha2\tspecular1\teta2\tk2\tbsdf1\tbsdf2\n",
                    row = "0\t0.5\t0.4\t0.1\t0.08\t-100\tMitsuba-Ward\tMitsuba-Pbr-AS\n";
  const Table table = parse(header + row);
  CHECK(table.source.model == "mitsuba/ward");
  CHECK(table.target.model == "mitsuba/as");
  CHECK(table.rows[0].specular2 == 0.08);
  REQUIRE(table.remarks.size() == 1);
  CHECK_THAT(table.remarks[0], Catch::Contains("t.csv: read as the table published with the paper"));
  std::string other = row;
  other.replace(other.find("Ward"), 4, "Phong");
  CHECK_THROWS_WITH(parse(header + row + other), Catch::Contains("--columns sztrajman-2019"));
  CHECK(parse_table(header + row, "t.csv", column_map("specular2=k2")).remarks.empty());
}

TEST_CASE("table: a file is plain CSV; how it was made is beside it, and read back") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "t.csv").string();
  const std::string rows = kHeader + "0.1,0.2,0.3,0.4,0,ok\n";
  write_plain_table(path, "# source: a/b\n# note: \"c\": d\n" + rows);
  CHECK(read_file(path) == rows);
  const Table table = read_table(path);
  CHECK(table.source.model == "a/b");
  CHECK(table.comments == Comments{{"source", "a/b"}, {"note", "c\": d"}});
  CHECK(table.remarks.empty());
  CHECK(whole_text(parse_table_file(rows, path), rows) == "# source: a/b\n# note: c\": d\n" + rows);
  write_file(path, rows + "0.2,0.2,0.3,0.4,0,ok\n");
  REQUIRE(read_table(path).remarks.size() == 1);
  CHECK_THAT(read_table(path).remarks[0],
             Catch::Contains("t.csv.json, which states its models, does not belong to this table"));
  write_file(path, "# source: c/d\n" + rows);  // a table with comments ignores FILE.json
  CHECK(read_table(path).source.model == "c/d");
  CHECK_THROWS_WITH(require_new_table(path, false),
                    Catch::Contains("t.csv: already exists (--force overwrites)"));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(require_new_table(path, false), Catch::Contains("t.csv.json: already exists"));
  CHECK_NOTHROW(require_new_table(path, true));
  CHECK_THROWS_WITH(parse_metadata("[1]", "t.csv.json"),
                    Catch::Contains("t.csv.json: expected an object of texts"));
  CHECK_THROWS_WITH(parse_metadata("{\"a\": 1}", "t.csv.json"), Catch::Contains("t.csv.json: a: expected"));
}

TEST_CASE("table: a row of another length is reported") {
  CHECK_THROWS_WITH(parse(kHeader + "0.1,0.2,0.3\n"), "t.csv:2:1: the row has 3 columns, the header 6");
}

TEST_CASE("table: text without header or rows is refused") {
  CHECK_THROWS_WITH(parse(""), Catch::Contains("no header row"));
  CHECK_THROWS_WITH(parse("# a: b\n"), Catch::Contains("no header row"));
  CHECK_THROWS_WITH(parse(kHeader), Catch::Contains("no rows"));
}

TEST_CASE("column map: the error for an unknown preset or column names the nearest") {
  CHECK_THROWS_WITH(column_map("sztrajman-2018"), Catch::Contains("use sztrajman-2019"));
  CHECK_THROWS_WITH(column_map("alpa1=x"), Catch::Contains("did you mean alpha1?"));
}

TEST_CASE("csv: two columns of one name are refused, with their places") {
  CHECK_THROWS_WITH(parse_table("alpha1,specular1,alpha2,specular2,alpha2\n1,1,1,1,1\n", "t.csv"),
                    "t.csv:1:35: the column alpha2 appears twice, as number 3 and 5 (remove one)");
  CHECK_NOTHROW(parse_table("alpha1,specular1,alpha2,specular2,,\n1,1,1,1,,\n", "t.csv"));
}

TEST_CASE("csv: what is too large is refused with the limit, and no message repeats it") {
  const std::string header = "alpha1,specular1,alpha2,specular2";
  std::string wide = header, long_cell = std::string(90'000, 'x');
  for (std::size_t i = 0; i < kMostCsvColumns; ++i) wide += ",c" + std::to_string(i);
  CHECK_THROWS_WITH(parse_table(wide + "\n1,1\n", "t.csv"),
                    "t.csv:1:1: the header has 1004 columns; at most 1000 can be read");
  CHECK_THROWS_WITH(parse_table(header + "\n" + std::string(100'001, '1'), "t.csv"),
                    "t.csv:2:1: the line has 100001 bytes; at most 100000 can be read");
  std::string many = header + "\n";
  for (std::size_t i = 0; i <= kMostCsvRows; ++i) many += "1,1,1,1\n";
  CHECK_THROWS_WITH(parse_table(many, "t.csv"),
                    Catch::Contains("t.csv:2000002:1: the table has more than 2000000 rows"));
  const std::string message = error_of([&] { parse_table(header + "\n" + long_cell + ",1,1,1\n", "t.csv"); });
  CHECK((message.size() > 0 && message.size() < 200));
}

TEST_CASE("csv: control characters of comments and cells are shown as escapes") {
  const std::string header = "alpha1,specular1,alpha2,specular2\n";
  const Table table = parse_table("# source: a\tb\x1b[2J\xe2\x80\xae\n" + header + "1,1,1,1\n", "t.csv");
  CHECK(table.comments.front().second == "a\\x09b\\x1b[2J\\u202e");
  CHECK_THROWS_WITH(parse_table(header + std::string("1,\0,1,1\n", 8), "t.csv"),
                    Catch::Contains("specular1 is \"\\x00\" (must be a number)"));
}

TEST_CASE("table: a clamped row belongs to the limits of the target that it is at") {
  const std::string limits = "# target_alpha_limit: 0.9\n# target_specular_limit: 1\n";
  const std::string rows =
      "alpha1,specular1,alpha2,specular2,status\n0.5,0.5,0.3,0.3,ok\n0.5,0.5,0.9,0.3,clamped\n"
      "0.5,0.5,0.3,1,clamped\n0.5,0.5,0.9,1,clamped\n0.5,0.5,0.3,0,clamped\n0.5,0.5,0.9,0.3,flat\n"
      "0.5,0.5,0.9,0.3,unstable\n";
  const Table table = parse_table(limits + rows, "t.csv");
  std::vector<RowStatus> found;
  for (const TableRow& row : table.rows) found.push_back(row.status);
  CHECK(found == std::vector{RowStatus::kOk, RowStatus::kWide, RowStatus::kBright, RowStatus::kCorner,
                             RowStatus::kClamped, RowStatus::kFlat, RowStatus::kUnstable});
  CHECK(answer_rows(table).size() == 4);
  CHECK(table_text(table).find(rows.substr(rows.find("0.5"), 16)) != std::string::npos);
  CHECK(answer_rows(parse_table(rows, "t.csv")).size() == 1);  // the limits are unknown
  const Table wide = parse_table("# target_alpha_limit: 0.9\n" + rows, "t.csv");
  CHECK(wide.limits.alpha == 0.9);
  CHECK_FALSE(wide.limits.specular.has_value());
  CHECK(wide.rows[3].status == RowStatus::kWide);
  CHECK_THROWS_WITH(parse_table("# target_alpha_limit: -1\n" + rows, "t.csv"),
                    Catch::Contains("t.csv") && Catch::Contains("a number above 0"));
}

namespace {

// Returns `count` different rows of two source columns.
MaterialTable material_table(std::size_t count) {
  MaterialTable table;
  table.name = "n.csv";
  table.comments = {{"source", "a/b"}, {"seed", "7"}};
  table.source_columns = {"metallic1", "roughness1"};
  table.target_columns = {"f0_r2", "roughness2"};
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / 7.0;
    table.rows.push_back({{share, 1.0 - share}, {share / 3.0, 1e-17}, 0.25, RowStatus::kOk, 0});
  }
  return table;
}

std::vector<std::string> kinds(const std::vector<Finding>& findings) {
  std::vector<std::string> kinds;
  for (const Finding& finding : findings) kinds.push_back(finding.kind);
  return kinds;
}

}  // namespace

TEST_CASE("material table: what is written is read back number for number") {
  MaterialTable table = material_table(3);
  table.rows[1].status = RowStatus::kClamped;
  const std::string text = material_table_text(table);
  CHECK_THAT(text, Contains("# source_columns: metallic1,roughness1\n# target_columns: f0_r2,roughness2\n"
                            "metallic1,roughness1,f0_r2,roughness2,error,status\n"));
  CHECK(std::holds_alternative<MaterialTable>(parse_any_table(text, "n.csv")));
  const MaterialTable back = parse_material_table(text, "n.csv");
  CHECK(back.comments == table.comments);
  CHECK(back.source_columns == table.source_columns);
  CHECK(back.rows[2].target == table.rows[2].target);
  CHECK(back.rows[1].status == RowStatus::kClamped);
  CHECK(back.rows[1].line == 7);
  CHECK(material_table_text(back) == text);
}

TEST_CASE("material table: errors name the place") {
  CHECK_THROWS_WITH(parse_material_table("# source_columns: a1\n# target_columns: b2\na1,b2,error,status\n"
                                         "0.5,x,0,ok\n",
                                         "n.csv"),
                    "n.csv:4:5: b2 is \"x\" (must be a number)");
  CHECK_THROWS_WITH(parse_material_table(
                        "# source_columns: a1,c1\n# target_columns: b2\na1,b2,error,status\n1,2,0,ok\n", "n"),
                    "n:3:1: has no column c1, which the comments name");
  CHECK_THROWS_WITH(parse_material_table("a1,b2,error,status\n1,2,0,ok\n", "n"),
                    Contains("has no comment source_columns"));
}

TEST_CASE("material table: commands that need width and specular refuse it") {
  CHECK_THROWS_WITH(
      parse_table(material_table_text(material_table(2)), "n.csv"),
      Contains(
          "n.csv:5:1: this command needs the columns alpha1, specular1, alpha2, specular2 of remapc sweep; "
          "the table has named parameters (metallic1,roughness1)"));
  CHECK(std::holds_alternative<Table>(
      parse_any_table("alpha1,specular1,alpha2,specular2\n1,2,3,4\n", "t.csv")));
}

TEST_CASE("material table: the check finds each fault") {
  CHECK(check_table(material_table(20)).empty());
  CHECK(kinds(check_table(material_table(19))) == std::vector<std::string>{"rows"});
  MaterialTable table = material_table(21);
  table.rows[20].source = table.rows[0].source;
  CHECK(kinds(check_table(table)) == std::vector<std::string>{"contradiction"});
  table.rows[20].target = table.rows[0].target;
  CHECK(kinds(check_table(table)) == std::vector<std::string>{"duplicate"});
  table = material_table(21);
  table.rows[3].status = RowStatus::kUnstable;
  CHECK(kinds(check_table(table)) == std::vector<std::string>{"saturation"});
  table.rows[3].target[0] = std::numeric_limits<double>::infinity();
  CHECK(kinds(check_table(table)) == std::vector<std::string>{"range", "saturation"});
  table = material_table(20);
  for (std::size_t i = 0; i < 20; ++i) table.rows[i].source = {0.5, static_cast<double>(i)};
  CHECK(kinds(check_table(table)) == std::vector<std::string>{"gap"});
}
