# The lines that scripts/demo, scripts/test and .ci/run are made of: quiet about success, loud about failure, from
# any folder.
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

# A step never waits for somebody to type.
expect_exit 0 script 'step "Read" bash -c "! read -r line"'

printf '{\n  "rms": 0.25,\n  "max": 1e-06,\n  "rms": -3\n}\n' >"$work/numbers.json"
expect_exit 0 script "json_number $work/numbers.json rms; json_number $work/numbers.json max; json_number $work/numbers.json rms 2"
[[ $(xargs <"$work/output") == "0.25 1e-06 -3" ]] || fail "numbers are misread: $(cat "$work/output")"
