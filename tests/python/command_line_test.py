"""The package gives the bits of the command line."""

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse
from conftest import BOX_FACES, BOX_VERTICES, DATA, run

import hemitex as hx

ROOM = DATA / "cornell-box.obj"
BOX = BOX_VERTICES, BOX_FACES


def table(text: str) -> dict[str, list[str]]:
    """The columns of a CSV text."""
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: [row[name] for row in rows] for name in rows[0]}


def numbers(column: list[str]) -> np.ndarray:
    return np.array([float(value) for value in column])


@pytest.mark.parametrize("method", ["hemicube", "single-plane", "tetrahedron", "rays", "analytic"])
def test_form_factor_row_equals_hemitex_formfactors(method: str) -> None:
    found = hx.form_factor_row(hx.load_scene(ROOM), "light", by_surface=True, method=method)
    expected = table(run("formfactors", ROOM, "--from", "light", "--by-surface", "--method", method))
    assert found.names == expected["surface"]
    assert np.array_equal(found.form_factor, numbers(expected["form_factor"]))
    assert np.array_equal(found.area, numbers(expected["area"]))
    if method == "rays":
        assert np.array_equal(found.standard_error, numbers(expected["standard_error"]))


def test_form_factor_row_of_a_texel_equals_hemitex_formfactors() -> None:
    elements = hx.discretize(hx.load_scene(ROOM), texels=8)
    found = hx.form_factor_row(elements, ("floor", 3, 5), resolution=128)
    expected = table(run("formfactors", ROOM, "--from", "floor:3,5", "--texels", 8, "--resolution", 128))
    assert np.array_equal(found.form_factor, numbers(expected["form_factor"]))
    assert [str(column) for column in elements.column] == expected["column"]
    assert [str(row) for row in elements.row] == expected["row"]


def test_a_source_may_be_the_number_of_a_facet() -> None:
    scene = hx.load_scene(ROOM, facets=True)
    by_name = hx.form_factor_row(scene, scene.names[2], by_surface=True)
    assert np.array_equal(hx.form_factor_row(scene, 2, by_surface=True).form_factor, by_name.form_factor)
    with pytest.raises(hx.InputError, match="source"):
        hx.form_factor_row(scene, len(scene.names))
    assert np.array_equal(hx.form_factor_row(scene, np.int64(2), by_surface=True).form_factor, by_name.form_factor)
    assert len(repr(by_name)) < 100


def test_numbers_of_facets_count_those_without_area() -> None:
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
    scene = hx.Scene.from_arrays(corners, [[0, 1, 1, 0], [0, 1, 2, 3], [4, 7, 6, 5]])
    assert hx.form_factor_row(scene, 1, by_surface=True).form_factor[2] == pytest.approx(0.2, abs=0.01)
    with pytest.raises(hx.InputError, match="facet 0 has no area"):
        hx.form_factor_row(scene, 0)


MATRICES: dict[str, tuple[dict, list]] = {
    "plain": ({"facets": True, "resolution": 32}, ["--facets", "--resolution", 32]),
    "bounded": ({"facets": True, "max_error": 0.1}, ["--facets", "--max-error", 0.1]),
    "smooth": ({"facets": True, "max_error": 0.1, "smooth": True}, ["--facets", "--max-error", 0.1, "--smooth"]),
    "rays": ({"facets": True, "method": "rays", "samples": 4096, "smooth": True},
             ["--facets", "--method", "rays", "--samples", 4096, "--smooth"]),
    "surfaces": ({"resolution": 32, "smooth": True}, ["--resolution", 32, "--smooth"]),
    "mirrors": ({"facets": True, "resolution": 32, "mirrors": [("x", 600)]},
                ["--facets", "--resolution", 32, "--mirror", "x=600"]),
}


