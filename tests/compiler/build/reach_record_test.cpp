// This file tests the recorded excess of fits. A record is used as long as its fit has not changed.
#include <catch2/catch.hpp>

#include "build/fit_folder.hpp"
#include "core/files.hpp"
#include "core/input_file.hpp"
#include "remap/error.hpp"
#include "support/temporary_folder.hpp"
#include "table/table.hpp"

using namespace remap;

TEST_CASE("reach records: are kept for fits that have not changed since") {
  const TemporaryFolder folder;
  CHECK(read_reach(folder.path()).empty());
  for (const std::string id : {"a_to_b", "b_to_a"}) write_file(folder.path() / (id + ".json"), id);
  ReachRecords records;
  records["a_to_b"] = {file_sha256(folder.path() / "a_to_b.json"), 144, 1.25e-4, 0.0123, 0.5, 0.75};
  records["b_to_a"] = {file_sha256(folder.path() / "b_to_a.json"), 144, -2e-5, 0.004, 1.0, 0.04};
  write_reach(folder.path(), records);
  const ReachRecords again = current_reach(folder.path());
  REQUIRE(again.size() == 2);
  CHECK(again.at("a_to_b").fit == records["a_to_b"].fit);
  CHECK(again.at("a_to_b").materials == 144);
  CHECK(again.at("a_to_b").mean_excess == 1.25e-4);
  CHECK(again.at("a_to_b").largest_excess == 0.0123);
  CHECK(again.at("b_to_a").alpha == 1.0);
  CHECK(again.at("b_to_a").specular == 0.04);
  write_file(folder.path() / "a_to_b.json", "another fit");
  CHECK(current_reach(folder.path()).size() == 1);
  CHECK(read_reach(folder.path()).size() == 2);
  write_file(folder.path() / kReachName, "converter,fit\na,b\n");
  CHECK_THROWS_AS(read_reach(folder.path()), Error);
}
