# Tests a project outside of the tree. It finds the installed package, uses a shipped header, the library, and a
# header emitted at build time, and emits again when its fit changes.
source "$(dirname "$0")/check.bash"
build=$3
compiler=$4
id=mitsuba_ward_to_mitsuba_as
prefix=$work/prefix

# The project must not lie in the tree, because there a search in parent folders could find what is not installed.
project=$(mktemp -d)
trap 'rm -rf "$project"' EXIT
cp -r "$source_folder/examples/outside_project/." "$project"

expect_exit 0 cmake --install "$build" --prefix "$prefix"
for file in bin/remapc bin/texremap lib/remap/images.so include/remap/$id.hpp include/remap/LICENSE include/remap/version.hpp; do
  [[ -f $prefix/$file ]] || fail "$file: is not installed"
done
! grep -rlF -e "$source_folder" -e "$build" "$prefix"/lib* "$prefix/include" ||
  fail "an installed file names a folder of the build"

# The installed programs must find the module that reads images, and give advice if it is missing.
map=$work/map.exr
expect_exit 0 "$prefix/bin/remapc" render --model mitsuba/ggx --set alpha=0.3 --set f0=0.5,0.4,0.3 --resolution 8 -o "$map"
convert_map() {
  "$prefix/bin/texremap" convert --from mitsuba/ward --to mitsuba/ggx --roughness "$map:R" --specular 0.5 -o "$work/converted" --force
}
expect_exit 0 convert_map
mv "$prefix/lib/remap/images.so" "$work"
expect_exit 1 convert_map
expect_output "lib/remap/images.so: file not found, but the programs need this file for images (install them by cmake --install)"
mv "$work/images.so" "$prefix/lib/remap"

# The commands of README.md, and commands that look up fits, must also work in an empty folder outside of the tree.
away=$(mktemp -d)
trap 'rm -rf "$project" "$away"' EXIT
{
  echo 'set -euo pipefail'
  sed -n '/^```sh$/,/^```$/{/^```/!p}' "$source_folder/README.md" |
    sed "s| generated | $prefix/include/remap |; s| examples/| $prefix/share/remap/examples/|"
  cat <<'COMMANDS'
remapc list
remapc show mitsuba_ward_to_mitsuba_as
remapc preview mitsuba_ward_to_mitsuba_as --resolution 16
remapc chain mitsuba_ward_to_mitsuba_ggx mitsuba_ggx_to_cycles_2_7_ggx -o mine
remapc emit mitsuba_ward_to_mitsuba_as -o mine
remapc eval mitsuba_ward_to_mitsuba_as "$tables/mitsuba_ward_to_mitsuba_as.csv"
remapc compare "$tables/mitsuba_ward_to_mitsuba_as.csv"
remapc export "$tables/mitsuba_ward_to_mitsuba_as.csv" -o plain.csv
remap-study reach mitsuba_ward_to_mitsuba_as --materials 2
COMMANDS
} >"$work/commands"
(cd "$away" && PATH=$prefix/bin:$PATH tables=$prefix/share/remap/fits/tables expect_exit 0 bash "$work/commands")
expect_output "mitsuba_ward_to_mitsuba_as (compact)"
[[ ! -e $away/fits ]] || fail "a folder of fits was made"

configure() {
  cmake -S "$project" -B "$project/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_BUILD_TYPE=Release
}
# second_row PROGRAM prints its result for alpha 0.2, specular 0.7 0.5 0.
second_row() {
  expect_exit 0 "$project/build/$1"
  expect_output "0 texels out of domain"
  numbers "$(sed -n 2p "$work/output")"
}
own_fit() { expected_row "$project/$id.json" 0.2 0.7 0.5 0; }

expect_exit 1 configure
expect_output "$id.json: file not found"
echo '{"name": "no fit"}' >"$project/$id.json"
expect_exit 1 configure
expect_output "$id.json: not a fit"

cp "$source_folder/fits/$id.json" "$project"
shipped=$(own_fit)
expect_exit 0 configure
expect_exit 0 cmake --build "$project/build"
[[ -f $project/build/remap_generated/remap/$id.hpp ]] || fail "the header was not emitted in the binary folder"
expect_close "$(second_row shipped)" "$shipped"
expect_close "$(second_row own_fit)" "$shipped"
expect_exit 0 "$project/build/convert_buffers"
expect_output "65536 texels, "

for file in man/man1/texremap-convert.1 bash-completion/completions/remapc zsh/site-functions/_texremap \
  fish/vendor_completions.d/remapc.fish; do
  [[ -f $prefix/share/$file ]] || fail "$file is not installed"
done

# Each public header must compile when it is included first, and must need nothing that is not installed.
for header in "$prefix"/include/remap/*.hpp; do
  [[ $header == *_to_*.hpp ]] || echo "#include \"$header\""
done >"$work/headers.txt"
(($(wc -l <"$work/headers.txt") > 8)) || fail "public headers are not installed"
while read -r include; do
  expect_exit 0 "$compiler" -std=c++20 -fsyntax-only -I "$prefix/include" -x c++ - <<<"$include"
done <"$work/headers.txt"

expect_exit 0 "$prefix/bin/remapc" fit "$source_folder/fits/tables/$id.csv" --seed 2 --force -o "$project"
[[ $(own_fit) != "$shipped" ]] || fail "the fit was to be changed"
expect_exit 0 cmake --build "$project/build"
expect_close "$(second_row shipped)" "$shipped"
expect_close "$(second_row own_fit)" "$(own_fit)"
