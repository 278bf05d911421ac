"""Animated pictures."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from pathlib import Path

from ..core.errors import InputError
from ..io.atomic import atomic_file

KINDS = {".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}
"""Format of an animated picture by the suffix of its file."""


def save_frames(
    path: str | Path, draw: Callable[[], Sequence[bytes]], count: int, *, pause: int, overwrite: bool = False
) -> Path:
    """Write the ``count`` PNG that ``draw`` makes, all of one size, as an animated picture with a
    ``pause`` of so many ms after each.

    Raises
    ------
    InputError
        If the suffix is none of ``KINDS``, or there are fewer than two frames.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    from PIL import Image

    target = Path(path)
    kind = KINDS.get(target.suffix.lower())
    if kind is None:
        raise InputError(f"path of the animation must end in {', '.join(KINDS)}, but is {target.name!r}.")
    if count < 2:
        raise InputError(f"frames of an animation must be at least 2, but are {count!r}.")
    first, *rest = (Image.open(io.BytesIO(frame)) for frame in draw())
    with atomic_file(target, overwrite=overwrite) as file:
        first.save(file, format=kind, save_all=True, append_images=rest, duration=pause, loop=0)
    return target
