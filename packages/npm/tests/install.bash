#!/usr/bin/env bash
# install.bash FOLDER: installs what the package in FOLDER needs, and sharp, once. Skipped (77) where it cannot be had, which
# is a failure if REMAP_REQUIRE holds "npm".
set -euo pipefail
cd "$1"
[[ -d node_modules/fast-png && -d node_modules/sharp ]] && exit
rm -rf node_modules # npm takes a folder without an optional package for a complete one
npm install --no-audit --no-fund --no-save --no-package-lock sharp && exit
echo "skipped: npm: fast-png and sharp cannot be installed"
[[ ,${REMAP_REQUIRE-}, == *,npm,* ]] && exit 1
exit 77
