#!/usr/bin/env bash
# commands.bash FOLDER PROGRAM... tests what texremap can do without images: the self-tests of every converter, paths,
# numbers, factors of materials, journals, parts, and refusals. PROGRAM is the command that runs texremap.
set -euo pipefail
repository=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
program=("${@:1:$#-1}" "$(realpath "${@: -1}")")
cases=0
rm -rf "${folder:?}"/*
cd "$folder"

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# Windows ends lines with two characters, and writes folders with backslashes.
run() {
  local status=0
  "${program[@]}" "$@" >output 2>&1 || status=$?
  tr -d '\r' <output | tr '\\' / >text
  return "$status"
}

# expect CODE TEXT WORDS... checks that texremap WORDS ends with CODE and prints TEXT.
expect() {
  local -r code=$1 text=$2
  local status=0
  shift 2
  run "$@" || status=$?
  [[ $status == "$code" ]] || fail "texremap $*: exit code $status, expected $code: $(cat text)"
  grep -qF -- "$text" text || fail "texremap $*: expected \"$text\" in: $(cat text)"
  ((cases += 1))
}

expect 0 "texremap $(sed -n 's/^project(remap VERSION \([0-9.]*\).*/\1/p' "$repository/CMakeLists.txt")" --version
expect 0 "libraries: CLI11 " --version
expect 0 "mitsuba_ward_to_mitsuba_ggx" list
expect 0 '"self_test": true' list --pairs --json
! grep -F '"self_test": false' text || fail "a converter fails its self-test"
expect 0 "rendered pictures differ by 8.2 % (12.8 % with copied numbers)" path --from mitsuba/ward --to mitsuba/ggx
expect 0 "alpha 0.223668" convert --from mitsuba/ward --to mitsuba/ggx --roughness 0.3 --specular 0.04
grep -qx "f0 0.0210798" text || fail "numbers: expected f0 0.0210798 in: $(cat text)"
expect 0 "metallic 0.0629479" convert --from gltf-specgloss --to gltf --diffuse 0.1,0.2,0.3 --specular 0.04,0.05,0.06 \
  --glossiness 0.7

# This material has only factors.
cat >model.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_pbrSpecularGlossiness"], "materials": [
 {"name": "paint", "extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 1.0], "specularFactor": [0.5, 0.4, 0.3], "glossinessFactor": 0.7}}}]}
GLTF
cat >expected.gltf <<'GLTF'
{"asset": {"version": "2.0"}, "materials": [
 {"name": "paint", "pbrMetallicRoughness": {"baseColorFactor":[0.4888752,0.49199563,0.4951161,1.0],"metallicFactor":0.7812724,"roughnessFactor":0.3}}]}
GLTF
expect 0 "1 material converted" convert model.gltf --to gltf -o out
cmp out/model.gltf expected.gltf || fail "model.gltf: other bytes than expected"
expect 1 "already exists (--force overwrites)" convert model.gltf --to gltf -o out
expect 0 "1 material converted" convert model.gltf --to gltf -o out --force
cmp out/model.gltf expected.gltf || fail "model.gltf by --force: other bytes than expected"
expect 0 "nothing looks wrong" check model.gltf
mkdir -p tree/deeper
cp model.gltf tree/deeper
expect 0 "1 asset" convert tree --recursive --assets --to gltf -o tree_out
cmp tree_out/deeper/model.gltf expected.gltf || fail "deeper/model.gltf: other bytes than expected"
expect 0 "1 done before" convert tree --recursive --assets --to gltf -o tree_out
expect 1 "holds results of another conversion" convert tree --recursive --assets --from gltf --to gltf-specgloss -o tree_out
expect 0 "1 asset of 1 file" index tree --assets -o tree.manifest
expect 0 "1 material converted" convert tree --manifest tree.manifest --part 1/1 --to gltf -o parts_out
expect 0 "1 part: 1 asset converted, 0 failed" merge-reports parts_out
[[ -z $(find . -name '*.unfinished-*') ]] || fail "unfinished files are left: $(find . -name '*.unfinished-*')"

# A build without images must refuse maps and print their names.
: >a_roughness.png
expect 1 "was built without an image library" convert --from mitsuba/ward --to mitsuba/ggx --roughness a_roughness.png \
  --specular 0.04 -o maps
expect 1 "nowhere.gltf: cannot be read: No such file or directory" convert nowhere.gltf --to gltf -o out
expect 2 "unknown model 'mitsuba/wrd' (closest: mitsuba/ward" path --from mitsuba/wrd --to mitsuba/ggx
echo "$cases runs are as expected"
