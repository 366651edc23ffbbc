#!/bin/bash
# repeat.sh PROGRAM N: draws the suite N times with each device of this machine. Exit code: 1 if item IDs change.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" -q vector suite -o "$folder/suite" >/dev/null
for device in software opengl; do
  echo "$device, $2 times"
  "$1" vector run "$folder/suite" --device "'$1' vector render {vector} -o {output} --device $device" \
    -o "$folder/answers" --repeat "$2" --time-limit 60 | tail -n 1
done
