// Files that appear whole, and those that cannot be read.
#include "system/files.hpp"

#include <catch2/catch.hpp>

#include "support/temporary_folder.hpp"

using namespace remap;

TEST_CASE("write file: replaces the old one whole, and leaves it where it fails") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "sub" / "a.txt";
  write_file(path, "one");
  write_file(path, "two");
  CHECK(read_file(path) == "two");
  CHECK(std::distance(std::filesystem::directory_iterator(path.parent_path()), {}) == 1);
  CHECK_THROWS_WITH(write_file(path / "b.txt", "x"), Catch::Contains("folder"));
  CHECK(read_file(path) == "two");
}

TEST_CASE("read file: a folder and a missing file are told apart") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_file(folder.path()), Catch::Contains("is a folder"));
  CHECK_THROWS_WITH(read_file(folder.path() / "no"), Catch::Contains("No such file"));
}
