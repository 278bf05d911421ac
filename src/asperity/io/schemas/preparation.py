"""Preparation steps of a surface, carried out in the order in which they stand."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field, model_validator

from ...core.errors import InputError
from ...core.settings import Settings, setting
from ...core.values import Length, LengthRange, Number, Points, Positive, Whole
from ...surfaces.prepare.level import HIGHEST_DEGREE
from .values import PlaceOnMap

OddCount: TypeAlias = Annotated[int, Whole(3, odd=True)]
Degree: TypeAlias = Annotated[int, Whole(0, HIGHEST_DEGREE)]
Width: TypeAlias = Annotated[float, Number(above=0.0, most=0.5)]


class Level(Settings):
    """Remove a ``form`` (a plane by default) or a polynomial of total ``degree``; ``robust`` leaves out outliers."""

    step: Literal["level"]
    form: Literal["mean", "plane", "quadratic"] | None = None
    degree: Degree | None = None
    robust: bool = False

    @model_validator(mode="after")
    def _one_form(self) -> Level:
        if self.degree is not None and self.form is not None:
            raise InputError(" must give form or degree, but gives both.")
        return self


class Despike(Settings):
    """Mask points far from the median of their surroundings, by ``threshold`` standard deviations; fill them afterwards."""

    step: Literal["despike"]
    threshold: Positive = 6.0
    window: OddCount = 5


class LineCorrect(Settings):
    """Remove the offsets between the scan lines, which run along the fast ``axis``."""

    step: Literal["line_correct"]
    axis: Literal["x", "y"] = "x"


class Filter(Settings):
    """Remove the waves shorter than ``short`` and longer than ``long``; ``short_y``, ``long_y`` where y differs from x."""

    step: Literal["filter"]
    short: Length | None = None
    short_y: Length | None = None
    long: Length | None = None
    long_y: Length | None = None
    kind: Literal["gaussian", "robust", "sharp"] = "gaussian"
    order: Literal[0, 1, 2] = 0

    @model_validator(mode="after")
    def _something(self) -> Filter:
        if self.short is None and self.long is None:
            raise InputError(' must give short or long or both, such as short = "1 um", but gives neither.')
        for along_x, along_y in (("short", "short_y"), ("long", "long_y")):
            if getattr(self, along_y) is not None and getattr(self, along_x) is None:
                raise InputError(f" must give {along_x} together with {along_y}, but gives only {along_y}.")
        return self


class TipLimit(Settings):
    """Remove the waves that a tip of this ``radius`` may have shaped."""

    step: Literal["tip_limit"]
    radius: Length


class Crop(Settings):
    """Keep the rectangle between ``x`` and ``y``, each a pair of lengths from the corner."""

    step: Literal["crop"]
    x: LengthRange | None = None
    y: LengthRange | None = None

    @model_validator(mode="after")
    def _something(self) -> Crop:
        if self.x is None and self.y is None:
            raise InputError(' must give x or y or both, such as x = ["0 um", "5 um"], but gives neither.')
        return self


class Resample(Settings):
    """Change the number of points at constant size."""

    step: Literal["resample"]
    points: Points


class Fill(Settings):
    """Fill missing points; does nothing where none are missing."""

    step: Literal["fill"]
    method: Literal["harmonic", "mean", "nearest"] = "harmonic"


class Taper(Settings):
    """Let the heights fall to their mean along the borders; ``width`` is a fraction of the side."""

    step: Literal["taper"]
    width: Width = 0.1


class Periodise(Settings):
    """Remove the smooth component that carries the jumps between opposite borders."""

    step: Literal["periodise"]


class Slice(Settings):
    """Keep one line, that at ``y`` or that at ``x``, as a surface of one row, for line contact.

    ``length`` is the length along the contact that forces and areas belong to: per metre by default.
    """

    step: Literal["slice"]
    x: PlaceOnMap | None = None
    y: PlaceOnMap | None = None
    length: Length = setting("1 m")

    @model_validator(mode="after")
    def _one(self) -> Slice:
        if (self.x is None) == (self.y is None):
            given = "none" if self.x is None else "both"
            raise InputError(f' must give exactly one of x and y, such as y = "middle", but gives {given}.')
        return self


Step: TypeAlias = Annotated[
    Level | Crop | Resample | Fill | Despike | LineCorrect | Filter | TipLimit | Taper | Periodise | Slice,
    Field(discriminator="step"),
]
"""One preparation step, told apart by the key ``step``."""
