"""Scenes, their elements, and edits."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InputError

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Vector = Union[float, Sequence[float], Floats]
"""Three numbers, such as RGB bands, or one that stands for three."""


class Scene:
    """Surfaces with materials. A scene does not change; `edit` returns another one.

    A *surface* is a set of triangles with one material. Several surfaces may form a *family*: the parts of one group of
    the file. A name is that of a surface or a family.
    """

    def __init__(self, core: _core.Scene, again: Callable[..., Scene] | None = None) -> None:
        """For use by this package: see `load_scene` and `Scene.from_arrays`."""
        self._core = core
        self._again = again
        self._about: dict[str, Any] = _core.about_scene(core)

    @staticmethod
    def from_arrays(vertices: npt.ArrayLike,
                    faces: npt.ArrayLike | Sequence[Sequence[int]],
                    reflectance: npt.ArrayLike = 0.5,
                    emission: npt.ArrayLike = 0.0,
                    names: Sequence[str] | None = None,
                    *,
                    sides: Literal["auto", "one", "two"] | None = None,
                    charts: Literal["auto", "planar"] = "auto",
                    max_reflectance: float = 0.9999,
                    sky: Vector = 0.0,
                    suns: Sequence[tuple[Vector, Vector]] = (),
                    lamps: Sequence[tuple[Vector, Vector]] = (),
                    mirrors: Sequence[tuple[Literal["x", "y", "z"], float]] = (),
                    period: Vector = 0.0,
                    repeats: int | None = None) -> Scene:
        """A scene of arrays.

        vertices: (n, 3), in the unit of the scene.
        faces: (m, k) vertices per face, or a list of faces with any number of corners, at least 3. A face reflects and
            emits on the side from which its corners run counter-clockwise.
        reflectance: diffuse, in [0, 1): one number, (m,) per face, (1, 3) RGB or (m, 3) RGB per face.
        emission: emitted radiosity, W/m^2, in the same shapes.
        names: one per face; faces of one name are one surface, or the parts of a family. Without it each face is a
            surface of one element, named by its number (a facet).
        sides: which surfaces send light on both sides: `one` none, `two` all, `auto` open sheets that are lit from
            both; by default `auto`, and `one` for facets.
        sky: irradiance of an open plane, W/m^2. suns: (direction, irradiance) of parallel lights.
        lamps: (position, radiant intensity in W/sr) of points; in edits they are `lamp-1`, `lamp-2`, ...
        mirrors: (axis, coordinate) of planes behind which the scene continues as in a mirror, at most two per axis.
        period: lengths along x, y and z of a box that is repeated; 0 along an axis without repeats.
        repeats: images on each side of a box that `period` or two mirrors repeat (4 if not given).

        >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
        >>> Scene.from_arrays(square, [[0, 1, 2, 3]], names=["floor"]).area
        array([1.])
        """
        corners, counts = _flat_faces(faces)
        rho, light = _per_face(reflectance, len(counts), "reflectance"), _per_face(emission, len(counts), "emission")
        both = np.ascontiguousarray(np.hstack([rho, light]))
        materials, material_of = np.unique(both, axis=0, return_inverse=True) if len(both) else (both, np.zeros(0, int))
        if names is None:
            groups, group_of = ["mesh"], np.zeros(len(counts), np.int64)
        else:
            if isinstance(names, str) or len(names) != len(counts):
                raise InputError(f"`names` has not one name for each of {len(counts)} faces")
            numbers: dict[str, int] = {}
            group_of = np.array([numbers.setdefault(str(name), len(numbers)) for name in names], np.int64)
            groups = list(numbers)
        settings = {
            "sides": sides,
            "charts": charts,
            "max_reflectance": max_reflectance,
            "facets": names is None,
            "mirrors": list(mirrors),
            "period": period,
            "repeats": repeats,
        }
        core = _core.scene_from_arrays(vertices, corners, counts, group_of, material_of.reshape(-1), groups,
                                       np.ascontiguousarray(materials[:, :3]), np.ascontiguousarray(materials[:, 3:]),
                                       settings)
        points, corners, rho, light = np.array(vertices), corners.copy(), rho.copy(), light.copy()

        def again(facets: bool | None = None, **other: Any) -> Scene:
            if facets is False and names is None:
                raise InputError("the faces have no names, so that each is a facet", "omit `facets`, or give `names`")
            kept: dict[str, Any] = dict(sides=sides, charts=charts, max_reflectance=max_reflectance, sky=sky, suns=suns,
                                        lamps=lamps, mirrors=mirrors, period=period, repeats=repeats)
            polygons = np.split(corners, np.cumsum(counts)[:-1])
            return Scene.from_arrays(points, polygons, rho, light, None if facets else names, **{**kept, **other})

        return Scene(_core.with_light(core, sky, list(suns), list(lamps), True), again)

    def _with(self, **settings: Any) -> Scene:
        """The scene with other settings; those that are None stay."""
        given = {name: value for name, value in settings.items() if value is not None}
        if not given:
            return self
        if self._again is None:
            raise InputError(f"the scene was changed after it was made; give `{next(iter(given))}` where it was made")
        return self._again(**given)

    @property
    def names(self) -> list[str]:
        """The names of the surfaces."""
        return list(self._about["names"])

    @property
    def families(self) -> list[str]:
        """The family of each surface."""
        return list(self._about["families"])

    @property
    def materials(self) -> list[str]:
        """The name of the material of each surface."""
        return list(self._about["materials"])

    @property
    def area(self) -> Floats:
        """(surfaces,): the area of each."""
        return self._about["area"]

    @property
    def reflectance(self) -> Floats:
        """(surfaces, 3): of the material, without maps."""
        return self._about["reflectance"]

    @property
    def emission(self) -> Floats:
        """(surfaces, 3): emitted radiosity of the material, W/m^2, without maps."""
        return self._about["emission"]

    @property
    def extent(self) -> float:
        """The diagonal of the bounds."""
        return float(self._about["extent"])

    @property
    def origin(self) -> tuple[float, float, float]:
        """The centre of the bounds."""
        return self._about["origin"]

    @property
    def lamps(self) -> list[tuple[str, tuple[float, float, float], tuple[float, float, float]]]:
        """The name, the position and the intensity in W/sr of each lamp that is a point."""
        return list(self._about["lamps"])

    @property
    def files(self) -> list[str]:
        """The files that were read, the scene first; none for arrays."""
        return list(self._about["files"])

    @property
    def warnings(self) -> list[str]:
        """What was repaired in the input, one sentence each."""
        return list(self._about["warnings"])

    def triangles(self) -> tuple[Floats, Integers]:
        """(t, 3, 3) corners, and the surface (t,) of each triangle."""
        return _core.triangles(self._core)

    def lit_from_outside(self, sky: Vector = 0.0, suns: Sequence[tuple[Vector, Vector]] = ()) -> Scene:
        """The scene with another sky and other suns (see `from_arrays`)."""
        return Scene(_core.with_light(self._core, sky, list(suns), [], False))

    @property
    def wavelengths(self) -> list[float]:
        """The bands in nm, ascending; empty where they are red, green and blue."""
        return self._about["wavelengths"]

    def in_bands(self,
                 wavelengths: npt.ArrayLike,
                 spectra: Mapping[str, Mapping[str, npt.ArrayLike]] | None = None) -> Scene:
        """The scene in bands of wavelengths, in nm, ascending.

        `spectra` gives materials, by their names, `reflectance` below 1 and `emission` in W/m^2, each with one value
        per wavelength. The colours of other materials and of light from outside stand for thirds of the bands."""
        return Scene(_core.in_bands(self._core, wavelengths, {name: dict(of) for name, of in (spectra or {}).items()}))

    def __repr__(self) -> str:
        return f"<hemitex.Scene of {len(self._about['names'])} surfaces, {self.extent:.4g} units across>"


def load_scene(file: str | os.PathLike[str],
               *,
               charts: Literal["auto", "file", "planar"] = "auto",
               sides: Literal["auto", "one", "two"] | None = None,
               emission: Literal["radiosity", "radiance"] = "radiosity",
               max_reflectance: float = 0.9999,
               lumens_per_watt: float = 683.0,
               crease: float | None = None,
               facets: bool = False,
               flip: Sequence[str] = (),
               sky: Vector = 0.0,
               suns: Sequence[tuple[Vector, Vector]] = (),
               lamps: Sequence[tuple[Vector, Vector]] = (),
               mirrors: Sequence[tuple[Literal["x", "y", "z"], float]] = (),
               period: Vector = 0.0,
               repeats: int | None = None) -> Scene:
    """Reads OBJ with MTL, glTF, STL, PLY, VTK or View3D files, as `hemitex solve` does. A unit of length that an OBJ
    file states, such as `# units: mm`, makes fluxes those in W; lengths and areas stay in the unit of the file.

    emission: the unit of `Ke`. lumens_per_watt: divides candela and lux of the lights of a glTF file. crease: the angle
    in degrees at which curved parts end. facets: each face of the file is a surface of one element, named by its
    number. flip: names of surfaces or groups that are turned over. For the others see `Scene.from_arrays`.
    """
    settings = {
        "charts": charts,
        "sides": sides,
        "emission": emission,
        "max_reflectance": max_reflectance,
        "lumens_per_watt": lumens_per_watt,
        "crease": crease,
        "facets": facets,
        "flip": list(flip),
        "mirrors": list(mirrors),
        "period": period,
        "repeats": repeats,
    }
    core = _core.with_light(_core.load_scene(os.fspath(file), settings), sky, list(suns), list(lamps), True)
    kept: dict[str, Any] = {**settings, "sky": sky, "suns": suns, "lamps": lamps}
    return Scene(core, lambda **other: load_scene(file, **{**kept, **other}))


class Elements:
    """A scene whose surfaces are divided into elements, the units of radiosity, and into patches, which shoot light.

    Elements are numbered surface by surface, row by row of a surface's grid of texels.
    """

    def __init__(self, core: _core.Elements, scene: Scene | None = None) -> None:
        """For use by this package: see `discretize`."""
        self._core = core
        self.scene = Scene(_core.scene_of(core)) if scene is None else scene
        self._about: dict[str, Any] = _core.about_elements(core)

    def __len__(self) -> int:
        return len(self._core)

    @property
    def surface(self) -> Integers:
        """(elements,): the number of the surface of each."""
        return self._about["surface"]

    @property
    def column(self) -> Integers:
        """(elements,): the column of the element's texel."""
        return self._about["column"]

    @property
    def row(self) -> Integers:
        """(elements,): the row of the element's texel."""
        return self._about["row"]

    @property
    def area(self) -> Floats:
        """(elements,): the exposed area of each."""
        return self._about["area"]

    @property
    def patch(self) -> Integers:
        """(elements,): the number of the patch of each."""
        return self._about["patch"]

    @property
    def reflectance(self) -> Floats:
        """(elements, 3): with maps averaged over each element."""
        return self._about["reflectance"]

    @property
    def emission(self) -> Floats:
        """(elements, 3): emitted radiosity, W/m^2, with maps averaged over each element."""
        return self._about["emission"]

    @cached_property
    def _places(self) -> tuple[Floats, Floats]:
        return _core.places(self._core)

    @property
    def centre(self) -> Floats:
        """(elements, 3): a point of each, at its middle."""
        return self._places[0]

    @property
    def normal(self) -> Floats:
        """(elements, 3): unit normals."""
        return self._places[1]

    def of(self, name: str) -> Integers:
        """The numbers of the elements of a surface or family, ascending."""
        return np.flatnonzero(np.isin(self.surface, _core.surfaces_named(self._core, name)))

    def grid(self, name: str) -> Integers:
        """(rows, columns): the number of the element of each texel of a surface, -1 where there is none.

        Row 0 is at v = 0 of the chart.
        """
        if not isinstance(name, str) or name not in self.scene.names:
            raise InputError(f"no surface is named `{name}`; choose one of Scene.names")
        return _core.grid(self._core, self.scene.names.index(name))

    def to_xarray(self, values: npt.ArrayLike, name: str) -> Any:
        """Values (elements,) or (elements, 3) of a surface as an xarray.DataArray (row, column[, band])."""
        import xarray
        numbers, of = self.grid(name), _numbers(values, "values")
        if of.ndim not in (1, 2) or of.shape[0] != len(self) or (of.ndim == 2 and of.shape[1] != 3):
            raise InputError(f"`values` has the shape {of.shape}; give ({len(self)},) or ({len(self)}, 3)")
        picked = np.where((numbers < 0).reshape(numbers.shape + (1, ) * (of.ndim - 1)), np.nan, of[numbers])
        dims = ("row", "column", "band")[:picked.ndim]
        coords = {"band": ["r", "g", "b"]} if picked.ndim == 3 else {}
        return xarray.DataArray(picked, dims=dims, coords=coords, name=name)

    def __repr__(self) -> str:
        return f"<hemitex.Elements: {len(self)} elements of {self.scene!r}>"


