"""Form factors: rows, matrices, hemicubes, closed forms, and the judge of matrices."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Union, overload

import numpy as np
import numpy.typing as npt
import scipy.sparse

from . import _core
from ._core import InputError
from .rasterizers import Face, Rasterizer, _face, _factory
from .scenes import Elements, Floats, Integers, Scene, Vector, _core_of, _elements, _numbers, load_scene

Source = Union[str, int, tuple[str, int, int]]
"""The name of a surface or family, the number of a surface or facet, or (surface, column, row) of a texel."""
Method = Literal["hemicube", "single-plane", "tetrahedron", "rays", "analytic"]
Told = Callable[[float], Any]
"""Takes the share of a call that is done, in [0, 1]."""


@dataclass(frozen=True)
class FormFactorRow:
    """The shares of the flux leaving a source that reach each receiver. With `surroundings` and `backs` they sum to 1."""
    form_factor: Floats  #: (receivers,)
    area: Floats  #: (receivers,)
    standard_error: Floats | None  #: (receivers,), of rays
    surroundings: float | None  #: share that meets nothing; None if the method ignores blockers
    backs: float | None  #: share that meets backs of faces
    captured: float | None  #: share that a projection captures; the rest counts as surroundings
    names: list[str] | None  #: of the receivers, if they are surfaces; None for elements
    elements: Elements

    def __repr__(self) -> str:
        receivers = "elements" if self.names is None else "surfaces"
        return (f"<hemitex.FormFactorRow to {len(self.form_factor)} {receivers}, which receive "
                f"{self.form_factor.sum():.4g} of the flux>")

    def to_xarray(self) -> Any:
        """An xarray.DataArray over `to`, the names or numbers of receivers."""
        import xarray
        receivers = np.arange(len(self.form_factor)) if self.names is None else self.names
        return xarray.DataArray(self.form_factor, dims="to", coords={"to": receivers, "area": ("to", self.area)},
                                name="form factor")


@dataclass(frozen=True)
class FormFactorMatrix:
    """A sparse matrix of form factors: row i has the shares of the flux leaving i."""
    matrix: scipy.sparse.csr_array  #: (n, n), n surfaces or facets
    surroundings: Floats  #: (n,) share of each row that meets nothing
    backs: Floats  #: (n,) share of each row that meets backs of faces
    area: Floats  #: (n,)
    error: Floats | None  #: (n,) estimate of the sum of absolute errors of each row, where the method has one
    names: list[str]  #: of rows and columns
    entry_errors: scipy.sparse.csr_array | None = None  #: (n, n + 2) of the entries of `complete`, where they are known

    def __repr__(self) -> str:
        return f"<hemitex.FormFactorMatrix of {len(self.names)} rows with {self.matrix.nnz} entries>"

    @property
    def complete(self) -> scipy.sparse.csr_array:
        """(n, n + 2): with the columns `surroundings` and `backs`; each row sums to 1."""
        extra = scipy.sparse.csr_array(np.column_stack([self.surroundings, self.backs]))
        return scipy.sparse.csr_array(scipy.sparse.hstack([self.matrix, extra], format="csr"))

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the bytes of `hemitex formfactors --all -o FILE`; the file ends in .npz, .mtx or .csv.

        The estimates of whole rows, `error`, are in no file.
        """
        rows = _rows(self.complete)
        errors = None if self.entry_errors is None else _rows(self.entry_errors).data
        _written(file, lambda place: _core.write_matrix(place, rows.data, rows.indices, rows.indptr, errors, self.area,
                                                        self.names))

    @staticmethod
    def load(file: str | os.PathLike[str], area: npt.ArrayLike | None = None) -> FormFactorMatrix:
        """Reads a matrix of a file (.npz, .mtx, .csv, .vf, .txt).

        area: (n,) of the facets, if the file has none. A matrix without the columns of surroundings and backs has 0
        there. Names of surfaces are in .npz files alone; others have their numbers.
        """
        found = _core.read_matrix(os.fspath(file))
        count, columns = found["shape"]
        areas = found["area"] if area is None else _numbers(area, "area")
        if areas is None:
            raise InputError(f"{os.fspath(file)} has no areas; give `area`, one number for each of {count} facets")
        if areas.shape != (count, ):
            raise InputError(f"`area` has the shape {areas.shape}; the matrix has {count} rows")
        names = [str(number) for number in range(count)]
        if Path(file).suffix == ".npz":
            with np.load(file) as archive:
                about = json.loads(archive["about"].item()) if "about" in archive else {}
            names = about.get("names", names)
        return _matrix_of({**found, "area": areas, "error": None, "names": names})

    def compare(self, other: FormFactorMatrix | Any) -> MatrixDifference:
        """How far another matrix of the same mesh is apart, as `hemitex matrix compare` says it."""
        first, second = _parts(self, len(self.names)), _parts(other, len(self.names))
        return MatrixDifference(**_core.compare_matrices(first, second, self.area))

    def write_vtu(self, file: str | os.PathLike[str], mesh: Scene, rows: Sequence[int] = ()) -> None:
        """Writes the facets of a mesh for ParaView, with `row_sum`, `surroundings`, `backs` and, if known, `error`.

        mesh: of which this is the matrix. rows: facets whose form factors are written, too, as by
        `hemitex formfactors --vtu`.
        """
        values = {"row_sum": self.matrix @ np.ones(len(self.names)), "surroundings": self.surroundings,
                  "backs": self.backs}
        if self.error is not None and self.error.max(initial=0) > 0:
            values["error"] = self.error
        for row in rows:
            if not 0 <= row < len(self.names):
                raise InputError(f"`rows` has {row}; the mesh has {len(self.names)} facets, counted from 0")
            values[f"form_factor_from_{row}"] = self.matrix[[row]].toarray().ravel()
            if self.entry_errors is not None:
                values[f"standard_error_from_{row}"] = self.entry_errors[[row]].toarray().ravel()[:-2]
        _written(file, lambda place: _core.write_facets(place, _core_of(mesh, Scene), values))

    def to_xarray(self) -> Any:
        """A dense xarray.DataArray (from, to)."""
        import xarray
        return xarray.DataArray(self.matrix.toarray(), dims=("from", "to"),
                                coords={"from": self.names, "to": self.names}, name="form factor")


