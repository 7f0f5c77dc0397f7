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
# parametric fit, inside its domain.
expected_row() {
  tr -d '\n' <"$1" | LC_ALL=C awk -v given="${*:2}" '
    function number(text, name) {
      match(text, "\"" name "\": *[-+0-9.eE]+")
      return substr(text, RSTART + length(name) + 3, RLENGTH - length(name) - 3) + 0
    }
    function phi(rate, x) { return rate == 0 ? x : (1 - exp(-rate * x)) / rate }
    function factor(term, a) {
      return number(term, "start") + number(term, "ramp") * phi(number(term, "ramp_rate"), a) \
        + number(term, "bump") * phi(number(term, "bump_rate"), a * a) + number(term, "pole") / a
    }
    {
      gsub(" ", "")
      count = split(given, value, " ")
      a = value[1]
      for (i = 2; i <= count; ++i) if (value[i] > top) top = value[i]
      match($0, "\"kind\":\"parametric\",\"roughness\":\\[\\[[^a-z]*\\]\\],")
      list = substr($0, RSTART, RLENGTH)
      sub("^[^[]*\\[\\[", "", list); sub("\\]\\],$", "", list)
      rows = split(list, row, "\\],\\[")
      for (j = 1; j <= rows; ++j) {
        n = split(row[j], c, ",")
        for (i = 1; i <= n; ++i) alpha += c[i] * a ^ i * top ^ (j - 1)
      }
      printf "%.9g", alpha
      list = substr($0, index($0, "\"specular\":[{"))
      terms = split(substr(list, 1, index(list, "]")), term, "\"power\":")
      for (i = 2; i <= count; ++i) {
        sum = 0
        for (t = 2; t <= terms; ++t) sum += factor(term[t], a) * value[i] ^ (term[t] + 0)
        printf " %.9g", (sum > 0 ? sum : 0)
      }
      printf "\n"
    }'
}

# expect_close "NUMBERS" "EXPECTED": alpha within 1e-5, specular within 1e-4, what headers are lowered to, and seven
# printed digits of inputs that are rounded to float.
expect_close() {
  LC_ALL=C awk -v found="$1" -v expected="$2" 'BEGIN {
    n = split(found, f, " ")
    if (n == 0 || n != split(expected, e, " ")) exit 1
    for (i = 1; i <= n; ++i) {
      d = f[i] - e[i]
      within = (i == 1 ? 1e-5 : 1e-4) + 2e-6
      if (!(d < within && d > -within)) exit 1
    }
  }' || fail "found $1, expected $2"
}

# numbers LINE: those of "model: alpha 1, f0 2 3 4".
numbers() { sed 's/.*alpha //; s/, f0//' <<<"$1"; }
