"""Creep-force curves: the forces of rolling over a range of creepages, with the theories of smooth
wheels beside them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ...contact.boundary import FreeLine, Periodic
from ...contact.controls import Control
from ...contact.problem import ContactProblem
from ...core import require
from ...core.arrays import RealArray
from ...core.errors import InputError
from ...core.quantity import Quantity
from ...core.status import NoProgress, Progress
from ...solids.elastic import Elastic
from ...surfaces.surface import Surface
from ...theories.friction.kalker import LARGEST_RATIO, SMALLEST_RATIO
from ...theories.friction.rolling import CreepForces, Fastsim, KalkerLinear
from ..friction.law import Coulomb
from .rolling import DIRECTIONS, Creepage, Rolling, RollingContact, roll
from .rough import RoughRolling, roll_rough

if TYPE_CHECKING:
    import xarray

CREEPAGES = (
    Quantity("longitudinal", "1", "longitudinal creepage"),
    Quantity("lateral", "1", "lateral creepage"),
    Quantity("spin", "rad/m", "spin"),
)
"""What is prescribed at each point of a curve."""

FORCES = (
    Quantity("longitudinal_force", "N", "force on the body along the rolling direction"),
    Quantity("lateral_force", "N", "force on the body across the rolling direction"),
    Quantity("torque", "N*m", "torque on the body about the centre"),
    Quantity("slip_area_fraction", "1", "area that slips / area in contact (pixels)"),
    Quantity("dissipated", "J/m", "heat per distance rolled"),
    Quantity("deviation", "N", "standard deviation of the longitudinal force over the distance"),
)
"""What a curve holds of each point."""

THEORIES = {"fastsim": "FASTSIM (Kalker 1982)", "linear": "linear theory (Kalker 1967)", "carter": "Carter (1926)"}
"""Theories of smooth wheels of equal bodies, by name."""

_SOURCES = {"fastsim": "Kalker1982", "linear": "Kalker1967", "carter": "Carter1926"}

_ELLIPSE = 0.05
"""Deviation of the area in contact from that of the ellipse of the pressure's moments up to which
the contact counts as one."""


@dataclass(frozen=True, eq=False)
class CreepCurve:
    """Forces over creepages: arrays (n,), SI.

    Attributes
    ----------
    longitudinal, lateral, spin
        Creepages, and spin in rad/m.
    longitudinal_force, lateral_force, torque
        Forces on the body along and across the rolling direction (N) and torque about the centre
        (N·m); means over the distance for rough wheels.
    slip_area_fraction
        Share of the contact that slips.
    dissipated
        Heat per distance rolled, J/m.
    deviation
        Standard deviation of the longitudinal force of rough wheels over the distance, N; zero for
        smooth ones.
    first
        The contact of the first point; of a rough wheel after its last move.
    rough
        Whether the wheel is rough.
    """

    longitudinal: RealArray
    lateral: RealArray
    spin: RealArray
    longitudinal_force: RealArray
    lateral_force: RealArray
    torque: RealArray
    slip_area_fraction: RealArray
    dissipated: RealArray
    deviation: RealArray
    first: RollingContact
    rough: bool

    def __len__(self) -> int:
        """Number of points."""
        return int(self.longitudinal.size)

    @property
    def friction_limit(self) -> float:
        """Largest tangential force that the contact of the first point bears, N."""
        return self.first.friction_limit

    @property
    def theories(self) -> tuple[str, ...]:
        """Names of the theories that know this contact, if any."""
        return () if self.rough else theories_of(self.first, plain=not (self.lateral.any() or self.spin.any()))

    def theory(self, name: str) -> CreepForces:
        """Forces of the theory ``name`` at these creepages, along and across the rolling direction;
        InputError for one that does not know the contact."""
        require.one_of(name, self.theories, "theory of a creep-force curve")
        return theory_forces(name, self.first, (self.longitudinal, self.lateral, self.spin))

    @property
    def citation_keys(self) -> tuple[str, ...]:
        """Papers of the method, the contact and the theories beside it."""
        return tuple(sorted({*self.first.citation_keys, *(_SOURCES[name] for name in self.theories)}))

    def to_xarray(self) -> xarray.Dataset:
        """Creepages and forces over the number of the point, with units and long names, and the
        forces of the theories."""
        import xarray

        values = {item.name: ("point", getattr(self, item.name), item.attributes) for item in (*CREEPAGES, *FORCES)}
        for name in self.theories:
            found = self.theory(name)
            for item, force in zip(FORCES[:2], (found.force_x, found.force_y), strict=True):
                label = {"units": item.unit, "long_name": f"{item.label}, {THEORIES[name]}"}
                values[f"{name}_{item.name}"] = ("point", force, label)
        return xarray.Dataset(values, attrs={"friction_limit": self.friction_limit})


def creep_curve(
    problem: ContactProblem,
    control: Control,
    longitudinal: ArrayLike = 0.0,
    *,
    lateral: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
    roughness: Surface | None = None,
    distance: float | None = None,
    direction: Rolling = "x",
    tolerance: float = 1e-4,
    progress: Progress | None = None,
) -> CreepCurve:
    """Forces of steady rolling over creepages, each point started from the one before.

    Parameters
    ----------
    problem, control
        As for ``roll``.
    longitudinal, lateral, spin
        Creepages, and spin in rad/m: numbers, and arrays (n,) of one length.
    roughness, distance
        Roughness of the wheel, and the distance (m) rolled at each point, as for ``roll_rough``,
        whose means are the curve.
    direction, tolerance
        As for ``roll``.
    progress
        Receives the share of the points that are left.

    Raises
    ------
    InputError
        If the problem cannot roll, or the arrays are of different lengths or not finite.
    ConvergenceError
        If a point is not solved.
    """
    creepages = (np.atleast_1d(np.asarray(part, dtype=float)) for part in (longitudinal, lateral, spin))
    try:
        at = tuple(np.array(part) for part in np.broadcast_arrays(*creepages))
    except ValueError:
        raise InputError(
            "longitudinal, lateral and spin must be numbers and arrays of one length, but are not."
        ) from None
    if at[0].ndim != 1 or not at[0].size:
        raise InputError(f"longitudinal creepage must be a number or an array (n,), but has the shape {at[0].shape}.")
    progress = progress or NoProgress()
    rows: list[tuple[float, ...]] = []
    first: RollingContact | None = None
    before: RollingContact | None = None
    for number, (x, y, phi) in enumerate(zip(*at, strict=True), start=1):
        creepage = Creepage(float(x), float(y), float(phi))
        if roughness is None:
            before = roll(problem, control, creepage, direction=direction, tolerance=tolerance, start=before)
            rows.append(mean_forces(before, None))
        else:
            options: Any = {"distance": distance, "direction": direction, "tolerance": tolerance}
            rough = roll_rough(problem, control, creepage, roughness, **options)
            before = rough.last
            rows.append(mean_forces(before, rough))
        first = first or before
        progress.update(number, 1.0 - number / len(at[0]), 0.0)
    assert first is not None
    points = {item.name: part for item, part in zip(CREEPAGES, at, strict=True)}
    columns = {item.name: column for item, column in zip(FORCES, np.array(rows).T, strict=True)}
    return CreepCurve(**points, **columns, first=first, rough=roughness is not None)


def mean_forces(found: RollingContact, rough: RoughRolling | None) -> tuple[float, ...]:
    """``FORCES`` of the contact ``found``: its own, or means over the distance of the ``rough``
    wheel of which it is the last."""
    if rough is None:
        forces = (found.longitudinal_force, found.lateral_force, found.torque)
        return (*forces, found.slip_area_fraction, found.dissipated, 0.0)
    axis = DIRECTIONS[found.direction]
    x, y = rough.mean("force_x"), rough.mean("force_y")
    along, across = (x, y) if axis.axis == 0 else (y, -x)
    deviation = rough.deviation("force_x" if axis.axis == 0 else "force_y")
    others = (rough.mean(name) for name in ("torque", "slip_area_fraction", "dissipated"))
    return (axis.sign * along, axis.sign * across, *others, deviation)


# Theories of smooth wheels beside it.


def semi_axes(found: RollingContact) -> tuple[float, float]:
    """Half-axes (m) of the contact along and across the rolling direction, from the moments of the
    pressure as of Hertz's; NaN across a line."""
    pressure, grid, axis = found.normal.pressure, found.normal.problem.grid, DIRECTIONS[found.direction].axis
    share = 5.0 if min(grid.shape) > 1 else 4.0
    axes = []
    for along in (axis, 1 - axis):
        weight = pressure.sum(axis=1 - along)
        place = np.arange(len(weight)) * grid.spacing[along]
        mean = float(weight @ place / weight.sum())
        axes.append(math.sqrt(share * float(weight @ (place - mean) ** 2 / weight.sum())) or math.nan)
    return axes[0], axes[1]


