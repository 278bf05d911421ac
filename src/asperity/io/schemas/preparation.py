"""Preparation steps of a surface, carried out in the order in which they stand."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import AfterValidator, Field, model_validator

from ...core import require
from ...core.errors import InputError
from .values import LengthRange, Points, Table


def _width(value: float) -> float:
    return require.at_most(value, 0.5, "")


class Level(Table):
    """Remove the mean, a plane or a quadratic form."""

    step: Literal["level"]
    form: Literal["mean", "plane", "quadratic"] = "plane"


class Crop(Table):
    """Keep the rectangle between ``x`` and ``y``, each a pair of lengths from the corner."""

    step: Literal["crop"]
    x: LengthRange | None = None
    y: LengthRange | None = None

    @model_validator(mode="after")
    def _something(self) -> Crop:
        if self.x is None and self.y is None:
            raise InputError(' must give x or y or both, such as x = ["0 um", "5 um"], but gives neither.')
        return self


class Resample(Table):
    """Change the number of points at constant size."""

    step: Literal["resample"]
    points: Points


class Fill(Table):
    """Fill missing points; does nothing where none are missing."""

    step: Literal["fill"]
    method: Literal["harmonic", "mean", "nearest"] = "harmonic"


class Taper(Table):
    """Let the heights fall to their mean along the borders; ``width`` is a fraction of the side."""

    step: Literal["taper"]
    width: Annotated[float, AfterValidator(_width)] = 0.1


class Periodise(Table):
    """Remove the smooth component that carries the jumps between opposite borders."""

    step: Literal["periodise"]


Step: TypeAlias = Annotated[Level | Crop | Resample | Fill | Taper | Periodise, Field(discriminator="step")]
"""One preparation step, told apart by the key ``step``."""

__all__ = ["Crop", "Fill", "Level", "Periodise", "Resample", "Step", "Taper"]
