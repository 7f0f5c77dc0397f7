# scripts/package sources this file. It makes the Debian packages remap-tools, libremap-dev and remap-doc, for the Debian
# that this runs on.

usage_deb() {
  cat <<'TEXT'
Usage: scripts/package deb [--test]

Builds remap as Debian builds packages, and makes remap-tools, libremap-dev and remap-doc in build/packages/deb.
Dependencies are the packages whose libraries the programs name; ATLAS is among them, since Debian's libceres-dev brings it.

  --test  also checks them by lintian, and installs and tries them in a Debian of nothing else (root; debootstrap)

Environment:
  REMAP_MAINTAINER  who stands in the packages, "Name <address>"
TEXT
}

readonly deb_build=build/packages/deb.build

configure_deb() {
  local -a options=(-DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DREMAP_DEBIAN=ON -DREMAP_BUILD_TESTS=OFF
    -DREMAP_BUILD_EXAMPLES=OFF)
  [[ -z ${REMAP_MAINTAINER-} ]] || options+=("-DREMAP_MAINTAINER=$REMAP_MAINTAINER")
  # Debian's flags map the source folder to ".". Symbols for debuggers are stripped later, and -O3 is kept.
  export DEB_CXXFLAGS_STRIP="-g -O2"
  CXXFLAGS="$(dpkg-buildflags --get CPPFLAGS) $(dpkg-buildflags --get CXXFLAGS)" LDFLAGS=$(dpkg-buildflags --get LDFLAGS) \
    cmake -S . -B $deb_build -G Ninja "${options[@]}"
}

make_deb() {
  rm -rf $deb_build/cpack build/packages/deb
  cpack -G DEB --config $deb_build/CPackConfig.cmake -B $deb_build/cpack
  mkdir -p build/packages/deb
  mv $deb_build/cpack/*.deb build/packages/deb
}

package_deb() {
  case ${1-} in
    "" | --test) ;;
    -h | --help)
      usage_deb
      return
      ;;
    *)
      echo "scripts/package deb: unknown argument '$1'; try --help" >&2
      return 2
      ;;
  esac
  scripts/install-packages build package
  step "Configure as Debian does" configure_deb
  step "Build the programs and the library" cmake --build $deb_build
  step "Make the packages" make_deb
  local package
  for package in build/packages/deb/*.deb; do
    printf '%-52s %6s kB, %s kB installed\n' "$package" $((($(stat -c %s "$package") + 500) / 1000)) \
      "$(dpkg-deb --field "$package" Installed-Size)"
  done
  [[ ${1-} != --test ]] || step "Install and try them" bash tests/packaging/deb.bash . build/packages/deb.test build/packages/deb
  [[ ${1-} != --test ]] || cat build/packages/deb.test/report
}
