# To be sourced by scripts/package: the hashes of bits, by other compilers and on other machines.

# What a variant cannot be built with is a reason to skip it. Debian's package of libc++ is never installed: it replaces a library that
# the whole build needs. It is unpacked into a folder of the build.
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

# check_bits NAME EMULATOR OPTION...: builds bits in build/check/NAME, and compares what it prints, run by the words of EMULATOR.
check_bits() {
  local -r name=$1 emulator=$2 folder=build/check/$1
  shift 2
  {
    cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DREMAP_BUILD_PROGRAMS=OFF -DREMAP_BUILD_BITS=ON \
      -DREMAP_INSTALL=OFF -Dnlohmann_json_DIR="$PWD/cmake/wasm" "$@" && cmake --build "$folder" --target bits
  } >"build/check/$name.log" 2>&1 || {
    tail -n 20 "build/check/$name.log" >&2
    echo "$name: does not build; the whole log: build/check/$name.log" >&2
    return 1
  }
  # shellcheck disable=SC2086 # the emulator is words
  printf '%-12s' "$name:"
  tests/bits/check.bash $emulator "$(ls "$folder"/bin/bits{,.exe} 2>/dev/null | head -n 1)"
}

# check_cross NAME COMPILER EMULATOR SYSTEM PROCESSOR OPTION...
check_cross() {
  local -r name=$1 compiler=$2 emulator=$3 system=$4 processor=$5
  shift 5
  local program
  for program in "$compiler" ${emulator:+"$emulator"}; do
    type -P "$program" >/dev/null || {
      echo "$name: skipped: $program is not installed"
      return
    }
  done
  check_bits "$name" "$emulator" -DCMAKE_SYSTEM_NAME="$system" -DCMAKE_SYSTEM_PROCESSOR="$processor" \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_EXE_LINKER_FLAGS=-static "$@"
}

# package_check: every variant, also after one has failed.
package_check() {
  local status=0 libcxx
  mkdir -p build/check
  if ! type -P clang++ >/dev/null; then
    echo "libc++: skipped: clang++ is not installed"
  elif ! libcxx=$(libcxx_folder); then
    echo "libc++: skipped: its packages cannot be downloaded"
  else
    local -r lib=$libcxx/usr/lib/llvm-14
    check_bits libc++ "env LD_LIBRARY_PATH=$lib/lib" -DCMAKE_CXX_COMPILER=clang++ \
      -DCMAKE_CXX_FLAGS="-nostdinc++ -isystem $PWD/cmake/libcxx/include -isystem $lib/include/c++/v1" \
      -DCMAKE_EXE_LINKER_FLAGS="-nostdlib++ -L$lib/lib -lc++ -lc++abi" || status=1
  fi
  check_cross aarch64 aarch64-linux-gnu-g++ qemu-aarch64-static Linux aarch64 || status=1
  # Debian has wine64 in no folder of programs. What wine writes for itself, and what it says of itself, is nobody's matter.
  export WINEPREFIX=$PWD/build/check/wine WINEDEBUG=-all
  local wine=wine64
  type -P wine64 >/dev/null || [[ ! -x /usr/lib/wine/wine64 ]] || wine=/usr/lib/wine/wine64
  check_cross windows x86_64-w64-mingw32-g++-posix "$wine" Windows AMD64 || status=1
  return "$status"
}
