"""Arrays that are wrong in shape, type, order, contiguity or content raise errors and never crash.

`HEMITEX_FUZZ=100000` tries more; tests/python/address_sanitizer.sh does so under the address sanitizer.
"""

import os
import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from conftest import BOX_FACES, BOX_NAMES, BOX_VERTICES

import hemitex as hx
from hemitex import _core

COUNT = int(os.environ.get("HEMITEX_FUZZ", "3000"))
#: What a call with wrong arguments may raise.
ALLOWED = (hx.InputError, TypeError, MemoryError, OverflowError)

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def unaligned(values: np.ndarray) -> np.ndarray:
    """The same values at an odd address."""
    memory = np.zeros(values.nbytes + 1, np.uint8)
    result = memory[1:].view(values.dtype).reshape(values.shape)
    result[...] = values
    return result


def strided(values: np.ndarray) -> np.ndarray:
    """The same values with gaps between them, and backwards in memory."""
    padded = np.zeros(tuple(2 * side for side in values.shape), values.dtype)
    view = padded[tuple(slice(None, None, 2) for _ in values.shape)][::-1]
    view[...] = values
    return view


#: Other arrays with the same values.
SAME: list[Callable[[np.ndarray], Any]] = [
    np.asfortranarray, strided, unaligned, lambda a: a.astype(a.dtype.newbyteorder()), lambda a: a.tolist(),
    lambda a: a.astype(np.float32) if a.dtype.kind == "f" else a.astype(np.int16), np.ma.asarray
]


@pytest.mark.parametrize("same", range(len(SAME)))
def test_arrays_of_any_layout_give_equal_results(same: int) -> None:
    expected = hx.Scene.from_arrays(BOX_VERTICES, BOX_FACES, np.full((6, 3), 0.5), np.ones((6, 3)), BOX_NAMES)
    found = hx.Scene.from_arrays(SAME[same](BOX_VERTICES), SAME[same](BOX_FACES), SAME[same](np.full((6, 3), 0.5)),
                                 SAME[same](np.ones((6, 3))), BOX_NAMES)
    assert np.array_equal(found.triangles()[0], expected.triangles()[0])
    solution = hx.solve(expected, residual=0.1, resolution=32)
    weights = np.arange(3 * len(solution.elements), dtype=float).reshape(-1, 3) % 5
    slopes = [hx.sensitivity(solution, each).by_emission for each in (weights, SAME[same](weights))]
    assert np.array_equal(*slopes)


def wrong(values: Any, rng: random.Random) -> Any:
    """A changed argument, perhaps still a valid one."""
    array = np.array(values) if not isinstance(values, (str, dict, tuple)) else np.zeros((2, 3))
    flat = array.astype(float) if array.dtype.kind in "iuf" else np.zeros(4)
    changed = flat.copy().reshape(flat.shape)
    if changed.size:
        changed.ravel()[rng.randrange(changed.size)] = rng.choice(
            [np.nan, np.inf, -np.inf, 1e300, -1e300, 1e19, -1, 0, 2**31, 2**32, 2**63, 1e-320])
    choices: list[Any] = [
        None, "text", b"bytes", 0, -1, 1.5, 2**70, True, object(), {}, [], [[]], [None], [[1, 2], [3]], "\ud800",
        np.zeros(0), np.zeros((0, 3)), np.zeros((3, 0)), np.zeros((1, 1, 1, 1)), np.array(5), np.array("x"),
        np.array([1 + 2j]), np.array([object()]), np.array(["a", "b"]), np.array(["2020-01-01"], "M8[D]"),
        np.array([True, False]), flat[..., :-1] if flat.ndim else flat, flat[:-1] if flat.ndim else flat,
        np.repeat(flat, 2, axis=0) if flat.ndim else flat, flat.T, flat.ravel(), flat[np.newaxis], flat.astype(complex),
        flat.astype(object), flat.astype(str), flat.astype(np.float16), flat.astype(np.longdouble),
        flat.astype(np.int8, casting="unsafe"), flat.astype(np.uint64, casting="unsafe"), strided(flat) if flat.ndim else 0,
        unaligned(flat), np.broadcast_to(flat.ravel()[0] if flat.size else 0.0, flat.shape), changed,
        changed.astype(np.int64, casting="unsafe"), -flat, flat * 1e200, flat * 1e-200,
        np.zeros(1, [("a", int), ("b", float)]), np.empty((10**6, 1), np.int8), float("nan"), float("inf"), -0.0
    ]
    return rng.choice(choices)


