# Solves the room; light that leaves it is lost.
cd "$(dirname "$0")" || exit 2
hemitex solve -q room.obj --size 8x8 -o lit | awk '
  /^lost/ {print "flux that leaves the room:", $5, "% (goal: 0 %)"; reached = $5 == 0}
  END {exit !reached}'
