// This file has the main function of every test program. Its exit code is 0 if all cases passed. It is 77,
// which ctest knows by SKIP_RETURN_CODE, if some cases were skipped and the others passed. Otherwise it is 1.
#define CATCH_CONFIG_RUNNER
#include <cstdlib>
#include <iostream>
#include <set>
#include <vector>

#include <catch2/catch.hpp>

#include "support/before_cases.hpp"
#include "support/skip.hpp"

namespace {

// These are reasons to skip the running test case. A case may give the same reason several times.
std::set<std::string> reasons;
bool is_listed_alone = false;
bool any_skipped = false;

// Returns the functions that run before the first case.
std::vector<void (*)()>& works() {
  static std::vector<void (*)()> all;
  return all;
}

bool is_required(const std::string& what) {
  const char* required = std::getenv("REMAP_REQUIRE");
  return required != nullptr &&
         ("," + std::string(required) + ",").find("," + what + ",") != std::string::npos;
}

// Prints the reasons after a case that has not failed.
class SkipListener : public Catch::TestEventListenerBase {
 public:
  using TestEventListenerBase::TestEventListenerBase;

  void testCaseStarting(const Catch::TestCaseInfo& info) override {
    is_listed_alone = false;
    for (const std::string& tag : info.lcaseTags)
      is_listed_alone = is_listed_alone || tag == "needs" || tag == "slow" || tag == ".";
  }

  void testCaseEnded(const Catch::TestCaseStats& stats) override {
    if (stats.totals.assertions.allOk())
      for (const std::string& reason : reasons) std::cout << "skipped: " << reason << std::endl;
    any_skipped = any_skipped || !reasons.empty();
    reasons.clear();
  }
};
CATCH_REGISTER_LISTENER(SkipListener)

// Lists each case that is not hidden, for discover_tests.cmake: file, tags with spaces between them, name.
void list_cases(const Catch::IConfig& config) {
  for (const Catch::TestCase& test : Catch::getAllTestCasesSorted(config)) {
    if (test.isHidden()) continue;
    std::cout << test.lineInfo.file << '\t';
    for (const std::string& tag : test.lcaseTags) std::cout << ' ' << tag;
    std::cout << " \t" << test.name << '\n';
  }
}

}  // namespace

namespace remap {

void before_cases(void (*work)()) { works().push_back(work); }

void may_skip() {
  if (!is_listed_alone) FAIL_CHECK("this case may be skipped: give it the tag [needs]");
}

void skip(const std::string& what, const std::string& reason) {
  may_skip();
  if (is_required(what)) FAIL_CHECK("REMAP_REQUIRE names " << what << ", but: " << reason);
  reasons.insert(what + ": " + reason);
}

bool has_program(const std::string& program) {
  may_skip();
  if (std::system(("command -v '" + program + "' >/dev/null 2>&1").c_str()) == 0) return true;
  skip(program, "not installed");
  return false;
}

bool has_avx2() {
  may_skip();
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return true;
#endif
  skip("avx2", "this processor has no AVX2");
  return false;
}

}  // namespace remap

int main(int argc, char** argv) {
  Catch::Session session;
  if (argc == 2 && std::string(argv[1]) == "--list-for-ctest") {
    list_cases(session.config());
    return 0;
  }
  if (session.applyCommandLine(argc, argv) != 0) return 1;
  for (void (*work)() : works()) work();
  // A name that matches no case is an error, because ctest would report it as passed.
  session.configData().warnings =
      static_cast<Catch::WarnAbout::What>(session.configData().warnings | Catch::WarnAbout::NoTests);
  if (session.run() != 0) return 1;
  return any_skipped ? 77 : 0;
}
