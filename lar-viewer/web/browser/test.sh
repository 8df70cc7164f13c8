#!/usr/bin/env bash
# Builds the viewer for browsers, exports the three cubes, and drives the page in headless Chromium; see TESTING.md.
# Pages and screenshots are left in target/web/pages.
set -euo pipefail
cd "$(dirname "$0")"
root=$(realpath ../../..)
pages="$root/target/web/pages"
../build.sh
npm ci --no-audit --no-fund --silent
mkdir -p "$pages"
cd "$root"
cargo run --quiet --locked -p lar-examples -- export-html fixtures/three_cubes_{a,b,c}.obj -o "$pages/cubes.html" \
    --alpha 0.9 --title "Three cubes"
node lar-viewer/web/browser/test.mjs "$pages/cubes.html" "$pages"
