# with_numpy.bash SCRIPT [ARGUMENT...] runs a Python script by a Python that has NumPy, or reports that the test is
# skipped.
set -euo pipefail

for python in python3 /usr/bin/python3; do
  if "$python" -c 'import numpy' 2>/dev/null; then exec "$python" "$@"; fi
done
echo "skipped: numpy: no python3 with NumPy (Debian: python3-numpy)"
[[ ,${REMAP_REQUIRE-}, == *,numpy,* ]] && exit 1
exit 77