@dataclass(frozen=True)
class MatrixDifference:
    """How far the rows of two matrices of one mesh are apart."""
    share: float  #: of the exchange between facets: sum of A_i |F_ij - G_ij| over that of A_i F_ij
    difference: Floats  #: (n,) sum of the absolute differences of each row
    difference_received: Floats  #: (n,) by how much the light differs that each facet receives from radiosity 1
    row_sum: Floats  #: (n,) of the first matrix, over facets

    def __repr__(self) -> str:
        return f"<hemitex.MatrixDifference of {len(self.difference)} rows: {self.share:.3g} of the exchange>"


@dataclass(frozen=True)
class MatrixVerdict:
    """What is wrong with a matrix."""
    problems: list[str]  #: one sentence per kind; empty: nothing was found
    fault: str | None  #: the known fault that explains the problems
    largest_row_sum: float
    reciprocity: float  #: sum of |A_i F_ij - A_j F_ji| over the sum of A_i F_ij
    difference: float  #: from rays, in the measured rows, as a share of their light
    noise: float  #: the part of it that the rays explain
    measured_rows: int


@dataclass(frozen=True)
class HemicubeFace:
    """A face of a projection with its item buffer, (height, width), row 0 first."""
    face: Face
    ids: npt.NDArray[np.uint32]  #: item IDs
    elements: Integers  #: the element that each pixel shows; -1: nothing, -2: the back of a face
    weights: Floats  #: delta form factors: the share of light that leaves through each pixel


