"""What is too large is refused before it takes the memory."""

import os
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest

import hemitex as hx


def test_discretize_refuses_more_elements_than_it_is_meant_for() -> None:
    start = time.monotonic()
    scene = hx.Scene.from_arrays(np.array([[0, 0, z] for z in range(2)] + [[1, 0, 0], [1, 1, 0]], float),
                                 [[0, 2, 3], [1, 2, 3]], names=["a", "b"], sides="one")
    with pytest.raises(hx.InputError, match="more than 16777216.*with hemitex.insist()"):
        hx.discretize(scene, texel_size=1e-9)
    assert time.monotonic() - start < 5


def test_insist_runs_what_is_refused_otherwise(tmp_path: Path) -> None:
    script = tmp_path / "insist.py"
    script.write_text("""
import resource, sys
import hemitex as hx
scene = hx.Scene.from_arrays([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2, 3]], names=["square"],
                             sides="one")
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + (300 << 20), used + (300 << 20)))
try:
    hx.discretize(scene, texels=2000)
except hx.InputError as error:
    print(error)
try:
    with hx.insist():
        hx.discretize(scene, texels=2000)
except MemoryError:
    print("MemoryError")
try:
    hx.discretize(scene, texels=2000)
except hx.InputError as error:
    print("refused again")
""")
    run = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=60, env=os.environ)
    assert run.returncode == 0, run.stderr
    lines = run.stdout.splitlines()
    assert "the scene with 4000000 elements takes about 400 MB of memory; " in lines[0]
    assert lines[-1] == "refused again"


def test_read_matrix_refuses_an_archive_that_promises_much(tmp_path: Path) -> None:
    header = "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000,), }"
    header += " " * (117 - len(header)) + "\n"
    with zipfile.ZipFile(tmp_path / "bomb.npz", "w") as archive:
        for name in ["format", "shape", "indptr", "indices", "data"]:
            archive.writestr(name + ".npy", b"\x93NUMPY\x01\x00" + bytes([118, 0]) + header.encode())
    with pytest.raises(hx.InputError, match="bomb.npz"):
        hx.read_matrix(tmp_path / "bomb.npz")


def test_readers_do_not_wait_for_a_pipe(tmp_path: Path) -> None:
    for name in ["a.csv", "a.mtx", "a.npz", "a.vf"]:
        os.mkfifo(tmp_path / name)
        with pytest.raises(hx.InputError, match="is a pipe or a device"):
            hx.read_matrix(tmp_path / name)
    for name in ["a.obj", "a.glb", "a.ply", "a.vtp"]:
        os.mkfifo(tmp_path / name)
        with pytest.raises(hx.InputError, match="is a pipe or a device"):
            hx.load_scene(tmp_path / name)
