// This file tests tables of named parameters: reading and writing, their checks, and commands that refuse
// them.
#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "table/check.hpp"
#include "table/table.hpp"

using namespace remap;
using Catch::Matchers::Contains;

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
