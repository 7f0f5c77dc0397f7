# Tests files in earlier formats that are still read. They were written by earlier versions. Never change a file in
# formats/. A new version of a format adds files. If a version is no longer read, its files are removed, with a line
# in CHANGELOG.md. Such files must then be refused with advice.
source "$(dirname "$0")/check.bash"
bin=$3
formats=$source_folder/tests/packaging/formats
id=mitsuba_ward_to_mitsuba_as
cd "$work"

# The name of a fit must be its id.
mkdir fits
cp "$formats/fit.json" fits/$id.json
cp "$formats/workflow.json" fits/gltf_to_gltf_specgloss.json
expect_exit 0 "$bin/remapc" show $id
expect_output "kind compact, by remapc "
expect_exit 0 "$bin/remapc" show gltf_to_gltf_specgloss
expect_exit 0 "$bin/remapc" emit --all -o headers
expect_exit 0 "$bin/texremap" list --pairs --converters headers/converters.json
expect_output "$id from mitsuba/ward"
expect_exit 0 "$bin/texremap" list --pairs --converters "$formats/converters.json"
expect_output "test passed with"

for table in table table_with_comments; do
  expect_exit 0 "$bin/remapc" check "$formats/$table.csv"
done
expect_exit 0 "$bin/remapc" fit "$formats/table_with_comments.csv" -o fitted
expect_exit 0 "$bin/remapc" show fitted/$id.json
expect_output "kind compact, by remapc "

expect_exit 1 "$bin/remapc" show "$formats/fit_of_version_3.json"
expect_output "has format version 3, but this program reads version 4 (make it again by remapc fit or remapc warp)"
sed 's/"version": 4/"version": 5/' "$formats/fit.json" >newer.json
expect_exit 1 "$bin/remapc" show newer.json
expect_output "this program reads version 4 (use the newer remap that wrote it)"
