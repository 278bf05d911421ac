"""Numbers of a contact that have a derivative, with their partial derivatives at a solved state."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from ...contact.operators import Operator
from ...contact.problem import ContactProblem
from ...core import require
from ...core.arrays import BoolArray, RealArray
from ...core.errors import InputError
from .parameters import Parameter


class State(NamedTuple):
    """A contact of a ``problem`` on its set: ``pressure`` (Pa), ``deflection`` by it (m) and
    ``profile`` (m), arrays (nx, ny); the position ``offset`` (m); where the bodies touch without
    yielding (``free``) and where they yield (``capped``)."""

    problem: ContactProblem
    operator: Operator
    pressure: RealArray
    deflection: RealArray
    profile: RealArray
    offset: float
    free: BoolArray
    capped: BoolArray

    @property
    def open(self) -> BoolArray:
        """Where the bodies do not touch."""
        return ~(self.free | self.capped)

    @property
    def gap(self) -> RealArray:
        """offset + deflection - profile, (nx, ny) in m."""
        return np.asarray(self.offset + self.deflection - self.profile)


Direct: TypeAlias = Callable[[Sequence[Parameter]], Mapping[str, float]]
"""Derivatives to parameters, by name."""


@dataclass(frozen=True, eq=False)
class Slopes:
    """A number J of a contact and its partial derivatives.

    Attributes
    ----------
    value
        J.
    pressure
        To the pressure of each point (nx, ny), the deflection following it.
    offset
        To the position, per m.
    heights
        To each height (nx, ny) at given pressure and position, per m; None for zero.
    deflected
        To the deflection of each point (nx, ny) at given pressure, per m: what a change of the
        compliance alone does. None for zero.
    given_load
        Derivative to the sum of pressures at given load where that is known without a linear
        solve, J then being stationary on the set; else None.
    direct
        Derivatives to constants of the bodies at given pressures, beside those by the deflection;
        by name, zero for those left out. None for zero.
    """

    value: float
    pressure: RealArray
    offset: float = 0.0
    heights: RealArray | None = None
    deflected: RealArray | None = None
    given_load: float | None = None
    direct: Direct | None = None


class Output(Protocol):
    """A number of a contact with derivatives."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def unit(self) -> str:
        """Its SI unit."""

    @property
    def degree(self) -> float | None:
        """Its degree in load and moduli together, which Euler's relation needs."""

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""


@dataclass(frozen=True)
class Scalar:
    """One of the outputs that are asked for by their ``name``."""

    name: str
    unit: str
    degree: float | None

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        p, pixel = state.pressure, state.operator.grid.pixel_area
        none = np.zeros(p.shape)
        if self.name == "approach":
            top = none.copy()
            top.flat[int(np.argmax(state.profile))] = 1.0
            return Slopes(float(state.profile.max()) - state.offset, none, -1.0, heights=top)
        if self.name == "offset":
            return Slopes(state.offset, none, 1.0)
        if self.name == "force":
            return Slopes(float(p.sum()) * pixel, np.full(p.shape, pixel))
        if self.name == "mean_gap":
            share = state.open / p.size
            slope = state.operator.apply(share)
            value = float((state.gap * share).sum())
            return Slopes(value, slope, float(share.sum()), heights=-share, deflected=share)
        work = state.deflection * pixel
        if self.name == "elastic_energy":
            return Slopes(0.5 * float((p * work).sum()), work, deflected=0.5 * pixel * p)
        value = float((p * (0.5 * work - state.profile * pixel)).sum())
        slope = pixel * (state.deflection - state.profile)
        return Slopes(value, slope, heights=-pixel * p, deflected=0.5 * pixel * p, given_load=-state.offset * pixel)


OUTPUTS: Mapping[str, Output] = MappingProxyType(
    {
        each.name: each
        for each in (
            Scalar("approach", "m", 0.0),
            Scalar("offset", "m", 0.0),
            Scalar("force", "N", 1.0),
            Scalar("mean_gap", "m", 0.0),
            Scalar("elastic_energy", "J", 1.0),
            Scalar("complementary_energy", "J", 1.0),
        )
    }
)
"""Outputs by name."""


@dataclass(frozen=True)
class PressureNorm:
    """p-norm of the pressure over the nominal area A, (1/A ∫ p^m dA)^(1/m), in Pa: a peak pressure
    with a derivative.

    InputError if ``m`` is not at least 1.

    Parameters
    ----------
    m
        Exponent, >= 1; 8 to 32 for a peak. Its ratio to the largest pressure depends on the field:
        keep it fixed where norms are compared.
    """

    m: float = 16.0
    unit: str = "Pa"
    degree: float | None = 1.0

    def __post_init__(self) -> None:
        if require.finite(self.m, "exponent of a norm of the pressure") < 1.0:
            raise InputError(f"exponent of a norm of the pressure must be at least 1, but is {self.m:g}.")

    @property
    def name(self) -> str:
        """With the exponent."""
        return f"pressure_norm_{self.m:g}"

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        touching = state.pressure > 0.0
        p, slope = state.pressure[touching], np.zeros(state.pressure.shape)
        if not p.size:
            return Slopes(0.0, slope)
        largest = float(p.max())
        powers = (p / largest) ** (self.m - 1.0)
        mean = float((powers * p).sum()) / (largest * slope.size)
        slope[touching] = mean ** (1.0 / self.m - 1.0) / slope.size * powers
        return Slopes(largest * mean ** (1.0 / self.m), slope)


