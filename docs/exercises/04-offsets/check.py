"""Puts the offsets into the test vector, and checks that they are unique and use few item IDs."""
import json
import sys

from offsets import offsets

with open("vector/vector.json") as file:
    vector = json.load(file)
sizes = [draw["width"] * draw["height"] for draw in vector["draws"]]
found = offsets(sizes)
for draw, offset in zip(vector["draws"], found):
    draw["offset"] = offset
with open("vector/vector.json", "w") as file:
    json.dump(vector, file)
vector["blend"] = "integer-add"
with open("integer/vector.json", "w") as file:
    json.dump(vector, file)

ends = sorted((offset, offset + size) for offset, size in zip(found, sizes))
unique = all(end <= start for (_, end), (start, _) in zip(ends, ends[1:]))
highest = max(end for _, end in ends)
print(f"item IDs are unique: {'yes' if unique else 'no'}; highest item ID: {highest - 1} (goal: below 4096)")
sys.exit(0 if unique and highest <= 4096 else 1)
