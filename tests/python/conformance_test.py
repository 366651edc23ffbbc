"""Rasterizers written in Python: judged by the vectors, and used by the solver."""

import numpy as np
import pytest
from conftest import DATA

import hemitex as hx


def reference(draw_list: hx.DrawList, face: hx.Face, skipped: np.ndarray) -> np.ndarray:
    """The reference renderer as a function, which draws all triangles but the skipped ones."""
    draws = []
    for draw in draw_list.draws:
        for triangle in range(draw.first, draw.first + draw.count):
            if triangle not in skipped:
                draws.append(hx.Draw(triangle, 1, draw.offset, draw.back, draw.index_map))
    parts = hx.DrawList(draw_list.positions, draw_list.texcoords, draw_list.triangles, draws, draw_list.index_maps,
                        draw_list.channel_bits, draw_list.blend)
    return hx.TestVector.from_arrays("one", parts, face).draw()[0]


def test_judge_passes_the_reference() -> None:
    for vector in hx.vector_suite()[:10]:
        verdict = hx.judge(vector, reference)
        assert verdict.passed and verdict.counts["exact"] == sum(pixels.size for pixels in verdict.pixels)


def test_judge_names_the_fault_of_a_rasterizer() -> None:
    vector = next(vector for vector in hx.vector_suite() if vector.name == "texels-100")

    def mirrored(draw_list: hx.DrawList, face: hx.Face, skipped: np.ndarray) -> np.ndarray:
        return reference(draw_list, face, skipped)[::-1]

    verdict = hx.judge(vector, mirrored)
    assert not verdict.passed and verdict.errors and "upside" in verdict.text + str(verdict.diagnosis)


def test_solve_with_a_rasterizer_equals_the_reference() -> None:
    elements = hx.discretize(hx.load_scene(DATA / "cornell-box.obj"), texels=2)
    calls = []

    def counted(draw_list: hx.DrawList, face: hx.Face, skipped: np.ndarray) -> np.ndarray:
        calls.append(face)
        return reference(draw_list, face, skipped)

    options = {"residual": 0.2, "resolution": 32}
    found = hx.solve(elements, rasterizer=counted, **options)
    assert calls and np.array_equal(found.radiosity, hx.solve(elements, **options).radiosity)


def test_errors_of_a_rasterizer_reach_the_caller() -> None:
    scene = hx.load_scene(DATA / "cornell-box.obj")

    def fails(draw_list: hx.DrawList, face: hx.Face, skipped: np.ndarray) -> np.ndarray:
        raise KeyError("broken")

    with pytest.raises(KeyError, match="broken"):
        hx.solve(scene, rasterizer=fails)
    for wrong in (None, 1, "x", np.zeros((3, 3), np.uint32), np.zeros((32, 32)), np.full((32, 32), -1)):
        with pytest.raises(hx.InputError, match="rasterizer"):
            hx.hemicube(scene, "floor", resolution=32, rasterizer=lambda *_: wrong)
