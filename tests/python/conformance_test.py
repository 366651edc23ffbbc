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
                draws.append(hx.Draw(triangle, 1, draw.offset, draw.back, draw.index_map, draw.cull))
    parts = hx.DrawList(draw_list.positions, draw_list.texcoords, draw_list.triangles, draws, draw_list.index_maps,
                        draw_list.channel_bits, draw_list.blend, draw_list.values)
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


def test_holes_and_culling() -> None:
    positions = [[-1, -1, -1], [3, -1, -1], [-1, 3, -1], [-2, -2, -2], [6, -2, -2], [-2, 6, -2]]
    texcoords = [[0, 0], [2, 0], [0, 2]] * 2
    sides = [[0, 1, 2], [0, 2, 1]]
    for cull, shown in (("none", 0x101), ("back", 0x101), ("front", 0x201)):
        draws = [hx.Draw(0, 1, 0x100, index_map=0, cull=cull), hx.Draw(1, 1, 0x200, index_map=0, cull=cull)]
        draw_list = hx.DrawList(positions, texcoords, sides + [[3, 4, 5]], draws + [hx.Draw(2, 1, 0x300)],
                                [[[1, 2**32 - 1]]])
        ids = hx.TestVector.from_arrays("cut-out", draw_list, hx.Face(resolution=8)).draw()[0]
        assert np.all(ids[:, :4] == shown) and np.all(ids[:, 4:] == 0x300)
    with pytest.raises(hx.InputError, match="none, front, back"):
        hx.TestVector.from_arrays("wrong", hx.DrawList(positions, texcoords, sides, [hx.Draw(0, 1, cull="both")]),
                                  hx.Face(resolution=8))


def test_judge_takes_arrays() -> None:
    vector = next(vector for vector in hx.vector_suite() if vector.name == "texels-100")
    (right,) = vector.draw()
    for found in (right, [right], [right.tolist()], right[np.newaxis], right.astype(np.int64), right[::-1][::-1]):
        assert hx.judge(vector, found).passed
    wrong = right.copy()
    wrong[3, 5] ^= 64
    verdict = hx.judge(vector, wrong)
    assert verdict.counts["error"] == 1 and [verdict.errors[0][key] for key in ("column", "row")] == [5, 3]
    with pytest.raises(hx.InputError, match="found"):
        hx.judge(vector, right.astype(float))
    with pytest.raises(hx.InputError, match="found"):
        hx.judge(vector, right[1:])


def test_judge_takes_a_buffer_of_triangle_numbers() -> None:
    # Two triangles share the diagonal of a square from -1 to 1 at w = 1. Its samples belong to the one that lies to
    # the right, whose left edge it is.
    corners = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]], np.float32)
    vector = hx.TestVector.from_arrays("square", hx.DrawList.of_triangles(corners, [[0, 1, 2], [0, 2, 3]]),
                                       hx.Face(resolution=8))
    row, column = np.indices((8, 8))
    assert hx.judge(vector, np.where(column >= row, 0, 1)).counts["exact"] == 64
    hole = np.where(column == row, vector.draw_list.background, np.where(column > row, 0, 1))
    verdict = hx.judge(vector, hole)
    assert verdict.counts["error"] == 8 and verdict.errors[0]["kind"] == "missing"


def test_triangle_numbers() -> None:
    positions = [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1]]
    draw_list = hx.DrawList(positions, np.zeros((4, 2)), [[0, 1, 2], [1, 3, 2]], [hx.Draw(0, 2, 7)],
                            values="triangle-numbers")
    ids = hx.TestVector.from_arrays("numbers", draw_list, hx.Face(resolution=8)).draw()[0]
    assert ids[0, 0] == 7 and ids[7, 7] == 8 and set(ids.ravel()) == {7, 8}


def test_solve_with_a_rasterizer_equals_the_reference() -> None:
    elements = hx.discretize(hx.load_scene(DATA / "cornell-box.obj"), texels=2)
    calls = []

    def counted(draw_list: hx.DrawList, face: hx.Face, skipped: np.ndarray) -> np.ndarray:
        calls.append(face)
        return reference(draw_list, face, skipped)

    options = {"residual": 0.2, "resolution": 32}
    found = hx.solve(elements, rasterizer=counted, **options)
    assert calls and np.array_equal(found.radiosity, hx.solve(elements, **options).radiosity)


@pytest.mark.parametrize("device", ["software", "vulkan"])
def test_solve_and_rows_with_a_device_equal_the_reference(device: hx.Device) -> None:
    elements = hx.discretize(hx.load_scene(DATA / "cornell-box.obj"), texels=2)
    options = {"residual": 0.5, "resolution": 32}
    try:
        found = hx.solve(elements, rasterizer=device, **options)
    except hx.InputError as error:
        if "test vectors wrongly" in str(error):
            raise
        pytest.skip(f"no device: {error}")
    assert np.array_equal(found.radiosity, hx.solve(elements, **options).radiosity)
    row = hx.form_factor_row(elements, "floor", resolution=32)
    drawn = hx.form_factor_row(elements, "floor", resolution=32, rasterizer=device)
    assert np.array_equal(drawn.form_factor, row.form_factor)


def test_unknown_devices_are_errors_with_the_names_of_all() -> None:
    with pytest.raises(hx.InputError, match="vulkan-compute"):
        hx.solve(hx.load_scene(DATA / "cornell-box.obj"), rasterizer="vulcan")


def test_errors_of_a_rasterizer_reach_the_caller() -> None:
    scene = hx.load_scene(DATA / "cornell-box.obj")

    def fails(draw_list: hx.DrawList, face: hx.Face, skipped: np.ndarray) -> np.ndarray:
        raise KeyError("broken")

    with pytest.raises(KeyError, match="broken"):
        hx.solve(scene, rasterizer=fails)
    for wrong in (None, 1, "x", np.zeros((3, 3), np.uint32), np.zeros((32, 32)), np.full((32, 32), -1)):
        with pytest.raises(hx.InputError, match="rasterizer"):
            hx.hemicube(scene, "floor", resolution=32, rasterizer=lambda *_: wrong)
