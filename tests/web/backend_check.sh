#!/bin/bash
# backend_check.sh PROGRAM WORK API: draws probes and suite with the backend of an API, webgl2 or webgpu, in headless
# Chromium. With the profile that the probes give, no pixel may be an error. Chromium's own rasterizer draws, so that any
# machine can run it.
set -euo pipefail
page=$(cd "$(dirname "$0")/../../web/webgl2" && pwd)
browser=$(command -v chromium || command -v chromium-browser || true)
if [ -z "$browser" ] || ! command -v node >/dev/null; then
  echo "skipped: Chromium or Node.js is not installed"
  exit 0
fi
rm -rf "$2"
mkdir -p "$2"
cd "$2"
"$1" -q vector suite -o suite >/dev/null
"$1" -q vector calibrate --probes probes >/dev/null
# Chromium starts without an answer now and then on a busy machine. A second start after that is no second try for a
# wrong picture: only a time-out (124) gets one.
draw() { timeout 60 node "$page/draw_suite.mjs" "$1" "drawn-$1" "$browser" "$2"; }
for vectors in suite probes; do
  draw $vectors "$3" || { [ $? = 124 ] && draw $vectors "$3"; }
done
"$1" vector calibrate probes --candidate drawn-probes -o profile.json
"$1" vector check suite --candidate drawn-suite --profile profile.json | tail -n 5
