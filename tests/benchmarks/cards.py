#!/usr/bin/env python3
"""Solves a tree of 2,000 cards with a leaf of 512 x 512 pixels cut out, and the same tree of plain quads. Prints the
processor time of both on one thread, medians of runs by turns, and exits with 1 if the cards need over 2.5 times that
of the quads. The goal is 1.3 times.

usage: cards.py PROGRAM WORK [RUNS]"""
import math
import os
import random
import statistics
import struct
import subprocess
import sys
import zlib

CARDS, SIDE, LIMIT = 2000, 512, 2.5


def leaf():
    """The bytes of a PNG file with alpha."""
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

    rows = bytearray()
    for row in range(SIDE):
        rows.append(0)
        half_width = .45 * math.sin(math.pi * (row + .5) / SIDE) * SIDE
        for column in range(SIDE):
            rows += bytes((60 + column // 8, 150 - row // 10, 40, 255 if abs(column + .5 - SIDE / 2) < half_width else 0))
    return b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', SIDE, SIDE, 8, 6, 0, 0, 0)) + \
        chunk(b'IDAT', zlib.compress(bytes(rows))) + chunk(b'IEND', b'')


def unit(vector):
    length = math.sqrt(sum(x * x for x in vector))
    return [x / length for x in vector]


def tree(name):
    """The text of an OBJ file: squares of .15 m in a ball above a floor, which may cut each other."""
    chance = random.Random(1)
    lines = [f'mtllib {name}.mtl', 'vt 0 0', 'vt 1 0', 'vt 1 1', 'vt 0 1',
             'v -5 0 -5', 'v -5 0 5', 'v 5 0 5', 'v 5 0 -5', 'v -1 8 -1', 'v 1 8 -1', 'v 1 8 1', 'v -1 8 1',
             'o floor', 'usemtl floor', 'f 1/1 2/2 3/3 4/4', 'o lamp', 'usemtl lamp', 'f 5/1 6/2 7/3 8/4']
    for card in range(CARDS):
        centre = [chance.gauss(mean, .8) for mean in (0, 3, 0)]
        along = unit([chance.gauss(0, 1) for _ in range(3)])
        other = [chance.gauss(0, 1) for _ in range(3)]
        across = unit([x - sum(a * b for a, b in zip(other, along)) * y for x, y in zip(other, along)])
        lines += [f'o leaf{card}', 'usemtl leaf']
        for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            lines.append('v ' + ' '.join(f'{c + .075 * (s * a + t * b):.6f}' for c, a, b in zip(centre, along, across)))
        lines.append('f ' + ' '.join(f'{4 * card + k + 8}/{k}' for k in (1, 2, 3, 4)))
    return '\n'.join(lines) + '\n'


def seconds(arguments):
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f'{" ".join(arguments)}: exit code {process.returncode}')
    return usage.ru_utime + usage.ru_stime


def main():
    program, work, runs = sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 3
    os.makedirs(work, exist_ok=True)
    with open(f'{work}/leaf.png', 'wb') as file:
        file.write(leaf())
    times = {'quads': [], 'cards': []}
    for name, maps in (('quads', 'Kd .2 .4 .1'), ('cards', 'Kd 1 1 1\nmap_Kd leaf.png\nmap_d leaf.png')):
        with open(f'{work}/{name}.mtl', 'w') as file:
            file.write(f'newmtl floor\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 20 20 20\nnewmtl leaf\n{maps}\n')
        with open(f'{work}/{name}.obj', 'w') as file:
            file.write(tree(name))
    for _ in range(runs):
        for name, taken in times.items():
            taken.append(seconds([program, 'solve', f'{work}/{name}.obj', '-o', f'{work}/{name}', '--shots', '200',
                                  '--threads', '1', '-q']))
    quads, cards = statistics.median(times['quads']), statistics.median(times['cards'])
    print(f'{CARDS} quads {quads:.1f} s, {CARDS} cards {cards:.1f} s: {cards / quads:.2f} times')
    sys.exit(cards > LIMIT * quads)


main()