@dataclass(frozen=True)
class Hemicube:
    """A projection over a point: the top, then the sides towards +x, +y, -x and -y of the top."""
    faces: list[HemicubeFace]
    of: Elements

    def row(self) -> Floats:
        """(elements,): the sum of the weights of the pixels that show each element."""
        elements = np.concatenate([face.elements.ravel() for face in self.faces])
        weights = np.concatenate([face.weights.ravel() for face in self.faces])
        seen = elements >= 0
        return np.bincount(elements[seen], weights[seen], minlength=len(self.of)).astype(np.float64)

    def unfolded(self, values: npt.ArrayLike | None = None) -> npt.NDArray[Any]:
        """(2R, 2R[, 3]): what the pixels show, as a cross: the sides folded down around the top, seen from the point.

        The top row of the picture comes first. values: one per element, (elements,) or (elements, 3); by default its
        number. Pixels outside the faces are NaN, those of backs and of the background 0 (-1 for numbers).
        """
        table = _numbers(np.arange(len(self.of)) if values is None else values, "values").astype(float)
        if table.ndim not in (1, 2) or len(table) != len(self.of):
            raise InputError(f"`values` has the shape {table.shape}; give one value for each of {len(self.of)} elements")
        shown = []
        for face in self.faces:
            shown.append(table[np.maximum(face.elements, 0)])
            shown[-1][face.elements < 0] = -1 if values is None else 0
        return self._cross(shown)

    def unfolded_weights(self) -> Floats:
        """(2R, 2R): the delta form factors of all pixels, as `unfolded`."""
        return self._cross([face.weights for face in self.faces])

    def _cross(self, pictures: list[npt.NDArray[Any]]) -> npt.NDArray[Any]:
        if len(pictures) != 5:
            raise InputError("only a hemicube unfolds to a cross")
        r = self.faces[0].face.resolution
        place = (2 * np.arange(2 * r) + 1 - 2 * r) / r
        x, y = np.meshgrid(place, -place)  # in halves of the top's width, y upwards
        depth = np.minimum(1, 2 - np.maximum(abs(x), abs(y)))[..., np.newaxis]
        right, up, normal = (np.array(axis) for axis in (self.faces[0].face.x, self.faces[0].face.y,
                                                         self.faces[0].face.w))
        towards = depth * normal + y.clip(-1, 1)[..., np.newaxis] * up - x.clip(-1, 1)[..., np.newaxis] * right
        depths = np.stack([towards @ np.array(face.face.w) for face in self.faces])
        nearest = depths.argmax(axis=0)
        cross = np.full((2 * r, 2 * r) + pictures[0].shape[2:], np.nan)
        for number, (face, picture) in enumerate(zip(self.faces, pictures)):
            pixels = (nearest == number) & (np.minimum(abs(x), abs(y)) <= 1)
            first_column, first_row, width, height = face.face.rectangle
            seen = towards[pixels] / depths[number][pixels][:, np.newaxis]
            column, row = [((seen @ np.array(axis) + 1) * r / 2).astype(int) - first
                           for axis, first in ((face.face.x, first_column), (face.face.y, first_row))]
            cross[pixels] = picture[row.clip(0, height - 1), column.clip(0, width - 1)]
        return cross


def _settings(**given: Any) -> dict[str, Any]:
    return {name: value for name, value in given.items() if value is not None}


def form_factor_row(what: Scene | Elements,
                    source: Source,
                    *,
                    by_surface: bool = False,
                    method: Method = "hemicube",
                    resolution: int | None = None,
                    orientation: Literal["turned", "aligned"] | None = None,
                    split: float | None = None,
                    elements_by: Literal["texture", "mesh"] | None = None,
                    samples: int | None = None,
                    seed: int | None = None,
                    aimed: bool | None = None,
                    rasterizer: Rasterizer | None = None) -> FormFactorRow:
    """The row of a surface or of a texel, to all elements, or to all surfaces.

    The row of a surface is the mean over its patches, by area; that of a texel is drawn from its centre.
    resolution: pixels along the side of a hemicube, even, 2 to 4096 (default 256). orientation: of hemicubes (default
    turned). split: a patch is split while more than this share of its light would go elsewhere from other points of it;
    1: never (default 0.003). samples, seed, aimed: of rays (default 65536, 0, False).
    """
    elements = _elements(what)
    row = _core.form_factor_row(
        _core_of(elements, Elements), source,
        _settings(by_surface=by_surface, method=method, resolution=resolution, orientation=orientation, split=split,
                  elements_by=elements_by, samples=samples, seed=seed, aimed=aimed), _factory(rasterizer))
    return FormFactorRow(elements=elements, **row)


