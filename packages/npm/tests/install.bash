#!/usr/bin/env bash
# install.bash FOLDER: installs what the package in FOLDER needs, sharp and glTF-Transform, once, as package-lock.json pins it. No package
# runs a script. If this is not possible, exits with 77 (skipped), which is a failure if REMAP_REQUIRE holds "npm".
set -euo pipefail
cd "$1"
[[ -d node_modules/fast-png && -d node_modules/sharp && -d node_modules/@gltf-transform/extensions ]] && exit
npm ci --ignore-scripts --no-audit --no-fund && exit
echo "skipped: npm: fast-png, sharp and glTF-Transform cannot be installed"
[[ ,${REMAP_REQUIRE-}, == *,npm,* ]] && exit 1
exit 77
