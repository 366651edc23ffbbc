# Solves the room; a face that is wound the wrong way shows its black back to the light.
cd "$(dirname "$0")" || exit 2
hemitex solve -q room.obj --size 8x8 -o lit | awk '
  /to backs/ {print "flux lost to backs of faces:", $6, "% (goal: below 0.01 %)"; reached = $6 < 0.01}
  END {exit !reached}'
