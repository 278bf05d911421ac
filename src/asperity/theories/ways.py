"""How theories are asked: along which argument, with what given, and what comes out. For people and the command line.

The theories of rough surfaces and of single contacts share a few ways (``ways_of``); a theory that is asked in another way
names it in its attribute ``ways``, and numbers that depend on nothing but its inputs in ``numbers``.
"""

from __future__ import annotations

from dataclasses import dataclass
from operator import attrgetter

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import RealArray
from ..core.errors import InputError
from .protocol import QUANTITIES, Described, Input, Limit, curve


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

    axis: Input
    method: str
    columns: tuple[Column, ...]
    given: tuple[Input, ...] = ()
    checked: bool = True


def asked(name: str, unit: str, meaning: str, default: float | None = None) -> Input:
    """An argument of a way."""
    return Input(name, unit, meaning, of="choice", default=default)


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
    """What ``theory`` tells that depends on nothing but its inputs."""
    columns: tuple[Column, ...] = getattr(theory, "numbers", ())
    return columns


@dataclass(frozen=True, eq=False)
class Evaluation:
    """What a theory says along one of its ways.

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
    values = curve(arguments[way.axis.name], f"{way.axis.meaning} ({way.axis.unit or 'number'})")
    given = {item.name: _one(item, arguments.get(item.name, item.default)) for item in way.given}
    answer = getattr(theory, way.method)(**{way.axis.name: values}, **given)
    columns = [(Column(way.axis.name, way.axis.unit, way.axis.meaning), values)]
    for column in way.columns:
        found = np.broadcast_to(np.asarray(attrgetter(column.name)(answer), dtype=float), values.shape)
        if column.name != way.axis.name and not np.isnan(found).all():
            columns.append((column, found))
    limits = theory.validity(answer) if way.checked and hasattr(theory, "validity") else ()
    return Evaluation(theory, numbers, tuple(columns), tuple(limits))


def _one(item: Input, value: ArrayLike) -> float:
    numbers = curve(value, f"{item.meaning} ({item.unit or 'number'})")
    if numbers.size != 1:
        raise InputError(f"{item.name} must be one number beside the range, but has {numbers.size}.")
    return float(numbers[0])


def _way(theory: Described, names: set[str]) -> Way:
    for way in ways_of(theory):
        needed = {way.axis.name} | {item.name for item in way.given if item.default is None}
        if needed <= names <= needed | {item.name for item in way.given}:
            return way
    raise InputError(f"{theory.name} must be asked {_choice(theory)}, but is asked by {', '.join(sorted(names))}.")


def _choice(theory: Described) -> str:
    """In words, the arguments by which ``theory`` can be asked."""
    texts = [
        " with ".join([way.axis.name, *(item.name for item in way.given if item.default is None)])
        for way in ways_of(theory)
    ]
    return "by " + ", or by ".join(texts) if texts else "nothing: it has numbers alone"
