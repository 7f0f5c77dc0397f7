# manual.bash SOURCES checks that groff has no complaint about the manual pages, and that each page shows its subject.
set -euo pipefail
command -v groff >/dev/null || { echo "SKIPPED: groff is not installed" && exit 77; }
cd "$1/docs/man"
for page in *.1; do
  shown=$(groff -man -Tutf8 -ww "$page" 2>&1 >/dev/null)
  [[ -z $shown ]] || { echo "$page: $shown" && exit 1; }
  [[ $(groff -man -Tascii -P -cbou "$page" | tr -s ' ') == *" ${page%.1} - "* ]] || { echo "$page: its name is not shown" && exit 1; }
done
