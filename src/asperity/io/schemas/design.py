"""The table [design] of a study document: what may be chosen, what is to be best, and what must
hold."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings
from ...core.values import Count, Fraction, NonEmpty, NonNegative, Positive, Seed, Whole
from .axis_values import LimitTable, Values


class VariableTable(Settings):
    """One scalar of the problem that may be chosen: a number from ``low`` to ``high``, or one of
    the ``choices``.

    A number is sought from ``start``, by default the value in the problem, on a ``scale``, by
    default the logarithm where ``low`` is positive. Scalars named in ``also`` follow: each a number
    of times the value, or of choices a list.
    """

    path: NonEmpty
    name: NonEmpty | None = None
    low: str | int | float | None = None
    high: str | int | float | None = None
    start: str | int | float | None = None
    scale: Literal["linear", "log"] | None = None
    choices: Values | None = None
    also: dict[str, Values | Positive] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _one_way(self) -> VariableTable:
        given = [key for key in ("low", "high") if getattr(self, key) is not None]
        if (self.choices is None and len(given) < 2) or (self.choices is not None and given):
            both = ("choices", *given) if self.choices is not None else given
            raise InputError(f" must give low and high, or choices, but gives {' and '.join(both) or 'none'}.")
        if self.choices is not None and (self.start is not None or self.scale is not None):
            raise InputError(" must leave out start and scale with choices, but gives one of them.")
        if self.choices is not None and len(self.choices) < 2:
            raise InputError(f".choices must hold at least two values, but holds {len(self.choices)}.")
        return self


Over = Literal["worst", "each", "mean"]
"""What is taken of the cases of a study: the worst of them, each by itself, or their mean."""


class ConstraintTable(LimitTable):
    """A limit of a quantity that must hold.

    ``over`` says of which cases: the worst, each by itself, or their mean; ``at`` takes those at
    given values of the axes of the study.
    """

    over: Over = "worst"
    at: dict[str, str | int | float] = Field(default_factory=dict)


class GoalTable(Settings):
    """What is to be as small or as large as can be: a quantity, or the path or name of a
    variable."""

    minimise: NonEmpty | None = None
    maximise: NonEmpty | None = None
    over: Literal["worst", "mean"] = "worst"
    at: dict[str, str | int | float] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _one_goal(self) -> GoalTable:
        if (self.minimise is None) == (self.maximise is None):
            given = "neither" if self.minimise is None else "both"
            raise InputError(f" must give exactly one of minimise and maximise, but gives {given}.")
        return self


class ParetoTable(GoalTable):
    """A second objective: the best of the first at ``points`` limits of this one."""

    points: Annotated[int, Whole(3)] = 7


class DesignTable(GoalTable):
    """A design: ``variables`` within their bounds that make the objective best while all
    ``constraints`` hold.

    Axes of the study are the cases it must do for. With samples, numbers are their mean, less or
    more ``robust`` standard deviations, whichever is worse. ``step`` is the relative step of
    differences, ``tolerance`` the relative change of the objective at which the search ends, above
    the noise of the grid. ``population`` and ``generations`` bound an evolution.
    """

    variables: tuple[VariableTable, ...]
    constraints: tuple[ConstraintTable, ...] = ()
    pareto: ParetoTable | None = None
    robust: NonNegative = 0.0
    method: Literal["auto", "slsqp", "trust-constr", "evolution"] = "auto"
    starts: Count = 3
    population: Annotated[int, Whole(5, 1000)] | None = None
    generations: Annotated[int, Whole(1, 1000)] = 30
    seed: Seed = 1
    tolerance: Fraction = 1e-3
    step: Fraction = 0.05
    max_iterations: Count = 40

    @model_validator(mode="after")
    def _something(self) -> DesignTable:
        if not self.variables:
            raise InputError(".variables must hold at least one scalar, but is empty.")
        return self
