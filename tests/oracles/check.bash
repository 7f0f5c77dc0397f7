# What `texremap check` finds in rebuilt bug reports, and where it cries wolf (check_judge.py). The rules were written with the cases
# of --seed-offset 0 at hand; these are others.
#   check.bash TEXREMAP
set -euo pipefail
readonly texremap=$1 judge=$(dirname "${BASH_SOURCE[0]}")/check_judge.py

for python in python3 /usr/bin/python3; do
  if "$python" -c 'import numpy' 2>/dev/null; then
    exec "$python" "$judge" "$texremap" --seed-offset 1000
  fi
done
echo "skipped: numpy: no python3 with NumPy (Debian: python3-numpy)"
[[ ,${REMAP_REQUIRE-}, == *,numpy,* ]] && exit 1
exit 77
