# completion.bash SOURCES PROGRAMS checks what bash completes, by the words of the documentation. Then it checks that
# zsh and fish can read their files, if they are installed.
set -euo pipefail
cd "$1"
PATH=$2:$PATH
faults=0

# expect LINE WORDS checks what bash offers for the last word of a command line. bash also splits words at =.
expect() {
  local -a COMP_WORDS
  read -ra COMP_WORDS <<<"$1"
  [[ $1 != *' ' ]] || COMP_WORDS+=('')
  local -r COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  "_${COMP_WORDS[0]}" "${COMP_WORDS[0]}" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}" 2>/dev/null
  [[ ${COMPREPLY[*]:-} == "$2" ]] || { echo "$1: got '${COMPREPLY[*]:-}', expected '$2'" && faults=1; }
}

. docs/completions/bash/texremap
. docs/completions/bash/remapc
expect "texremap " "convert check list path index plan merge-reports --version -h --help"
expect "remapc re" "render renderers"
expect "texremap convert --recur" "--recursive"
expect "texremap convert --type " "uint8 uint8-dithered uint16 half float"
expect "texremap convert --type = h" "half"
expect "texremap convert --layout = " "as-inputs separate orm arm specgloss gltf unity unity-hdrp unreal godot threejs blender usd marmoset"
expect "texremap convert --to mitsuba/ward-" "mitsuba/ward-balanced mitsuba/ward-duer"
expect "remapc sweep --source mitsuba/as-i" "mitsuba/as-ior"
expect "remapc show mitsuba_ward_to_mitsuba_as_" "mitsuba_ward_to_mitsuba_as_sztrajman_2019"
expect "remapc fit --model s" "svr"
expect "texremap convert --roughness " ""      # bash itself adds files
expect "texremap convert assets" ""            # bash itself adds files
expect "texremap convert --threads 4 --qui" "--quiet"
# Only the Python package has texremap usd.
expect "texremap us" ""
. packages/python/completions/bash/texremap
expect "texremap us" "usd"
expect "texremap usd --to " "openpbr preview metallic specular"
expect "texremap usd -o " ""                   # bash itself adds files
expect "texremap usd --dr" "--dry-run"
expect "texremap convert --qui" "--quiet"
for shell in zsh fish; do
  command -v "$shell" >/dev/null || continue
  for file in {docs,packages/python}/completions/"$shell"/*; do
    "$shell" -n "$file" || { echo "$file: $shell cannot read it" && faults=1; }
  done
done
exit $faults