@pytest.mark.parametrize("kind", MATRICES)
def test_form_factor_matrix_equals_hemitex_formfactors(tmp_path: Path, kind: str) -> None:
    settings, options = MATRICES[kind]
    max_error = settings.get("max_error")
    found = hx.form_factor_matrix(hx.load_scene(ROOM), **settings)
    run("formfactors", ROOM, "--all", "-o", tmp_path / "F.npz", "--vtu", tmp_path / "F.vtu", "--row", 3, *options) if (
        "facets" in settings) else run("formfactors", ROOM, "--all", "-o", tmp_path / "F.npz", *options)
    expected = scipy.sparse.load_npz(tmp_path / "F.npz").tocsr()
    assert (found.complete != expected).nnz == 0
    assert np.allclose(found.complete.sum(axis=1), 1, atol=1e-12)
    read, area = hx.read_matrix(tmp_path / "F.npz")
    assert (read != expected).nnz == 0 and np.array_equal(area, found.area)
    about = json.loads((tmp_path / "F.json").read_text())
    if max_error is not None:
        assert np.array_equal(found.error, about["errors"])
        assert found.error.max() <= max_error or kind == "smooth"
    found.save(tmp_path / "saved.npz")
    assert (tmp_path / "saved.npz").read_bytes() == (tmp_path / "F.npz").read_bytes()
    loaded = hx.FormFactorMatrix.load(tmp_path / "saved.npz")
    assert (loaded.complete != found.complete).nnz == 0 and loaded.names == found.names
    loaded.save(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == (tmp_path / "F.npz").read_bytes()
    if kind in ("plain", "bounded", "smooth"):
        found.write_vtu(tmp_path / "saved.vtu", hx.load_scene(ROOM, facets=True), rows=[3])
        assert (tmp_path / "saved.vtu").read_bytes() == (tmp_path / "F.vtu").read_bytes()
    assert len(list(tmp_path.iterdir())) <= 6, "nothing is left over"


def test_settings_of_a_scene_of_arrays_may_be_changed_for_its_matrix(box: hx.Scene) -> None:
    found = hx.form_factor_matrix(box, facets=True, mirrors=[("x", 1.5)], resolution=16)
    scene = hx.Scene.from_arrays(*BOX, mirrors=[("x", 1.5)])
    assert (found.complete != hx.form_factor_matrix(scene, resolution=16).complete).nnz == 0
    with pytest.raises(hx.InputError, match="changed.*mirrors"):
        hx.form_factor_matrix(hx.edit(box, hx.SetEmission("floor", 1)), mirrors=[("x", 1.5)])
    with pytest.raises(hx.InputError, match="names"):
        hx.form_factor_matrix(scene, facets=False)


def test_settings_without_effect_are_refused(box: hx.Scene) -> None:
    facets = hx.load_scene(ROOM, facets=True)
    for given in ({"method": "rays", "max_error": 0.1}, {"resolution": 32, "max_error": 0.1},
                  {"samples": 4096}, {"method": "rays", "split": 0.1}, {"samples": 4096, "max_error": 0.1}):
        with pytest.raises(hx.InputError):
            hx.form_factor_matrix(facets, **given)
    with pytest.raises(hx.InputError, match="samples.*analytic"):
        hx.form_factor_row(box, "floor", method="analytic", samples=4096)


def test_matrices_are_compared_and_written(tmp_path: Path) -> None:
    scene = hx.Scene.from_arrays(*BOX)
    coarse, fine = (hx.form_factor_matrix(scene, resolution=resolution) for resolution in (16, 32))
    difference = fine.compare(coarse)
    apart = abs(fine.matrix - coarse.matrix).toarray()
    assert difference.difference == pytest.approx(apart.sum(axis=1), abs=1e-15)
    assert difference.share == pytest.approx(apart.sum() / fine.matrix.sum())
    assert fine.compare(fine.matrix).share == 0
    fine.write_vtu(tmp_path / "box.vtu", scene)
    assert hx.load_scene(tmp_path / "box.vtu", facets=True).area.sum() == pytest.approx(6)
    for name in ("box.txt", "none/box.npz", "box"):
        with pytest.raises(hx.InputError):
            fine.save(tmp_path / name)
    with pytest.raises(hx.InputError, match="vtu"):
        fine.write_vtu(tmp_path / "box.ply", scene)
    with pytest.raises(hx.InputError, match=r"\(5, 5\).*6 facets"):
        fine.compare(fine.matrix[:5, :5])
    with pytest.raises(hx.InputError, match=r"\(6, 7\).*6 facets"):
        hx.check_matrix(fine.complete[:, :7], scene)
    (tmp_path / "F.csv").write_text("from,to,form_factor\n0,1,0.5\n1,0,0.5\n")
    with pytest.raises(hx.InputError, match="area"):
        hx.FormFactorMatrix.load(tmp_path / "F.csv")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["F.csv", "box.vtu"]


def test_check_matrix_equals_hemitex_matrix_check(tmp_path: Path) -> None:
    scene = hx.load_scene(ROOM, facets=True)
    matrix = hx.form_factor_matrix(scene, max_error=0.01).complete
    assert not hx.check_matrix(matrix, scene).problems
    wrong = scipy.sparse.csr_array(matrix[:, :-2].T)
    scipy.sparse.save_npz(tmp_path / "wrong.npz", scipy.sparse.csr_matrix(wrong))
    expected = json.loads(run("matrix", "check", tmp_path / "wrong.npz", ROOM, "--json"))
    found = hx.check_matrix(wrong, scene)
    assert found.problems == expected["problems"] and found.problems
    assert found.fault == expected["fault"] and "transposed" in found.fault
    assert found.difference == expected["difference"]
    with pytest.raises(hx.InputError, match="for 19 facets give"):
        hx.check_matrix(wrong[:-1], scene)


def elements_of(folder: Path) -> dict[str, np.ndarray]:
    columns = table((folder / "elements.csv").read_text())
    return {
        "radiosity": np.column_stack([numbers(columns[name]) for name in ("b_r", "b_g", "b_b")]),
        "centre": np.column_stack([numbers(columns[name]) for name in "xyz"]),
        "normal": np.column_stack([numbers(columns[name]) for name in ("nx", "ny", "nz")]),
        "area": numbers(columns["area"])
    }


def test_solve_and_render_equal_hemitex_solve(tmp_path: Path) -> None:
    from matplotlib import image
    solution = hx.solve(hx.discretize(hx.load_scene(ROOM), texels=8))
    run("solve", ROOM, "--texels", 8, "-o", tmp_path)
    expected = elements_of(tmp_path)
    assert np.array_equal(solution.radiosity, expected["radiosity"])
    assert np.array_equal(solution.elements.centre, expected["centre"])
    assert np.array_equal(solution.elements.normal, expected["normal"])
    assert np.array_equal(solution.elements.area, expected["area"])
    about = json.loads((tmp_path / "solution.json").read_text())
    assert (solution.shots, solution.residual, solution.patches) == (about["shots"], about["residual"], about["patches"])
    assert list(solution.energy["absorbed"]) == about["energy"]["absorbed"]
    drawn = np.rint(image.imread(tmp_path / "render.png")[..., :3] * 255).astype(int)
    assert np.array_equal(hx.render(solution), drawn)


def test_gathered_pictures_equal_hemitex_solve(tmp_path: Path) -> None:
    from matplotlib import image
    solution = hx.solve(hx.discretize(hx.load_scene(ROOM), texels=2))
    run("solve", ROOM, "--texels", 2, "--gather", "--size", "80x60", "-o", tmp_path)
    drawn = np.rint(image.imread(tmp_path / "render.png")[..., :3] * 255).astype(int)
    assert np.array_equal(hx.render(solution, size=(80, 60), gather=True), drawn)
    with pytest.raises(hx.InputError, match="gathered light is not filtered"):
        hx.render(solution, size=(8, 6), gather=True, filter="bilinear")


def test_solve_with_light_from_outside_equals_hemitex_solve(tmp_path: Path) -> None:
    scene = hx.load_scene(DATA / "pyramid-room.obj", sky=(1, 2, 3), suns=[((1, 2, 1), (10, 9, 8))])
    solution = hx.solve(hx.discretize(scene, texels=4), residual=0.01)
    run("solve", DATA / "pyramid-room.obj", "--sky", "1,2,3", "--sun", "1,2,1=10,9,8", "--texels", 4, "--residual", 0.01,
        "--size", "8x6", "-o", tmp_path)
    assert np.array_equal(solution.radiosity, elements_of(tmp_path)["radiosity"])


def test_solve_with_lamps_equals_hemitex_solve(tmp_path: Path) -> None:
    scene = hx.load_scene(DATA / "pyramid-room.obj", lamps=[((0.2, 1.5, 0.1), (3, 2, 1))])
    assert scene.lamps == [("lamp-1", (0.2, 1.5, 0.1), (3.0, 2.0, 1.0))]
    solution = hx.solve(hx.discretize(scene, texels=4), residual=0.01)
    run("solve", DATA / "pyramid-room.obj", "--lamp", "0.2,1.5,0.1=3,2,1", "--texels", 4, "--residual", 0.01,
        "--size", "8x6", "-o", tmp_path)
    assert np.array_equal(solution.radiosity, elements_of(tmp_path)["radiosity"])
    moved = hx.edit(scene, hx.Move("lamp-1", (0, 0, 1))).lit_from_outside(sky=1)
    assert moved.lamps == [("lamp-1", (0.2, 1.5, 1.1), (3.0, 2.0, 1.0))]


def test_solve_in_bands_equals_hemitex_solve(tmp_path: Path) -> None:
    white = [0.7, 0.72, 0.5, 0.75]
    (tmp_path / "bands.json").write_text(json.dumps({
        "wavelengths": [450, 500, 550, 650],
        "materials": {"white": {"reflectance": white}, "light": {"emission": [3, 5, 11, 21]}}}))
    scene = hx.load_scene(ROOM).in_bands([450, 500, 550, 650],
                                         {"white": {"reflectance": white}, "light": {"emission": [3, 5, 11, 21]}})
    assert scene.wavelengths == [450, 500, 550, 650]
    solution = hx.solve(hx.discretize(scene, texels=4), residual=0.01)
    run("solve", ROOM, "--texels", 4, "--residual", 0.01, "--bands", tmp_path / "bands.json", "--size", "8x6",
        "-o", tmp_path / "lit")
    with open(tmp_path / "lit" / "elements.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    for band, name in enumerate(("b_450", "b_500", "b_550", "b_650")):
        assert np.array_equal(solution.bands[:, band], [float(row[name]) for row in rows])
    assert np.array_equal(solution.radiosity, elements_of(tmp_path / "lit")["radiosity"])
    energy = json.loads((tmp_path / "lit" / "solution.json").read_text())["energy"]
    assert list(solution.energy["absorbed"]) == energy["absorbed"]
    for wavelengths, spectra, message in (([500, 450], {}, "ascend"), ([], {}, "no wavelength"),
                                          ([450], {"whte": {}}, "no material `whte`"),
                                          ([450], {"white": {"reflectance": [1]}}, "or 1 or more"),
                                          ([450], {"white": {"reflectance": [0.5, 0.5]}}, "reflectance"),
                                          ([450], {"white": {"emission": [-1]}}, "below 0"),
                                          ([450], {"white": {"colour": [1]}}, "is no quantity")):
        with pytest.raises(hx.InputError, match=message):
            scene.in_bands(wavelengths, spectra)
    with pytest.raises(hx.InputError, match="red, green and blue"):
        hx.sensitivity(solution, "floor")


def test_edit_equals_hemitex_solve_with_edits(tmp_path: Path) -> None:
    (tmp_path / "edits.json").write_text(
        '{"frames": [[{"move": "short-block", "by": [40, 0, -80]}], [{"remove": "tall-block"}]]}')
    run("solve", ROOM, "--texels", 4, "--edits", tmp_path / "edits.json", "--size", "8x6", "-o", tmp_path / "lit")
    solution = hx.solve(hx.discretize(hx.load_scene(ROOM), texels=4, editable=True), editable=True)
    moved = hx.edit(solution, hx.Move("short-block", by=(40, 0, -80)))
    removed = hx.edit(moved, [hx.Remove("tall-block")])
    for each, folder in ((solution, "lit"), (moved, "lit/frame-1"), (removed, "lit/frame-2")):
        assert np.array_equal(each.radiosity, elements_of(tmp_path / folder)["radiosity"])
    assert len(removed.elements) < len(moved.elements) == len(solution.elements)
    assert solution.update_cost is None and moved.update_cost.rows_in_windows > 0
    for old in (solution, moved):
        with pytest.raises(hx.InputError, match="edited before"):
            hx.edit(old, hx.Restore("tall-block"))
    assert len(hx.edit(removed, hx.Restore("tall-block")).elements) == len(moved.elements)


def test_solve_with_a_bound_equals_hemitex_solve(tmp_path: Path) -> None:
    room = DATA / "paper-room.obj"
    elements = hx.discretize(hx.load_scene(room), texels=4)
    solution = hx.solve(elements, max_error=0.05)
    run("solve", room, "--texels", 4, "--max-error", 0.05, "--size", "8x6", "-o", tmp_path)
    about = json.loads((tmp_path / "solution.json").read_text())
    assert np.array_equal(solution.radiosity, elements_of(tmp_path)["radiosity"])
    assert solution.expected_error == max(about["expected_error"], about["expected_error_seen"])
    limits = ["--resolution", 192, "--residual", 0.003, "--shots", 5000]
    run("solve", room, "--texels", 4, "--max-error", 0.05, *limits, "--size", "8x6", "-o", tmp_path)
    limited = hx.solve(elements, max_error=0.05, resolution=192, residual=0.003, shots=5000)
    assert np.array_equal(limited.radiosity, elements_of(tmp_path)["radiosity"])
    assert limited.residual <= 0.003 and limited.ended_by == "residual"
    ended = hx.solve(elements, max_error=0.05, shots=7)
    assert ended.shots == 7 and ended.ended_by == "shots" and ended.expected_error is None


def test_solve_of_facets_with_a_bound_equals_hemitex_solve(tmp_path: Path) -> None:
    room = DATA / "paper-room.obj"
    solution = hx.solve(hx.load_scene(room, facets=True), max_error=0.05)
    run("solve", room, "--facets", "--max-error", 0.05, "--size", "8x6", "-o", tmp_path)
    assert np.array_equal(solution.radiosity, elements_of(tmp_path)["radiosity"])
    assert solution.row_error == json.loads((tmp_path / "solution.json").read_text())["row_error"]
    assert solution.expected_error is None
    divided = hx.solve(hx.discretize(hx.load_scene(room, facets=True), texels=2), max_error=0.05)
    run("solve", room, "--facets", "--texels", 2, "--max-error", 0.05, "--size", "8x6", "-o", tmp_path)
    assert np.array_equal(divided.radiosity, elements_of(tmp_path)["radiosity"])
    assert divided.row_error is None and divided.expected_error <= 0.1
    with pytest.raises(hx.InputError, match="resolution"):
        hx.solve(hx.load_scene(room, facets=True), max_error=0.05, resolution=64)
    with pytest.raises(hx.InputError, match="hemicubes"):
        hx.solve(hx.load_scene(room), max_error=0.05, method="single-plane")
    with pytest.raises(hx.InputError, match="rays"):
        hx.solve(hx.load_scene(room), method="ray")  # type: ignore[arg-type]


def test_explain_equals_hemitex_vector_explain(tmp_path: Path) -> None:
    run("vector", "suite", "-o", tmp_path)
    vector = next(vector for vector in hx.vector_suite() if vector.name == "perspective-floor")
    found = hx.explain(vector, 8, 3)
    expected = json.loads(run("vector", "explain", tmp_path / vector.name, "--pixel", f"{found.face},8,3", "--json"))
    assert (found.id, found.origin, found.derivation) == (expected["word"], expected["from"], expected["derivation"])
    read = hx.read_vector(tmp_path / vector.name)
    assert np.array_equal(read.draw_list.positions, vector.draw_list.positions) and read.faces == vector.faces
    assert all(np.array_equal(a, b) for a, b in zip(read.draw(), vector.draw()))


def test_hemicube_shows_the_picture_of_hemitex_render(tmp_path: Path) -> None:
    from matplotlib import image
    run("render", ROOM, "--show", "hemicube", "--from", "floor", "--resolution", 64, "-o", tmp_path / "cube.png")
    drawn = np.rint(image.imread(tmp_path / "cube.png")[..., :3] * 255).astype(int)
    cube = hx.hemicube(hx.load_scene(ROOM), "floor", resolution=64)
    shown = cube.unfolded()
    grey = np.isnan(shown)
    # Two pictures show the same where pixels of one element have one colour.
    assert drawn.shape[:2] == shown.shape
    colours: dict[float, set[tuple[int, ...]]] = {}
    for element, colour in zip(shown[~grey], drawn[~grey]):
        colours.setdefault(float(element), set()).add(tuple(colour))
    colours.pop(-1.0)  # backs are white, the background is black
    assert max(map(len, colours.values())) == 1 and len(colours) > 100
