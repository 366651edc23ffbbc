"""Files under a locale with decimal commas."""

import locale
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hemitex as hx

NAMES = ["de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "es_ES.UTF-8"]


@pytest.fixture
def commas(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Sets a locale with decimal commas: one of the system, or one that localedef makes."""
    made = subprocess.run(["sh", "-c", f"localedef -f UTF-8 -i de_DE '{tmp_path}/de_DE.UTF-8'"], capture_output=True)
    if made.returncode == 0:
        monkeypatch.setenv("LOCPATH", str(tmp_path))
    for name in NAMES:
        try:
            locale.setlocale(locale.LC_ALL, name)
            break
        except locale.Error:
            continue
    else:
        pytest.skip("the system has no locale with decimal commas, and cannot make one")
    assert locale.localeconv()["decimal_point"] == ","
    yield
    locale.setlocale(locale.LC_ALL, "C")


def files(folder: Path) -> Path:
    """A triangle of a painted material, and its files."""
    os.makedirs(folder, exist_ok=True)
    (folder / "s.obj").write_text("mtllib s.mtl\nusemtl a\nv 0.5 0 0\nv 1.25 0 0\nv 1.25 1.5 0\nf 1 2 3\n")
    (folder / "s.mtl").write_text("newmtl a\nKd spectral p.rfl 0.5\nKe 0.25 1.5 2e-3\n")
    (folder / "p.rfl").write_text("400 0.25\n555.5 0.75\n700 0.5\n")
    (folder / "s.view.json").write_text('{"eye": [0.5, 0.25, 4.5], "look_at": [0.9, 0.5, 0.0], "fov": 40.5}')
    return folder / "s.obj"


def read(file: Path) -> tuple:
    scene = hx.load_scene(file)
    solution = hx.solve(scene)
    return scene.extent, scene.triangles()[0], solution.radiosity, hx.camera(scene).fov


def test_files_are_read_alike_under_decimal_commas(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    expected = read(files(tmp_path / "files"))
    request.getfixturevalue("commas")
    found = read(tmp_path / "files" / "s.obj")
    for value, other in zip(found, expected):
        assert np.array_equal(value, other)