def theories_of(found: RollingContact, *, plain: bool) -> tuple[str, ...]:
    """Names of the theories that know the contact ``found``: equal, homogeneous bodies under one
    coefficient of friction on an ellipse, or on a line under ``plain`` longitudinal creepage."""
    problem, law = found.normal.problem, found.law
    pair = [body for body in (problem.body, problem.counter_body) if isinstance(body, Elastic)]
    equal = len({(body.youngs_modulus, body.poisson_ratio) for body in pair}) == 1 and len(pair) == 2
    coulomb = isinstance(law, Coulomb) and not np.ndim(law.coefficient) and math.isinf(law.limit)
    if not equal or not coulomb or not found.normal.contact.any() or isinstance(problem.boundary, Periodic):
        return ()
    if isinstance(problem.boundary, FreeLine):
        return ("carter",) if plain else ()
    a, b = semi_axes(found)
    area = np.count_nonzero(found.normal.contact) * problem.grid.pixel_area
    ellipse = abs(area / (math.pi * a * b) - 1.0) <= _ELLIPSE and SMALLEST_RATIO <= a / b <= LARGEST_RATIO
    return ("fastsim", "linear") if ellipse and 0.0 <= pair[0].poisson_ratio <= 0.5 else ()


def theory_forces(name: str, found: RollingContact, at: tuple[RealArray, RealArray, RealArray]) -> CreepForces:
    """Forces of the theory ``name`` for the contact ``found`` at longitudinal and lateral creepages
    and spin (rad/m)."""
    problem, law, (a, b) = found.normal.problem, found.law, semi_axes(found)
    assert isinstance(problem.body, Elastic)
    assert isinstance(law, Coulomb)
    mu, load = float(law.coefficient), float(found.normal.force)
    shear, nu = problem.body.shear_modulus, problem.body.poisson_ratio
    if name == "fastsim":
        return Fastsim(a, b, shear, nu, load, mu).at_creepage(*at)
    if name == "linear":
        return KalkerLinear(a, b, shear, nu).at_creepage(*at)
    # Carter: Q = μP [1 - (1 - ξ/ξ_s)²], all slips from ξ_s = μa/R on; P = π E* a²/4R per length
    curvature = 4.0 * load / (math.pi * problem.contact_modulus * a**2 * problem.grid.spacing[1])
    share = np.minimum(np.abs(at[0]) / (mu * a * curvature), 1.0)
    force = np.sign(at[0]) * mu * load * (1.0 - (1.0 - share) ** 2)
    return CreepForces(force, np.zeros_like(force), np.zeros_like(force))
