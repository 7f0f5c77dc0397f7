#!/usr/bin/env bash
# try_package.bash TGZ: installs the package into an empty folder, without a cache of npm, converts a set and an array with it,
# and prints how many bytes and seconds this takes.
set -euo pipefail
tgz=$(realpath "$1")
tests=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../tests")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/project"
python3 "$tests/make_inputs.py" "$work/inputs"
cd "$work/project"
export npm_config_cache=$work/cache

start=$(date +%s%N)
npm install --silent "$tgz"
installed=$(date +%s%N)
npx --no texremap convert "$work/inputs/library/gold" --from mitsuba/ward --to mitsuba/as --roughness-encoding roughness -o out
converted=$(date +%s%N)
[[ -s out/gold_roughness.png && -s out/gold_specular.png ]]

cat >five_lines.mjs <<'PROGRAM'
import { load, convert } from 'texremap';
await load();
const maps = { roughness: new Float32Array([0.2, 0.5]), specular: new Float32Array([0.8, 0.6, 0.4, 0.04, 0.04, 0.04]) };
const made = convert({ source: 'mitsuba/ward', target: 'cycles-5/ggx', ...maps });
if (made.roughness.length !== 2 || made.specular.length !== 6 || ![...made.roughness, ...made.specular].every(Number.isFinite)) throw made;
PROGRAM
node five_lines.mjs

npm install --silent --global --prefix "$work/global" "$tgz"
[[ -s $work/global/share/man/man1/texremap-convert.1 ]]
[[ -s $work/global/lib/node_modules/texremap/completions/bash/texremap ]]

seconds() { awk -v ns="$(($2 - $1))" 'BEGIN { printf "%.1f", ns / 1e9 }'; }
echo "$(stat -c %s "$tgz") bytes packed, $(du -sb node_modules | cut -f 1) installed ($(du -sb node_modules/texremap | cut -f 1) of texremap)"
echo "$(seconds "$start" "$installed") s to install, $(seconds "$start" "$converted") s to the first converted set"
