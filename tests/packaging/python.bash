# Tests the Python package. A wheel of the libraries of this build is installed into an environment that has nothing
# else. Its tests compare arrays with closed forms, and the command with the program. The test is skipped (77) if
# Python's headers or the packages that it needs are missing.
source "$(dirname "$0")/check.bash"
build=$3
python=${REMAP_PYTHON:-python3}

skip() {
  echo "skipped: python: $1"
  [[ ,${REMAP_REQUIRE-}, == *,python,* ]] && exit 1
  exit 77
}
"$python" -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null || skip "there is no python3 of 3.9 or later"
"$python" -c 'import sysconfig, os, sys; sys.exit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))' ||
  skip "its headers are missing (apt-get install python3-dev)"
"$python" -m venv "$work/venv" >/dev/null 2>&1 || skip "it makes no environments (apt-get install python3-venv)"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check -c "$source_folder/packages/python/pinned.txt" scikit-build-core nanobind numpy pytest hypothesis OpenImageIO \
  usd-core MaterialX >"$work/pip.log" 2>&1 || skip "packages cannot be installed: $(tail -n 1 "$work/pip.log")"

# Without optimiser, nanobind also checks that Python objects are only used under the interpreter's lock.
expect_exit 0 env SKBUILD_BUILD_DIR="$work/module" "$work/venv/bin/pip" install --disable-pip-version-check --no-build-isolation \
  --no-deps --config-settings=cmake.build-type=Debug --config-settings=cmake.define.REMAP_CORE="$build" "$source_folder"
# Runs the tests of the repository with the installed package.
cp -r "$source_folder/packages" "$work/packages"
rm -r "$work/packages/python/texremap"
ln -s "$source_folder/fits" "$source_folder/generated" "$work"
cd "$work/packages/python/tests"
export REMAP_SHARED_DATA=${REMAP_SHARED_DATA:-$source_folder/../shared/data}
REMAP_TEXREMAP=$build/bin/texremap PYTHONDONTWRITEBYTECODE=1 "$work/venv/bin/python" -m pytest -q -p no:cacheprovider . ||
  fail "tests of the Python package"
