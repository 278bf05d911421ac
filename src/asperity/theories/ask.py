"""Evaluation of theories for one kind of argument: load, pressure, approach or others, at one value
or along a curve."""

from __future__ import annotations

from dataclasses import dataclass
from operator import attrgetter

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import BoolArray, RealArray
from ..core.errors import InputError
from ..core.late import Tabled
from ..core.parameters import REQUIRED, Parameter
from ..core.quantity import Quantity
from ..core.tensor import Displacement, StressTensor, second_invariant
from ..core.units import DIMENSIONS
from ..core.values import Number
from .protocol import QUANTITIES, Described, Limit, checked, curve

# How theories are asked: along which argument, with what given, and what comes out. For people and
# the command line.
#
# The theories of rough surfaces and of single contacts share a few ways (``ways_of``); a theory
# that is asked in another way names it in its attribute ``ways``, and numbers that depend on
# nothing but its inputs in ``numbers``.


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
    columns: tuple[Quantity, ...]
    given: tuple[Parameter, ...] = ()
    checked: bool = True


_KINDS = {
    unit.replace("**", "^"): kind
    for kind, unit in DIMENSIONS.items()
    if kind not in ("number", "surface tension", "hardness")
}


def asked(name: str, unit: str, meaning: str, default: float = REQUIRED) -> Parameter:
    """An argument of a way."""
    return Parameter(name, float, Number(_KINDS.get(unit, unit)), default, meaning, of="choice")


PRESSURE = asked("pressure", "Pa", "nominal pressure")
SEPARATION = asked("separation", "m", "distance of the rigid plane from the mean plane of the surface")

POINT = (
    Quantity("load", "N", "normal force"),
    Quantity("approach", "m", "displacement of distant points toward each other"),
    Quantity("radius", "m", "contact radius"),
    Quantity("area", "m^2", "contact area"),
    Quantity("max_pressure", "Pa", "largest pressure"),
    Quantity("mean_pressure", "Pa", "load over area"),
    Quantity("stiffness", "N/m", "derivative of the load by the approach"),
)
"""What theories of one contact answer."""

LINE = (
    Quantity("load", "N/m", "normal force per length"),
    Quantity("approach", "m", "displacement of distant points toward each other"),
    Quantity("radius", "m", "half-width of the contact"),
    Quantity("area", "m", "width of the contact"),
    Quantity("max_pressure", "Pa", "largest pressure"),
    Quantity("mean_pressure", "Pa", "load over width"),
    Quantity("stiffness", "N/m^2", "derivative of the load per length by the approach"),
)
"""The same in plane strain."""

LINE_LOAD = Way(asked("load", "N/m", "normal force per length"), "at_load", LINE)

CONTACT_RADIUS = asked("contact_radius", "m", "contact radius")

BY_RADIUS = Way(CONTACT_RADIUS, "at_radius", (POINT[0], POINT[1], POINT[3]))
"""Contacts whose pressure is infinitely tensile at the edge."""

BY_CONTACT = (
    Way(asked("load", "N", "normal force"), "at_load", POINT),
    Way(asked("approach", "m", "displacement of distant points toward each other"), "at_approach", POINT),
    Way(CONTACT_RADIUS, "at_radius", POINT),
)
"""Ways to ask for one contact."""

COMMON: tuple[Way, ...] = (
    Way(PRESSURE, "at_pressure", QUANTITIES),
    Way(SEPARATION, "at_separation", QUANTITIES),
    *BY_CONTACT[:2],
    Way(asked("interference", "m", "displacement of distant points toward each other"), "at_interference", POINT),
    BY_CONTACT[2],
)
"""Ways of every theory that has the method."""


def ways_of(theory: Described | type[Described]) -> tuple[Way, ...]:
    """The ways to ask ``theory``, the usual one first; empty if it has numbers alone."""
    own: tuple[Way, ...] | None = getattr(theory, "ways", None)
    return tuple(way for way in COMMON if hasattr(theory, way.method)) if own is None else own


@dataclass(frozen=True, eq=False, repr=False)
class Evaluation(Tabled):
    """Results of a theory for one kind of argument.

    Parameters
    ----------
    theory
        The theory.
    numbers
        What depends on its inputs alone, each with its value.
    columns
        The axis and everything that the theory defines along it, each (n,); empty if nothing was
        asked.
    limits
        Conditions for validity, their values (n,).
    """

    theory: Described
    numbers: tuple[tuple[Quantity, float], ...]
    columns: tuple[tuple[Quantity, RealArray], ...] = ()
    limits: tuple[Limit, ...] = ()

    def holds(self, quantity: str = "") -> BoolArray:
        """(n,) whether all limits hold that concern the column ``quantity``; without a name those
        that concern every one."""
        inside = np.ones(self.columns[0][1].shape, dtype=bool)
        for limit in self.limits:
            if limit.concerns(quantity):
                inside &= limit.holds
        return inside


