"""The table [calibration] of a study document: what is fitted to which measured curve."""

from __future__ import annotations

from pydantic import Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings
from ...core.values import Count, Fraction, NonEmpty, Positive, Seed


class FittedTable(Settings):
    """One scalar of the problem that is fitted, from ``low`` to ``high``, which are positive.

    It is sought from ``start``, by default the value in the problem. A ``prior`` is what is known
    of it before, with the relative standard ``deviation``. Scalars named in ``also`` follow, each
    that many times.
    """

    path: NonEmpty
    name: NonEmpty | None = None
    low: str | int | float
    high: str | int | float
    start: str | int | float | None = None
    prior: str | int | float | None = None
    deviation: Positive | None = None
    also: dict[str, Positive] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _whole_prior(self) -> FittedTable:
        if (self.prior is None) != (self.deviation is None):
            given = "prior" if self.deviation is None else "deviation"
            raise InputError(f" must give prior and deviation, or none of them, but gives {given} alone.")
        return self


class CalibrationTable(Settings):
    """Parameters of a contact from a measured curve.

    ``curve`` is a file of columns with units in its head, the first of which is prescribed.
    ``noise`` is the relative standard deviation of the others where they have no column of their
    own for it.
    """

    curve: NonEmpty
    parameters: tuple[FittedTable, ...]
    noise: Fraction = 0.01
    starts: Count = 1
    seed: Seed = 1
    tolerance: Fraction = 1e-4
    step: Fraction = 0.02
    max_iterations: Count = 30

    @model_validator(mode="after")
    def _something(self) -> CalibrationTable:
        if not self.parameters:
            raise InputError(".parameters must hold at least one scalar, but is empty.")
        return self
