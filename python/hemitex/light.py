"""Light: solutions, edits, sensitivities."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InputError
from .cameras import Camera, camera
from .form_factors import Told, _settings
from .rasterizers import Rasterizer, _factory
from .scenes import Edit, Elements, Floats, Scene, _core_of, _edits, _elements, _three_bands


@dataclass(frozen=True)
class UpdateCost:
    """The work of an edit of a solution beside its shots: numbers of form-factor rows."""
    rows_in_windows: int  #: of which only the changed windows were drawn
    rows_whole: int  #: drawn completely
    rows_retracted: int  #: of patches that moved or were removed
    rows_left: int  #: kept, as little of their light can pass the change
    started_over: bool  #: solved again


class Solution:
    """The light of a scene."""

    def __init__(self, core: _core.Solution, update_cost: UpdateCost | None = None) -> None:
        """For use by this package: see `solve` and `edit`."""
        self._core = core
        self.update_cost = update_cost
        """What the edit took that gave this solution; None for one of `solve`."""
        self.elements = Elements(_core.elements_of(self._core))
        self.radiosity: Floats = _core.radiosity(self._core)
        """(elements, 3), W/m^2 per band; read-only, in the memory of the solution. Of a scene with wavelengths the
        colour, in linear sRGB."""
        self.bands: Floats = _core.radiosity_in_bands(self._core)
        """(elements, wavelengths), W/m^2 per band of a scene with wavelengths; empty of other scenes."""
        about: dict[str, Any] = _core.about_solution(self._core)
        self.residual: float = about["residual"]
        """Flux that was not shot yet over emitted flux."""
        self.shots: int = about["shots"]
        self.patches: int = about["patches"]
        """The number of patches, as split."""
        self.ended_by: str = about["ended_by"]
        """The limit that ended it: "residual", "shots", or "progress" for the callback."""
        self.is_interrupted: bool = about["interrupted"]
        """Whether the progress callback ended it before a limit was reached."""
        self.energy: dict[str, tuple[float, ...]] = about["energy"]
        """Where the flux went, in W per band: emitted = absorbed + unshot + lost."""
        self.expected_error: float | None = about["expected_error"]
        """With max_error: the expected share of the flux that is in the wrong place."""
        self.row_error: float | None = about["row_error"]
        """Of facets with max_error: the largest estimated error of a row of form factors."""
        self.warnings: list[str] = about["warnings"]

    @property
    def scene(self) -> Scene:
        """The scene, with all edits."""
        return self.elements.scene

    def mean(self, name: str) -> Floats:
        """(3,): the radiosity of a surface or family, W/m^2, averaged by area."""
        numbers = self.elements.of(name)
        area = self.elements.area[numbers]
        return area @ self.radiosity[numbers] / area.sum()

    def to_xarray(self, name: str) -> Any:
        """The radiosity of a surface as an xarray.DataArray (row, column, band)."""
        return self.elements.to_xarray(self.radiosity, name)

    def __repr__(self) -> str:
        return f"<hemitex.Solution of {self.elements!r}, {self.shots} shots, residual {self.residual:.3g}>"


def solve(what: Scene | Elements,
          *,
          texels: int | None = None,
          texel_size: float | None = None,
          residual: float | None = None,
          shots: int | None = None,
          max_error: float | None = None,
          seen_by: Camera | None = None,
          method: Literal["hemicube", "single-plane", "tetrahedron", "rays"] = "hemicube",
          resolution: int | None = None,
          orientation: Literal["turned", "aligned"] = "turned",
          split: float | None = None,
          elements_by: Literal["texture", "mesh"] = "texture",
          format: str = "r8g8b8a8",
          samples: int | None = None,
          seed: int = 0,
          editable: bool = False,
          rasterizer: Rasterizer | None = None,
          progress: Told | None = None) -> Solution:
    """Solves by progressive radiosity, with the bits of `hemitex solve`.

    texels, texel_size: the elements of a scene, as `discretize` takes them.
    residual: stops when so much of the emitted flux is unshot (default 0.001; with light from outside 0.001 of
    what stays in rooms, at least 0.00001 of all; with max_error a tenth of that, if it is less). shots: stops after so
    many, or at the residual.
    resolution, split: of hemicubes (default 256 and 0.003); with max_error its effort begins there.
    max_error: solves with growing effort until the expected error is at most this share, of all flux and of what
    `seen_by` sees; of facets without texels, bounds the error of every row of form factors. format: channels of item
    IDs.
    editable: `edit` takes the solution.
    progress: a function of the share that is done; if it returns False, the solution ends with what it has.
    """
    elements = _elements(what, editable, texels, texel_size)
    settings = _settings(residual=residual, shots=shots, max_error=max_error, method=method, format=format,
                         samples=samples, seed=seed, editable=editable, elements_by=elements_by,
                         orientation=orientation, resolution=resolution, split=split)
    seen_from = None if max_error is None else vars(seen_by or camera(elements.scene))
    return Solution(_core.solve(_core_of(elements, Elements), settings, seen_from, _factory(rasterizer), progress))


@overload
def edit(what: Scene, edits: Edit | Sequence[Edit]) -> Scene:
    ...


@overload
def edit(what: Solution, edits: Edit | Sequence[Edit], *, progress: Told | None = None) -> Solution:
    ...


def edit(what: Any, edits: Edit | Sequence[Edit], *, progress: Told | None = None) -> Any:
    """The edited scene or solution; `what` keeps its values.

    A solution is updated instead of solved again. It must be editable, and can be edited once: edit the result next.
    """
    if isinstance(what, Scene):
        return Scene(_core.edit_scene(what._core, _edits(edits)))
    core, cost = _core.edit_solution(_core_of(what, Solution), _edits(edits), progress)
    return Solution(core, UpdateCost(**cost))


@dataclass(frozen=True)
class Sensitivity:
    """Derivatives of the target, the sum of weights times radiosity over elements. Bands do not mix."""
    target: Floats  #: (3,) per band
    by_emission: Floats  #: (elements, 3): by the emitted radiosity of each element
    by_reflectance: Floats  #: (elements, 3)
    radiosity: Floats  #: (elements, 3), W/m^2: the exact solution with the rows of the solution
    elements: Elements

    def of(self, name: str, by: Literal["emission", "reflectance"] = "emission") -> Floats:
        """(3,): the derivative by the emission or reflectance of all elements of a surface or family together."""
        if by not in ("emission", "reflectance"):
            raise InputError(f"`by` is {by!r}; give emission or reflectance")
        values = self.by_emission if by == "emission" else self.by_reflectance
        return values[self.elements.of(name)].sum(axis=0)


@overload
def sensitivity(solution: Solution, target: str | npt.NDArray[Any], *, progress: Told | None = None) -> Sensitivity:
    ...


@overload
def sensitivity(solution: Solution,
                target: list[Any] | tuple[Any, ...],
                *,
                progress: Told | None = None) -> list[Sensitivity]:
    ...


def sensitivity(solution: Solution, target: Any, *, progress: Told | None = None) -> Any:
    """The derivatives of a target by all emissions and reflectances at once, by one transposed solution.

    target: weights of elements, (elements,) or (elements, 3), or the name of a surface, whose mean radiosity is meant.
    A list of targets, or an array (targets, elements, 3), gives a list. Rows of form factors, which take most of the
    time, are computed once for all targets. Rows are those of the patches of the solution.
    """
    core = _core_of(solution, Solution)
    elements = solution.elements
    are_many = np.ndim(target) == 3 if isinstance(target, np.ndarray) else isinstance(target, (list, tuple)) and any(
        isinstance(each, str) or (np.ndim(each) > 0 and len(each) == len(elements)) for each in target)
    weights = [_weights(each, elements) for each in (target if are_many else [target])]
    found = [
        Sensitivity(elements=elements, **{**each, "target": np.array(each["target"])})
        for each in _core.sensitivities(core, weights, progress)
    ]
    return found if are_many else found[0]


def _weights(target: Any, elements: Elements) -> npt.NDArray[Any]:
    if not isinstance(target, str):
        return _three_bands(target, "target")
    numbers = elements.of(target)
    shares = np.zeros(len(elements))
    shares[numbers] = elements.area[numbers] / elements.area[numbers].sum()
    return _three_bands(shares, "target")


@contextmanager
def insist() -> Iterator[None]:
    """Runs the calls inside a `with` block whatever their size.

    Otherwise more than 2^24 elements, and files, meshes, images and matrices that do not fit into the free memory, raise
    `InputError` with the number. Holds for all threads.
    """
    policy = _core.SizePolicy(True)
    try:
        yield
    finally:
        del policy


@contextmanager
def threads(count: int) -> Iterator[None]:
    """Limits all calls inside a `with` block to a number of threads; 0 means all of the machine."""
    limit = _core.Threads(count)
    try:
        yield
    finally:
        del limit
