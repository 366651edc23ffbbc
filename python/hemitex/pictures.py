"""Pictures of scenes and of their light."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._core import InputError
from .cameras import Camera, camera
from .form_factors import _settings
from .light import Solution
from .scenes import Elements, Scene, _elements, _three_bands


def render(what: Solution | Scene | Elements,
           *,
           values: npt.ArrayLike | None = None,
           show: Literal["wireframe", "mesh", "ids", "index-map", "offsets"] = "wireframe",
           seen_by: Camera | None = None,
           size: Sequence[int] = (800, 600),
           exposure: float | None = None,
           filter: Literal["none", "triangle", "bilinear", "bicubic"] | None = None,
           gather: bool = False) -> npt.NDArray[np.uint8]:
    """A picture, (height, width, 3) sRGB codes, the top row first.

    Of a solution: its light, filtered, as `hemitex solve` writes it into render.png. filter: by default bicubic.
    gather: each texel gathers its light instead, as with `--gather`. exposure: factor from W/m^2 to
    linear colours in [0, 1]; by default chosen from what the camera sees. Of a scene or elements: what `show` says, or
    `values`, linear colours (elements,) or (elements, 3) in [0, 1], one per element.
    """
    elements = what.elements if isinstance(what, Solution) else _elements(what)
    if not isinstance(elements, Elements):
        raise InputError(f"{what!r:.80} is no Solution, Scene or Elements")
    view = vars(seen_by or camera(elements.scene))
    try:
        width, height = size
    except (TypeError, ValueError):
        raise InputError(f"`size` is {size!r}; give (width, height)") from None
    settings = _settings(width=width, height=height, exposure=exposure, filter=filter, gather=gather or None)
    if values is not None:
        return _core.value_picture(elements._core, _three_bands(values, "values"), view, settings)
    if isinstance(what, Solution):
        return _core.lit_picture(what._core, view, settings)[0]
    return _core.structure_picture(elements._core, show, view, settings)
