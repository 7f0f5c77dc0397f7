# Tests scripts/install-packages on a path that has only stubs. If it can install nothing, it must print what is
# missing and end with exit code 1. If nothing is missing, it must be silent.
source "$(dirname "$0")/check.bash"
stubs=$work/stubs
mkdir "$stubs"
for program in bash env cat mktemp rm tail true; do ln -s "$(type -P $program)" "$stubs/$program"; done

stub() {
  printf '#!/usr/bin/env bash\n%s\n' "$2" >"$stubs/$1"
  chmod +x "$stubs/$1"
}
install_packages() { env -u REMAP_PACKAGES PATH="$stubs" "$@" "$source_folder/scripts/install-packages" build clang </dev/null; }
# Everything is installed except Ceres and CLI11.
some_missing='case ${!#} in libceres-dev | libcli11-dev) exit 1 ;; *) echo -n installed ;; esac'
expect_advice() { expect_output "apt-get install --no-install-recommends libceres-dev libcli11-dev"; }

stub dpkg-query "$some_missing"
stub id 'echo 0'
expect_exit 1 install_packages
expect_output "there is no apt-get here; missing: libceres-dev libcli11-dev"
expect_advice

stub apt-get 'echo "apt $*" >>"'"$work"'/apt"'
stub id 'echo 1000'
expect_exit 1 install_packages
expect_output "this is not root, and there is no sudo; missing: libceres-dev libcli11-dev"
expect_advice
[[ ! -e $work/apt ]] || fail "apt-get was called without being root"

stub sudo 'exit 1'
expect_exit 1 install_packages
expect_output "sudo gives no leave; missing: libceres-dev libcli11-dev"

stub sudo 'shift; echo "sudo $DEBIAN_FRONTEND $1" >>"'"$work"'/sudo"; exec "$@"'
expect_exit 0 install_packages
grep -q "^sudo .*env" "$work/sudo" || fail "apt-get was not called through sudo"
grep -q "apt .* update" "$work/apt" || fail "the lists of packages were not fetched"
grep -q "apt .*install --yes --no-install-recommends libceres-dev libcli11-dev$" "$work/apt" ||
  fail "other packages were asked for: $(cat "$work/apt")"

stub apt-get 'echo "E: no such package"; exit 100'
stub id 'echo 0'
expect_exit 1 install_packages
expect_output "E: no such package"
expect_advice

rm "$stubs/apt-get" "$stubs/dpkg-query"
expect_exit 1 install_packages
expect_output "missing: cmake ninja-build g++ libeigen3-dev libsvm-dev"
expect_exit 0 env PATH="$stubs" REMAP_PACKAGES=ready "$source_folder/scripts/install-packages"

stub dpkg-query 'echo -n installed'
stub apt-get 'exit 100'
expect_exit 0 install_packages
[[ ! -s $work/output ]] || fail "it speaks though nothing is missing: $(cat "$work/output")"
expect_exit 2 "$source_folder/scripts/install-packages" bild
expect_output "unknown set bild"