def calls() -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """Valid calls; one or two of their arguments are then replaced."""
    scene = hx.Scene.from_arrays(BOX_VERTICES, BOX_FACES, 0.5, np.ones(6), BOX_NAMES)
    elements = hx.discretize(scene, texels=2)
    solution = hx.solve(elements, residual=0.5, resolution=32)
    facets = hx.Scene.from_arrays(BOX_VERTICES, BOX_FACES)
    matrix = hx.form_factor_matrix(facets, resolution=16, split=1).complete
    draws = [hx.Draw(0, 2, 4096, None, 0)]
    positions = np.array([[-1.0, -1, -2], [1, -1, -2], [0, 1, -2], [0, 0, -3]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    vector = hx.TestVector.from_arrays(
        "one", hx.DrawList(positions, positions[:, :2], triangles, draws, [np.arange(6).reshape(2, 3)], (16, )),
        hx.Face(resolution=16))

    def vector_of(**given: Any) -> None:
        face = {name: given.pop(name) for name in ("eye", "x", "near", "resolution", "scissor")}
        draw = hx.Draw(**{name: given.pop(name) for name in ("first", "count", "offset", "back", "index_map", "cull")})
        hx.TestVector.from_arrays("fuzz", hx.DrawList(draws=[draw], **given), hx.Face(**face)).draw()

    return {
        "from_arrays": (lambda **given: hx.discretize(hx.Scene.from_arrays(**given), texels=2),
                        dict(vertices=BOX_VERTICES, faces=BOX_FACES, reflectance=np.full((6, 3), 0.5),
                             emission=np.ones(6), names=BOX_NAMES, sky=(1.0, 1, 1))),
        "core": (lambda **given: _core.scene_from_arrays(*given.values(), {}),
                 dict(zip(("vertices", "corners", "counts", "group", "material", "groups", "reflectance", "emission"),
                          (BOX_VERTICES, BOX_FACES.ravel(), np.full(6, 4), np.zeros(6, int), np.zeros(6, int), ["a"],
                           np.full((1, 3), 0.5), np.ones((1, 3)))))),
        "discretize": (hx.discretize, dict(scene=scene, texels=2, texel_size=None, surface_texels={"floor": 2}, patch=2)),
        "row": (hx.form_factor_row, dict(what=elements, source=("floor", 0, 1), resolution=16, split=1.0,
                                         method="hemicube", by_surface=True)),
        "hemicube": (hx.hemicube, dict(what=elements, source=("floor", 0, 1), resolution=16, method="hemicube")),
        "analytic": (hx.analytic, dict(what=SQUARE, source=SQUARE[::-1] + [0, 0, 1.0])),
        "check_matrix": (hx.check_matrix, dict(matrix=matrix.toarray(), mesh=facets, tolerance=0.5, rows=1, samples=64)),
        "check_core": (lambda **given: _core.check_matrix(hx.discretize(facets)._core, *given.values()),
                       dict(data=matrix.data, indices=matrix.indices, indptr=matrix.indptr, columns=8,
                            settings={"rows": 1, "samples": 64})),
        "solve": (hx.solve, dict(what=elements, residual=0.5, resolution=16, shots=3, method="hemicube", split=1.0,
                                 format="r8g8b8a8")),
        "sensitivity": (hx.sensitivity, dict(solution=solution, target=np.ones((len(elements), 3)))),
        "render": (hx.render, dict(what=solution, values=np.ones((len(elements), 3)), size=(16, 12), exposure=1.0)),
        "camera": (lambda **given: hx.render(solution, seen_by=hx.Camera(**given), size=(8, 6)),
                   dict(eye=(0.5, 0.5, 0.2), look_at=(0.5, 0.5, 0.9), up=(0, 1.0, 0), fov=50.0)),
        "edit": (lambda **given: hx.edit(scene, hx.SetEmission(**given)), dict(name="floor", to=(1.0, 1, 1))),
        "move": (lambda **given: hx.edit(scene, hx.Move(**given)), dict(name="floor", by=(0.0, 0.1, 0))),
        "sky": (scene.lit_from_outside, dict(sky=(1.0, 1, 1), suns=[((0, 1.0, 0), (1.0, 1, 1))])),
        "vector": (vector_of, dict(positions=positions, texcoords=positions[:, :2], triangles=triangles,
                                   index_maps=[np.arange(6).reshape(2, 3)], channel_bits=(16, ), blend="clamped-add",
                                   first=0, count=2, offset=4096, back=None, index_map=0, cull="back", eye=(0.0, 0, 0),
                                   x=(1.0, 0, 0), near=0.1, resolution=16, scissor=(0, 0, 16, 16))),
        "judge": (hx.judge, dict(vector=vector, found=vector.draw())),
        "judge_ids": (lambda ids: hx.judge(vector, [ids]), dict(ids=vector.draw()[0])),
        "explain": (hx.explain, dict(vector=vector, column=8, row=8)),
        "xarray": (elements.to_xarray, dict(values=np.ones((len(elements), 3)), name="floor")),
    }


def test_wrong_arguments_raise_errors() -> None:
    valid = calls()
    for function, given in valid.values():
        function(**given)
    rng = random.Random(1)
    raised = 0
    for _ in range(COUNT):
        name = rng.choice(list(valid))
        function, given = valid[name]
        changed = dict(given)
        try:
            with np.errstate(all="ignore"):
                for key in rng.sample(list(given), rng.choice([1, 1, 1, 2]) if len(given) > 1 else 1):
                    changed[key] = wrong(given[key], rng)
                function(**changed)
        except ALLOWED:
            raised += 1
        except Exception as error:
            raise AssertionError(f"{name}({changed})") from error
    assert raised > COUNT / 3