def discretize(scene: Scene,
               *,
               texels: int | None = None,
               texel_size: float | None = None,
               surface_texels: Mapping[str, int] | None = None,
               patch: int = 4,
               editable: bool = False) -> Elements:
    """Divides surfaces into texels x texels elements, or into elements of a size in the unit of the scene.

    By default the number follows the size of each surface, about 90 elements per surface; facets have one.
    surface_texels: other numbers for some surfaces or families. patch: patch x patch elements shoot light together.
    editable: for solutions that `edit` will update; also elements inside solids then exist.
    """
    if surface_texels is not None and not isinstance(surface_texels, Mapping):
        raise InputError("`surface_texels` is no dictionary of names and numbers")
    settings = {
        "texels": texels,
        "texel_size": texel_size,
        "surface_texels": None if surface_texels is None else dict(surface_texels),
        "patch": patch,
        "unburied": editable,
    }
    return Elements(_core.discretize(_core_of(scene, Scene), settings), scene)


@dataclass(frozen=True)
class Move:
    """Moves surfaces by a vector in the unit of the scene. `*` at the end of a name means any rest."""
    name: str
    by: Vector


@dataclass(frozen=True)
class Remove:
    """Removes surfaces."""
    name: str


@dataclass(frozen=True)
class Restore:
    """Restores removed surfaces at their old place."""
    name: str


