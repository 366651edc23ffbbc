"""Solutions, sensitivities, progress, Ctrl-C and threads."""

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from conftest import BOX_FACES, BOX_NAMES, BOX_VERTICES, DATA

import hemitex as hx


def test_scene_from_arrays_equals_the_same_file(tmp_path, box: hx.Scene) -> None:
    lines = ["mtllib box.mtl"] + [f"v {x} {y} {z}" for x, y, z in BOX_VERTICES]
    for name, face in zip(BOX_NAMES, BOX_FACES):
        material = "light" if name == "ceiling" else "red" if name == "left" else "grey"
        lines += [f"g {name}", f"usemtl {material}", "f " + " ".join(str(corner + 1) for corner in face)]
    (tmp_path / "box.obj").write_text("\n".join(lines))
    (tmp_path / "box.mtl").write_text("newmtl grey\nKd .5 .5 .5\nnewmtl red\nKd .6 .1 .1\n"
                                      "newmtl light\nKd .5 .5 .5\nKe 2 2 2\n")
    file = hx.load_scene(tmp_path / "box.obj")
    assert (file.names, file.extent, file.origin) == (box.names, box.extent, box.origin)
    assert np.array_equal(file.triangles()[0], box.triangles()[0])
    assert np.array_equal(hx.solve(file).radiosity, hx.solve(box).radiosity)


