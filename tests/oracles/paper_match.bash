# remapc's match by the objective `paper` against the same match computed apart from it (paper_match.py).
#   paper_match.bash REMAPC FOLDER
set -euo pipefail
readonly remapc=$1 folder=$2
readonly script=$(dirname "${BASH_SOURCE[0]}")/paper_match.py

rm -rf "$folder"
mkdir -p "$folder"
for target in ggx beckmann; do
  "$remapc" sweep --source mitsuba/ward --target "mitsuba/$target" --objective paper --roughness-range 0.03,1 \
    --roughness-samples 12 --specular-samples 3 --resolution 256 -o "$folder/$target.csv" --quiet
done
for python in python3 /usr/bin/python3; do
  if "$python" -c 'import numpy' 2>/dev/null; then
    exec "$python" "$script" 256 "$folder/ggx.csv" "$folder/beckmann.csv"
  fi
done
echo "skipped: numpy: no python3 with NumPy (Debian: python3-numpy)"
[[ ,${REMAP_REQUIRE-}, == *,numpy,* ]] && exit 1
exit 77
