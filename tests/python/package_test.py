"""The package: its examples run, and its types are checked."""

import doctest
import importlib
import inspect
import subprocess
import sys

import pytest
from conftest import TOP

import hemitex as hx

MODULES = ["hemitex"] + [f"hemitex.{name}" for name in ("scenes", "form_factors", "light", "pictures", "rasterizers",
                                                        "conformance")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_the_documentation_run(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_examples_of_the_page_run() -> None:
    assert doctest.testfile(str(TOP / "docs/python.md"), module_relative=False).failed == 0


def test_all_public_names_have_documentation() -> None:
    for name in hx.__all__:
        value = getattr(hx, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            assert inspect.getdoc(value), name


def test_types_are_checked() -> None:
    command = [sys.executable, "-m", "mypy", "--config-file", str(TOP / "pyproject.toml"), str(TOP / "python/hemitex")]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_input_errors_have_file_line_and_advice(tmp_path) -> None:
    file = tmp_path / "scene.obj"
    file.write_text("v 0 0 0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n")
    with pytest.raises(hx.InputError) as caught:
        hx.load_scene(file)
    assert caught.value.file == str(file) and caught.value.line == 3
    with pytest.raises(hx.InputError) as caught:
        hx.load_scene(tmp_path / "missing.obj")
    assert caught.value.file and caught.value.line is None and caught.value.advice
    assert isinstance(caught.value, ValueError)