def test_mirrors_give_the_light_of_the_whole_room() -> None:
    def box_with(low: float, **symmetry: Any) -> hx.Scene:
        vertices = [[x, y, z] for x in (low, 2) for y in (0, 3) for z in (0, 5)]
        faces = [[4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] + [[0, 2, 3, 1]] * (low != 0)
        names = ["right", "floor", "ceiling", "back", "front", "left"][:len(faces)]
        emission = [float(name == "ceiling") for name in names]
        return hx.Scene.from_arrays(vertices, faces, 0.5, emission, names, sides="one", **symmetry)

    half = hx.solve(hx.discretize(box_with(0, mirrors=[("x", 0)]), texels=4), residual=1e-7)
    whole = hx.solve(hx.discretize(box_with(-2), texels=4), residual=1e-7)
    assert len(half.elements) == 5 * 16
    for name in ("right", "floor", "back"):
        assert np.allclose(half.mean(name), whole.mean(name), rtol=5e-3), name
    with pytest.raises(hx.InputError, match="cuts the surface"):
        box_with(0, mirrors=[("x", 1)])
    with pytest.raises(hx.InputError, match="mirrors"):
        box_with(0, mirrors=[("w", 1)])


def test_arrays_share_memory_and_cannot_be_changed(box: hx.Scene) -> None:
    solution = hx.solve(box)
    radiosity = solution.radiosity
    assert radiosity.base is not None and not radiosity.flags.writeable
    with pytest.raises(ValueError):
        radiosity[0] = 0
    mean = radiosity.mean()
    del solution
    assert radiosity.mean() == mean


def test_sensitivity_equals_finite_differences(box: hx.Scene) -> None:
    def mean(scene: hx.Scene) -> tuple[np.ndarray, hx.Solution]:
        # Patches are not split, so that rows stay the same.
        solution = hx.solve(hx.discretize(scene, texels=3), residual=1e-13, split=1e9, resolution=64)
        return solution.mean("floor"), solution

    value, solution = mean(box)
    found = hx.sensitivity(solution, "floor")
    assert np.allclose(found.target, value, rtol=1e-10)
    step = 1e-3
    for name in ("ceiling", "left", "floor"):
        for by, kind in (("emission", hx.SetEmission), ("reflectance", hx.SetReflectance)):
            at = getattr(box, by)[box.names.index(name)]
            values = [mean(hx.edit(box, kind(name, np.abs(at + sign * step))))[0] for sign in (1, -1)]
            if by == "emission" and name != "ceiling":  # no emission below 0; the target is linear in it
                slope = (values[0] - value) / step
            else:
                slope = (values[0] - values[1]) / (2 * step)
            assert np.allclose(found.of(name, by), slope, rtol=2e-6), (name, by)


def test_sensitivities_of_many_targets_are_those_of_each(box: hx.Scene) -> None:
    solution = hx.solve(box, texels=3, resolution=32)
    weights = np.linspace(0, 1, len(solution.elements))
    together = hx.sensitivity(solution, ["floor", weights, "left"])
    for target, found in zip(["floor", weights, "left"], together):
        alone = hx.sensitivity(solution, target)
        assert np.array_equal(found.target, alone.target)
        assert np.array_equal(found.by_reflectance, alone.by_reflectance)
    stacked = hx.sensitivity(solution, np.stack([np.repeat(weights[:, np.newaxis], 3, axis=1)] * 2))
    assert np.array_equal(stacked[1].by_emission, together[1].by_emission)
    with pytest.raises(hx.InputError, match="target"):
        hx.sensitivity(solution, ["floor", weights[1:]])


def test_sensitivity_finds_lamp_powers(box: hx.Scene) -> None:
    solution = hx.solve(box, residual=1e-6)
    found = hx.sensitivity(solution, "floor")
    power = 3.0 / found.of("ceiling")[1]  # for 3 W/m^2 on average
    lit = hx.solve(hx.edit(box, hx.SetEmission("ceiling", power)), residual=1e-6)
    assert abs(lit.mean("floor")[1] - 3) < 1e-3


def test_solve_tells_progress_and_ends_early() -> None:
    scene = hx.load_scene(DATA / "cornell-box.obj")
    told: list[float] = []
    solution = hx.solve(scene, residual=1e-4, progress=told.append)
    assert told and all(0 <= share <= 1 for share in told) and told == sorted(told)
    ended = hx.solve(scene, residual=1e-7, progress=lambda share: False)
    assert ended.is_interrupted and not solution.is_interrupted


def test_exceptions_of_a_progress_callback_end_a_call() -> None:
    scene = hx.load_scene(DATA / "cornell-box.obj")

    def fail(share: float) -> None:
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        hx.solve(scene, residual=1e-7, progress=fail)
    facets = hx.load_scene(DATA / "gallery.obj", facets=True)
    with pytest.raises(RuntimeError, match="enough"):
        hx.form_factor_matrix(facets, progress=fail)


def test_control_c_ends_a_call() -> None:
    code = f"import hemitex as hx; print('go', flush=True); hx.solve(hx.load_scene({str(DATA / 'gallery.obj')!r}), "
    code += "residual=1e-13, resolution=1024)"
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "go\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert "KeyboardInterrupt" in errors and process.returncode in (130, -signal.SIGINT, 1)


def test_other_threads_run_during_a_call() -> None:
    scene = hx.load_scene(DATA / "cornell-box.obj")
    count, done = 0, threading.Event()

    def tick() -> None:
        nonlocal count
        while not done.is_set():
            count += 1
            time.sleep(0.001)

    other = threading.Thread(target=tick)
    other.start()
    begin = time.monotonic()
    hx.solve(scene, residual=1e-4)
    spent = time.monotonic() - begin
    done.set()
    other.join()
    assert count > 20 * spent


def test_results_are_equal_on_any_number_of_threads() -> None:
    scene = hx.load_scene(DATA / "cornell-box.obj")
    elements = hx.discretize(scene, texels=6)
    vector = next(vector for vector in hx.vector_suite() if vector.name == "perspective-floor")

    def work(_: int) -> list[np.ndarray]:
        solution = hx.solve(elements, residual=0.01)
        weights = np.ones(len(elements))
        return [
            solution.radiosity,
            hx.form_factor_row(elements, "light").form_factor,
            hx.sensitivity(solution, weights).by_reflectance,
            hx.render(solution, size=(80, 60)),
            vector.draw()[0]
        ]

    with hx.threads(1):
        expected = work(0)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(work, range(8)):
            assert all(np.array_equal(a, b) for a, b in zip(found, expected))


def test_xarray_names_axes(box: hx.Scene) -> None:
    solution = hx.solve(hx.discretize(box, texels=4))
    floor = solution.to_xarray("floor")
    assert floor.dims == ("row", "column", "band") and floor.shape == (4, 4, 3)
    assert np.array_equal(floor.sel(band="r").values.ravel(), solution.radiosity[solution.elements.of("floor"), 0])
    matrix = hx.form_factor_matrix(box).to_xarray()
    assert abs(float(matrix.sel({"from": "floor", "to": "ceiling"})) - 0.19982) < 1e-3
    assert hx.form_factor_row(box, "floor", by_surface=True).to_xarray().coords["to"].values.tolist() == BOX_NAMES


def test_analytic_and_rays_agree_with_a_closed_form(box: hx.Scene) -> None:
    exact = 0.19982489569838746  # Howell, C-11: opposite squares at the distance of their side
    square = BOX_VERTICES[BOX_FACES]
    assert abs(hx.analytic(square[2], square[3]) - exact) < 1e-12
    closed = hx.analytic(box, "floor", by_surface=True)
    assert abs(closed.form_factor[3] - exact) < 1e-12 and closed.surroundings is None
    measured = hx.rays(box, "floor", by_surface=True)
    assert abs(measured.form_factor[3] - exact) < 5 * measured.standard_error[3]


def test_hemicube_sums_to_the_row(box: hx.Scene) -> None:
    elements = hx.discretize(box, texels=4)
    cube = hx.hemicube(elements, ("floor", 1, 2), resolution=128)
    row = hx.form_factor_row(elements, ("floor", 1, 2), resolution=128)
    assert np.allclose(cube.row(), row.form_factor, atol=1e-15)
    assert abs(sum(face.weights.sum() for face in cube.faces) - 1) < 1e-12


def test_threads_limits_calls() -> None:
    with hx.threads(1):
        assert len(hx.vector_suite()) > 50
    assert os.getpid() > 0


def test_a_shift_of_one_number_is_refused(box: hx.Scene) -> None:
    for change in (hx.Move("floor", 5), hx.Add("other.obj", 1.0)):
        with pytest.raises(hx.InputError, match="give three, along x, y and z"):
            hx.edit(box, change)


def test_solve_divides_scenes_only(box: hx.Scene) -> None:
    assert np.array_equal(hx.solve(box, texels=4).radiosity, hx.solve(hx.discretize(box, texels=4)).radiosity)
    with pytest.raises(hx.InputError, match="give `texels` or `texel_size` to `discretize`"):
        hx.solve(hx.discretize(box, texels=4), texel_size=1.0)


def test_a_dark_scene_of_arrays_is_told_of_arrays() -> None:
    with pytest.raises(hx.InputError, match="from_arrays") as error:
        hx.solve(hx.Scene.from_arrays(BOX_VERTICES, BOX_FACES, 0.5))
    assert "MTL" not in str(error.value)
