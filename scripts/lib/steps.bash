# scripts/demo, scripts/test and .ci/run source this file. It prints one line per step on the terminal, and writes
# everything else to a log file. It shows the end of the log when a step fails.

repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$repository"
log=/dev/null
cmake_options=()  # options for build_preset
last_seconds=0.0

# open_log NAME makes all following steps write to build/logs/NAME.log.
open_log() {
  log=$repository/build/logs/$1.log
  mkdir -p "${log%/*}"
  : >"$log"
}

microseconds() { echo "${EPOCHREALTIME//[!0-9]/}"; }

# seconds_since MICROSECONDS prints seconds with one decimal.
seconds_since() {
  local -r tenths=$((($(microseconds) - $1) / 100000))
  echo "$((tenths / 10)).$((tenths % 10))"
}

# step TITLE COMMAND [ARGUMENT...] runs a step, and stores its time in last_seconds.
step() {
  local -r title=$1 start=$(microseconds)
  local status=0
  shift
  printf '%-52s' "$title"
  printf '\n== %s: %s\n' "$title" "$*" >>"$log"
  "$@" </dev/null >>"$log" 2>&1 || status=$?
  last_seconds=$(seconds_since "$start")
  if [[ $status == 0 ]]; then
    printf '%8s s\n' "$last_seconds"
  else
    printf '  failed\n'
    tail -n 30 "$log" >&2
    echo "Failed: $title (exit code $status); the whole log: $log" >&2
  fi
  return "$status"
}

# save_output FILE COMMAND... runs a step whose standard output is a result.
save_output() {
  local -r file=$1
  shift
  "$@" >"$file"
}

# json_number FILE KEY [N] prints the Nth number (default: first) of the key KEY. Each number must be on a separate
# line.
json_number() {
  sed -n 's/.*"'"$2"'": *\(-\{0,1\}[0-9][0-9.eE+-]*\).*/\1/p' "$1" | sed -n "${3:-1}p"
}

# build_preset PRESET [TARGET...] configures and builds. Without a target it builds all.
build_preset() {
  local -r preset=$1
  shift
  cmake --preset "$preset" "${cmake_options[@]}" && cmake --build --preset "$preset" ${1:+--target "$@"}
}

# run_tests PRESET [CTEST_OPTION...] shows failures, ctest's summary and why tests were skipped. Passed and skipped tests
# are only in the log.
run_tests() {
  # Many tests wait for files and processes, so more of them run than there are processors.
  local -ri tests_at_once=$((2 * $(nproc)))
  local -r preset=$1 hidden='^ *(Start +[0-9]+:|[0-9]+/[0-9]+ +Test +#[0-9]+:.*( Passed |\*\*\*Skipped ))'
  local -a statuses
  shift
  echo "Testing (preset $preset${*:+, $*})"
  ctest --preset "$preset" --parallel "$tests_at_once" --no-label-summary "$@" </dev/null 2>&1 | tee -a "$log" |
    grep -vE "$hidden" && statuses=(0) || statuses=("${PIPESTATUS[@]}")
  skip_reasons "build/$preset/Testing/Temporary/LastTest.log" | tee -a "$log"
  return "${statuses[0]}"
}

# skip_reasons CTEST_LOG prints why tests were skipped, each reason with the number of tests. It prints nothing if none was.
skip_reasons() {
  sed -n 's/^skipped: //p' "$1" | sort | uniq -c | sort -rn | sed '1i Skipped (tests, reason):'
}

# count_tests LOG prints "PASSED FAILED SKIPPED" of the last run of tests in a log. A log without a summary is treated
# as one failure.
count_tests() {
  local summary
  summary=$(sed -n 's/.*tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1 \2/p' "$1" | tail -n 1)
  local -r failed=${summary% *} total=${summary#* }
  local -r skipped=$(grep -cE '^ *[0-9]+/[0-9]+ +Test +#[0-9]+:.*\*\*\*Skipped ' "$1")
  if [[ -z $summary ]]; then
    echo "0 1 0"
  else
    echo "$((total - failed - skipped)) $failed $skipped"
  fi
}
