# Tests the lines that scripts/demo, scripts/test and .ci/run print. They must be short after success and detailed
# after failure, from any folder.
source "$(dirname "$0")/check.bash"
cd "$work"

script() {
  printf 'set -euo pipefail\nsource "%s/scripts/lib/steps.bash"\nlog="%s/log"\n%s\n' "$source_folder" "$work" "$1" >"$work/script"
  bash "$work/script"
}

expect_exit 0 script 'step "Talk a lot" seq 1000; [[ $PWD == "$repository" ]]'
grep -qE '^Talk a lot +[0-9]+\.[0-9] s$' "$work/output" || fail "a step is not one line: $(cat "$work/output")"
(($(wc -l <"$work/output") == 1)) || fail "a step that succeeds shows its output"
grep -qx 1000 "$work/log" || fail "the output of a step is not in the log"

expect_exit 7 script 'step "Break" bash -c "echo the reason >&2; exit 7"; echo went on'
expect_output "the reason"
expect_output "Failed: Break (exit code 7); the whole log: $work/log"
! grep -q "went on" "$work/output" || fail "a script goes on after a failed step"

# A step must not wait for somebody to type.
expect_exit 0 script 'step "Read" bash -c "! read -r line"'

printf '{\n  "rms": 0.25,\n  "max": 1e-06,\n  "rms": -3\n}\n' >"$work/numbers.json"
expect_exit 0 script "json_number $work/numbers.json rms; json_number $work/numbers.json max; json_number $work/numbers.json rms 2"
[[ $(xargs <"$work/output") == "0.25 1e-06 -3" ]] || fail "numbers are misread: $(cat "$work/output")"

# This is a folder of tests in the form that ctest reads, one of each kind.
mkdir tests
cat >tests/CTestTestfile.cmake <<'CMAKE'
add_test(good true)
add_test(bad false)
add_test(skipped bash -c "echo 'skipped: gnuplot: not installed'; exit 77")
set_tests_properties(skipped PROPERTIES SKIP_RETURN_CODE 77)
CMAKE
(cd tests && ctest >"$work/ctest_log" 2>&1) && fail "ctest passes though a test fails"
expect_exit 0 script "count_tests $work/ctest_log; skip_reasons $work/tests/Testing/Temporary/LastTest.log"
expect_output "1 1 1 Skipped (tests, reason): 1 gnuplot: not installed"
expect_exit 0 script "count_tests /dev/null"
expect_output "0 1 0"
expect_exit 2 "$source_folder/scripts/test" quik
expect_output "unknown argument 'quik'; try --help"

# Warnings are only errors where remap is tested, because newer compilers have more warnings.
expect_exit 0 script 'cmake() { echo "cmake $*"; }; cmake_options=(-DREMAP_WARNINGS_AS_ERRORS=ON); build_preset release texremap'
expect_output "cmake --preset release -DREMAP_WARNINGS_AS_ERRORS=ON"
expect_output "cmake --build --preset release --target texremap"
! grep -q WARNINGS_AS_ERRORS "$source_folder/CMakePresets.json" || fail "a preset makes errors of warnings"
