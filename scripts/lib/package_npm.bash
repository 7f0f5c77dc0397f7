# To be sourced by scripts/package: the package for node and browsers.

package_npm() {
  local -r folder=$repository/build/packages/npm
  if ! type -P em++ >/dev/null; then
    echo "npm: em++ was not found (install it with: apt-get install --no-install-recommends emscripten)" >&2
    return 1
  fi
  step "Build for WebAssembly" build_preset wasm npm_package
  rm -rf "$folder"
  mkdir -p "$folder"
  step "Pack" npm pack --silent --pack-destination "$folder" "$repository/build/wasm/npm"
  ls "$folder"/*.tgz
}
