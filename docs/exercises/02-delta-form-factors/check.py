"""Compares the sums of delta form factors with those of hemitex."""
import csv
import json
import struct
import sys

from delta import delta_form_factor

RESOLUTION = 64
SIDE = 2 / RESOLUTION  # of a pixel; the faces are at distance 1 from the eye

with open("vector/vector.json") as file:
    vector = json.load(file)
draws = {draw["offset"]: k for k, draw in enumerate(vector["draws"])}
sums = [0.0] * len(draws)
total = 0.0
for face in vector["faces"]:
    column, row, width, height = face["scissor"]
    with open("vector/" + face["words"], "rb") as file:
        ids = struct.unpack(f"<{width * height}I", file.read())
    for pixel, item_id in enumerate(ids):
        x = (pixel % width + 0.5) * SIDE - 1
        y = (pixel // width + row + 0.5) * SIDE - 1  # on a side face: height over the horizon
        share = delta_form_factor(face["name"] == "top", x, y, SIDE * SIDE)
        total += share
        if item_id in draws:
            sums[draws[item_id]] += share

# Surfaces of hemitex are object parts; the vector has one draw per part, in the same order.
expected = {}
with open("expected.csv") as file:
    for line in csv.DictReader(file):
        expected[line["surface"]] = float(line["form_factor"])
names = ["floor", "ceiling", "wall-back", "wall-green", "wall-red"] + ["short-block"] * 5 + ["tall-block"] * 5 + ["light"]
found = dict.fromkeys(expected, 0.0)
for name, value in zip(names, sums):
    found[name] += value
worst = max(expected, key=lambda name: abs(found[name] - expected[name]))
error = abs(found[worst] - expected[worst])
print(f"sum of all delta form factors: {total:.3f} (goal: 0.998 to 1.002)")
print(f"largest error of a form factor: {error:.3f} (goal: at most 0.01), to {worst}: "
      f"{found[worst]:.3f} instead of {expected[worst]:.3f}")
sys.exit(0 if 0.998 <= total <= 1.002 and error <= 0.01 else 1)
