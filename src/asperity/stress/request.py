"""Which stresses inside a body are wanted, in SI; checked before the contact is solved."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, Protocol, TypeAlias

import numpy as np

from ..core import units
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.grid import Grid
from ..solids.elastic import Rigid
from .compute import Loaded, papers
from .criteria import Criterion, VonMises
from .mean_mode import require_held
from .regions import planes
from .tractions import Sliding, Tractions

Place: TypeAlias = float | Literal["max", "pressure"]
"""Position in m as in figures (in the middle of a pixel), of the largest stress, or of the highest pressure."""


class Contact(Loaded, Protocol):
    """What a survey needs of a contact result beside its pressure and problem."""

    @property
    def spot_areas(self) -> RealArray:
        """Areas of the contact spots in m², in any order."""

    @property
    def plastic(self) -> BoolArray:
        """(nx, ny), True where the pressure is at its limit."""


@dataclass(frozen=True)
class WantedSection:
    """Vertical plane at ``place`` of the ``axis`` "x" or "y"."""

    axis: Literal["x", "y"]
    place: Place


@dataclass(frozen=True)
class WantedProfile:
    """Line into the body at ``x`` and ``y``."""

    x: Place
    y: Place


@dataclass(frozen=True)
class Strengths:
    """Strengths in Pa with which the largest tension, shear and peel are compared; NaN where not given."""

    tensile: float = math.nan
    interface_shear: float = math.nan
    interface_peel: float = math.nan


@dataclass(frozen=True)
class StressRequest:
    """Stresses that are asked for, all values SI.

    Attributes
    ----------
    friction, direction, coupled
        Friction coefficient, angle in rad of the shear traction on the body, and whether it may change the pressure.
    of
        ``"body"`` or ``"counter_body"``.
    depths
        Depths in m of whole planes.
    sections, profiles
        Vertical planes and lines.
    deepest
        Depth in m at which those end; None for one that suits the contact.
    criterion, strengths
        What decides on yield, and strengths beside those of the materials.
    dtype
        Type of the numbers.
    """

    friction: float = 0.0
    direction: float = 0.0
    coupled: bool = False
    of: Literal["body", "counter_body"] = "body"
    depths: tuple[float, ...] = ()
    sections: tuple[WantedSection, ...] = (WantedSection("y", "max"),)
    profiles: tuple[WantedProfile, ...] = ()
    deepest: float | None = None
    criterion: Criterion = VonMises()
    strengths: Strengths = Strengths()
    dtype: str = "float64"

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers on what is done with the stresses: principal ones, those in sections, coupling, criterion."""
        drawn = ("Peng2001",) if self.sections else ()
        return ("Eberly2014", *drawn, *(("Dundurs1969",) if self.coupled else ()), *self.criterion.citation_keys)

    def check(self, problem: Any) -> None:
        """Refuse what ``problem`` has no stress for, before it is solved.

        Raises
        ------
        InputError
            If the body does not deform, a depth lies below its rigid base, a position outside the grid, or nothing would
            hold sheared layers (see ``require_held``).
        """
        body, grid = getattr(problem, self.of), problem.grid
        if isinstance(body, Rigid):
            asked = self.of.replace("_", " ")
            raise InputError(
                f"stresses are asked for inside the {asked}, which is rigid; ask for them in the other body."
            )
        planes(body, self.depths or (0.0,))
        boundary: Any = problem.boundary.name
        require_held(Tractions(grid, np.ones(grid.shape), Sliding(self.friction), boundary), body)
        for section in self.sections:
            _require_within(section.place, section.axis, "section", grid)
            if grid.shape["yx".index(section.axis)] == 1:
                raise InputError(
                    f"stress section must hold more than one point, but that at {section.axis} = const is one point wide "
                    f"on this surface of {grid.shape[0]} x {grid.shape[1]} points."
                )
        for line in self.profiles:
            _require_within(line.x, "x", "profile", grid)
            _require_within(line.y, "y", "profile", grid)


@dataclass(frozen=True)
class Planned:
    """Stresses asked for in a ``problem``, before it is solved; for ``cite``."""

    request: StressRequest
    problem: Any

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Keys of the papers that the stresses will rest on."""
        body = getattr(self.problem, self.request.of)
        sheared = self.request.friction != 0.0
        return (*papers(body, self.problem.boundary.name, sheared=sheared), *self.request.citation_keys)


def _require_within(place: Place, axis: str, kind: str, grid: Grid) -> None:
    size = grid.size["xy".index(axis)]
    if isinstance(place, float) and place > size:
        raise InputError(
            f"{axis} of a stress {kind} must be at most the length {units.show(size, 'm')} of the surface, "
            f"but is {units.show(place, 'm')}."
        )
