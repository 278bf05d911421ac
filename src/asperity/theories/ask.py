"""Evaluation of theories for one kind of argument: load, pressure, approach or others, at one value or along a curve."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from operator import attrgetter
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from ..core.errors import InputError
from ..core.parameters import REQUIRED, Parameter
from ..core.tensor import Displacement, StressTensor, second_invariant
from ..core.units import DIMENSIONS
from ..core.values import Number
from .protocol import QUANTITIES, Described, Limit, curve

# How theories are asked: along which argument, with what given, and what comes out. For people and the command line.
#
# The theories of rough surfaces and of single contacts share a few ways (``ways_of``); a theory that is asked in
# another way names it in its attribute ``ways``, and numbers that depend on nothing but its inputs in ``numbers``.


@dataclass(frozen=True)
class Column:
    """One number that comes out: ``name`` an attribute of the answer, with dots for an attribute of it; SI ``unit``."""

    name: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Way:
    """One way to ask a theory.

    Parameters
    ----------
    axis
        The argument that takes a number or a range.
    method
        Method of the theory; its arguments are called like ``axis`` and ``given``.
    columns
        What the answer holds.
    given
        Further arguments, one number each.
    checked
        Whether the validity of the theory is checked on the answer.
    """

    axis: Parameter
    method: str
    columns: tuple[Column, ...]
    given: tuple[Parameter, ...] = ()
    checked: bool = True


_KINDS = {
    unit.replace("**", "^"): kind for kind, unit in DIMENSIONS.items() if kind not in ("number", "surface tension")
}


def asked(name: str, unit: str, meaning: str, default: float = REQUIRED) -> Parameter:
    """An argument of a way."""
    return Parameter(name, float, Number(_KINDS.get(unit, unit)), default, meaning, of="choice")


ROUGH = tuple(Column(*quantity) for quantity in QUANTITIES)
"""What theories of rough surfaces answer."""

PRESSURE = asked("pressure", "Pa", "nominal pressure")
SEPARATION = asked("separation", "m", "distance of the rigid plane from the mean plane of the surface")

POINT = (
    Column("load", "N", "normal force"),
    Column("approach", "m", "displacement of distant points toward each other"),
    Column("radius", "m", "contact radius"),
    Column("area", "m^2", "contact area"),
    Column("max_pressure", "Pa", "largest pressure"),
    Column("mean_pressure", "Pa", "load over area"),
    Column("stiffness", "N/m", "derivative of the load by the approach"),
)
"""What theories of one contact answer."""

LINE = (
    Column("load", "N/m", "normal force per length"),
    Column("approach", "m", "displacement of distant points toward each other"),
    Column("radius", "m", "half-width of the contact"),
    Column("area", "m", "width of the contact"),
    Column("max_pressure", "Pa", "largest pressure"),
    Column("mean_pressure", "Pa", "load over width"),
    Column("stiffness", "N/m^2", "derivative of the load per length by the approach"),
)
"""The same in plane strain."""

LINE_LOAD = Way(asked("load", "N/m", "normal force per length"), "at_load", LINE)

COMMON: tuple[Way, ...] = (
    Way(PRESSURE, "at_pressure", ROUGH),
    Way(SEPARATION, "at_separation", ROUGH),
    Way(asked("load", "N", "normal force"), "at_load", POINT),
    Way(asked("approach", "m", "displacement of distant points toward each other"), "at_approach", POINT),
    Way(asked("interference", "m", "displacement of distant points toward each other"), "at_interference", POINT),
    Way(asked("contact_radius", "m", "contact radius"), "at_radius", POINT),
)
"""Ways of every theory that has the method."""


def ways_of(theory: Described | type[Described]) -> tuple[Way, ...]:
    """The ways to ask ``theory``, the usual one first; empty if it has numbers alone."""
    own: tuple[Way, ...] | None = getattr(theory, "ways", None)
    return tuple(way for way in COMMON if hasattr(theory, way.method)) if own is None else own


def numbers_of(theory: Described | type[Described]) -> tuple[Column, ...]:
    """Results of ``theory`` that depend on its parameters alone."""
    columns: tuple[Column, ...] = getattr(theory, "numbers", ())
    return columns


@dataclass(frozen=True, eq=False)
class Evaluation:
    """Results of a theory for one kind of argument.

    Parameters
    ----------
    theory
        The theory.
    numbers
        What depends on its inputs alone, each with its value.
    columns
        The axis and everything that the theory defines along it, each (n,); empty if nothing was asked.
    limits
        Conditions for validity, their values (n,).
    """

    theory: Described
    numbers: tuple[tuple[Column, float], ...]
    columns: tuple[tuple[Column, RealArray], ...] = ()
    limits: tuple[Limit, ...] = ()


def evaluate(theory: Described, **arguments: ArrayLike) -> Evaluation:
    """Ask ``theory`` along one of its ways, in SI: ``evaluate(HertzPoint(1e11, 1e-6), load=[1e-6, 1e-5])``.

    Without arguments the answer holds the numbers that depend on the inputs alone.

    Raises
    ------
    InputError
        If the arguments are those of no way of the theory, or the theory refuses their values.

    Examples
    --------
    >>> from asperity.theories import HertzPoint
    >>> answer = evaluate(HertzPoint(E_star=115e9, radius=5e-3), load=[10.0])
    >>> [(column.name, f"{values[0]:.3g}", column.unit) for column, values in answer.columns][:3]
    [('load', '10', 'N'), ('approach', '9.48e-07', 'm'), ('radius', '6.88e-05', 'm')]
    """
    numbers = tuple((column, float(attrgetter(column.name)(theory))) for column in numbers_of(theory))
    if not arguments:
        if not numbers:
            raise InputError(f"{theory.name} must be asked {_choice(theory)}, but nothing is given.")
        return Evaluation(theory, numbers)
    way = _way(theory, set(arguments))
    values = curve(arguments[way.axis.name], f"{way.axis.help} ({way.axis.unit or 'number'})")
    given = {item.name: _one(item, arguments.get(item.name, item.default)) for item in way.given}
    answer = getattr(theory, way.method)(**{way.axis.name: values}, **given)
    columns = [(Column(way.axis.name, way.axis.unit, way.axis.help), values)]
    for column in way.columns:
        found = np.broadcast_to(np.asarray(attrgetter(column.name)(answer), dtype=float), values.shape)
        if column.name != way.axis.name and not np.isnan(found).all():
            columns.append((column, found))
    limits = theory.validity(answer) if way.checked and hasattr(theory, "validity") else ()
    return Evaluation(theory, numbers, tuple(columns), tuple(limits))


def _one(item: Parameter, value: ArrayLike) -> float:
    numbers = curve(value, f"{item.help} ({item.unit or 'number'})")
    if numbers.size != 1:
        raise InputError(f"{item.name} must be one number beside the range, but has {numbers.size}.")
    return float(numbers[0])


def _way(theory: Described, names: set[str]) -> Way:
    for way in ways_of(theory):
        needed = {way.axis.name} | {item.name for item in way.given if item.required}
        if needed <= names <= needed | {item.name for item in way.given}:
            return way
    raise InputError(f"{theory.name} must be asked {_choice(theory)}, but is asked by {', '.join(sorted(names))}.")


def _choice(theory: Described) -> str:
    """In words, the arguments by which ``theory`` can be asked."""
    texts = [
        " with ".join([way.axis.name, *(item.name for item in way.given if item.required)]) for way in ways_of(theory)
    ]
    return "by " + ", or by ".join(texts) if texts else "nothing: it has numbers alone"


# The separation at which a theory carries a given pressure.


PressureAndStiffness: TypeAlias = Callable[[RealArray], tuple[RealArray, RealArray]]
"""Pressure p and -dp/dh at separations h, all (n,)."""

_TABLE = 65  # separations at which the pressure is tabulated for a start
_STEPS = 60  # bisections alone would find a double in these
_SQUARED = 1e-8  # a Newton step so small leaves its square, which is rounding
_ROUNDING = 4e-15


def separation_at(pressure: RealArray, law: PressureAndStiffness, low: float, high: float, *, unit: float) -> RealArray:
    """Separations (n,) in m at which a falling ``law`` has the given ``pressure`` (n,) in Pa.

    Newton steps on ln p, which is nearly straight or parabolic for most theories, kept within brackets from a table.

    Parameters
    ----------
    pressure
        (n,) in Pa, positive.
    law
        Pressure and stiffness at given separations; the pressure must not rise with the separation.
    low, high
        Separations in m between which the answer is sought.
    unit
        Length in m on which the pressure changes; sets the accuracy.

    Raises
    ------
    InputError
        If a pressure lies beyond those at ``low`` and ``high``.
    """
    table = np.linspace(low, high, _TABLE)
    logs = _log(law(table)[0])
    wanted = np.log(pressure)
    if wanted.max() > logs[0] or wanted.min() < logs[-1]:
        raise InputError(
            f"pressures must lie between {np.exp(logs[-1]):.4g} and {np.exp(logs[0]):.4g} Pa, where this theory is "
            f"evaluated, but go from {pressure.min():.4g} to {pressure.max():.4g} Pa."
        )
    cell = np.clip(np.searchsorted(-logs, -wanted) - 1, 0, _TABLE - 2)
    below, above = table[cell], table[cell + 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (logs[cell] - wanted) / (logs[cell] - logs[cell + 1])
    h = below + np.where(np.isfinite(share), share, 0.5) * (above - below)
    for _ in range(_STEPS):
        p, stiffness = law(h)
        excess = _log(p) - wanted
        below, above = np.where(excess >= 0.0, h, below), np.where(excess <= 0.0, h, above)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = h + excess * p / stiffness
        inside = (step >= below) & (step <= above)
        new = np.where(inside, step, 0.5 * (below + above))
        change, h = np.abs(new - h), new
        if np.all((inside & (change <= _SQUARED * unit)) | (change <= _ROUNDING * (unit + np.abs(h)))):
            break
    return h


def _log(values: RealArray) -> RealArray:
    with np.errstate(divide="ignore"):
        logs: RealArray = np.log(values)
    return logs


# Fields in a half-space as answers of theories: displacement and stress at points, and the stress of von Mises.


STRESS = (
    *(
        Column(f"stress.{name}", "Pa", f"stress σ{name}, tension positive")
        for name in ("xx", "yy", "zz", "xy", "xz", "yz")
    ),
    Column("von_mises", "Pa", "stress of von Mises"),
)
"""Stresses at a point."""

FIELDS = (*(Column(f"displacement.{name}", "m", f"displacement along {name}") for name in "xyz"), *STRESS)
"""Displacements and stresses at a point."""

DEPTH = asked("depth", "m", "depth below the surface")
ALONG_X = asked("x", "m", "place along x", 0.0)
ALONG_Y = asked("y", "m", "place along y", 0.0)


@dataclass(frozen=True, eq=False)
class StressAnswer:
    """``stress`` at points."""

    stress: StressTensor

    @property
    def von_mises(self) -> RealArray:
        """Stress of von Mises sqrt(3 J2) in Pa."""
        return np.asarray(np.sqrt(3.0 * second_invariant(self.stress)))


@dataclass(frozen=True, eq=False)
class FieldAnswer(StressAnswer):
    """``stress`` and ``displacement`` at points."""

    displacement: Displacement
