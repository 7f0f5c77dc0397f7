# Of every test in this folder: its arguments, a fresh folder to work in, and what to say when something is wrong.
set -euo pipefail
source_folder=$1
work=$2
rm -rf "$work"
mkdir -p "$work"

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_exit CODE COMMAND...: output of both streams goes to $work/output.
expect_exit() {
  local -r expected=$1
  local status=0
  shift
  "$@" >"$work/output" 2>&1 || status=$?
  [[ $status == "$expected" ]] || fail "$*: exit code $status, expected $expected: $(cat "$work/output")"
}

# expect_output WORDS: however the program breaks its lines (CMake does).
expect_output() {
  tr -s ' \n' ' ' <"$work/output" | grep -qF -- "$1" || fail "expected the words \"$1\" in: $(cat "$work/output")"
}

# expected_row FIT ALPHA SPECULAR...: converted alpha and speculars by the formulas that `remapc show` prints for a
# parametric fit, with the coefficients of the JSON, evaluated by awk: no code of ours.
expected_row() {
  tr -d '\n' <"$1" | LC_ALL=C awk -v given="${*:2}" '
    function number(name) {
      match($0, "\"" name "\": *[-+0-9.eE]+")
      return substr($0, RSTART + length(name) + 3, RLENGTH - length(name) - 3) + 0
    }
    function phi(rate, x) { return rate == 0 ? x : (1 - exp(-rate * x)) / rate }
    {
      match($0, "\"kind\": *\"parametric\", *\"roughness\": *\\[[^]]*")
      list = substr($0, RSTART, RLENGTH)
      sub(".*\\[", "", list)
      split(list, c, ",")
      count = split(given, value, " ")
      a = value[1]
      slope = number("start") + number("ramp") * phi(number("ramp_rate"), a)
      slope += number("bump") * phi(number("bump_rate"), a * a)
      printf "%.9g", a * (c[1] + a * (c[2] + a * (c[3] + a * c[4])))
      for (i = 2; i <= count; ++i) printf " %.9g", value[i] * slope
      printf "\n"
    }'
}

# expect_close "NUMBERS" "EXPECTED": each within 2e-6: 1e-6 of the header against the fit, seven printed digits, and
# inputs that are rounded to float.
expect_close() {
  LC_ALL=C awk -v found="$1" -v expected="$2" 'BEGIN {
    n = split(found, f, " ")
    if (n == 0 || n != split(expected, e, " ")) exit 1
    for (i = 1; i <= n; ++i) { d = f[i] - e[i]; if (!(d < 2e-6 && d > -2e-6)) exit 1 }
  }' || fail "found $1, expected $2"
}

# numbers LINE: those of "model: alpha 1, f0 2 3 4".
numbers() { sed 's/.*alpha //; s/, f0//' <<<"$1"; }
