#!/usr/bin/env bash
# Kills a solve with SIGKILL at random moments, goes on from its checkpoint, and compares the result with that of a run
# that was not killed. A run that ends before its signal begins anew.
# usage: kills_check.sh PROGRAM SCENE WORK KILLS
set -euo pipefail
program=$1 scene=$2 work=$3 kills=$4
rm -rf "$work" && mkdir -p "$work" && cd "$work"

solve=("$program" solve "$scene" --texels 64 --patch 4 --resolution 128 --residual 1e-5 --size 40x30 -q)

"${solve[@]}" -o whole
RANDOM=1
for ((killed = 0; killed < kills;)); do
  resume=()
  [ ! -e checkpoint ] || resume=(--resume checkpoint)
  "${solve[@]}" -o pieces --checkpoint checkpoint --every 0.001 "${resume[@]}" &
  sleep "0.$((RANDOM % 300 + 100))"
  if kill -KILL $!; then
    killed=$((killed + 1))
  else
    rm -rf checkpoint pieces
  fi
  wait $! || true
done 2>/dev/null
"${solve[@]}" -o pieces --resume checkpoint
# The times of solution.json differ.
diff <(grep -v '_s"' whole/solution.json) <(grep -v '_s"' pieces/solution.json)
diff --recursive --exclude solution.json whole pieces
echo "$kills kills: the result is that of a run without one"
