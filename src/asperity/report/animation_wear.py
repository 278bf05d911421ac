"""Animated pictures of an outcome: the section of a contact that wears."""

from __future__ import annotations

from pathlib import Path

from ..core.errors import InputError
from ..physics.wear.figures import WearPicture, save_wear
from ..physics.wear.part import Wear
from ..run.execute import Outcome


def save_wear_animation(outcome: Outcome, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write the section of a contact that wears, and its pressure, along the way as an animated
    picture (.gif, .png or .webp), of an ``outcome`` or its file.

    Raises
    ------
    InputError
        If nothing wears in the outcome, or the suffix is another.
    OutputError
        If the file exists and ``overwrite`` is false, or cannot be written.
    """
    found = outcome.found.get(Wear.name)
    if found is None:
        raise InputError(
            "outcome of an animation of wear must be of a contact that wears, but is not. Give {wear.distance=1m}.",
            subject="outcome of an animation of wear",
        )
    return save_wear(WearPicture(outcome.solved.problem, found.values, found.detail), path, overwrite=overwrite)
