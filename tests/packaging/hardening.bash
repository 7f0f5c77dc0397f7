#!/usr/bin/env bash
# hardening.bash PROJECT WORK CONFIGURATION FILE... checks that programs and modules are hardened against memory
# errors (cmake/RemapHardening.cmake).
set -euo pipefail
readonly configuration=$3
shift 3
failed=0

# expect FILE WHAT PATTERN COMMAND... checks that the output of the command matches the pattern.
expect() {
  local -r file=$1 what=$2 pattern=$3
  shift 3
  "$@" "$file" | grep -E "$pattern" >/dev/null || { echo "$file: has no $what" >&2; failed=1; }
}

for file in "$@"; do
  expect "$file" "addresses of its own (PIE)" 'Type: +DYN' readelf -h
  expect "$file" "read-only tables (RELRO)" GNU_RELRO readelf -lW
  expect "$file" "symbols bound at the start (BIND_NOW)" 'BIND_NOW|Flags:.*NOW' readelf -dW
  expect "$file" "canaries on the stack" __stack_chk_fail readelf -sW --dyn-syms
  if [[ $configuration == Release ]]; then expect "$file" "checked calls (FORTIFY)" '__[a-z_]+_chk' readelf -sW --dyn-syms; fi
  ! readelf -lW "$file" | grep -E "GNU_STACK.* RWE" >/dev/null || { echo "$file: has a stack that can be executed" >&2; failed=1; }
done
exit $failed
