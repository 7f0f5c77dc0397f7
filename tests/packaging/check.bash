# Every test in this folder sources this file. It sets the arguments, makes a fresh folder to work in, and has
# functions that report errors.
set -euo pipefail
source_folder=$1
work=$2
rm -rf "$work"
mkdir -p "$work"

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_exit CODE COMMAND... checks the exit code. Both output streams go to $work/output.
expect_exit() {
  local -r expected=$1
  local status=0
  shift
  "$@" >"$work/output" 2>&1 || status=$?
  [[ $status == "$expected" ]] || fail "$*: exit code $status, expected $expected: $(cat "$work/output")"
}

# expect_output WORDS searches for the words, however the program breaks its lines (CMake does this).
expect_output() {
  tr -s ' \n' ' ' <"$work/output" | grep -qF -- "$1" || fail "expected the words \"$1\" in: $(cat "$work/output")"
}

# expected_row FIT ALPHA SPECULAR... prints converted alpha and speculars by the formula of the kind `compact`, inside
# its domain and the limits of its target.
expected_row() {
  python3 - "$@" <<'PROGRAM'
import json
import sys

mapping = json.load(open(sys.argv[1]))["mapping"]
alpha, *speculars = map(float, sys.argv[2:])
if mapping["kind"] != "compact":
    sys.exit(f"{sys.argv[1]}: is of kind {mapping['kind']}; this test knows compact")


def factor(terms, specular):
    t = specular / (specular + mapping["pole"])
    return sum(c * t**j * alpha**i for j, row in enumerate(terms) for i, c in enumerate(row))


print(f"{alpha * factor(mapping['alpha'], max(speculars)):.9g}",
      *(f"{s * factor(mapping['specular'], s):.9g}" for s in speculars))
PROGRAM
}

# expect_close "NUMBERS" "EXPECTED" checks alpha within 1e-5 and specular within 1e-4. This allows for the error of
# lowering, and for seven printed digits of inputs that are rounded to float.
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

# numbers LINE prints the numbers of "model: alpha 1, f0 2 3 4".
numbers() { sed 's/.*alpha //; s/, f0//' <<<"$1"; }
