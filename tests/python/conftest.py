"""What the tests of the Python package share: the program hemitex, the scenes, and a room of arrays."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hemitex as hx

TOP = Path(__file__).resolve().parents[2]
DATA = TOP / "data"

BOX_VERTICES = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
#: The six faces of the unit cube, seen from inside.
BOX_FACES = np.array([[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]])
BOX_NAMES = ["back", "front", "floor", "ceiling", "left", "right"]


def run(*arguments: object) -> str:
    """The output of the program hemitex."""
    program = os.environ["HEMITEX_PROGRAM"]
    done = subprocess.run([program, "-q", *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


@pytest.fixture
def box() -> hx.Scene:
    """A closed room: the ceiling emits, and the left wall is red."""
    reflectance = np.full((6, 3), 0.5)
    reflectance[4] = [0.6, 0.1, 0.1]
    emission = np.zeros(6)
    emission[3] = 2.0
    return hx.Scene.from_arrays(BOX_VERTICES, BOX_FACES, reflectance, emission, BOX_NAMES)
