// Catch2's own main, once for every test program, and the lines by which ctest knows skipped tests.
#define CATCH_CONFIG_MAIN
#include <cstdlib>
#include <iostream>
#include <set>

#include <catch2/catch.hpp>

#include "support/skip.hpp"

namespace {

// Of the running test case. A case may say the same several times.
std::set<std::string> reasons;

bool is_required(const std::string& what) {
  const char* required = std::getenv("REMAP_REQUIRE");
  return required != nullptr &&
         ("," + std::string(required) + ",").find("," + what + ",") != std::string::npos;
}

// Prints the reasons after a case that has not failed: ctest takes any test that prints one for skipped.
class SkipListener : public Catch::TestEventListenerBase {
 public:
  using TestEventListenerBase::TestEventListenerBase;

  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    if (stats.totals.assertions.allOk())
      for (const std::string& reason : reasons) std::cout << "skipped: " << reason << std::endl;
    reasons.clear();
  }
};
CATCH_REGISTER_LISTENER(SkipListener)

}  // namespace

namespace remap {

void skip(const std::string& what, const std::string& reason) {
  if (is_required(what)) FAIL_CHECK("REMAP_REQUIRE names " << what << ", but: " << reason);
  reasons.insert(what + ": " + reason);
}

bool has_program(const std::string& program) {
  if (std::system(("command -v '" + program + "' >/dev/null 2>&1").c_str()) == 0) return true;
  skip(program, "not installed");
  return false;
}

bool has_avx2() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return true;
#endif
  skip("avx2", "this processor has no AVX2");
  return false;
}

}  // namespace remap
