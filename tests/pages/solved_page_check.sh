#!/bin/bash
# solved_page_check.sh PROGRAM DATA WORK: uses the page of `hemitex solve --report` in headless Chromium
# (solved_page_check.mjs). The scene is a Cornell box with a warning that names a surface, and with a block whose faces
# are turned over, so that its backs absorb light. A sky is its background. A page with an injected fault must fail.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
browser=$(command -v chromium || command -v chromium-browser || true)
if [ -z "$browser" ] || ! command -v node >/dev/null; then
  echo "skipped: Chromium or Node.js is not installed"
  exit 0
fi
rm -rf "$3"
mkdir -p "$3"
cd "$3"
cp "$2/cornell-box.mtl" .
cp "$2/cornell-box.view.json" box.view.json
awk '/^g /{turned = $2 == "short-block"} turned && /^f /{printf "f"; for (i = NF; i > 1; --i) printf " %s", $i; print ""; next} 1' \
  "$2/cornell-box.obj" >box.obj
"$1" -q solve box.obj -o lit --one-sided --report --sky 0.02,0.04,0.08 --texels 8 --filter bilinear --reflectance wall-red=1,0.1,0.1
if grep -E '(src|href)=["'\'']?(https?:)?//' lit/report.html; then
  echo "the page names resources of a network" >&2
  exit 1
fi
node "$here/solved_page_check.mjs" lit "$browser" "$1"

cp -r lit broken
sed -i 's/new THREE.Raycaster()/new THREE.NoRaycaster()/' broken/report.html
if node "$here/solved_page_check.mjs" broken "$browser" "$1" 2>broken/message; then
  echo "a page whose clicks fail passes" >&2
  exit 1
fi
