#!/usr/bin/env python3
"""Solves tiled rooms of growing size and prints a table of their time and memory.

usage: sizes.py PROGRAM GENERATOR WORK [TILES ...]

A room of N tiles has 16 N^2 surfaces of 10 x 10 elements; the default is 10^4 to 10^8 elements, which needs 14 GB of
memory. GENERATOR is hemitex_data."""
import json
import os
import shutil
import subprocess
import sys

SHOTS = 100


def run(arguments, stdout=None, silent=False, folder=None):
    """Runs a command. Returns its processor time in seconds and its peak memory in bytes."""
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL if silent else stdout,
                               stderr=subprocess.DEVNULL if silent else None, cwd=folder)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f'{" ".join(arguments)}: exit code {process.returncode}')
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


def solved(program, generator, work, tiles):
    """Solves a room. Returns a line of the table."""
    shutil.rmtree(f'{work}/solved', ignore_errors=True)  # an old result would be read
    run([generator, work, '--tiles', str(tiles)])
    scene, folder = f'{work}/tiled-room-{tiles}.obj', f'{work}/solved'
    cpu, memory = run([program, 'solve', scene, '-o', folder, '--texels', '10', '--shots', str(SHOTS),
                       '--no-elements', '--no-textures', '--insist', '-q'])
    os.remove(scene)
    with open(f'{folder}/solution.json') as file:
        solution = json.load(file)
    times, elements = solution['times'], solution['elements']
    assert elements == 1600 * tiles * tiles and solution['shots'] == SHOTS
    seconds = [times[key] for key in ('load_s', 'discretize_s', 'solve_s', 'write_s')]
    numbers = [f'{second:.3g}' for second in seconds + [cpu]]
    return [elements, len(solution['surfaces'])] + numbers + [
        f'{SHOTS / times["solve_s"]:.3g}', round(memory / 1e6), f'{memory / elements:.0f}']


def main():
    program, generator, work = sys.argv[1:4]
    os.makedirs(work, exist_ok=True)
    header = ['elements', 'surfaces', 'load s', 'discretize s', 'solve s', 'write s', 'processor s', 'shots/s', 'MB',
              'bytes/element']
    for line in [header, ['---'] * len(header)]:
        print('| ' + ' | '.join(line) + ' |')
    for tiles in map(int, sys.argv[4:] or [3, 8, 25, 80, 250]):
        print('| ' + ' | '.join(map(str, solved(program, generator, work, tiles))) + ' |', flush=True)


if __name__ == "__main__":
    main()