def form_factor_matrix(what: Scene | Elements | str | os.PathLike[str],
                       *,
                       facets: bool | None = None,
                       mirrors: Sequence[tuple[Literal["x", "y", "z"], float]] | None = None,
                       period: Vector | None = None,
                       repeats: int | None = None,
                       method: Literal["hemicube", "single-plane", "tetrahedron", "rays"] = "hemicube",
                       resolution: int | None = None,
                       orientation: Literal["turned", "aligned"] | None = None,
                       split: float | None = None,
                       max_error: float | None = None,
                       smooth: bool = False,
                       samples: int | None = None,
                       seed: int | None = None,
                       rasterizer: Rasterizer | None = None,
                       progress: Told | None = None) -> FormFactorMatrix:
    """The matrix between all surfaces, families added up, or between all facets, as `hemitex formfactors` writes it.

    what: elements, a scene, or its file. facets, mirrors, period, repeats: settings of the scene that are to be others
    (see `load_scene` and `Scene.from_arrays`).
    max_error: bounds the sum of the absolute errors of each row, for scenes of facets; chooses the other settings.
    smooth: corrects the matrix to exact reciprocity by least squares, with the same row sums. For the others see
    `form_factor_row`.
    """
    changes = {"facets": facets, "mirrors": mirrors, "period": period, "repeats": repeats}
    if isinstance(what, (str, os.PathLike)):
        what = load_scene(what, **_settings(**changes))
    elif isinstance(what, Scene):
        what = what._with(**changes)
    elif _settings(**changes):
        raise InputError(f"the elements are divided already; give `{next(iter(_settings(**changes)))}` with a scene")
    elements = _elements(what)
    return _matrix_of(_core.form_factor_matrix(
        _core_of(elements, Elements),
        _settings(method=method, resolution=resolution, orientation=orientation, split=split, max_error=max_error,
                  smooth=smooth, samples=samples, seed=seed), _factory(rasterizer), progress))


def rays(what: Scene | Elements,
         source: Source,
         *,
         by_surface: bool = False,
         samples: int = 1 << 16,
         seed: int = 0,
         aimed: bool = False) -> FormFactorRow:
    """A row by rays from the whole area of the source, with standard errors: the ground truth for other methods.

    aimed: rays aim at each receiver instead of covering the hemisphere; accurate, but slow for many receivers.
    """
    return form_factor_row(what, source, by_surface=by_surface, method="rays", samples=samples, seed=seed, aimed=aimed)


@overload
def analytic(what: Scene | Elements, source: Source, *, by_surface: bool = False) -> FormFactorRow:
    ...


@overload
def analytic(what: npt.ArrayLike, source: npt.ArrayLike) -> float:
    ...


def analytic(what: Any, source: Any, *, by_surface: bool = False) -> Any:
    """Closed forms without blockers: a row of a scene, or the form factor from one polygon to another.

    A polygon is (corners, 3), convex and planar, counter-clockwise in front. Relative error 1e-9.

    >>> below = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> above = [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]
    >>> round(analytic(below, above), 9)  # Howell's C-11
    0.199824896
    """
    if isinstance(what, (Scene, Elements)):
        return form_factor_row(what, source, by_surface=by_surface, method="analytic")
    return _core.polygon_form_factor(what, source)


def hemicube(what: Scene | Elements,
             source: Source,
             *,
             resolution: int = 64,
             method: Literal["hemicube", "single-plane", "tetrahedron"] = "hemicube",
             rasterizer: Rasterizer | None = None) -> Hemicube:
    """The faces over the centre of a texel, or of the first patch of a surface, with item IDs and delta form factors."""
    elements = _elements(what)
    faces = _core.hemicube(_core_of(elements, Elements), source, _settings(resolution=resolution, method=method),
                           _factory(rasterizer))
    return Hemicube([
        HemicubeFace(_face(face["face"]), face["ids"], face["elements"], face["weights"]) for face in faces
    ], elements)


