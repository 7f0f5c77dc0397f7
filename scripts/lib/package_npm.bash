# scripts/package sources this file. It makes the package for node and browsers.

# package_npm [--test] makes the package. With --test it also installs it into an empty folder, and uses it from there.
package_npm() {
  local -r folder=$repository/build/packages/npm
  case ${1-} in
    "" | --test) ;;
    -h | --help)
      echo "Usage: scripts/package npm [--test]    --test installs the package into an empty folder, and converts with it"
      return
      ;;
    *)
      echo "npm: unknown option '$1'; try --help" >&2
      return 2
      ;;
  esac
  if ! type -P em++ >/dev/null; then
    echo "npm: em++ was not found (install it with: apt-get install --no-install-recommends emscripten)" >&2
    return 1
  fi
  step "Build for WebAssembly" build_wasm npm_package
  rm -rf "$folder"
  mkdir -p "$folder"
  step "Pack" npm pack --silent --pack-destination "$folder" "$repository/build/wasm/npm"
  ls "$folder"/*.tgz
  if [[ ${1-} == --test ]]; then packages/npm/tests/try_package.bash "$folder"/*.tgz; fi
}
