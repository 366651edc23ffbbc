#!/bin/bash
# backend_check.sh PROGRAM WORK API: draws probes, suites and random vectors with the backend of an API, webgl2 or
# webgpu, in headless Chromium. With the profile that the probes give, no pixel may be an error. Chromium's own
# rasterizer draws, so that any machine can run it.
set -euo pipefail
page=$(cd "$(dirname "$0")/../../web/webgl2" && pwd)
browser=$(command -v chromium || command -v chromium-browser || true)
if [ -z "$browser" ] || ! command -v node >/dev/null; then
  echo "skipped: Chromium or Node.js is not installed"
  exit 0
fi
rm -rf "$2"
mkdir -p "$2/random" "$2/all"
cd "$2"
"$1" -q vector suite -o suite >/dev/null
"$1" -q vector suite --rules 2 -o suite-2 >/dev/null
"$1" -q vector calibrate --probes probes >/dev/null
for family in holes culled-sides two-sided triangle-numbers depth-tests viewports clip-space assemblies; do
  "$1" -q vector random --seed 0 --count 5 --family $family -o $family >/dev/null
  mv $family/*-[0-9]* random
done
# No check explains counts, which differ where a device has fewer sub-pixels than the rules. Those of the suite do not.
for file in $(grep -l '"passed-samples"' random/*/vector.json); do rm -r "$(dirname "$file")"; done
ln -s "$PWD"/{suite,suite-2,random}/*/ all

# Chromium starts without an answer now and then. Further starts after that are no second try for a wrong picture: only
# silence (124) gets one.
draw() {
  for start in 1 2 3 4; do
    node "$page/draw_suite.mjs" "$1" "drawn-$1" "$browser" "$2" && return
    [ $? = 124 ] || return 1
  done
  return 1
}
draw probes "$3"
draw all "$3" 2>failures || true
# WebGPU has no depths of exactly 24 bits. It refuses the vectors, and names the key.
if [ "$3" = webgpu ]; then
  for file in $(grep -l '"unorm24"' {suite-2,random}/*/vector.json); do
    folder=$(dirname "$file")
    refusal="$(basename "$folder"): Error: this device does not draw such depth_precision"
    grep -qx "$refusal" failures || echo "missing: $refusal" >>failures
    sed -i "/^$refusal\$/d" failures
    rm -r "$folder"
  done
fi
cat failures
[ ! -s failures ]

"$1" vector calibrate probes --candidate drawn-probes -o profile.json
for vectors in suite suite-2 random; do
  "$1" vector check $vectors --candidate drawn-all --profile profile.json | tail -n 5
done
