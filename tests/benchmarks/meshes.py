#!/usr/bin/env python3
"""Solves meshes and cities of growing size with one shot and prints a table of their time and memory.

usage: meshes.py PROGRAM WORK [LARGEST]

A mesh is a wavy ball of N triangles in a room, a city has N boxes of five faces on a ground; N is 10^3, 10^4, ... up to
LARGEST (default 10^6 triangles, and a fifth of as many boxes). Exit code: 1 if ten times the size takes more than 20
times the time, but at least 20 s, or more than 20 times the memory."""
import math
import os
import random
import shutil
import sys

sys.dont_write_bytecode = True  # no files beside the sources
from sizes import run  # noqa: E402

LAMP = 'usemtl lamp\no lamp\nv 1.5 {0} 2\nv 2.5 {0} 2\nv 2.5 {0} 3\nv 1.5 {0} 3\nf -4 -3 -2 -1\n'


def box(low, high, faces):
    corners = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    return ''.join('v %.9g %.9g %.9g\n' % tuple(c) for c in corners) + ''.join(
        'f ' + ' '.join(str(i - 8) for i in face) + '\n' for face in faces)


SIDES = [(4, 5, 7, 6), (1, 0, 2, 3), (5, 1, 3, 7), (0, 4, 6, 2), (6, 7, 3, 2), (0, 1, 5, 4)]


def mesh(file, triangles):
    """A room with a wavy ball: a grid around the axis, without the triangles at the poles."""
    file.write('mtllib scene.mtl\n' + LAMP.format(2.9) + 'usemtl grey\no room\n')
    file.write(box((0, 0, 0), (4, 3, 5), [face[::-1] for face in SIDES]) + 'o ball\n')
    rows = round(math.sqrt(triangles / 4))
    around = round(triangles / 2 / rows)
    for i in range(rows + 1):
        polar = math.pi * (0.05 + 0.9 * i / rows)
        for j in range(around):
            angle = 2 * math.pi * j / around
            radius = 0.7 + 0.05 * math.sin(6 * polar) * math.sin(5 * angle)
            file.write('v %.9g %.9g %.9g\n' % (2 + radius * math.sin(polar) * math.cos(angle), 1.3 + radius * math.cos(
                polar), 2.5 - radius * math.sin(polar) * math.sin(angle)))
    for i in range(rows):
        for j in range(around):
            a, b = 13 + i * around + j, 13 + i * around + (j + 1) % around
            file.write(f'f {a} {a + around} {b}\nf {b} {a + around} {b + around}\n')


def city(file, boxes):
    side = round(math.sqrt(boxes))
    height = random.Random(1)
    file.write('mtllib scene.mtl\n' + LAMP.format(80) + 'usemtl grey\no ground\n')
    end = 12 * side
    file.write(f'v 0 0 0\nv 0 0 {end}\nv {end} 0 {end}\nv {end} 0 0\nf -4 -3 -2 -1\n')
    for i in range(side * side):
        x, z = 12 * (i % side) + 3, 12 * (i // side) + 3
        file.write(f'o box-{i}\n' + box((x, 0, z), (x + 6, height.uniform(3, 40), z + 6), SIDES[:5]))


def solved(program, work, what, count):
    """Solves a scene. Returns processor seconds and bytes."""
    with open(f'{work}/scene.obj', 'w') as file:
        what(file, count)
    shutil.rmtree(f'{work}/solved', ignore_errors=True)
    return run([program, 'solve', f'{work}/scene.obj', '-o', f'{work}/solved', '--shots', '1', '--no-elements',
                '--no-textures', '-q'])


def main():
    program, work = sys.argv[1:3]
    largest = int(sys.argv[3]) if len(sys.argv) > 3 else 10 ** 6
    os.makedirs(work, exist_ok=True)
    with open(f'{work}/scene.mtl', 'w') as file:
        file.write('newmtl grey\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\n')
    print('| scene | size | processor s | MB |\n| --- | --- | --- | --- |')
    failed = False
    for what, unit, end in ((mesh, 'triangles', largest), (city, 'boxes', largest // 5)):
        previous = None
        for count in [10 ** n for n in range(3, 9) if 10 ** n < end] + [end]:
            seconds, size = solved(program, work, what, count)
            print(f'| {what.__name__} | {count} {unit} | {seconds:.3g} | {size / 1e6:.0f} |', flush=True)
            if previous:
                ratio = 2 * count / previous[0]  # 20 for ten times the size
                failed |= seconds > ratio * max(previous[1], 1) or size > ratio * previous[2]
            previous = (count, seconds, size)
    sys.exit(failed)


if __name__ == "__main__":
    main()