def check_matrix(matrix: FormFactorMatrix | Any,
                 mesh: Scene,
                 *,
                 tolerance: float = 0.05,
                 rows: int = 32,
                 samples: int = 1 << 18) -> MatrixVerdict:
    """Judges a matrix that any program computed for a mesh of facets: what is wrong, where, and which fault explains it.

    matrix: (n, n), or (n, n + 2) with the columns surroundings and backs: a FormFactorMatrix, or any matrix of SciPy or
    NumPy. mesh: loaded with facets=True, or of arrays without names. tolerance: relative error of an entry that is no
    fault. rows: so many are measured by rays, with `samples` rays each.
    """
    facets = _elements(mesh)
    parts = _parts(matrix, len(_core.families(_core_of(facets, Elements))))
    found = _core.check_matrix(facets._core, *parts, _settings(tolerance=tolerance, rows=rows, samples=samples))
    return MatrixVerdict(**found)


def read_matrix(file: str | os.PathLike[str]) -> tuple[scipy.sparse.csr_array, Floats | None]:
    """A matrix of a file (.npz, .mtx, .csv, .vf, .txt), and the areas of its facets if the file has them."""
    found = _core.read_matrix(os.fspath(file))
    return _csr(found), found["area"]


def _csr(found: dict[str, Any]) -> scipy.sparse.csr_array:
    return scipy.sparse.csr_array((found["data"], found["indices"], found["indptr"]), shape=found["shape"])


def _matrix_of(found: dict[str, Any]) -> FormFactorMatrix:
    """The matrix of rows of C++, which have the columns of surroundings and backs or none."""
    rows, count = _csr(found), len(found["names"])
    outside = np.zeros((count, 2)) if rows.shape[1] == count else rows[:, count:].toarray()
    errors = None if found["errors"] is None else _csr({**found, "data": found["errors"]})
    return FormFactorMatrix(scipy.sparse.csr_array(rows[:, :count]), outside[:, 0].copy(), outside[:, 1].copy(),
                            found["area"], found["error"], found["names"], errors)


def _rows(matrix: FormFactorMatrix | Any) -> scipy.sparse.csr_array:
    """A copy in compressed rows of any matrix of SciPy or NumPy; each entry is there once, in ascending columns."""
    try:
        rows = scipy.sparse.csr_array(matrix.complete if isinstance(matrix, FormFactorMatrix) else matrix, copy=True)
    except (ValueError, TypeError, NotImplementedError) as error:
        raise InputError(f"the matrix is none of SciPy or NumPy: {error}") from None
    if len(rows.shape) != 2:
        raise InputError(f"the matrix has the shape {rows.shape}")
    rows.sum_duplicates()
    return rows


def _parts(matrix: FormFactorMatrix | Any, facets: int) -> tuple[Any, ...]:
    """The arrays and the number of columns of a matrix with a row for each facet."""
    rows = _rows(matrix)
    if rows.shape[0] != facets or rows.shape[1] not in (facets, facets + 2):
        raise InputError(f"the matrix has the shape {rows.shape}; for {facets} facets give ({facets}, {facets}), or "
                         f"({facets}, {facets + 2}) with the columns surroundings and backs")
    return rows.data, rows.indices, rows.indptr, rows.shape[1]


def _written(file: str | os.PathLike[str], write: Callable[[str], Any]) -> None:
    """Lets `write` make a file beside its place, and moves it there when it is complete."""
    place = Path(file)
    try:
        with tempfile.TemporaryDirectory(prefix=f".{place.name}-", dir=place.parent) as folder:
            made = Path(folder) / place.name
            write(os.fspath(made))
            os.replace(made, place)
    except OSError as error:
        raise InputError(f"{place} cannot be written: {error.strerror}") from None
