# scripts/package sources this file. It compares the hashes of bits, and runs tests, with other compilers and on other
# machines.

# Skips a variant if its tools are missing. Debian's package of libc++ is never installed, because it replaces a library
# that the whole build needs. It is unpacked into a folder of the build.
libcxx_folder() {
  local -r folder=$PWD/build/check/libcxx
  if [[ ! -d $folder/usr ]]; then
    mkdir -p "$folder/packages" || return
    (cd "$folder/packages" && apt-get download --quiet libc++-14-dev libc++1-14 libc++abi-14-dev libc++abi1-14 libunwind-14 libunwind-14-dev) \
      >/dev/null 2>&1 || return
    local package
    for package in "$folder"/packages/*.deb; do dpkg -x "$package" "$folder" || return; done
  fi
  echo "$folder"
}

# build_variant NAME TARGETS OPTION... builds in build/check/NAME.
build_variant() {
  local -r name=$1 targets=$2 folder=build/check/$1
  local -a options=(-DCMAKE_BUILD_TYPE=Release -DREMAP_BUILD_BITS=ON -DREMAP_BUILD_EXAMPLES=OFF -DREMAP_INSTALL=OFF "${@:3}")
  # shellcheck disable=SC2086 # the targets are words
  cmake -S . -B "$folder" -G Ninja "${options[@]}" && cmake --build "$folder" --target $targets
}

program_of() { ls "build/check/$1/bin/$2"{,.exe} 2>/dev/null | head -n 1; }

# check_bits, check_tests and check_commands NAME EMULATOR run the built programs with the emulator. EMULATOR may have
# several words.
# shellcheck disable=SC2086 # the emulator is words
check_bits() { tests/bits/check.bash $2 "$(program_of "$1" bits)"; }

# shellcheck disable=SC2086
check_tests() { (cd build/check && $2 "$(cd "$repository" && realpath "$(program_of "$1" machine_test)")" "~[slow]"); }

# shellcheck disable=SC2086
check_commands() { tests/machines/commands.bash build/check/"$1".commands $2 "$(program_of "$1" texremap)"; }

# check_variant NAME EMULATOR TARGETS OPTION...
check_variant() {
  local -r name=$1 emulator=$2 targets=$3
  step "$name: build" build_variant "$name" "$targets" "${@:4}" || return
  local status=0 target
  for target in $targets; do
    case $target in
      bits) step "$name: bits are equal" check_bits "$name" "$emulator" || status=1 ;;
      machine_test) step "$name: tests of texts, lowering, stages and maps" check_tests "$name" "$emulator" || status=1 ;;
      texremap) step "$name: texremap without images" check_commands "$name" "$emulator" || status=1 ;;
    esac
  done
  return "$status"
}

# check_cross NAME COMPILER EMULATOR TARGETS OPTION... checks a variant by cmake/cross/NAME.cmake.
check_cross() {
  local -r name=$1 compiler=$2 emulator=$3 targets=$4
  local program
  for program in "$compiler" "$emulator"; do
    type -P "$program" >/dev/null || {
      echo "$name: skipped: $program is not installed"
      return
    }
  done
  check_variant "$name" "$emulator" "$targets" -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/cross/$name.cmake" \
    -DREMAP_BUILD_MACHINE_TEST=ON "${@:5}"
}

# package_check checks every variant, even after one has failed.
package_check() {
  local status=0 libcxx
  mkdir -p build/check
  if ! type -P clang++ >/dev/null; then
    echo "libc++: skipped: clang++ is not installed"
  elif ! libcxx=$(libcxx_folder); then
    echo "libc++: skipped: its packages cannot be downloaded"
  else
    local -r lib=$libcxx/usr/lib/llvm-14
    check_variant libc++ "env LD_LIBRARY_PATH=$lib/lib" bits -DREMAP_BUILD_PROGRAMS=OFF \
      -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/headers/header_folders.cmake" -DCMAKE_CXX_COMPILER=clang++ \
      -DCMAKE_CXX_FLAGS="-nostdinc++ -isystem $PWD/cmake/libcxx/include -isystem $lib/include/c++/v1" \
      -DCMAKE_EXE_LINKER_FLAGS="-nostdlib++ -L$lib/lib -lc++ -lc++abi" || status=1
  fi
  check_cross aarch64 aarch64-linux-gnu-g++ qemu-aarch64-static "bits machine_test" -DREMAP_BUILD_PROGRAMS=OFF || status=1
  # Debian installs wine64 outside of PATH. Files and messages of wine itself are discarded.
  export WINEPREFIX=$PWD/build/check/wine WINEDEBUG=-all
  local wine=wine64
  type -P wine64 >/dev/null || [[ ! -x /usr/lib/wine/wine64 ]] || wine=/usr/lib/wine/wine64
  check_cross windows x86_64-w64-mingw32-g++-posix "$wine" "bits machine_test texremap" -DREMAP_BUILD_IMAGES=OFF || status=1
  return "$status"
}
