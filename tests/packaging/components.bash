# Tests the contents of packages. The components must have every installed file once. No file may contain a folder of
# the build. CMake and pkg-config must find the library without the programs. Both programs must print their versions.
source "$(dirname "$0")/check.bash"
build=$3
compiler=$4

list_files() { (cd "$1" && find . -type f -o -type l | sort); }
expect_exit 0 cmake --install "$build" --prefix "$work/all"
for component in remap_tools remap_dev remap_doc; do
  expect_exit 0 cmake --install "$build" --prefix "$work/$component" --component $component
done
diff <(list_files "$work/all") <(cat <(list_files "$work/remap_tools") <(list_files "$work/remap_dev") <(list_files "$work/remap_doc") | sort) ||
  fail "a file is in no component, or in two"
# No installed file may contain a path of the sources or of the build.
! grep -rlF -e "$source_folder/" -e "$build" "$work/all" || fail "an installed file names a folder of the build"

dev=$work/remap_dev
[[ ! -e $dev/bin && ! -e $dev/lib/remap && -f $dev/share/remap/converters.json ]] || fail "remap_dev: holds other files than it should"
[[ -f $work/remap_tools/share/remap/naming.json && -f $work/remap_tools/share/remap/fits/README.md ]] || fail "remap_tools: lacks data"
for page in README.md docs/tutorial.md docs/conversion.png docs/reference/texremap.md; do
  [[ -f $work/all/share/doc/remap/$page ]] || fail "$page: is not installed"
done
# Links of pages must lead somewhere, except for links to sources.
python3 - "$work/all/share/doc/remap" <<'PROGRAM' || fail "pages have links that lead nowhere"
import pathlib, re, sys
root = pathlib.Path(sys.argv[1])
missing = {(str(page.relative_to(root)), link) for page in root.rglob("*.md") for link in re.findall(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)", page.read_text())
           if "://" not in link and not (page.parent / link).exists()}
missing = {found for found in missing if not re.match(r"\.\./runtime/.*\.hpp$", found[1])}
print(*missing, sep="\n")
sys.exit(bool(missing))
PROGRAM

# This tests the library without the programs, after it was moved.
mv "$dev" "$work/moved"
sed '/own_fit/d; /^add_executable(shipped/d; /shipped PRIVATE/d' "$source_folder/examples/outside_project/CMakeLists.txt" >"$work/CMakeLists.txt"
cp "$source_folder/examples/outside_project/convert_buffers.cpp" "$work"
configure() { cmake -S "$work" -B "$work/project" -DCMAKE_PREFIX_PATH="$work/moved" -DCMAKE_CXX_COMPILER="$compiler"; }
expect_exit 0 configure
expect_exit 0 cmake --build "$work/project"
expect_exit 0 "$work/project/convert_buffers"
expect_output "65536 texels, "
echo 'remap_add_converter(convert_buffers fit.json)' >>"$work/CMakeLists.txt"
expect_exit 1 configure
expect_output "remapc is not here, which emits the header (install the package remap-tools,"

if type -P pkg-config >/dev/null; then
  pkg_config() { PKG_CONFIG_PATH=$work/moved/lib/pkgconfig pkg-config "$@"; }
  version=$(pkg_config --modversion remap)
  read -ra flags < <(pkg_config --cflags --libs remap)
  expect_exit 0 "$compiler" -std=c++20 -fsyntax-only "${flags[0]}" "$work/convert_buffers.cpp"
  expect_exit 0 "$compiler" -Wl,--trace -shared -o "$work/nothing.so" "${flags[@]:1}"
  expect_output "moved/lib/pkgconfig/../../lib/libremap.a"
  expect_exit 0 "$work/remap_tools/bin/remapc" --version
  expect_output "remapc $version build: "
fi

# The first line is the version. Facts for error reports follow.
expect_exit 0 "$work/remap_tools/bin/remapc" --version
for words in "data: $(grep -c '^ *{"id":' "$source_folder/generated/converters.json") converters, SHA-256 $(
  sha256sum "$source_folder/generated/converters.json" | head -c 12)..." "libraries: OpenImageIO " "libwebp 1." "Eigen 3."; do
  expect_output "$words"
done
