"""Cameras of pictures."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _core
from ._core import InputError
from .scenes import Scene, Vector


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
