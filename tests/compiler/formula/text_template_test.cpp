// This file tests templates of generated code: holes, and the lines that contain them.
#include "formula/text_template.hpp"

#include <stdexcept>

#include <catch2/catch.hpp>

using namespace remap;

TEST_CASE("template: holes are filled, lines of a value keep the indentation, empty lines are removed") {
  CHECK(fill_template("a @x@ b\n", {{"x", "1"}}) == "a 1 b\n");
  CHECK(fill_template("{\n  @x@\n}\n", {{"x", "one\ntwo\n"}}) == "{\n  one\n  two\n}\n");
  CHECK(fill_template("{\n  @x@\n}\n", {{"x", ""}}) == "{\n}\n");
  CHECK(fill_template("@x@@x@\n", {{"x", "@y@"}}) == "@y@@y@\n");
}

TEST_CASE("template: a hole without value and a value without hole are bugs") {
  CHECK_THROWS_AS(fill_template("@x@\n", {}), std::logic_error);
  CHECK_THROWS_AS(fill_template("x\n", {{"x", "1"}}), std::logic_error);
  CHECK_THROWS_AS(fill_template("@x\n", {{"x", "1"}}), std::logic_error);
}

TEST_CASE("template: the mark of an independent loop becomes pragmas at its indentation") {
  const std::string text = fill_template("{\n  REMAP_INDEPENDENT_LOOP\n  for (;;);\n}\n", {});
  CHECK(text.starts_with("{\n  #if defined(__clang__)\n  #pragma clang loop vectorize(assume_safety)\n"));
  CHECK(text.ends_with("\n  #endif\n  for (;;);\n}\n"));
}

TEST_CASE("template: a file of code that does not exist is a bug") {
  CHECK(code_file("frame").find("#ifndef @guard@") != std::string::npos);
  CHECK_THROWS_AS(code_file("frames"), std::logic_error);
}
