# Tests that a generated header and its example build with a bare compiler call, as C++17, 20 and 23, without a
# warning, and give the values of the fit.
source "$(dirname "$0")/check.bash"
compiler=$3
fit=$source_folder/fits/mitsuba_ward_to_mitsuba_as.json
expected=$(expected_row "$fit" 0.2 0.72 0.48 0.36)

# The example must be readable at a glance.
(($(wc -l <"$source_folder/examples/convert_material.cpp") <= 30)) || fail "convert_material.cpp has grown"

for standard in c++17 c++20 c++2b; do
  expect_exit 0 "$compiler" -std=$standard -Wall -Wextra -Wconversion -Werror -I "$source_folder/generated" \
    "$source_folder/examples/convert_material.cpp" -o "$work/convert_material"
  expect_exit 0 "$work/convert_material"
  expect_output "mitsuba/ward: alpha 0.2, specular 0.72 0.48 0.36"
  expect_close "$(numbers "$(tail -n 1 "$work/output")")" "$expected"
done
