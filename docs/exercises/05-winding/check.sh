# Solves the room; a face that is wound the wrong way shows its black back to the light.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
rm -rf lit
hemitex solve -q room.obj --size 8x8 -o lit > log && python3 - <<'END' && exit 0
import json, sys
energy = json.load(open("lit/solution.json"))["energy"]
share = 100 * sum(energy["lost_to_backs"]) / sum(energy["emitted"])
print(f"flux lost to backs of faces: {share:.2f} % (goal: below 0.01 %)")
sys.exit(share >= 0.01)
END
# The faces whose backs the light meets.
hemitex formfactors room.obj --all --by-surface 2>&1 >log | sed -n 's/.*warning: `\([^`]*\)` looks the other way.*/light meets the back of: \1/p'
exit 1
