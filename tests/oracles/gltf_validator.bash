#!/usr/bin/env bash
# Converts every public glTF file in every direction, and runs Khronos' validator (npm install gltf-validator) on each
# before and after. A conversion must not add errors or warnings. This includes files that fail in part. glTF files
# made from OBJ files must have none, except for those that come from their images.
#
# Usage: gltf_validator.bash TEXREMAP. NODE_PATH leads to the validator. The test is skipped (77) without node, the
# validator or the files.
set -euo pipefail
texremap=$(realpath "$1")
source_folder=$(cd "$(dirname "$0")/../.." && pwd)
assets=${REMAP_SHARED_DATA:-$source_folder/../shared/data}/assets

skip() {
  echo "skipped: $1: $2"
  exit 77
}
[[ -d $assets ]] || skip shared-data "$assets is not there"
command -v node >/dev/null || skip node "not installed"
node -e 'require("gltf-validator")' 2>/dev/null || skip gltf-validator "not found in NODE_PATH (npm install gltf-validator)"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/validate.js" <<'JS'
const {validateBytes} = require('gltf-validator'), fs = require('fs'), path = require('path');
const read = file => new Uint8Array(fs.readFileSync(file));
// Counts of errors and warnings by their code.
async function faults(file) {
  const beside = uri => Promise.resolve(read(path.resolve(path.dirname(file), decodeURIComponent(uri))));
  const report = await validateBytes(read(file), {uri: file, maxIssues: 0, externalResourceFunction: beside});
  const counts = {};
  for (const {severity, code} of report.issues.messages) if (severity < 2) counts[code] = (counts[code] || 0) + 1;
  return counts;
}
(async () => {
  const pairs = fs.readFileSync(process.argv[2], 'utf8').trim().split('\n').map(line => line.split('\t'));
  let added = 0;
  for (const [before, after] of pairs) {
    const old = before === 'none' ? {IMAGE_FEATURES_UNSUPPORTED: Infinity} : await faults(before), now = await faults(after);
    for (const code in now)
      if (now[code] > (old[code] || 0)) {
        console.log(`${after}: ${code}: ${now[code]}, was ${old[code] || 0}`);
        added += now[code] - (old[code] || 0);
      }
  }
  console.log(`${pairs.length} files, ${added} new errors and warnings`);
  process.exit(added > 0 ? 1 : 0);
})();
JS

readonly directions=(
  "--to gltf"
  "--to gltf --extensions write"
  "--to gltf --keep-unused --resample --compression jpeg=90"
  "--to gltf --extensions fold"
  "--to gltf --extensions fold --keep-unused --resample"
  "--to gltf-specgloss"
  "--to gltf-specgloss --keep-unused --resample"
)
mapfile -t files < <(find "$assets" -name '*.gltf' -o -name '*.glb' | sort)
for i in "${!directions[@]}"; do
  read -ra options <<<"${directions[i]}"
  written=0
  for number in "${!files[@]}"; do
    file=${files[number]} output=$work/$i/$number
    "$texremap" convert "$file" "${options[@]}" -o "$output" >/dev/null 2>&1 || true
    [[ -f $output/$(basename "$file") ]] || continue
    printf '%s\t%s\n' "$file" "$output/$(basename "$file")" >>"$work/pairs"
    ((++written))
  done
  echo "${directions[i]}: $written of ${#files[@]} files written"
  # If an option were refused, this would look like a file that fails.
  ((2 * written > ${#files[@]})) || exit 1
done
made=0
while IFS= read -r file; do
  for form in '' '--extensions write'; do
    for kind in glb gltf; do
      output=$work/made/$((++made))/made.$kind
      "$texremap" convert "$file" --to gltf $form -o "$output" >/dev/null 2>&1 || true
      if [[ -f $output ]]; then printf 'none\t%s\n' "$output" >>"$work/pairs"; fi
    done
  done
done < <(find "$assets" -name '*.obj' | sort)
node "$work/validate.js" "$work/pairs"
