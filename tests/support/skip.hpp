// Tests that need something which not every machine has.
#pragma once

#include <string>

namespace remap {

// ctest runs the cases of a file as one test, and a case that may be skipped alone, so that it counts. A case
// that calls any of these functions has the tag [needs], or it is [slow]; without, it fails.
void may_skip();

// Says that the running test lacks `what`, one word as in REMAP_REQUIRE: a program, a library's data, a
// right. The caller returns, or goes on with the checks that need nothing more. A test that passes but for
// this counts as skipped and prints `skipped: WHAT: REASON`; one that fails counts as failed. Where
// REMAP_REQUIRE, names with commas between them, holds `what`, the test fails instead.
void skip(const std::string& what, const std::string& reason);

// Whether `program` can be started. Else skips.
bool has_program(const std::string& program);

// Whether the processor has AVX2 and FMA. Else skips.
bool has_avx2();

}  // namespace remap
