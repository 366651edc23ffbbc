"""Writes small files that become large into the current folder: python3 bombs.py NAME..."""

import base64
import json
import struct
import sys
import zipfile
import zlib


def zeros_packed(size: int) -> bytes:
    packer = zlib.compressobj(9)
    block = bytes(1 << 20)
    parts = [packer.compress(block[:min(size - at, len(block))]) for at in range(0, size, len(block))]
    return b"".join(parts) + packer.flush()


def npz() -> None:
    """100 MB of zeros as the indices of a matrix, which are copied when they are read."""
    def header(shape: str, kind: str) -> bytes:
        text = "{'descr': '%s', 'fortran_order': False, 'shape': (%s), }" % (kind, shape)
        return b"\x93NUMPY\x01\x00" + bytes([118, 0]) + (text + " " * (117 - len(text)) + "\n").encode()

    entries = 25_000_000
    with zipfile.ZipFile("bomb.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("format.npy", header("", "|S3") + b"csr")
        archive.writestr("shape.npy", header("2,", "<i8") + struct.pack("<2q", 1, 1))
        archive.writestr("indptr.npy", header("2,", "<i8") + struct.pack("<2q", 0, entries))
        with archive.open("indices.npy", "w") as member:
            member.write(header(f"{entries},", "<i4"))
            for _ in range(4 * entries // 1_000_000):
                member.write(bytes(1_000_000))


def write_vtp(file: str, points: int, pieces: int) -> None:
    """Pieces that all have the same points, in one block of zlib."""
    bytes_of_points = 24 * points
    packed = zeros_packed(bytes_of_points)
    header = struct.pack("<4Q", 1, bytes_of_points, 0, len(packed))
    piece = (f'<Piece NumberOfPoints="{points}" NumberOfPolys="1"><Points><DataArray type="Float64" format="appended" '
             'NumberOfComponents="3" offset="0"/></Points><Polys><DataArray type="Int32" Name="connectivity" '
             'format="ascii">0 1 2</DataArray><DataArray type="Int32" Name="offsets" format="ascii">3</DataArray></Polys>'
             '</Piece>')
    with open(file, "wb") as stream:
        stream.write(('<VTKFile type="PolyData" byte_order="LittleEndian" header_type="UInt64" '
                      'compressor="vtkZLibDataCompressor"><PolyData>' + piece * pieces +
                      '</PolyData><AppendedData encoding="raw">_').encode() + header + packed +
                     b'</AppendedData></VTKFile>')


def write_gltf(file: str, **parts: object) -> None:
    with open(file, "w") as stream:
        json.dump({"asset": {"version": "2.0"}, "scene": 0, **parts}, stream)


def triangle(count: int) -> dict[str, object]:
    """The buffer, views and accessors of a triangle that is listed many times."""
    data = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<3H", 0, 1, 2) * count
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return {
        "buffers": [{"byteLength": len(data), "uri": uri}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6 * count}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5123, "count": 3 * count, "type": "SCALAR"}]}


def instances() -> None:
    """3000 nodes with one mesh of 3000 triangles."""
    nodes = 3000
    write_gltf("instances.gltf", scenes=[{"nodes": list(range(nodes))}], nodes=[{"mesh": 0}] * nodes,
               meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], **triangle(3000))


def write_png(file: str, side: int) -> None:
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    with open(file, "wb") as stream:
        stream.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", side, side, 8, 0, 0, 0, 0)) +
                     chunk(b"IDAT", zeros_packed(side * (side + 1))) + chunk(b"IEND", b""))


def write_textured(name: str, images: list[str]) -> None:
    """A triangle per image, as OBJ and as glTF."""
    numbers = range(len(images))
    with open(name + ".obj", "w") as obj, open(name + ".mtl", "w") as mtl:
        obj.write(f"mtllib {name}.mtl\n")
        for n in numbers:
            obj.write(f"g wall{n}\nusemtl m{n}\nv 0 0 {n}\nv 1 0 {n}\nv 0 1 {n}\nf -3 -2 -1\n")
            mtl.write(f"newmtl m{n}\nKd 1 1 1\nmap_Kd {images[n]}\nKe 1 1 1\n")
    write_gltf(name + ".gltf", scenes=[{"nodes": list(numbers)}],
               nodes=[{"mesh": n, "translation": [0, 0, n]} for n in numbers],
               meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": n}]} for n in numbers],
               materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": n}}, "emissiveFactor": [1, 1, 1]}
                          for n in numbers],
               textures=[{"source": n} for n in numbers], images=[{"uri": image} for image in images], **triangle(1))


def one_image() -> None:
    """40 textures of one image of 24 MB."""
    write_png("one.png", 1000)
    write_textured("one", ["one.png"] * 40)


def many_images() -> None:
    """40 images of 24 MB."""
    for n in range(40):
        write_png(f"image-{n}.png", 1000)
    write_textured("many", [f"image-{n}.png" for n in range(40)])


BOMBS = {"npz": npz, "pieces": lambda: write_vtp("pieces.vtp", 50_000, 200),
         "zlib": lambda: write_vtp("zlib.vtp", 10_000_000, 1), "instances": instances, "one_image": one_image,
         "many_images": many_images}

for bomb in sys.argv[1:]:
    BOMBS[bomb]()
