"""Test vectors, which judge rasterizers pixel by pixel, and explanations of pixels."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from .rasterizers import DrawList, Face, Ids, Rasterizer, _draw_list, _face, _factory, _to_core
from .scenes import _core_of

VERDICTS = ("exact", "coverage", "texel", "depth", "loose-clipping", "error")
"""The verdict on a pixel: that of the rules, explained by the profile of a device, or an error."""


class TestVector:
    """A draw list and faces, for which the raster rules say the item ID of each pixel."""
    __test__ = False  # no test of pytest

    def __init__(self, core: _core.TestVector) -> None:
        """For use by this package: see `vector_suite`, `read_vector` and `TestVector.from_arrays`."""
        self._core = core
        about: dict[str, Any] = _core.about_vector(core)
        self.name: str = about["name"]
        self.catches: str = about["catches"]
        """The faults that it finds."""
        self.draw_list: DrawList = _draw_list(about["draw_list"])
        self.faces: list[Face] = [_face(face) for face in about["faces"]]
        self.face_names: list[str] = list(about["face_names"])

    @staticmethod
    def from_arrays(name: str, draw_list: DrawList, faces: Face | Sequence[Face]) -> TestVector:
        """A vector of one's own. Raises InputError for a draw list or a face against the rules."""
        views = [_to_core(face) for face in ([faces] if isinstance(faces, Face) else faces)]
        return TestVector(_core.make_vector(name, _to_core(draw_list), views, []))

    def draw(self, rasterizer: Rasterizer | None = None) -> list[Ids]:
        """The item buffers of all faces, (height, width): by the rules, or by a rasterizer."""
        return _core.draw(self._core, _factory(rasterizer))

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes the vector into a folder that exists, for programs in any language."""
        _core.write_vector(self._core, os.fspath(folder))

    def __repr__(self) -> str:
        return f"<hemitex.TestVector {self.name}>"


@dataclass(frozen=True)
class Verdict:
    """The verdict on the item buffers of a rasterizer."""
    vector: str
    passed: bool  #: whether no pixel is an error
    counts: dict[str, int]  #: pixels by verdict (VERDICTS)
    errors: list[dict[str, Any]]  #: the first error pixels: face, column, row, kind, expected, found, ...
    diagnosis: list[dict[str, Any]]  #: faults that may explain the errors: fault, agreement, advice
    text: str  #: the diagnosis as one sentence; empty if there is none
    pixels: list[npt.NDArray[np.uint8]]  #: per face (height, width): the number of each verdict in VERDICTS
    expected: list[Ids]  #: per face (height, width): the item IDs of the rules

    def __str__(self) -> str:
        counts = ", ".join(f"{count} {name}" for name, count in self.counts.items() if count)
        return f"{self.vector}: {counts}" + (f"; {self.text}" if self.text else "")


def vector_suite() -> list[TestVector]:
    """All vectors of the suite.

    >>> [vector.name for vector in vector_suite() if vector.name.startswith("perspective-f")]
    ['perspective-floor']
    """
    return [TestVector(core) for core in _core.vector_suite()]


def read_vector(folder: str | os.PathLike[str]) -> TestVector:
    """The vector in a folder that `hemitex vector suite`, `export` or `random` wrote."""
    return TestVector(_core.read_vector(os.fspath(folder)))


def judge(vector: TestVector,
          found: Rasterizer | npt.NDArray[Any] | Sequence[npt.ArrayLike],
          *,
          profile: Mapping[str, Any] | None = None) -> Verdict:
    """Judges a rasterizer, or the item buffers that it drew: arrays (height, width) of integers, one per face. For a
    vector of one face the array alone is enough.

    profile: allowed deviations of a device, with the keys of profile files.
    """
    core = _core_of(vector, TestVector)
    drawn = vector.draw(found) if callable(found) else found
    buffers: list[Any] = [drawn] if getattr(drawn, "ndim", 0) == 2 else list(drawn)
    text, diagnosis, pixels, expected = _core.judge(core, buffers,
                                                    None if profile is None else json.dumps(dict(profile)))
    report = json.loads(text)
    return Verdict(vector=vector.name, passed=report["pass"], counts=report["pixels"], errors=report["errors"],
                   diagnosis=report["diagnosis"], text=diagnosis, pixels=pixels, expected=expected)


@dataclass(frozen=True)
class Explanation:
    """How the raster rules derive the item ID of a pixel."""
    face: str
    column: int
    row: int
    id: int
    origin: str  #: the draw and the texel that give the item ID
    derivation: dict[str, Any] | None  #: every number from the vertices to the blend; None for the background
    triangles: list[dict[str, Any]]  #: that cover the sample, nearest first

    def __str__(self) -> str:
        lines = [f"pixel {self.column},{self.row} of {self.face} holds {self.id}: {self.origin}"]
        lines += [f"  {name}: {value}" for name, value in (self.derivation or {}).items()]
        return "\n".join(lines)


def explain(vector: TestVector, column: int, row: int, *, face: str | None = None) -> Explanation:
    """Derives the item ID of a pixel of the viewport of a face, by default the first one."""
    found = json.loads(
        _core.explain(_core_of(vector, TestVector), vector.face_names[0] if face is None else face, column, row))
    return Explanation(face=found["face"], column=found["column"], row=found["row"], id=found["word"],
                       origin=found["from"], derivation=found["derivation"], triangles=found["triangles"])