@dataclass(frozen=True)
class Add:
    """Adds the surfaces of a file."""
    file: str | os.PathLike[str]
    by: Vector = 0.0


@dataclass(frozen=True)
class SetEmission:
    """Sets the emitted radiosity of surfaces or of a material, W/m^2."""
    name: str
    to: Vector


@dataclass(frozen=True)
class SetReflectance:
    """Sets the reflectance of surfaces or of a material, in [0, 1)."""
    name: str
    to: Vector


Edit = Union[Move, Remove, Restore, Add, SetEmission, SetReflectance]


def _shift(edit: Move | Add) -> Vector:
    """How far an edit moves; one number, other than 0, says no direction."""
    if isinstance(edit.by, (int, float)) and edit.by != 0:
        raise InputError(f"`by` of {type(edit).__name__} is one number; give three, along x, y and z")
    return edit.by


def _edits(edits: Edit | Sequence[Edit]) -> list[tuple[str, str, Any]]:
    """Edits as the module takes them."""
    result: list[tuple[str, str, Any]] = []
    kinds = (Move, Remove, Restore, Add, SetEmission, SetReflectance)
    for each in [edits] if isinstance(edits, kinds) else edits:
        if isinstance(each, Move):
            result.append(("move", each.name, _shift(each)))
        elif isinstance(each, Remove):
            result.append(("remove", each.name, None))
        elif isinstance(each, Restore):
            result.append(("restore", each.name, None))
        elif isinstance(each, Add):
            result.append(("add", os.fspath(each.file), _shift(each)))
        elif isinstance(each, SetEmission):
            result.append(("emission", each.name, each.to))
        elif isinstance(each, SetReflectance):
            result.append(("reflectance", each.name, each.to))
        else:
            raise InputError(f"{each!r} is no edit; use Move, Remove, Restore, Add, SetEmission or SetReflectance")
    return result


