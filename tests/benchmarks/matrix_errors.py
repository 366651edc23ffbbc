#!/usr/bin/env python3
"""Measures whether the estimated errors of matrices of form factors hold, in random meshes of eight kinds.

usage: matrix_errors.py PROGRAM WORK [MESHES] [SAMPLES] [ERROR...]

The kinds are canyons, rooms, combs, slits, double walls, bollards, overhangs and curved meshes. Mesh n is of kind
n mod 8; n seeds its numbers. Each is computed with --max-error ERROR (default .03 and .01), and by rays, SAMPLES per row
(default 2^20). MESHES is 32 if not given.

rows    whose absolute errors sum up to at most their estimate and the noise of the rays
sky     shares of surroundings that are off by at most their error and three standard errors of the rays

Exit code: 1 if fewer than 99 % of all rows or of all shares of surroundings are inside."""
import array
import ast
import io
import json
import math
import os
import random
import sys
import zipfile

sys.dont_write_bytecode = True  # no files beside the sources
from sizes import run  # noqa: E402


class Mesh:
    """Quads of a mesh, seen from their front counter-clockwise."""

    def __init__(self):
        self.quads = []

    def sheet(self, corner, u, v, columns=1, rows=1):
        """Divides a parallelogram, whose front is on the side of u x v."""
        def at(i, j):
            return tuple(c + a * i / columns + b * j / rows for c, a, b in zip(corner, u, v))
        self.quads += [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
                       for i in range(columns) for j in range(rows)]

    def box(self, low, size, parts=1, inside=False, bottom=True):
        (x, y, z), (a, b, c) = low, size
        sheets = [((x, y, z), (a, 0, 0), (0, b, 0)), ((x, y, z + c), (0, b, 0), (a, 0, 0)),
                  ((x, y, z), (0, b, 0), (0, 0, c)), ((x + a, y, z), (0, 0, c), (0, b, 0)),
                  ((x, y, z), (0, 0, c), (a, 0, 0)), ((x, y + b, z), (a, 0, 0), (0, 0, c))]
        for number, (corner, u, v) in enumerate(sheets):  # as given, fronts are inside
            if number > 0 or bottom:
                self.sheet(corner, *((u, v) if inside else (v, u)), parts, parts)

    def ground(self, x, y, parts):
        self.sheet((0, 0, 0), (x, 0, 0), (0, y, 0), parts, parts)

    def write(self, name, turn):
        """Turns the mesh about two axes; every second quad is written as two triangles."""
        (a, b), (c, d) = ((math.cos(angle), math.sin(angle)) for angle in turn)
        with open(name, 'w') as file:
            for number, quad in enumerate(self.quads):
                for x, y, z in quad:
                    x, y = a * x - b * y, b * x + a * y
                    file.write('v %.9g %.9g %.9g\n' % (x, c * y - d * z, d * y + c * z))
                file.write('f -4 -3 -2\nf -4 -2 -1\n' if number % 2 else 'f -4 -3 -2 -1\n')


def canyon(mesh, r):
    length, width = r.uniform(20, 40), r.uniform(4, 12)
    mesh.ground(width, length, 4)
    for x, side in ((0, 1), (width, -1)):
        y = 0
        while y < length:
            end, height = min(length, y + r.uniform(4, 9)), r.uniform(4, 20)
            along, up = (0, end - y, 0), (0, 0, height)
            mesh.sheet((x, y, 0), *((along, up) if side > 0 else (up, along)), 2, 2)
            y = end + r.choice((0, r.uniform(1, 3)))


def room(mesh, r):
    mesh.box((0, 0, 0), (5, 4, 3), 3, inside=True)
    for x in (0.3, 2.8):
        for y in (0.3, 2.2):
            size = [r.uniform(0.4, 1.6), r.uniform(0.4, 1.4), r.uniform(0.3, 2)]
            mesh.box((x + r.uniform(0, 0.2), y + r.uniform(0, 0.2), r.uniform(0.05, 0.6)), size)


def comb(mesh, r):
    teeth, gap = r.randint(3, 5), r.uniform(0.2, 0.6)
    mesh.box((0, 0, 0), (teeth, 2, 2), 2, inside=True)
    for n in range(teeth):
        thick, height = 0.1, r.uniform(1, 1.7)
        mesh.box((n + 0.2, 0.1, 0.01), (thick, 1.8, height))
        mesh.box((n + 0.2 + gap, 0.1, 1.99 - height), (thick, 1.8, height))


def slit(mesh, r):
    width, at = r.choice((0.01, 0.03, 0.1)), r.uniform(0.3, 0.7)
    mesh.box((0, 0, 0), (2, 1, 1), 3, inside=True)
    mesh.box((0.95, 0, 0), (0.1, at - width / 2, 1))
    mesh.box((0.95, at + width / 2, 0), (0.1, 1 - at - width / 2, 1))


def double_wall(mesh, r):
    gap = r.choice((0.002, 0.01, 0.05))
    mesh.box((0, 0, 0), (1, 1, 1), r.randint(1, 3), inside=True)
    mesh.box((gap, gap, gap), [1 - gap - r.choice((gap, 0.3)) for _ in range(3)], r.randint(1, 2))


def bollards(mesh, r):
    mesh.ground(20, 20, r.randint(1, 3))
    if r.random() < 0.5:
        mesh.sheet((0, 0, 0), (0, 20, 0), (0, 0, 6), 2, 1)
    for _ in range(r.randint(4, 10)):
        side = r.uniform(0.2, 1)
        mesh.box((r.uniform(1, 18), r.uniform(1, 18), 0), (side, side, r.uniform(0.5, 4)), bottom=False)


