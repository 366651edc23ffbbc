#!/usr/bin/env python3
"""Measures matrices of form factors and prints a table of their time, memory and error.

usage: matrices.py PROGRAM DATA WORK [LARGEST] [--view3d VIEW3D]

The scenes are cities of 1152, 4608, 22050 and 101250 triangles, up to LARGEST (default 22050), a wavy ball in a room,
and two rooms of DATA. Each matrix is computed with several bounds of its rows' errors, and smoothed. Up to 60 rows are
compared with rays. If the program View3D is given, it computes the cities up to 4608 triangles, too.

error      sum of area times the absolute errors of form factors, over the sum of area times form factors
inside     rows whose error is at most the estimate in the JSON file beside the matrix, and the noise of the rays
per exchange   processor time over the entries of the matrix

Exit code: 1 if fewer than 99 % of all rows are inside, or a matrix is off by more than its --max-error."""
import argparse
import json
import os
import random
import sys

sys.dont_write_bytecode = True  # no files beside the sources
from meshes import mesh  # noqa: E402
from sizes import run  # noqa: E402

SAMPLES = 1 << 21  # rays per row and seed
ROWS = 60


def city(file, boxes):
    """Boxes on a ground, as triangles of about one size: boxes * boxes of 10 x 10 in fields of 20 x 20."""
    height = random.Random(1)
    for n in range(boxes * boxes):
        x, z, h = 20 * (n % boxes), 20 * (n // boxes), height.uniform(5, 25)
        low, high, floor = 5, 15, [(0, 0), (20, 0), (20, 20), (0, 20)]
        a, b, c, d = (x + low, z + low), (x + high, z + low), (x + high, z + high), (x + low, z + high)
        e, f, g, i = ((x + u, z + v) for u, v in floor)
        quads = [[(p[0], 0, p[1]), (q[0], 0, q[1]), (q[0], h, q[1]), (p[0], h, p[1])]
                 for p, q in ((b, a), (c, b), (d, c), (a, d))]
        quads.append([(p[0], h, p[1]) for p in (d, c, b, a)])
        quads += [[(p[0], 0, p[1]) for p in field] for field in (
            [i, g, (g[0], c[1]), (i[0], d[1])], [(e[0], a[1]), (f[0], b[1]), f, e],
            [(e[0], d[1]), d, a, (e[0], a[1])], [c, (f[0], c[1]), (f[0], b[1]), b])]
        for quad in quads:
            file.write(''.join('v %.9g %.9g %.9g\n' % corner for corner in quad) + 'f -4 -3 -2\nf -4 -2 -1\n')


def lines_of(name):
    with open(name) as file:
        next(file)
        for line in file:
            yield line.rstrip('\n').split(',')


def chosen_rows(facets):
    count = min(ROWS, facets)
    return [(2 * n + 1) * facets // (2 * count) for n in range(count)]


def matrix_rows(name, rows):
    """The rows of a CSV as dictionaries, without surroundings and backs."""
    found = {row: {} for row in rows}
    for source, target, factor in lines_of(name):
        if int(source) in found and target.isdigit():
            found[int(source)][int(target)] = float(factor)
    return found


def view3d_rows(name, rows):
    with open(name) as file:
        texts = file.read().split('\n')
    return {row: {i: float(f) for i, f in enumerate(texts[2 + row].split()) if float(f) != 0} for row in rows}


def ray_rows(program, work, scene, names, rows):
    """The mean of two measurements of each row, and the part of their difference that is noise of the mean."""
    truth = {}
    for row in rows:
        seeds = []
        for seed in (1, 2):
            with open(f'{work}/row.csv', 'w') as file:
                run([program, 'formfactors', scene, '--facets', '--from', names[row], '--method', 'rays', '--samples',
                     str(SAMPLES), '--seed', str(seed), '-q'], stdout=file)
            seeds.append({i: float(cells[-2]) for i, cells in enumerate(lines_of(f'{work}/row.csv'))})
        a, b = seeds
        truth[row] = ({i: (a[i] + b[i]) / 2 for i in a if a[i] + b[i] > 0}, sum(abs(a[i] - b[i]) for i in a) / 2)
    return truth


def compare(found, truth, area, estimates):
    """The error of the matrix, the noise of the rays, and the number of rows inside."""
    apart = noise = light = inside = 0
    for row, (true, spread) in truth.items():
        own = found[row]
        error = sum(abs(own.get(i, 0) - true.get(i, 0)) for i in own.keys() | true.keys())
        apart += area[row] * error
        noise += area[row] * spread
        light += area[row] * sum(true.values())
        inside += estimates is not None and error <= estimates[row] + spread
    return apart / light, noise / light, inside


def to_view3d(scene, name):
    """Writes triangles of an OBJ with relative numbers for View3D."""
    count = surface = 0
    with open(scene) as obj, open(name, 'w') as file:
        file.write('T mesh\nC encl=0 list=0 eps=1.0e-4 maxU=12 maxO=8 minO=0 row=0 col=0 prjd=1\nF 3\n')
        for line in obj:
            kind, *words = line.split()
            if kind == 'v':
                count += 1
                file.write(f'V {count} {" ".join(words)}\n')
            if kind == 'f':
                surface += 1
                corners = ' '.join(str(count + 1 + int(word)) for word in words)
                file.write(f'S {surface} {corners} 0 0 0 0.9 f{surface}\n')
        file.write('End of data\n')


class Table:
    def __init__(self):
        self.rows = self.inside = 0
        self.has_failed = False
        print('| scene | facets | by | processor s | MB | entries | us per exchange | error % | noise of rays % | inside |')
        print('| --- ' * 10 + '|')

    def add(self, scene, facets, by, used, entries, compared, rows):
        error, noise, inside = compared
        seconds, memory = used
        print(f'| {scene} | {facets} | {by} | {seconds:.3g} | {memory / 1e6:.0f} | {entries} | '
              f'{1e6 * seconds / entries:.3g} | {100 * error:.3g} | {100 * noise:.2g} | '
              f'{f"{inside} of {rows}" if inside is not None else "-"} |', flush=True)

    def count(self, inside, rows, error, bound):
        self.rows += rows
        self.inside += inside
        self.has_failed |= error > bound


def measure(table, options, name, scene, bounds, has_view3d):
    work = options.work
    rows = truth = None
    for bound, smooth in bounds:
        output = f'{work}/F.csv'
        used = run([options.program, 'formfactors', scene, '--facets', '--all', '--max-error', str(bound), '-o', output,
                    '-q'] + (['--smooth'] if smooth else []))
        with open(f'{work}/F.json') as file:
            about = json.load(file)
        facets, area = about['facets'], about['area']
        if truth is None:
            rows = [row for row in chosen_rows(facets) if area[row] > 0]
            truth = ray_rows(options.program, work, scene, about.get('names', [str(f) for f in range(facets)]), rows)
        compared = compare(matrix_rows(output, rows), truth, area, about['errors'])
        by = f'--max-error {bound}' + (' --smooth' if smooth else '')
        table.add(name, facets, by, used, about['entries'], compared, len(rows))
        table.count(compared[2], len(rows), max(compared[0] - compared[1], 0), bound)
    if has_view3d:
        to_view3d(scene, f'{work}/scene.vs3')
        # View3D leaves a log where it runs.
        used = run([os.path.abspath(options.view3d), 'scene.vs3', 'scene.vf'], silent=True, folder=work)
        error, noise, _ = compare(view3d_rows(f'{work}/scene.vf', rows), truth, area, None)
        table.add(name, facets, 'View3D', used, facets * facets, (error, noise, None), len(rows))


def main():
    parser = argparse.ArgumentParser()
    for name in ('program', 'data', 'work'):
        parser.add_argument(name)
    parser.add_argument('largest', nargs='?', type=int, default=22050)
    parser.add_argument('--view3d')
    options = parser.parse_args()
    os.makedirs(options.work, exist_ok=True)
    with open(f'{options.work}/scene.mtl', 'w') as file:
        file.write('newmtl grey\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n')
    table = Table()
    scene = f'{options.work}/scene.obj'
    both = [(0.03, False), (0.03, True)]
    for boxes in (8, 16, 35, 75):
        facets = 18 * boxes * boxes
        if facets > options.largest:
            break
        with open(scene, 'w') as file:
            city(file, boxes)
        many = facets > 5000
        measure(table, options, 'city', scene, [(0.04, True)] if many else [(0.015, False)] + both,
                options.view3d and not many)
    with open(scene, 'w') as file:
        mesh(file, min(1000, options.largest))
    measure(table, options, 'ball in a room', scene, both, False)
    for room in ('cornell-box', 'pyramid-room'):
        measure(table, options, room, f'{options.data}/{room}.obj', both, False)
    share = table.inside / table.rows
    print(f'{100 * share:.4g} % of {table.rows} rows are inside')
    sys.exit(table.has_failed or share < 0.99)


if __name__ == '__main__':
    main()
