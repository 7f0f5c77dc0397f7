# Tests the Debian packages of a folder, in a Debian that has nothing else. lintian must find no error, and apt must
# install them. The programs must work in an empty folder. A project outside must build against the library by CMake
# and by pkg-config. Needs root, debootstrap and a mirror (REMAP_DEBIAN_MIRROR). Its measurements are in the file
# report. `scripts/package deb --test` runs it.
source "$(dirname "$0")/check.bash"
packages=$(cd "$3" && pwd)
work=$(cd "$work" && pwd)
source_folder=$(cd "$source_folder" && pwd)
debian=$work/debian
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=${REMAP_DEBIAN_MIRROR-http://deb.debian.org/debian}

((EUID == 0)) || fail "this is not root, who alone may make a root folder (sudo scripts/package deb --test)"
for package in remap-tools libremap-dev remap-doc; do
  (($(find "$packages" -name "${package}_*.deb" | wc -l) == 1)) || fail "$packages: needs one $package (run scripts/package deb)"
done

report() { printf '%s\n' "$*" | tee -a "$work/report"; }

expect_exit 0 lintian --fail-on error,warning --tag-display-limit 0 --allow-root "$packages"/*.deb
report "lintian: $(grep -c '^[EW]:' "$work/output" || true) errors and warnings"

# No file may contain a folder of the build.
for package in "$packages"/*.deb; do
  dpkg-deb --extract "$package" "$work/extracted"
done
! grep -rlF -e "$source_folder" "$work/extracted" || fail "an installed file names a folder of the build"

start=$SECONDS
expect_exit 0 debootstrap --variant=minbase "$suite" "$debian" "$mirror"
report "debootstrap: $((SECONDS - start)) s"
trap 'umount "$debian/proc" 2>/dev/null; rm -rf "$debian"' EXIT
mount -t proc proc "$debian/proc" || fail "/proc cannot be mounted, by which the programs find their data"
mkdir "$debian/packages" "$debian/away"
cp "$packages"/*.deb "$debian/packages"
cp -r "$source_folder/examples/outside_project" "$debian/away/project"

inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C chroot "$debian" "$@"; }
# install NAME WORDS... installs by apt, and reports what else was installed.
install() {
  local -r name=$1
  shift
  start=$SECONDS
  expect_exit 0 inside apt-get install --yes --no-install-recommends "$@"
  report "$name: $(sed -n 's/^.* \([0-9]*\) newly installed.*/\1/p' "$work/output") packages, $(
    sed -n 's/^Need to get \(.*\) of archives.*/\1/p' "$work/output" | sed 's|.*/||') fetched, $(
    sed -n 's/^After this operation, \(.*\) of additional disk space.*/\1/p' "$work/output") on disk, $((SECONDS - start)) s"
}
# file_of PACKAGE prints the path of the package's file inside the system, in the form that apt needs.
file_of() { (cd "$debian" && echo packages/"$1"_*.deb | sed 's|^|/|'); }
# away COMMANDS runs them in an empty folder.
away() { expect_exit 0 inside bash -c "set -euo pipefail; mkdir -p /away/empty; cd /away/empty; $1"; }

expect_exit 0 inside apt-get update
for package in "$(file_of libremap-dev)" "$(file_of remap-tools)" libopenimageio2.4; do
  expect_exit 0 inside apt-get install --simulate --no-install-recommends "$package"
  report "$package in a minimal Debian: $(sed -n 's/^.* \([0-9]*\) newly installed.*/\1/p' "$work/output") packages"
done
install libremap-dev "$(file_of libremap-dev)" g++ cmake make pkg-config
away 'g++ -std=c++20 $(pkg-config --cflags remap) ../project/convert_buffers.cpp $(pkg-config --libs remap) -o by_pkg_config &&
  ./by_pkg_config'
expect_output "65536 texels, "
# Without remapc, only targets that need it may be missing.
expect_exit 1 inside cmake -S /away/project -B /away/first
expect_output "remapc is not here, which emits the header (install the package remap-tools,"

install remap-tools "$(file_of remap-tools)"
away '
texremap --version
remapc --version
texremap list
texremap path --from mitsuba/ward --to mitsuba/ggx
remapc list
remapc show mitsuba_ward_to_mitsuba_as
remapc chain mitsuba_ward_to_mitsuba_ggx mitsuba_ggx_to_cycles_2_7_ggx -o mine
remapc emit --all
remapc eval mitsuba_ward_to_mitsuba_as /usr/share/remap/fits/tables/mitsuba_ward_to_mitsuba_as.csv
remapc compare /usr/share/remap/fits/tables/mitsuba_ward_to_mitsuba_as.csv
remapc renderers
remapc preview mitsuba_ward_to_mitsuba_as --resolution 16
remapc sweep --source mitsuba/ward --target mitsuba/ggx --roughness-range 0.1,0.6 --roughness-samples 6 \
  --specular-range 0,0.1 --specular-samples 3 --resolution 32 --no-cache -o table.csv
remapc fit table.csv --model parametric --form paper -o my_fits
remapc render --model mitsuba/ggx --set alpha=0.3 --set f0=0.5,0.4,0.3 --resolution 64 -o set/metal_roughness.exr
texremap convert --from mitsuba/ward --to mitsuba/ggx --roughness set/metal_roughness.exr:R --specular 0.04 -o converted
remap-study reach mitsuba_ward_to_mitsuba_as --materials 2'
[[ -f $debian/away/empty/generated/converters.json ]] || fail "remapc emit --all wrote no data"
cmp "$debian/away/empty/generated/converters.json" "$source_folder/generated/converters.json" ||
  fail "remapc emit --all gives other converters than those of the repository"
[[ -n $(find "$debian/away/empty/converted" -name '*.exr') ]] || fail "texremap converted no map"

cp "$source_folder/fits/mitsuba_ward_to_mitsuba_as.json" "$debian/away/project"
away 'cmake -S /away/project -B /away/second -DCMAKE_BUILD_TYPE=Release && cmake --build /away/second &&
  /away/second/shipped && /away/second/own_fit && /away/second/convert_buffers'
expect_output "65536 texels, "

install remap-doc "$(file_of remap-doc)"
# This system keeps documentation: the pages, and the folders that they link to.
away 'ls /usr/share/doc/remap/README.md /usr/share/doc/remap/docs/conversion.png /usr/share/doc/remap/examples/README.md \
  /usr/share/doc/remap/fits/README.md /usr/share/doc/remap/generated/LICENSE /usr/share/man/man1/texremap-convert.1.gz'
away 'apt-get purge --yes remap-tools libremap-dev remap-doc; ! ls -d /usr/share/remap /usr/lib/remap /usr/include/remap'
report "installed, tried and removed"
