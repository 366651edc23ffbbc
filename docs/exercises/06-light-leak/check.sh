# Solves the room; light that leaves it is lost.
cd "$(dirname "$0")" || exit 2
. ../begin.sh
rm -rf lit
hemitex solve -q room.obj --size 8x8 -o lit > log && python3 - <<'END' && exit 0
import json, sys
energy = json.load(open("lit/solution.json"))["energy"]
share = 100 * sum(energy["lost"]) / sum(energy["emitted"])
print(f"flux that leaves the room: {share:.2f} % (goal: 0 %)")
sys.exit(share > 0)
END
# The surface from which most light goes there.
hemitex formfactors room.obj --all --by-surface 2>&1 > log | sed -n 's/.*leaves the scene is at most/share from the worst surface:/p' | sed 's/;.*//'
exit 1
