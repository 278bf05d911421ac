"""Cone and wedge: the power-law indenters of exponent one by their slope (Sneddon 1965; Johnson 1985, secs. 5.1, 5.2)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from numpy.typing import ArrayLike

from .indenters import PowerLawIndenter
from .line_indenters import LinePowerLawIndenter
from .protocol import E_STAR, Input, Limit
from .single_contact import ContactAnswer
from .ways import LINE_LOAD, Way

SLOPE = Input("slope", "", "slope of the flanks against the surface, cotangent of the half-angle")


@dataclass(frozen=True)
class Cone:
    """Cone against an elastic half-space: a = 2δ/(π slope), P = (2/π) E* δ²/slope.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    slope
        Tangent of the angle between flank and surface, > 0; small.

    Examples
    --------
    >>> f"{Cone(1e9, 0.1).at_load(1e-3).approach:.4e}"
    '3.9633e-07'
    """

    E_star: float
    slope: float
    name: ClassVar[str] = "cone"
    title: ClassVar[str] = "Cone"
    citation_keys: ClassVar[tuple[str, ...]] = PowerLawIndenter.citation_keys
    inputs: ClassVar[tuple[Input, ...]] = (E_STAR, SLOPE)

    def __post_init__(self) -> None:
        _ = self.indenter

    @property
    def indenter(self) -> PowerLawIndenter:
        """The same as a power law."""
        return PowerLawIndenter(self.E_star, self.slope, 1.0)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N, >= 0, of any shape."""
        return self.indenter.at_load(load)

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """The slope must be small."""
        return self.indenter.validity(answer)


@dataclass(frozen=True)
class Wedge:
    """Wedge against an elastic half-space in plane strain.

    Parameters
    ----------
    E_star
        Contact modulus E* in Pa, > 0.
    slope
        Tangent of the angle between flank and surface, > 0; small.
    """

    E_star: float
    slope: float
    name: ClassVar[str] = "wedge"
    title: ClassVar[str] = "Wedge"
    citation_keys: ClassVar[tuple[str, ...]] = LinePowerLawIndenter.citation_keys
    inputs: ClassVar[tuple[Input, ...]] = (E_STAR, SLOPE)
    ways: ClassVar[tuple[Way, ...]] = (LINE_LOAD,)

    def __post_init__(self) -> None:
        _ = self.indenter

    @property
    def indenter(self) -> LinePowerLawIndenter:
        """The same as a power law."""
        return LinePowerLawIndenter(self.E_star, self.slope, 1.0)

    def at_load(self, load: ArrayLike) -> ContactAnswer:
        """The contact under ``load`` in N/m, >= 0, of any shape."""
        return self.indenter.at_load(load)

    def validity(self, answer: ContactAnswer) -> tuple[Limit, ...]:
        """The slope must be small."""
        return self.indenter.validity(answer)