def _core_of(value: Any, kind: type) -> Any:
    """The C++ object of a value; raises InputError for one of another class."""
    if not isinstance(value, kind):
        raise InputError(f"{value!r:.80} is no hemitex.{kind.__name__}")
    of: Any = value
    return of._core


def _elements(what: Scene | Elements,
              editable: bool = False,
              texels: int | None = None,
              texel_size: float | None = None) -> Elements:
    """Elements as they are, or those of a scene."""
    if isinstance(what, Scene):
        return discretize(what, texels=texels, texel_size=texel_size, editable=editable)
    if texels is not None or texel_size is not None:
        raise InputError("the elements are divided already; give `texels` or `texel_size` to `discretize`")
    return what


def _numbers(values: Any, name: str) -> npt.NDArray[Any]:
    """An array of real numbers; raises InputError for anything else."""
    try:
        array = np.asarray(values)
    except (ValueError, TypeError):
        array = np.zeros(0, object)
    if array.dtype.kind not in "fiu":
        raise InputError(f"`{name}` is no array of numbers")
    return array


def _three_bands(values: Any, name: str) -> npt.NDArray[Any]:
    """Values (n,) as (n, 3); others as they are."""
    array = _numbers(values, name)
    return np.repeat(array[:, np.newaxis], 3, axis=1) if array.ndim == 1 else array


