"""rasterizer.py VECTOR OUTPUT: draws a test vector. The start leaves every pixel at the background."""
import json
import os
import struct
import sys


def read(folder, name, kind):
    """The numbers of a raw file; kind is 'f' (binary32) or 'I' (uint32)."""
    with open(os.path.join(folder, name), "rb") as file:
        data = file.read()
    return struct.unpack(f"<{len(data) // 4}{kind}", data)


folder, output = sys.argv[1:]
with open(os.path.join(folder, "vector.json")) as file:
    vector = json.load(file)
positions = read(folder, vector["positions"], "f")
texcoords = read(folder, vector["texcoords"], "f")
indices = read(folder, vector["indices"], "I")

for face in vector["faces"]:
    column, row, width, height = face["scissor"]
    pixels = [vector["background"]] * (width * height)
    # Draw each triangle here: view, clip, cover, depth, texel, blend.
    with open(os.path.join(output, face["words"]), "wb") as file:
        file.write(struct.pack(f"<{len(pixels)}I", *pixels))