@dataclass(frozen=True)
class SmoothArea:
    """Smooth contact area ∫ p/(p + p_s) dA in m², which has a derivative where the count of pixels
    has none.

    InputError if the pressure is not positive.

    Parameters
    ----------
    pressure
        p_s in Pa, 1 to 3 % of the mean real pressure: the larger it is, the smoother and the more
        below the real area. It does not change with the parameters.
    """

    pressure: float
    unit: str = "m**2"
    degree: float | None = None

    def __post_init__(self) -> None:
        require.positive(self.pressure, "pressure of a smooth area (Pa)")

    @property
    def name(self) -> str:
        """What it is called."""
        return "smooth_area"

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        p, pixel = np.maximum(state.pressure, 0.0), state.operator.grid.pixel_area
        value = float((p / (p + self.pressure)).sum()) * pixel
        return Slopes(value, pixel * self.pressure / (p + self.pressure) ** 2)


@dataclass(frozen=True)
class EdgeArea:
    """Real contact area in m² whose derivative is that by the edge that moves, dA = ∮ 2 c/b ds:
    of pressures b √d and their rates c/√d on the fixed set at the distance d within the edge.

    Within the edge u = p² is linear in d, and the edge moves by 2 c/b = du/|∇u|. A smooth step of
    u, zero at the edge and one from p = ``pressure`` on, takes the place of a step at the edge; it
    leaves out what is linear in u. Of spheres 50 pixels in radius the area errs by 0.2 %, its
    derivatives by 4 to 6 % as the edge lies between pixels; near full contact they are 20 to 30 %
    too small, as p² bends within the edge of narrow openings. ``"area"`` of ``sensitivities`` takes
    their mean over several loads and corrects it by the areas there.

    InputError if the pressure is not positive.

    Parameters
    ----------
    pressure
        In Pa, about 3/4 of the mean real pressure. It does not change with the parameters.
    """

    pressure: float
    unit: str = "m**2"
    degree: float | None = None

    def __post_init__(self) -> None:
        require.positive(self.pressure, "pressure of an area by its edge (Pa)")

    @property
    def name(self) -> str:
        """What it is called."""
        return "edge_area"

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        step, pixel = edge_step(state.pressure, self.pressure), state.operator.grid.pixel_area
        return Slopes(float(step.value.sum()) * pixel, pixel * step.slope)


class EdgeStep(NamedTuple):
    """Smooth step at the edge of a contact, (nx, ny), and its ``slope`` to the pressure, 1/Pa."""

    value: RealArray
    slope: RealArray


def edge_step(pressure: RealArray, reach: float) -> EdgeStep:
    """Step of ``EdgeArea`` of a ``pressure`` (nx, ny), one from ``reach`` on, both in Pa.

    The integral of 60 t (1 - t)² (1 - 2 t), whose mean is one and whose first moment is zero, t =
    (p/reach)².
    """
    p = np.maximum(pressure, 0.0)
    t = np.minimum(p / reach, 1.0) ** 2
    step = t * t * (30.0 + t * (-80.0 + t * (75.0 - 24.0 * t)))
    return EdgeStep(step, 60.0 * t * (1.0 - t) ** 2 * (1.0 - 2.0 * t) * 2.0 * p / reach**2)


@dataclass(frozen=True)
class PressureAt:
    """Pressure at the point of the grid nearest to a place, in Pa, such as that in the middle of a
    sphere.

    Parameters
    ----------
    x, y
        The place, in m from the first point of the grid.
    """

    x: float
    y: float = 0.0
    unit: str = "Pa"
    degree: float | None = 1.0

    @property
    def name(self) -> str:
        """What it is called."""
        return "pressure_at"

    def at(self, state: State) -> Slopes:
        """Value and partial derivatives."""
        grid, place, slope = state.operator.grid, list[int](), np.zeros(state.pressure.shape)
        for at, many, spacing in zip((self.x, self.y), grid.shape, grid.spacing, strict=True):
            length = spacing * (many - 1)
            if not -0.5 * spacing <= require.finite(at, "place of a pressure (m)") <= length + 0.5 * spacing:
                raise InputError(f"place of a pressure (m) must be from 0 to {length:g} on this grid, but is {at:g}.")
            place.append(min(max(round(at / spacing), 0), many - 1))
        slope[place[0], place[1]] = 1.0
        return Slopes(float(state.pressure[place[0], place[1]]), slope)


SEVERAL = ("area", "stiffness", "electrical_conductance", "thermal_conductance")
"""Outputs that are found from several loads."""


def output(of: str | Output) -> Output:
    """The output that is asked for, with an InputError where it has no derivative."""
    if not isinstance(of, str):
        if not all(hasattr(of, each) for each in ("name", "unit", "degree", "at")):
            raise InputError(
                f"output of a sensitivity must be one of {', '.join((*OUTPUTS, *SEVERAL))}, or an output such as "
                f"PressureNorm(m), but is {of!r}."
            )
        return of
    if of not in OUTPUTS:
        hint = " It jumps from pixel to pixel: take area." if "area" in of else ""
        hint = hint or (" It has a kink wherever its place changes: take PressureNorm(16)." if "pressure" in of else "")
        raise InputError(
            f"output of a sensitivity must be one of {', '.join((*OUTPUTS, *SEVERAL))}, or an output such as "
            f"PressureNorm(m), but is {of!r}.{hint}"
        )
    return OUTPUTS[of]
