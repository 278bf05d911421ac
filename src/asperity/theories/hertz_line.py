"""Hertz's line contact of two parallel cylinders in plane strain (Hertz 1882; Johnson 1985, sec. 4.2c)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..core import require
from ..core.arrays import RealArray
from .hertz import hertz_profile
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer, checked, small_slope
from .ways import LINE_LOAD, Way


@dataclass(frozen=True)
class HertzLine:
    """Frictionless elastic contact of a cylinder of relative radius R: a² = 4PR/πE*, p0 = E*a/2R, p = p0 sqrt(1 - x²/a²).

    The approach of distant points depends on how the bodies are held (it grows with the logarithm of their size), so
    approach and stiffness are NaN.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    radius
        Relative radius of curvature R in m, > 0.
    """

    E_star: float
    radius: float
    name: ClassVar[str] = "hertz-line"
    title: ClassVar[str] = "Hertz, line contact"
    citation_keys: ClassVar[tuple[str, ...]] = ("Hertz1882", "Johnson1985")
    inputs: ClassVar[tuple[Input, ...]] = (
        E_STAR,
        Input("radius", "m", "relative radius of curvature"),
    )
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def __post_init__(self) -> None:
        require.positive(self.E_star, "contact modulus E_star (Pa)")
        require.positive(self.radius, "radius of curvature (m)")

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape."""
        P = checked(load, "load per length (N/m)")
        return self.at_half_width(np.sqrt(4.0 * P * self.radius / (np.pi * self.E_star)))

    def at_half_width(self, half_width: ArrayLike) -> ContactAnswer:
        """The contact of the ``half_width`` a in m, >= 0, of any shape."""
        a = checked(half_width, "half-width (m)")
        unknown = np.full_like(a, np.nan)
        return ContactAnswer(
            load=0.25 * np.pi * self.E_star * a**2 / self.radius,
            approach=unknown,
            radius=a,
            area=2.0 * a,
            max_pressure=0.5 * self.E_star * a / self.radius,
            stiffness=unknown,
        )

    def pressure(self, x: ArrayLike, load: float) -> RealArray:
        """Pressure in Pa at the distance ``x`` in m (any shape) from the middle under ``load`` in N/m, > 0."""
        answer = self.at_load(require.positive(load, "load per length (N/m)"))
        return hertz_profile(np.asarray(x, dtype=float), answer)

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """Slopes must be small: a/R <= 0.3."""
        return (small_slope("contact radius over radius of curvature", answer.radius / self.radius),)
