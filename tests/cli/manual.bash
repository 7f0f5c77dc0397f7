# groff has nothing to say about the manual pages, and they show what they are of. manual.bash SOURCES
set -euo pipefail
command -v groff >/dev/null || { echo "SKIPPED: groff is not installed" && exit 77; }
cd "$1/docs/man"
for page in *.1; do
  shown=$(groff -man -Tutf8 -ww "$page" 2>&1 >/dev/null)
  [[ -z $shown ]] || { echo "$page: $shown" && exit 1; }
  [[ $(groff -man -Tascii -P -cbou "$page" | tr -s ' ') == *" ${page%.1} - "* ]] || { echo "$page: its name is not shown" && exit 1; }
done
