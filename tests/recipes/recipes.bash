#!/usr/bin/env bash
# Follows the recipes of HACKING.md. Patches add a kind of fit, a stage, an option, a model and a renderer to a copy
# of the sources.
#
#   recipes.bash apply              checks that the patches fit the sources
#   recipes.bash build TEXREMAP     builds the copy and shows what was added. TEXREMAP is the program without it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
readonly here source=$here/../..

if [[ $1 == apply ]]; then
  git -C "$source" apply --check "$here"/*.patch
  exit
fi

readonly plain=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
tar -C "$source" --exclude=./build --exclude=./.git -cf - . | tar -C "$folder" -xf -
cd "$folder"
for patch in tests/recipes/*.patch; do patch --quiet -p1 <"$patch"; done
cp examples/lambert_worker.py compiler/adapters/toy.py
cp examples/blinn_phong.py compiler/adapters/

cmake --preset release -DREMAP_WARNINGS_AS_ERRORS=ON -DREMAP_BUILD_TESTS=OFF -DREMAP_BUILD_EXAMPLES=OFF >/dev/null
cmake --build --preset release --target remapc texremap >build.log || { cat build.log; exit 1; }
PATH=$folder/build/release/bin:$PATH

# says TEXT COMMAND... checks that the output of the command contains the text.
says() {
  local -r text=$1
  shift
  grep -qF -- "$text" <<<"$("$@" 2>&1)" || { echo "'$*' does not print '$text'" >&2; exit 1; }
}

echo "kind of fit"
remapc fit fits/tables/mitsuba_ward_to_mitsuba_as.csv --model line -o line >/dev/null
says "specular2 = " remapc show line/mitsuba_ward_to_mitsuba_as.json
remapc emit line/mitsuba_ward_to_mitsuba_as.json -o headers >/dev/null

echo "stage"
specular() {
  "$1" convert --from mitsuba/ward --to mitsuba/as --roughness 0.3 --specular 0.5 --json 2>/dev/null |
    python3 -c 'import json, sys; print(json.load(sys.stdin)["values"]["f0"][0])'
}
python3 - "$(specular "$plain")" "$(specular texremap)" <<'PY'
import sys
before, after = map(float, sys.argv[1:])
assert after == before / 2, (before, after)
PY

echo "option"
says "The same as --force" texremap convert --help-all
says "--again" texremap convert --from mitsuba/ward --to mitsuba/as --roughness 0.3 --specular 0.5 --again

echo "model, and renderer"
says "toy/ggx" remapc list --models
python3 compiler/adapters/check.py toy
