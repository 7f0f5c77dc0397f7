# Tests that the library can be configured without the programs, if their packages are missing, and that it has no
# rules for them. Its sources compile in a minute, so only REMAP_CAMPAIGN=full builds, installs and uses it.
source "$(dirname "$0")/check.bash"
compiler=$3

missing=()
for package in CLI11 OpenImageIO Imath Ceres Eigen3 Catch2 nanoflann benchmark; do
  missing+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
expect_exit 0 cmake -S "$source_folder" -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_BUILD_TYPE=Release -DREMAP_BUILD_PROGRAMS=OFF "${missing[@]}"
expect_exit 0 ninja -C "$work/build" -t targets all
grep -q '^runtime/libremap.a' "$work/output" || fail "there is no library: $(cat "$work/output")"
! grep -E '^bin/|_test|openimageio|CLI' "$work/output" || fail "there is more than the library"

# All tests need the programs.
expect_exit 0 cmake "$work/build" -DREMAP_BUILD_TESTS=ON -DREMAP_BUILD_COMPILER=ON
expect_exit 0 ninja -C "$work/build" -t targets all
! grep -E '^bin/|_test' "$work/output" || fail "there are tests or programs"

if [[ ${REMAP_CAMPAIGN-} == full ]]; then
  expect_exit 0 cmake --build "$work/build"
  expect_exit 0 cmake --install "$work/build" --prefix "$work/installed"
  expect_exit 0 "$compiler" -std=c++20 -I"$work/installed/include" \
    "$source_folder/examples/outside_project/convert_buffers.cpp" "$work/installed/lib/libremap.a" -pthread \
    -o "$work/convert_buffers"
  expect_exit 0 "$work/convert_buffers"
  expect_output "65536 texels"
fi
