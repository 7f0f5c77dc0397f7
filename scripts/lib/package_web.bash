# scripts/package sources this file. It makes the page for browsers.

usage_web() {
  cat <<'TEXT'
Usage: scripts/package web [--test]

Makes two forms of the page in build/packages/web: the folder texremap-web, to be served by any web server, and texremap.html,
which is everything in one file and runs from disk. Needs emscripten and node; npm brings the rest into build/web.

  --test  also tries the page in headless Chromium, where that is installed
TEXT
}

# Installs the packages of the page, as web/package-lock.json pins them. No package runs a script during installation.
install_modules() {
  mkdir -p build/web
  cp web/package.json web/package-lock.json build/web
  (cd build/web && npm ci --ignore-scripts --no-audit --no-fund)
}

package_web() {
  case ${1-} in
    "" | --test) ;;
    -h | --help)
      usage_web
      return
      ;;
    *)
      echo "scripts/package web: unknown argument '$1'; try --help" >&2
      return 2
      ;;
  esac
  local -r folder=build/packages/web/texremap-web
  step "Fetch what the page is bundled from" install_modules
  step "Compile the program for browsers" build_wasm texremap_page
  step "Make the page" node web/build.mjs build/packages/web build/web/node_modules build/wasm/web
  local file
  for file in "$folder"/* build/packages/web/texremap.html; do
    printf '%-52s %8s bytes, %8s by gzip\n' "$file" "$(stat -c %s "$file")" "$(gzip -9c "$file" | wc -c)"
  done
  [[ ${1-} != --test ]] || step "Try it in a browser" node --test web/tests/*.test.mjs
}