def evaluate(theory: Described, **arguments: ArrayLike) -> Evaluation:
    """Ask ``theory`` along one of its ways, in SI:
    ``evaluate(HertzPoint(1e11, 1e-6), load=[1e-6, 1e-5])``.

    Without arguments the answer holds the numbers that depend on the inputs alone.

    InputError if the arguments are those of no way of the theory, or the theory refuses their
    values.

    Examples
    --------
    >>> from asperity.theories import HertzPoint
    >>> answer = evaluate(HertzPoint(E_star=115e9, radius=5e-3), load=[10.0])
    >>> [(column.name, f"{values[0]:.3g}", column.unit) for column, values in answer.columns][:3]
    [('load', '10', 'N'), ('approach', '9.48e-07', 'm'), ('radius', '6.88e-05', 'm')]
    """
    numbers = tuple((column, float(attrgetter(column.name)(theory))) for column in theory.numbers)
    ways, names = ways_of(theory), set(arguments)
    texts = [" with ".join([way.axis.name, *(item.name for item in way.given if item.required)]) for way in ways]
    choice = "by " + ", or by ".join(texts) if texts else "nothing: it has numbers alone"
    if not arguments:
        if not numbers:
            raise InputError(f"{theory.name} must be asked {choice}, but nothing is given.")
        return Evaluation(theory, numbers)
    for way in ways:
        needed = {way.axis.name} | {item.name for item in way.given if item.required}
        if needed <= names <= needed | {item.name for item in way.given}:
            break
    else:
        raise InputError(f"{theory.name} must be asked {choice}, but is asked by {', '.join(sorted(names))}.")
    values = curve(arguments[way.axis.name], f"{way.axis.help} ({way.axis.unit or 'number'})")
    given = {}
    for item in way.given:
        beside = curve(arguments.get(item.name, item.default), f"{item.help} ({item.unit or 'number'})")
        if beside.size != 1:
            raise InputError(f"{item.name} must be one number beside the range, but has {beside.size}.")
        given[item.name] = float(beside[0])
    answer = getattr(theory, way.method)(**{way.axis.name: values}, **given)
    columns = [(Quantity(way.axis.name, way.axis.unit or "1", way.axis.help), values)]
    for column in way.columns:
        found = np.broadcast_to(np.asarray(attrgetter(column.name)(answer), dtype=float), values.shape)
        if column.name != way.axis.name and not np.isnan(found).all():
            columns.append((column, found))
    limits = theory.validity(answer) if way.checked else ()
    return Evaluation(theory, numbers, tuple(columns), limits)


# Fields in a half-space as answers of theories: displacement and stress at points, and the stress
# of von Mises.


STRESS = (
    *(
        Quantity(f"stress.{name}", "Pa", f"stress σ{name}, tension positive")
        for name in ("xx", "yy", "zz", "xy", "xz", "yz")
    ),
    Quantity("von_mises", "Pa", "stress of von Mises"),
)
"""Stresses at a point."""

FIELDS = (*(Quantity(f"displacement.{name}", "m", f"displacement along {name}") for name in "xyz"), *STRESS)
"""Displacements and stresses at a point."""

DEPTH = asked("depth", "m", "depth below the surface")
ALONG_X = asked("x", "m", "place along x", 0.0)
ALONG_Y = asked("y", "m", "place along y", 0.0)


def places(depth: ArrayLike, *beside: float) -> tuple[RealArray, ...]:
    """Coordinates ``beside`` the origin and ``depth`` >= 0 in m as arrays of one shape; InputError
    for other things."""
    z = checked(depth, "depth (m)")
    return (*(0.0 * z + require.finite(value, "place (m)") for value in beside), z)


@dataclass(frozen=True, eq=False, repr=False)
class StressAnswer(Tabled):
    """``stress`` at points."""

    stress: StressTensor

    @property
    def von_mises(self) -> RealArray:
        """Stress of von Mises sqrt(3 J2) in Pa."""
        return np.asarray(np.sqrt(3.0 * second_invariant(self.stress)))


@dataclass(frozen=True, eq=False, repr=False)
class FieldAnswer(StressAnswer):
    """``stress`` and ``displacement`` at points."""

    displacement: Displacement
