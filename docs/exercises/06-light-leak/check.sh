# Solves the room; light that leaves it is lost.
cd "$(dirname "$0")" || exit 2
rm -rf lit
hemitex solve -q room.obj --size 8x8 -o lit > log && python3 - <<'END'
import json, sys
energy = json.load(open("lit/solution.json"))["energy"]
share = 100 * sum(energy["lost"]) / sum(energy["emitted"])
print(f"flux that leaves the room: {share:.2f} % (goal: 0 %)")
sys.exit(share > 0)
END
