# paper_match.bash REMAPC FOLDER compares remapc's match by the objective `paper` with the result of a separate
# program (paper_match.py).
set -euo pipefail
readonly remapc=$1 folder=$2
readonly script=$(dirname "${BASH_SOURCE[0]}")/paper_match.py

rm -rf "$folder"
mkdir -p "$folder"
for target in ggx beckmann; do
  "$remapc" sweep --source mitsuba/ward --target "mitsuba/$target" --objective paper --roughness-range 0.03,1 \
    --roughness-samples 12 --specular-samples 3 --resolution 256 -o "$folder/$target.csv" --quiet
done
exec bash "$(dirname "${BASH_SOURCE[0]}")/with_numpy.bash" "$script" 256 "$folder/ggx.csv" "$folder/beckmann.csv"
