# Tests the texture set of the demo. It must have the same bytes every time and be what texremap expects. If it cannot
# be written, the failure must be clear.
source "$(dirname "$0")/check.bash"
bin=$3
mkdir "$work/first" "$work/second"

expect_exit 0 "$bin/scratched_metal" "$work/first" 128
expect_exit 0 "$bin/scratched_metal" "$work/second" 128
for map in roughness specular; do
  expect_exit 0 oiiotool "$work/first/$map.exr" "$work/second/$map.exr" --fail 0 --diff
done
expect_exit 0 oiiotool --stats "$work/first/roughness.exr"
expect_output "128 x 128, 1 channel, half openexr"
expect_output "NanCount: 0"
# The demo needs different alphas, between 0.03 and 0.9.
LC_ALL=C awk '/Stats Min/ { low = $3 } /Stats Max/ { high = $3 } /Stats StdDev/ { spread = $3 }
  END { exit !(low >= 0.0299 && high <= 0.9001 && spread > 0.05) }' "$work/output" ||
  fail "the roughness is out of range: $(cat "$work/output")"
expect_exit 0 oiiotool --stats "$work/first/specular.exr"
expect_output "128 x 128, 3 channel, half openexr"
expect_output "Monochrome: No"

expect_exit 1 "$bin/scratched_metal" "$work/no such folder" 16
expect_output "no such folder/roughness.exr: cannot be written"
expect_exit 2 "$bin/scratched_metal"
