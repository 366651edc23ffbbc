"""Pictures of scenes and of their light."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InputError
from .form_factors import _settings
from .scenes import Elements, Scene, Vector, _elements, _three_bands

if TYPE_CHECKING:
    from .light import Solution


@dataclass(frozen=True)
class Camera:
    """A camera; fov is the vertical field of view in degrees."""
    eye: Vector
    look_at: Vector
    up: Vector = (0.0, 1.0, 0.0)
    fov: float = 50.0


def camera(scene: Scene, **changes: Any) -> Camera:
    """The camera of SCENE.view.json beside the file, else that of the file, else one that shows most of the scene.

    changes: replace `eye`, `look_at`, `up` or `fov`.
    """
    found: dict[str, Any] = scene._about["camera"] or {}
    beside = Path(scene.files[0]).with_suffix(".view.json") if scene.files else None
    if beside and beside.exists():
        try:
            found = json.loads(beside.read_text(encoding="utf-8"))
        except json.JSONDecodeError as error:
            raise InputError(f"{beside}:{error.lineno}: is not JSON: column {error.colno}") from None
        except UnicodeDecodeError:
            raise InputError(f"{beside}: is not UTF-8") from None
        if not isinstance(found, dict):
            raise InputError(f"{beside}: is not a valid view: it is no JSON object")
    if not {"eye", "look_at"} <= set(found) | set(changes):
        found = {**_core.default_camera(scene._core), **found}
    try:
        return Camera(**{**found, **changes})
    except TypeError as error:
        raise InputError(f"no valid camera: {error}") from None


def render(what: Solution | Scene | Elements,
           *,
           values: npt.ArrayLike | None = None,
           show: Literal["wireframe", "mesh", "ids", "index-map", "offsets"] = "wireframe",
           seen_by: Camera | None = None,
           size: Sequence[int] = (800, 600),
           exposure: float | None = None,
           filter: Literal["none", "triangle", "bilinear", "bicubic"] = "bicubic") -> npt.NDArray[np.uint8]:
    """A picture, (height, width, 3) sRGB codes, the top row first.

    Of a solution: its light, filtered, as `hemitex solve` writes it into render.png. exposure: factor from W/m^2 to
    linear colours in [0, 1]; by default chosen from what the camera sees. Of a scene or elements: what `show` says, or
    `values`, linear colours (elements,) or (elements, 3) in [0, 1], one per element.
    """
    from .light import Solution
    elements = what.elements if isinstance(what, Solution) else _elements(what)
    if not isinstance(elements, Elements):
        raise InputError(f"{what!r:.80} is no Solution, Scene or Elements")
    view = vars(seen_by or camera(elements.scene))
    try:
        width, height = size
    except (TypeError, ValueError):
        raise InputError(f"`size` is {size!r}; give (width, height)") from None
    settings = _settings(width=width, height=height, exposure=exposure, filter=filter)
    if values is not None:
        return _core.value_picture(elements._core, _three_bands(values, "values"), view, settings)
    if isinstance(what, Solution):
        return _core.lit_picture(what._core, view, settings)[0]
    return _core.structure_picture(elements._core, show, view, settings)
