"""Rasterizers written in Python: what they get and what they return.

A *rasterizer* is a function of a draw list, a face and the numbers of skipped triangles, ascending. It returns the item
IDs of the face's pixels: (height, width) of the scissor rectangle, row 0 first. Pixels without a triangle hold
`DrawList.background`. `solve`, `form_factor_row`, `hemicube` and `judge` take one. All but `judge` also take the
name of a device: `software`, `vulkan`, `vulkan-compute` or `opengl`. It is judged when it is used first, which takes
seconds, and refused if it draws test vectors with errors (docs/gpu.md).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal, Union

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True)
class Draw:
    """A run of triangles with one offset and one index map."""
    first: int  #: number of the first triangle
    count: int  #: number of triangles
    offset: int = 0  #: item ID
    back: int | None = None  #: item ID of triangles that face away; None: drawn as those that face the eye
    index_map: int | None = None  #: in DrawList.index_maps; None: the offset alone
    cull: str = "none"  #: triangles that do not exist: none, front (those that face the eye) or back


@dataclass(frozen=True)
class DrawList:
    """All triangles that are drawn, independent of the view."""
    positions: npt.ArrayLike  #: (n, 3) in binary32
    texcoords: npt.ArrayLike  #: (n, 2) in binary32
    triangles: npt.ArrayLike  #: (m, 3) numbers of positions
    draws: Sequence[Draw]  #: in the order in which they are drawn
    index_maps: Sequence[npt.ArrayLike] = ()  #: (height, width) item IDs each; row 0 is at v = 0; 2**32 - 1 is a hole
    channel_bits: tuple[int, ...] = (8, 8, 8, 8)  #: of an item ID, the least significant channel first
    blend: str = "clamped-add"  #: of offset and texel: clamped-add per channel, integer-add or replace
    values: str = "item-ids"  #: of pixels: item-ids, or triangle-numbers, which count from the offset of their draw

    @staticmethod
    def of_triangles(positions: npt.ArrayLike, triangles: npt.ArrayLike) -> DrawList:
        """A draw list whose item IDs are numbers of triangles, as buffers for visibility and picking hold them."""
        return DrawList(positions, np.zeros((len(np.asarray(positions)), 2), np.float32), triangles,
                        [Draw(0, len(np.asarray(triangles)), 0)], channel_bits=(32,), values="triangle-numbers")

    @property
    def background(self) -> int:
        """The item ID of pixels that no triangle covers: all bits set."""
        return (1 << sum(self.channel_bits)) - 1


@dataclass(frozen=True)
class Face:
    """A view: x = X.d, y = Y.d, w = W.d with d = P - eye. The viewport shows x/w and y/w from -1 to 1."""
    eye: Sequence[float] = (0.0, 0.0, 0.0)
    x: Sequence[float] = (1.0, 0.0, 0.0)  #: right
    y: Sequence[float] = (0.0, 1.0, 0.0)  #: towards larger rows
    w: Sequence[float] = (0.0, 0.0, -1.0)  #: forward
    near: float = 2.0**-10  #: smallest w that is drawn
    resolution: int = 256  #: of the viewport; even, 2 to 4096
    scissor: tuple[int, int, int, int] | None = None  #: first column, first row, width, height; None: the viewport

    @property
    def rectangle(self) -> tuple[int, int, int, int]:
        """The scissor rectangle."""
        return (0, 0, self.resolution, self.resolution) if self.scissor is None else self.scissor


Ids = npt.NDArray[np.uint32]
Device = Literal["software", "vulkan", "vulkan-compute", "opengl"]
Rasterizer = Union[Callable[[DrawList, Face, npt.NDArray[np.uint32]], npt.ArrayLike], Device]


def _draw_list(core: dict[str, Any]) -> DrawList:
    given: dict[str, Any] = {**core, "draws": [Draw(**draw) for draw in core["draws"]]}
    return DrawList(**given)


def _face(core: dict[str, Any]) -> Face:
    return Face(**core)


def _to_core(value: DrawList | Face) -> dict[str, Any]:
    if isinstance(value, Face):
        return {**vars(value), "scissor": value.rectangle}
    return {**vars(value), "draws": [vars(draw) for draw in value.draws]}


def _factory(rasterizer: Rasterizer | None) -> Any:
    """What the module calls with a draw list, and then with faces."""
    return partial(_bound, rasterizer) if callable(rasterizer) else rasterizer


def _bound(rasterizer: Callable[..., npt.ArrayLike], core: dict[str, Any]) -> Any:
    draw_list = _draw_list(core)
    return lambda face, skipped: rasterizer(draw_list, _face(face), skipped)
