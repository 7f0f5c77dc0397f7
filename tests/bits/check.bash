#!/usr/bin/env bash
# check.bash COMMAND... checks that the program `bits` prints the list in this folder.
# check.bash --record COMMAND... writes the list.
set -euo pipefail
list=$(dirname "$0")/bits.txt
if [[ $1 == --record ]]; then
  shift
  "$@" >"$list"
  exit
fi
# Windows ends lines with two characters.
if found=$(diff <("$@" | tr -d '\r') "$list"); then
  echo "$(wc -l <"$list") hashes are equal"
else
  echo "$(grep -c '^>' <<<"$found") of $(wc -l <"$list") hashes differ or are missing:" >&2
  echo "$found" | head -n 20 >&2
  exit 1
fi
