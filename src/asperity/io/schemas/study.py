"""The study document: a base problem, what is varied in it, and what is asked of the answers."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings
from ...core.values import Count, Fraction, NonEmpty, Positive, Seed, Whole
from .axis_values import LimitTable, Values
from .calibration import CalibrationTable
from .design import DesignTable

DEFAULT_QUANTITIES = ("area_fraction_corrected", "max_pressure", "approach", "mean_gap")
"""What is collected unless the document asks for something else."""


class _Range(Settings):
    """Values: a list, or ``count`` values from ``first`` to ``last``, equally spaced on a
    ``scale``."""

    values: Values | None = None
    first: str | int | float | None = None
    last: str | int | float | None = None
    count: Count | None = None
    scale: Literal["linear", "log"] | None = None

    @model_validator(mode="after")
    def _one_way(self) -> _Range:
        ends = [key for key in ("first", "last", "count") if getattr(self, key) is not None]
        if self.values is not None and (ends or self.scale is not None):
            raise InputError(
                f" must give values, or first, last and count, but gives values and {(*ends, 'scale')[0]}."
            )
        if self.values is None and len(ends) < 3:
            raise InputError(f" must give values, or first, last and count, but gives {' and '.join(ends) or 'none'}.")
        if self.values is not None and not self.values:
            raise InputError(".values must hold at least one value, but is empty.")
        return self


class AxisTable(_Range):
    """One scalar of the problem and its values; scalars named in ``also`` follow it.

    ``also`` gives for each further path as many values, or a number: that many times the value of
    this axis. With an ``expression`` the values are plain numbers, and it makes the scalar of them
    (by the name of the axis), other axes and letters.
    """

    path: NonEmpty
    name: NonEmpty | None = None
    also: dict[str, Values | Positive] = Field(default_factory=dict)
    expression: NonEmpty | None = None

    @model_validator(mode="after")
    def _named(self) -> AxisTable:
        if self.expression is not None and self.name is None:
            raise InputError(" must have a name for its values, because an expression takes them, but has none.")
        return self


class DerivedTable(Settings):
    """A number by an ``expression`` of letters, axes and quantities, and its ``label`` in words."""

    expression: NonEmpty
    label: str = ""


def _derived(value: object) -> object:
    return {"expression": value} if isinstance(value, str) else value


class RandomTable(Settings):
    """One uncertain scalar: ``seed`` (another whole number for every sample), or a distribution of
    a number.

    ``normal`` and ``lognormal`` have ``mean`` and standard ``deviation`` of the value itself,
    ``uniform`` runs from ``low`` to ``high``.
    """

    path: NonEmpty
    name: NonEmpty | None = None
    distribution: Literal["seed", "normal", "lognormal", "uniform"]
    mean: str | int | float | None = None
    deviation: str | int | float | None = None
    low: str | int | float | None = None
    high: str | int | float | None = None

    @model_validator(mode="after")
    def _its_keys(self) -> RandomTable:
        wanted = {"seed": (), "uniform": ("low", "high")}.get(self.distribution, ("mean", "deviation"))
        given = tuple(key for key in ("mean", "deviation", "low", "high") if getattr(self, key) is not None)
        if given != wanted:
            need = " and ".join(wanted) or "none of mean, deviation, low and high"
            raise InputError(f" must give {need} for {self.distribution}, but gives {' and '.join(given) or 'none'}.")
        return self


class StopTable(Settings):
    """Samples end when the confidence interval of the mean of ``quantity`` is narrow enough,
    everywhere on the other axes.

    Exactly one of ``width`` (SI units of the quantity) and ``relative_width``; both are half the
    interval.
    """

    quantity: NonEmpty
    width: Positive | None = None
    relative_width: Positive | None = None
    confidence: Fraction = 0.95
    at_least: Annotated[int, Whole(2)] = 8

    @model_validator(mode="after")
    def _one_width(self) -> StopTable:
        if (self.width is None) == (self.relative_width is None):
            given = "neither" if self.width is None else "both"
            raise InputError(f" must give exactly one of width and relative_width, but gives {given}.")
        return self


class MonteCarloTable(Settings):
    """Samples of random scalars, all from one ``seed``; at most ``samples``, or fewer where
    ``stop`` ends them."""

    seed: Seed
    samples: Count
    random: tuple[RandomTable, ...]
    stop: StopTable | None = None

    @model_validator(mode="after")
    def _something(self) -> MonteCarloTable:
        if not self.random:
            raise InputError(
                ".random must hold at least one scalar, but is empty; give the path of a seed or a modulus."
            )
        return self


class ConvergenceTable(Settings):
    """The same contact at several ``levels``, the coarsest first.

    ``of`` is ``"grid"`` (levels are numbers of points along x), ``"tolerance"`` (of the solver) or
    ``"domain"`` (factors on size and points at constant pixel).
    """

    of: Literal["grid", "tolerance", "domain"]
    levels: tuple[Positive, ...]

    @model_validator(mode="after")
    def _three(self) -> ConvergenceTable:
        if len(self.levels) < 3:
            raise InputError(f".levels must hold at least three levels, but holds {len(self.levels)}.")
        steps = [b - a for a, b in zip(self.levels, self.levels[1:], strict=False)]
        falling = self.of == "tolerance"
        if any(step >= 0 if falling else step <= 0 for step in steps):
            order = "fall" if falling else "rise"
            raise InputError(
                f".levels of {self.of} must {order}, so that the last is the finest, but are {list(self.levels)}."
            )
        return self


class CriticalThicknessTable(_Range):
    """Thicknesses of one layer, between which floor and ceiling are sought.

    ``share`` is how far a quantity may be from that without the layer (floor) or without what lies
    below (ceiling), as a share of the difference of both (Peng 2001, eq. 4.1).
    """

    layer: NonEmpty = "body.layers.0"
    share: Fraction = 0.05


class ParameterTable(Settings):
    """One scalar that is varied on its own: from ``low`` to ``high``, or by a ``change``, a share
    of its value."""

    path: NonEmpty
    low: str | int | float | None = None
    high: str | int | float | None = None
    change: Fraction | None = None

    @model_validator(mode="after")
    def _one_way(self) -> ParameterTable:
        if (self.low is None) != (self.high is None) or (self.low is not None and self.change is not None):
            raise InputError(" must give low and high, or a change, or none of them, but gives something else.")
        return self


def _parameters(value: object) -> object:
    if not isinstance(value, list | tuple):
        return value
    return tuple({"path": item} if isinstance(item, str) else item for item in value)


class SensitivityTable(Settings):
    """Every one of the ``parameters`` varied on its own, by the share ``change`` unless it gives
    its own range."""

    parameters: Annotated[tuple[ParameterTable, ...], BeforeValidator(_parameters)]
    change: Fraction = 0.05

    @model_validator(mode="after")
    def _something(self) -> SensitivityTable:
        if not self.parameters:
            raise InputError(".parameters must hold at least one path, but is empty.")
        return self


KINDS = ("monte_carlo", "convergence", "critical_thickness", "sensitivity")
"""Tables of which at most one determines the kind of study; without any it is a sweep. A design has
none of them but samples."""


class StudyDocument(Settings):
    """A study, as text: the ``problem`` (a table, or the path of a problem document), axes, and a
    kind.

    ``combine`` is ``"grid"`` for all combinations of the axes or ``"list"`` for their first values
    together, their second, and so on. ``letters`` name scalars by their paths, for the expressions
    of ``derived`` numbers and of axes; ``limits`` are what cases are held against.
    """

    version: Literal[1]
    title: str = ""
    problem: str | dict[str, Any]
    quantities: tuple[NonEmpty, ...] = DEFAULT_QUANTITIES
    combine: Literal["grid", "list"] = "grid"
    letters: dict[str, NonEmpty] = Field(default_factory=dict)
    derived: dict[str, Annotated[DerivedTable, BeforeValidator(_derived)]] = Field(default_factory=dict)
    limits: tuple[LimitTable, ...] = ()
    axes: tuple[AxisTable, ...] = ()
    monte_carlo: MonteCarloTable | None = None
    convergence: ConvergenceTable | None = None
    critical_thickness: CriticalThicknessTable | None = None
    sensitivity: SensitivityTable | None = None
    design: DesignTable | None = None
    calibration: CalibrationTable | None = None

    @property
    def kind(self) -> str:
        """Which of the ``KINDS`` it is, or ``"sweep"``, ``"design"`` or ``"calibration"``."""
        for own in ("design", "calibration"):
            if getattr(self, own) is not None:
                return own
        return next((kind for kind in KINDS if getattr(self, kind) is not None), "sweep")

    @model_validator(mode="after")
    def _one_kind(self) -> StudyDocument:
        given = [kind for kind in KINDS if getattr(self, kind) is not None]
        if len(given) > 1:
            raise InputError(
                f"study must have at most one of the tables {', '.join(KINDS)}, but has {' and '.join(given)}."
            )
        if self.design is not None and any(kind != "monte_carlo" for kind in given):
            raise InputError(f"study with the table design must leave out the table {given[0]}, but has it.")
        if self.calibration is not None and (given or self.axes or self.design is not None):
            raise InputError(
                "study with the table calibration must have no axes and no other such table, but has; the curve gives "
                "the cases."
            )
        if not given and not self.axes and self.design is None and self.calibration is None:
            raise InputError(f"study must have axes or one of the tables {', '.join(KINDS)}, but has none.")
        if not self.quantities:
            raise InputError("quantities must hold at least one name, such as area_fraction, but is empty.")
        return self
