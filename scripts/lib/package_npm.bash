# To be sourced by scripts/package: the package for node and browsers.

# package_npm: makes build/packages/npm/texremap-VERSION.tgz. The same sources give the same bytes: npm sets every time.
package_npm() {
  local -r packages=build/packages/npm
  cmake --preset wasm && cmake --build --preset wasm --target npm_package || return
  rm -rf "$packages" && mkdir -p "$packages" && (cd "$packages" && npm pack --silent ../../wasm/npm)
}