def overhang(mesh, r):
    mesh.ground(24, 24, 4)
    for x in (3, 14):
        for y in (3, 14):
            height = r.uniform(3, 9)
            mesh.box((x, y, 0), (5, 5, height), bottom=False)
            reach = r.uniform(0.5, 2)
            mesh.box((x - reach, y - reach, height + 0.01), (5 + 2 * reach, 5 + 2 * reach, r.uniform(0.3, 3)))


def curved(mesh, r):
    """A ball of quads and a dish of rings in a room without a ceiling."""
    mesh.box((0, 0, 0), (4, 4, 3), 2, inside=True)
    mesh.quads = [quad for quad in mesh.quads if min(z for _, _, z in quad) < 3]
    around, rows, radius = r.randint(8, 12), r.randint(4, 6), r.uniform(0.5, 1)

    def on_ball(i, j):
        polar, angle = math.pi * (0.08 + 0.84 * i / rows), 2 * math.pi * j / around
        return (1.2 + radius * math.sin(polar) * math.cos(angle), 1.2 + radius * math.sin(polar) * math.sin(angle),
                1.2 + radius * math.cos(polar))
    # Two neighbours of a ring on two levels are in a plane.
    mesh.quads += [[on_ball(i, j), on_ball(i + 1, j), on_ball(i + 1, j + 1), on_ball(i, j + 1)]
                   for i in range(rows) for j in range(around)]

    def on_dish(i, j):
        angle = 2 * math.pi * j / around
        return (2.9 + 0.3 * (i + 1) * math.cos(angle), 2.9 + 0.3 * (i + 1) * math.sin(angle), 0.1 + 0.1 * i * i)
    mesh.quads += [[on_dish(i, j), on_dish(i + 1, j), on_dish(i + 1, j + 1), on_dish(i, j + 1)]
                   for i in range(2) for j in range(around)]


KINDS = (canyon, room, comb, slit, double_wall, bollards, overhang, curved)


def write_mesh(number, name):
    numbers = random.Random(number)
    mesh = Mesh()
    KINDS[number % len(KINDS)](mesh, numbers)
    mesh.write(name, (numbers.uniform(0, 1), numbers.uniform(0, 1)))


def array_of(file, name):
    """A one-dimensional array of a .npz file."""
    data = io.BytesIO(file.read(name + '.npy'))
    data.seek(8)
    header = ast.literal_eval(data.read(int.from_bytes(data.read(2), 'little')).decode())
    values = array.array({'<f8': 'd', '<f4': 'f', '<i4': 'i', '<i8': 'q'}[header['descr']])
    values.frombytes(data.read())
    return values


def rows_of(name):
    """The rows of a matrix: of each column its value and error."""
    with zipfile.ZipFile(name) as file:
        first, column, value, error = (array_of(file, part) for part in ('indptr', 'indices', 'data', 'error'))
    return [{column[k]: (value[k], error[k]) for k in range(first[row], first[row + 1])}
            for row in range(len(first) - 1)]


def inside(name, truth):
    """The number of rows inside, of shares of surroundings inside, and of rows that have any."""
    with open(f'{name}.json') as file:
        about = json.load(file)
    rows = shares = count = 0
    sky = about['facets']
    for found, true, estimate in zip(rows_of(f'{name}.npz'), truth, about['errors']):
        if not found:
            continue
        both = {c: (found.get(c, (0, 0)), true.get(c, (0, 0))) for c in found.keys() | true.keys()}
        count += 1
        rows += sum(abs(a - b) for (a, _), (b, _) in both.values()) <= estimate + sum(e for _, (_, e) in both.values())
        (a, e), (b, noise) = both.get(sky, ((0, 0), (0, 0)))
        shares += abs(a - b) <= e * (1 + 1e-6) + 3 * noise  # errors are of binary32
    return rows, shares, count


def main():
    program, work = sys.argv[1:3]
    meshes = int(sys.argv[3]) if len(sys.argv) > 3 else 32
    samples = sys.argv[4] if len(sys.argv) > 4 else str(1 << 20)
    errors = sys.argv[5:] or ['0.03', '0.01']
    os.makedirs(work, exist_ok=True)
    totals = [0, 0, 0]
    print('| mesh | kind | --max-error | processor s | rows | inside | sky inside |\n' + '| --- ' * 7 + '|')
    for number in range(meshes):
        scene = f'{work}/{number}.obj'
        write_mesh(number, scene)
        run([program, 'formfactors', scene, '--facets', '--all', '--method', 'rays', '--samples', samples, '-o',
             f'{work}/rays.npz', '-q'])
        truth = rows_of(f'{work}/rays.npz')
        for error in errors:
            seconds, _ = run([program, 'formfactors', scene, '--facets', '--all', '--max-error', error, '-o',
                              f'{work}/F.npz', '-q'])
            found = inside(f'{work}/F', truth)
            totals = [a + b for a, b in zip(totals, found)]
            print(f'| {number} | {KINDS[number % len(KINDS)].__name__} | {error} | {seconds:.2g} | {found[2]} | '
                  f'{found[0]} | {found[1]} |', flush=True)
    rows, shares, count = totals
    print(f'{100 * rows / count:.4g} % of {count} rows and {100 * shares / count:.4g} % of their skies are inside')
    sys.exit(min(rows, shares) < 0.99 * count)


if __name__ == '__main__':
    main()
