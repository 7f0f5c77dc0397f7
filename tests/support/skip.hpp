// This file serves tests that need something which some machines lack.
#pragma once

#include <string>

namespace remap {

// ctest runs the cases of a file as one test. But it runs a case that may be skipped separately, so that the
// skip is reported. A case that calls any of these functions must have the tag [needs] or [slow]. Otherwise
// it fails.
void may_skip();

// Records that the running test lacks `what`, one word as in REMAP_REQUIRE: a program, a library's data, a
// right. The caller returns, or continues with the checks that need nothing more. If the test passes
// otherwise, it is reported as skipped and prints `skipped: WHAT: REASON`. If REMAP_REQUIRE, a list of names
// with commas, contains `what`, the test fails instead.
void skip(const std::string& what, const std::string& reason);

// Returns true if `program` can be started. Otherwise skips.
bool has_program(const std::string& program);

// Returns true if the processor has AVX2 and FMA. Otherwise skips.
bool has_avx2();

}  // namespace remap
