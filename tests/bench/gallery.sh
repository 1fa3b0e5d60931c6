#!/usr/bin/env bash
# How a gallery of many cells fares in a browser:  tests/bench/gallery.sh LOBELIA [CELLS...]
set -euo pipefail
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../../gallery/web"
for need in node chromium; do
  command -v "$need" > /dev/null || { echo "gallery: skipped, no program '$need'"; exit 0; }
done
[[ -d node_modules/playwright-core ]] || { echo "gallery: skipped, gallery/web/node_modules is not there: tools/web fetches it"; exit 0; }
for cells in "${@:-20000}"; do
  LOBELIA_PROGRAM=$program node bench.mjs "$cells"
done