def _flat_faces(faces: Any) -> tuple[Integers, Integers]:
    """The corners of all faces one after another, and the number of corners of each."""
    try:
        array = np.asarray(faces)
    except (ValueError, TypeError):
        array = np.zeros(0, object)
    if array.ndim == 2 and array.dtype.kind in "iu":
        corners, counts = array.reshape(-1), np.full(array.shape[0], array.shape[1], np.int64)
    else:
        try:
            each = [np.asarray(face) for face in faces]
        except (ValueError, TypeError):
            raise InputError("`faces` is no list of faces; give the numbers of vertices of each") from None
        if any(face.ndim != 1 or (face.dtype.kind not in "iu" and face.size) for face in each):
            raise InputError("`faces` is no list of faces; give the numbers of vertices of each")
        corners = np.concatenate(each) if each else np.zeros(0, np.int64)
        counts = np.array([len(face) for face in each], np.int64)
    return corners, counts


def _per_face(values: Any, faces: int, name: str) -> Floats:
    """Values as (faces, 3): one for all, one per face, RGB for all, or RGB per face."""
    advice = f"give one number, ({faces},), (1, 3) or ({faces}, 3)"
    array = _numbers(values, name)
    if array.ndim == 1:
        array = array[:, np.newaxis]
    fits = array.ndim == 0 or (array.ndim == 2 and array.shape[0] in (1, faces) and array.shape[1] in (1, 3))
    if not fits or (array.ndim == 2 and array.shape == (1, 1) and faces != 1):
        raise InputError(f"`{name}` has the shape {np.shape(values)}; {advice}")
    return np.broadcast_to(np.asarray(array, np.float64), (faces, 3))
