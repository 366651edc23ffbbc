#!/bin/bash
# backend_check.sh PROGRAM WORK API: draws probes, suite and random vectors of version 2 with the backend of an API,
# webgl2 or webgpu, in headless Chromium. With the profile that the probes give, no pixel may be an error. Chromium's own rasterizer draws, so that any
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
for family in holes culled-sides two-sided; do
  "$1" -q vector random --seed 0 --count 20 --family $family -o $family >/dev/null
done
mkdir random
mv {holes,culled-sides,two-sided}/*-[0-9]* random
# Chromium starts without an answer now and then on a busy machine. A second start after that is no second try for a
# wrong picture: only a time-out (124) gets one.
draw() { timeout 60 node "$page/draw_suite.mjs" "$1" "drawn-$1" "$browser" "$2"; }
for vectors in suite probes random; do
  draw $vectors "$3" || { [ $? = 124 ] && draw $vectors "$3"; }
done
"$1" vector calibrate probes --candidate drawn-probes -o profile.json
for vectors in suite random; do
  "$1" vector check $vectors --candidate drawn-$vectors --profile profile.json | tail -n 5
done
