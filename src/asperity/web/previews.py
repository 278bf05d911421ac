"""A surface on its way through the steps of its preparation, as the pages show it: before some
steps, after them, or what they remove."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import AsperityError
from ..core.units import show
from ..io.atomic import atomic_file
from ..io.schemas.surfaces import prepared
from ..run.build import build_surface
from ..surfaces.characterise.heights import peak_to_valley, rms_height
from ..surfaces.prepare.filter import reliability_cutoff
from ..surfaces.surface import Surface

MOST_SHOWN = 512
"""Points of a preview along its longer side; larger surfaces are thinned out, and the page says
so."""

MOST_OF_A_LINE = 16_384
"""The same of a line scan."""


@dataclass(frozen=True, eq=False)
class Stages:
    """A surface ``before`` and ``after`` some steps of its preparation, and the cut-off wavelengths
    (m) of the filters among these by their names."""

    before: Surface
    after: Surface
    cutoffs: Mapping[str, float] = field(default_factory=dict)

    @property
    def same_grid(self) -> bool:
        """Whether there is a difference: points stayed where they were."""
        first, second = self.before.grid, self.after.grid
        return first.shape == second.shape and np.allclose(first.spacing, second.spacing, rtol=1e-9, atol=0.0)

    @property
    def removed(self) -> Surface | None:
        """Heights before less those after, NaN where one is missing; None where there is no
        difference."""
        if not self.same_grid:
            return None
        heights = np.asarray(self.before.heights, dtype=float) - np.asarray(self.after.heights, dtype=float)
        if not np.isfinite(heights).any():
            return None
        return Surface(heights, *self.before.grid.spacing, periodic=self.before.periodic and self.after.periodic)

    def words(self) -> str:
        """What the steps do to the heights, one or two sentences."""
        removed = self.removed
        if removed is None:
            first, last = (" × ".join(map(str, surface.shape)) for surface in (self.before, self.after))
            return f"Other points than before ({first} → {last}): there is no difference to show."
        gone = int(np.count_nonzero(self.after.mask & ~self.before.mask))
        come = int(np.count_nonzero(self.before.mask & ~self.after.mask))
        counts = [f"{gone} points become missing"] * (gone > 0) + [f"{come} missing points are filled"] * (come > 0)
        if not np.nanmax(np.abs(removed.heights)) > 0.0:
            return f"{' and '.join(counts) or 'Nothing is removed'}; all other heights stay as they are."
        rms = [show(rms_height(surface), "m", 4) for surface in (removed, self.before, self.after)]
        said = (
            f"Removed: rms {rms[0]}, peak to valley {show(peak_to_valley(removed), 'm', 4)}. The rms height is "
            f"{rms[1]} before and {rms[2]} after."
        )
        return " ".join([said, *(f"{count[0].upper()}{count[1:]}." for count in counts)])


def stages(table: Any, folder: Path, first: int, last: int) -> Stages:
    """The surface of the checked ``table`` after the ``first`` and after the ``last`` of its steps,
    counted from 1; relative paths start at ``folder``."""
    before = after = built(table, folder, first)
    found: dict[str, float] = {}
    for number in range(first, last):
        found |= cutoffs(after, [table.prepare[number]])
        after = _prepared(after, table, number)
    return Stages(before, after, found)


def built(table: Any, folder: Path, steps: int | None = None) -> Surface:
    """The surface of the checked ``table`` after so many ``steps`` of its preparation, or all; an
    error has the place of the step that failed."""
    found = build_surface(table.model_copy(update={"prepare": ()}), folder)
    for number in range(len(table.prepare) if steps is None else steps):
        found = _prepared(found, table, number)
    return found


def _prepared(surface: Surface, table: Any, number: int) -> Surface:
    try:
        return prepared(surface, table.prepare[number])
    except AsperityError as error:
        error.place = f"prepare.{number}"
        raise


def cutoffs(surface: Surface, steps: Sequence[Any]) -> dict[str, float]:
    """Cut-off wavelengths in m of the filters among ``steps``, by names; that of a tip is the one
    on this ``surface``."""
    found: dict[str, float] = {}
    names = {"short": "short", "short_y": "short, along y", "long": "long", "long_y": "long, along y"}
    for step in steps:
        given = step.given()
        if step.step == "filter":
            found |= {name: given[key] for key, name in names.items() if key in given}
        elif step.step == "tip_limit" and 0.0 < (reached := reliability_cutoff(surface, given["radius"])) < math.inf:
            found["tip"] = reached
    return found


def thinned(heights: Any, most: int | None = None) -> tuple[Any, int]:
    """Every so many-th of ``heights`` (nx, ny) along both sides, single precision with NaN for
    missing points, and how many that are."""
    line = heights.shape[1] == 1
    step = max(1, math.ceil(max(heights.shape) / (most or (MOST_OF_A_LINE if line else MOST_SHOWN))))
    return heights[::step, ::step].astype("<f4"), step


def kept(heights: Any, file: Path) -> None:
    """Write all ``heights`` (nx, ny) in m to ``file``, which is there whole or not at all."""
    with atomic_file(file, overwrite=True) as partial, partial.open("wb") as out:
        np.save(out, np.asarray(heights, dtype="<f8"))
