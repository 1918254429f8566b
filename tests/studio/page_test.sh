#!/usr/bin/env bash
# page_test.sh types|units|browser|static KEYLINE WEB: one part of the page's tests.
# 77, with the reason, where what it needs cannot be had: npm's packages, a browser.
set -euo pipefail
part=$1 keyline=$2 web=$3

skip() {
  printf 'skipped: %s\n' "$1"
  exit 77
}

command -v node >/dev/null || skip "node is not installed; ./dev test installs it"
[ -d "$web/node_modules/esbuild" ] || skip "web/node_modules is not there; ./dev test installs it"
cd "$web"
node generate.mjs "$keyline"
case $part in
  types) exec node node_modules/typescript/bin/tsc --noEmit ;;
  units) exec node node_modules/vitest/vitest.mjs run --dir test/unit ;;
  browser)
    browser=${KEYLINE_CHROMIUM:-$(command -v chromium || true)}
    [ -n "$browser" ] || skip "chromium is not installed; ./dev test installs it"
    KEYLINE=$keyline KEYLINE_CHROMIUM=$browser \
      exec node node_modules/vitest/vitest.mjs run --dir test/browser
    ;;
  static)
    browser=${KEYLINE_CHROMIUM:-$(command -v chromium || true)}
    [ -n "$browser" ] || skip "chromium is not installed; ./dev wasm test installs it"
    [ -n "${KEYLINE_WASM_PAGE:-}" ] || skip "./dev wasm test runs this: it needs Emscripten"
    KEYLINE_CHROMIUM=$browser exec node node_modules/vitest/vitest.mjs run --dir test/static
    ;;
esac
