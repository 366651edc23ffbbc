#!/usr/bin/env python3
"""Solves five scenes on one thread, and draws the unshot share of the flux over processor seconds of the whole program:
a panel per scene, a curve per PROGRAM, such as one before a change and one after it. Prints the seconds to each share.

usage: convergence.py PICTURE DATA WORK PROGRAM [PROGRAM ...]"""
import json
import math
import os
import subprocess
import sys

import matplotlib
matplotlib.use('Agg')
from matplotlib import pyplot  # noqa: E402

SCENES = [('cornell-box', []), ('furnished-room', []), ('gallery', ['--residual', '.01']),
          ('blind', ['--sky', '12,13,16', '--sun=-.35,.9,1=70,64,52', '--residual', '.01']), ('curved-room', [])]
SHARES = [.1, .01, .001]


def blind(folder):
    """Writes a room of 4 x 2.6 x 3.6 m with a window of 1.6 x 1.3 m, and 30 slats in front of it. Returns its file."""
    corners, faces = [], []

    def polygon(*points):
        corners.extend(points)
        faces.append(range(len(corners) - len(points) + 1, len(corners) + 1))

    def box(low, high, place=lambda x, y, z: (x, y, z), inwards=False, without=None):
        for axis in range(3):
            for side in (0, 1):
                if (axis, side) == without:
                    continue
                square = [(0, 0), (1, 0), (1, 1), (0, 1)][::1 if side != inwards else -1]
                points = []
                for a, b in square:
                    at = {axis: side, (axis + 1) % 3: a, (axis + 2) % 3: b}
                    points.append(place(*(high[k] if at[k] else low[k] for k in range(3))))
                polygon(*points)

    box((0, 0, 0), (4, 2.6, 3.6), inwards=True, without=(2, 1))
    for low, high in (((0, 0), (4, .85)), ((0, 2.15), (4, 2.6)), ((0, .85), (1.2, 2.15)), ((2.8, .85), (4, 2.15))):
        polygon((low[0], low[1], 3.6), (low[0], high[1], 3.6), (high[0], high[1], 3.6), (high[0], low[1], 3.6))
    slope, half, thickness = math.radians(35), .025, .001
    for slat in range(30):
        def turned(x, y, z, height=.87 + slat * 1.26 / 29):
            sine, cosine = math.sin(slope), math.cos(slope)
            return x, height + y * cosine - z * sine, 3.7 + y * sine + z * cosine

        box((1.21, 0, -half), (2.79, thickness, half), turned)
    file = f'{folder}/blind.obj'
    with open(f'{folder}/blind.mtl', 'w') as out:
        out.write('newmtl white\nKd .8 .78 .75\n')
    with open(file, 'w') as out:
        out.write('mtllib blind.mtl\nusemtl white\n')
        out.writelines(f'v {x:.7g} {y:.7g} {z:.7g}\n' for x, y, z in corners)
        for number, face in enumerate(faces):
            out.write(f'o f{number}\nf {" ".join(map(str, face))}\n')
    with open(f'{folder}/blind.view.json', 'w') as out:
        json.dump({'eye': [.6, 1.6, .4], 'look_at': [2.4, 1.1, 3.2], 'up': [0, 1, 0], 'fov': 66}, out)
    return file


def processor_seconds(process):
    with open(f'/proc/{process.pid}/stat') as file:
        fields = file.read().rsplit(')', 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def curve(program, scene, options, work):
    """Seconds and unshot shares, some ten per second."""
    process = subprocess.Popen([program, 'solve', scene, '--threads', '1', '--progress', 'json', '--no-elements',
                                '--no-textures', '-o', f'{work}/solved', *options],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    seconds, shares = [], []
    for line in process.stderr:
        if not line.startswith('{"shots"'):
            continue
        seconds.append(processor_seconds(process))
        shares.append(json.loads(line)['residual'])
    if process.wait() != 0:
        sys.exit(f'{program} {scene}: exit code {process.returncode}')
    return seconds, shares


def main():
    picture, data, work, *programs = sys.argv[1:]
    os.makedirs(work, exist_ok=True)
    figure, panels = pyplot.subplots(1, len(SCENES), figsize=(14, 3.2), sharey=True, layout='constrained')
    print('| scene | program | ' + ' | '.join(f's to {share:g}' for share in SHARES) + ' |')
    print('|---|---|' + '---|' * len(SHARES))
    for (name, options), panel in zip(SCENES, panels):
        scene = blind(work) if name == 'blind' else f'{data}/{name}.obj'
        for program in programs:
            seconds, shares = curve(program, scene, options, work)
            label = os.path.basename(program)
            panel.semilogy(seconds, shares, label=label)
            reached = [next((s for s, x in zip(seconds, shares) if x <= share), None) for share in SHARES]
            numbers = ['' if s is None else f'{s:.3g}' for s in reached]
            print('| ' + ' | '.join([name, label, *numbers]) + ' |', flush=True)
        panel.set(title=name, xlabel='processor seconds')
        panel.set_xlim(left=0)
        panel.grid(alpha=.3)
    panels[0].set_ylabel('unshot share of the flux')
    if len(programs) > 1:
        panels[0].legend(fontsize='small')
    figure.savefig(picture, dpi=90)


if __name__ == '__main__':
    main()
